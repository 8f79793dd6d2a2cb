// Bullet's position-based soft-body world.
#include <BulletSoftBody/btSoftBodySolvers.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "mysim/errors.h"
#include "reference/bullet/body_world.h"
#include "reference/bullet/worlds.h"

namespace crosscheck::bullet {
namespace {

/// kLST of a link of stiffness k between particles of reduced mass mu: one link, relaxed n times, is backward Euler.
double link_stiffness(double k, double mu, double h, int n) {
  return std::isinf(mu) ? 1 : -std::expm1(-std::log1p(k * h * h / mu) / n);
}

/// The stiffness (N/m) that kLST stands for: the inverse of link_stiffness.
double newton_per_metre(double kLST, double mu, double h, int n) {
  return mu / (h * h) * std::expm1(-n * std::log1p(-kLST));
}

class PbdWorld : public BodyWorld<btSoftRigidDynamicsWorld> {
 public:
  PbdWorld(const Scene& scene, double h, int iterations) : BodyWorld(scene, h), iterations_(iterations) {
    const Model& model = scene.model;
    const std::optional<double> rate = uniform_drag_rate(model);
    if (!rate) throw Unsupported("Bullet's position-based world has one drag rate for the whole body");

    world_ = std::make_unique<btSoftRigidDynamicsWorld>(&stage_.dispatcher, &stage_.broadphase, &solver_,
                                                        &stage_.configuration);
    btSoftBodyWorldInfo& info = world_->getWorldInfo();
    // its default voxel of 0.25 m would misplace the sphere by 1.5 cm
    info.m_sparsesdf.setDefaultVoxelsz(0.02);
    info.m_sparsesdf.Reset();
    const auto* gravity = model.find<Gravity>();
    info.m_gravity = gravity ? to_bullet(gravity->acceleration) : btVector3(0, 0, 0);
    info.m_dispatcher = &stage_.dispatcher;
    info.m_broadphase = &stage_.broadphase;

    scene_body_ = std::make_unique<SceneBody>(scene, info);
    set_stiffness();
    auto& cfg = body().m_cfg;
    cfg.piterations = iterations_;
    cfg.viterations = 0;
    cfg.kDP = -std::expm1(-*rate * h_);
    cfg.kKHR = 0.1;  // at 1 contacts bounce, at 0 links pull nodes into the sphere
    cfg.collisions = btSoftBody::fCollision::SDF_RS;
    enter();

    mapped_["stiffness"] = fmt::format("kLST = 1 - (1 + k h^2 / mu)^(-1/{})", iterations_);
    if (*rate > 0) mapped_["drag"] = fmt::format("kDP = 1 - exp(-gamma h) = {:.6g}", double(cfg.kDP));
    if (gravity) mapped_["gravity"] = "world info, g as it is";
    if (model.find<Wind>()) mapped_["wind"] = "added force m a(t) on each node";
  }

  ~PbdWorld() override { tear_down(); }

  void step(double t, double t_next) override {
    const Particles& particles = scene_.model.particles;
    if (const auto* wind = scene_.model.find<Wind>()) {
      const btVector3 a = to_bullet(wind->acceleration.at(t));
      for (int i = 0; i < particles.size(); ++i)
        if (!particles.pinned[i]) body().addForce(a * particles.mass[i], scene_body_->node_of(i));
    }
    scene_body_->place_pins(t_next);  // links are solved at the end of the step
    world_->stepSimulation(h_, 0);
  }

  std::optional<Readback> read_back() override {
    Readback r = scene_body_->read_back();
    const auto& cfg = body().m_cfg;
    if (const auto* springs = scene_.model.find<Springs>())
      for (size_t l = 0; l < springs->list.size(); ++l) {
        const double mu = pair_mass(scene_.model.particles, springs->list[l]);
        const double kLST = body().m_links[static_cast<int>(l)].m_material->m_kLST;
        r.links[l].stiffness = std::isinf(mu) ? springs->list[l].k : newton_per_metre(kLST, mu, h_, cfg.piterations);
      }
    if (scene_.model.find<Gravity>()) r.gravity = from_bullet(world_->getWorldInfo().m_gravity);
    if (scene_.model.find<Drag>())
      r.drag = std::vector<double>(scene_.model.particles.size(), -std::log1p(-cfg.kDP) / h_);
    read_obstacle(r);
    r.mapped = mapped_;
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
        material->m_kLST = kLST;
      }
      body().m_links[l++].m_material = material;
    };
    if (const auto* springs = scene_.model.find<Springs>())
      for (const Spring& s : springs->list)
        set(link_stiffness(s.k, pair_mass(scene_.model.particles, s), h_, iterations_));
    if (const auto* constraints = scene_.model.find<Constraints>())
      for (size_t c = 0; c < constraints->list.size(); ++c) set(1);  // the whole distance in each iteration
    body().updateLinkConstants();
    scene_body_->restore_lengths();
  }

  int iterations_;
  std::map<std::string, std::string> mapped_;
  btSequentialImpulseConstraintSolver solver_;
};

}  // namespace

Outcome run_pbd(const Scene& scene, const Run& run, Observer& observer, int iterations) {
  PbdWorld world(scene, plan(run).h, iterations);
  Outcome out = march(world, run, observer);
  out.evaluations = out.steps;
  if (const auto* springs = scene.model.find<Springs>())
    out.different_law.push_back(
        fmt::format("springs: position-based links {}are solved like an implicit step, one after the other",
                    springs->law == SpringLaw::hooke
                        ? "pull with k L (L^2 - r^2) / (L^2 + r^2), about k (L - r) for small strains, and "
                        : ""));
  if (scene.model.find<Constraints>())
    out.different_law.push_back(
        "hard distances: each is met at its turn, and spoilt by the next ones; more iterations help");
  if (scene.model.find<Spheres>())
    out.different_law.push_back(
        "friction: a touching node loses a fixed share of its tangential motion in each step, whatever "
        "presses it on; Coulomb's law is not followed");
  return out;
}

}  // namespace crosscheck::bullet
