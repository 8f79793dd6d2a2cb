#include "reference/bullet/pbd.h"

#include <BulletSoftBody/btSoftBodySolvers.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "mysim/base/errors.h"
#include "reference/bullet/parameters.h"
#include "reference/bullet/soft_body.h"

namespace crosscheck::bullet {
namespace {

std::string gravity_text(const BulletDefaults& defaults) {
  return defaults.gravity_factor == 1
             ? "world info, g unchanged"
             : fmt::format("world info, g / {0:g}, and {0:g} as the body's gravity factor", defaults.gravity_factor);
}

class PbdWorld : public SoftBodyWorld<btSoftRigidDynamicsWorld> {
 public:
  PbdWorld(const Scene& scene, double h, const PbdSettings& settings)
      : SoftBodyWorld(scene, h, settings.defaults), settings_(settings) {
    const Model& model = scene.model;
    const std::optional<double> rate = uniform_drag_rate(model);
    if (!rate) throw Unsupported("Bullet's position-based world has one drag rate for the whole body");
    if (settings.own_wind && !model.find<Aerodynamics>())
      throw Unsupported("Bullet's own wind presses on triangles: the scene has none");

    world_ = std::make_unique<btSoftRigidDynamicsWorld>(&collision_.dispatcher, &collision_.broadphase, &solver_,
                                                        &collision_.configuration);
    btSoftBodyWorldInfo& info = world_->getWorldInfo();
    info.m_sparsesdf.setDefaultVoxelsz(static_cast<btScalar>(settings.voxel));
    info.m_sparsesdf.Reset();
    const auto* gravity = model.find<Gravity>();
    info.m_gravity = gravity ? to_bullet(gravity->acceleration / settings.defaults.gravity_factor) : btVector3(0, 0, 0);
    info.m_dispatcher = &collision_.dispatcher;
    info.m_broadphase = &collision_.broadphase;

    soft_body_ = std::make_unique<SoftBody>(scene, info, settings.defaults);
    if (!settings.defaults.kLST) set_stiffness();
    auto& cfg = body().m_cfg;
    cfg.piterations = settings.iterations;
    cfg.viterations = 0;
    cfg.kDP = static_cast<btScalar>(damping_of_drag(*rate, h_));
    cfg.kKHR = btScalar(0.1);  // at 1, contacts bounce; at 0, links pull nodes into the sphere
    cfg.collisions = btSoftBody::fCollision::SDF_RS;
    if (settings.own_wind) use_own_wind(*model.find<Aerodynamics>());
    add_to_world();

    mapped_["stiffness"] = settings.defaults.kLST
                               ? fmt::format("kLST = {:g}, regardless of the scene", *settings.defaults.kLST)
                           : settings.demo ? "kLST = 1, the default of Bullet's demos, regardless of the scene"
                                           : link_stiffness_text(settings.iterations);
    const char *added = "added forces on the nodes at x_n, v_n",
               *own = "Bullet's own model of lift and drag on two sides, C as drag";
    const Overloaded tell{
        [&](const Gravity&) { mapped_["gravity"] = gravity_text(settings.defaults); },
        [&](const Drag&) { mapped_["drag"] = fmt::format("kDP = 1 - exp(-gamma h) = {:.6g}", double(cfg.kDP)); },
        [&](const Wind&) { mapped_["wind"] = "added force m a(t) on each node"; },
        [&](const Bending&) { mapped_["bending"] = added; },
        [&](const Dashpots&) { mapped_["dashpots"] = added; },
        [&](const Aerodynamics&) { mapped_["wind on triangles"] = settings.own_wind ? own : added; },
        [](const OneOf<Springs, Constraints> auto&) {},  // links, see above
        [](const OneOf<Spheres, Planes> auto&) {},       // soft_body.h
        [](const Rotation&) {},                          // refused before a world is built
    };
    for (const Term& term : model.terms) std::visit(tell, term);
    for (const char* each : {"bending", "wind", "dashpots", "wind on triangles"})
      has_added_forces_ = has_added_forces_ || mapped_.contains(each);
  }

  ~PbdWorld() override { remove_all(); }

  void step(double t, double t_next) override {
    if (has_added_forces_) add_forces(t, {.bending = true, .dashpots = true, .winds = true});
    if (settings_.own_wind) body().setWindVelocity(to_bullet(scene_.model.find<Aerodynamics>()->velocity.at(t)));
    soft_body_->place_pins(t_next);  // links are solved at the end of the step
    obstacles_.place(t_next);
    world_->stepSimulation(static_cast<btScalar>(h_), 0);
  }

  std::optional<Readback> read_back() override {
    Readback r = soft_body_->read_back();
    const auto& cfg = body().m_cfg;
    if (const auto* springs = scene_.model.find<Springs>(); springs && !settings_.demo && !settings_.defaults.kLST)
      for (size_t l = 0; l < springs->list.size(); ++l) {
        const double mu = pair_mass(scene_.model.particles, springs->list[l]);
        const double kLST = body().m_links[static_cast<int>(l)].m_material->m_kLST;
        r.links[l].stiffness = std::isinf(mu) ? springs->list[l].k : newton_per_metre(kLST, mu, h_, cfg.piterations);
      }
    r.gravity = from_bullet(world_->getWorldInfo().m_gravity) * double(body().m_gravityFactor);
    r.drag = std::vector<double>(scene_.model.particles.size(), drag_of_damping(cfg.kDP, h_));
    obstacles_.read_back(*world_, body(), r);
    r.later = prescribed_places();
    r.probe = probe(0);
    r.mapped.insert(mapped_.begin(), mapped_.end());
    r.settings["iterations"] = std::to_string(cfg.piterations);
    return r;
  }

 private:
  void set_stiffness() {
    std::map<double, btSoftBody::Material*> materials;
    int l = 0;
    auto set = [&](double kLST) {
      auto& material = materials[kLST];
      if (!material) {
        material = body().appendMaterial();
        material->m_kLST = static_cast<btScalar>(kLST);
      }
      body().m_links[l++].m_material = material;
    };
    if (const auto* springs = scene_.model.find<Springs>())
      for (const Spring& s : springs->list)
        set(settings_.demo ? 1 : link_stiffness(s.k, pair_mass(scene_.model.particles, s), h_, settings_.iterations));
    if (const auto* constraints = scene_.model.find<Constraints>())
      for (size_t c = 0; c < constraints->list.size(); ++c) set(1);  // each iteration removes the whole error
    body().updateLinkConstants();
    soft_body_->restore_lengths();
  }

  void use_own_wind(const Aerodynamics& air) {
    for (const auto& [a, b, c] : air.triangles)
      body().appendFace(soft_body_->node_of(a), soft_body_->node_of(b), soft_body_->node_of(c));
    world_->getWorldInfo().air_density = static_cast<btScalar>(air.density);
    body().m_cfg.aeromodel = btSoftBody::eAeroModel::F_TwoSidedLiftDrag;
    body().m_cfg.kDG = static_cast<btScalar>(air.coefficient);
  }

  /// Terms that links cannot represent. They act for one step, as forces on the nodes in their current state.
  struct Wanted {
    bool bending = false, dashpots = false, winds = false;
  };
  void add_forces(double t, const Wanted& wanted) {
    const Model& model = scene_.model;
    added_.f.setZero(3, model.particles.size());
    const State& now = soft_body_->read_state(t);
    const Overloaded add{
        [&](const Wind& wind) {
          if (wanted.winds) add_force(wind, model.particles, now, added_);
        },
        [&](const Aerodynamics& air) {
          if (wanted.winds && !settings_.own_wind) add_force(air, model.particles, now, added_);
        },
        [&](const Bending& bending) {
          if (wanted.bending) add_force(bending, model.particles, now, added_);
        },
        [&](const Dashpots& pairs) {
          if (wanted.dashpots) add_force(pairs, model.particles, now, added_);
        },
        [](const OneOf<Rotation, Gravity, Springs, Constraints, Drag, Spheres, Planes> auto&) {},  // Bullet's own
    };
    for (const Term& term : model.terms) std::visit(add, term);
    for (int i = 0; i < model.particles.size(); ++i)
      if (!model.particles.pinned[i]) body().addForce(to_bullet(added_.f.col(i)), soft_body_->node_of(i));
  }

  /// Forces on the nodes in a known state; springs are not forces in this world.
  ForceProbe probe(double t) {
    ProbeState placed(scene_, *soft_body_, t);
    using Stack = btAlignedObjectArray<btVector3>;
    Stack none, bending, dashpots, winds;
    auto take = [&](Stack& forces) {
      for (int i = 0; i < body().m_nodes.size(); ++i) {
        forces.push_back(body().m_nodes[i].m_f);
        body().m_nodes[i].m_f = btVector3(0, 0, 0);
      }
    };
    add_forces(t, {.bending = true});
    take(bending);
    add_forces(t, {.dashpots = true});
    take(dashpots);
    placed.stop();
    add_forces(t, {.winds = true});
    if (!settings_.own_wind) take(winds);
    return placed.probe(none, bending, dashpots, winds);
  }

  PbdSettings settings_;
  std::map<std::string, std::string> mapped_;
  bool has_added_forces_ = false;
  Forces added_;  // N
  btSequentialImpulseConstraintSolver solver_;
};

}  // namespace

Outcome run_pbd(const Scene& scene, const Run& run, Observer& observer, const PbdSettings& settings) {
  PbdWorld world(scene, time_grid(run).h, settings);
  Outcome out = run_loop(world, run, observer);
  out.evaluations = out.steps;
  if (const auto* springs = scene.model.find<Springs>())
    out.different_law.push_back(
        settings.demo || settings.defaults.kLST
            ? "springs: the stiffness of links depends on the iterations, not on the scene's stiffness"
            : fmt::format("springs: position-based links {}are solved like an implicit step, one after the other",
                          springs->law == SpringLaw::hooke
                              ? "pull with k L (L^2 - r^2) / (L^2 + r^2), about k (L - r) for small strains, and "
                              : ""));
  if (scene.model.find<Constraints>())
    out.different_law.push_back(
        "hard distances: each is satisfied in turn and violated again by the next ones; more iterations help");
  if (settings.own_wind)
    out.different_law.push_back(
        "wind on triangles: Bullet's own drag acts along the wind and is limited by each node's speed, so that it "
        "does not begin on a cloth at rest");
  if (scene.model.find<Spheres>())
    out.different_law.push_back(
        "contact: at any step, normals are gradients of a grid of distances, which are off by up to a / 2R = " +
        normal_error_text(scene, settings.voxel));
  if (has_contact(scene.model))
    out.different_law.push_back(
        "friction: a touching node loses a fixed share of its tangential motion in each step, regardless of "
        "the normal force, instead of Coulomb's law");
  return out;
}

}  // namespace crosscheck::bullet
