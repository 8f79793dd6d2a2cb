// Jolt's soft body, compiled natively, as a program of the engine protocol: one body among static balls, with the
// options and laws of npm's build. jolt.mjs explains them and each changed default.
#include <Jolt/Jolt.h>  // must precede all other headers of Jolt

#include <Jolt/ConfigurationString.h>
#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <Jolt/Physics/SoftBody/SoftBodyCreationSettings.h>
#include <Jolt/Physics/SoftBody/SoftBodyMotionProperties.h>
#include <Jolt/RegisterTypes.h>

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

constexpr JPH::ObjectLayer layer = 0;
constexpr JPH::uint memory = 32 << 20;  // bytes for temporary data of a step; larger needs use the heap

JPH::Vec3 to_jolt(const Vec& v) { return {float(v[0]), float(v[1]), float(v[2])}; }
template <class Vector>
Vec from_jolt(const Vector& v) {
  return {v.GetX(), v.GetY(), v.GetZ()};
}

struct Vertex {
  Vec x, v;             // position (m, in the scene's frame) and velocity (m/s)
  double inverse_mass;  // 1/kg; 0: held
};

class SoftBody {
 public:
  /// `origin` (m) of the body's frame, in which positions are rounded to single precision. `damping`: 1/s.
  SoftBody(const std::vector<Vertex>& vertices, const std::vector<Spring>& edges, const std::vector<Sphere>& spheres,
           const Vec& origin, int iterations, double damping) {
    pairs_.EnableCollision(layer, layer);
    layers_.MapObjectToBroadPhaseLayer(layer, JPH::BroadPhaseLayer(0));
    filter_ = std::make_unique<JPH::ObjectVsBroadPhaseLayerFilterTable>(layers_, 1, pairs_, 1);
    const auto bodies = static_cast<JPH::uint>(spheres.size() + 1);
    system.Init(bodies, 0, bodies * bodies, bodies * bodies, layers_, *filter_, pairs_);
    JPH::Ref<JPH::SoftBodySharedSettings> shared = new JPH::SoftBodySharedSettings;
    for (const Vertex& vertex : vertices) {
      JPH::SoftBodySharedSettings::Vertex made;
      to_jolt(vertex.x - origin).StoreFloat3(&made.mPosition);
      to_jolt(vertex.v).StoreFloat3(&made.mVelocity);
      made.mInvMass = float(vertex.inverse_mass);
      shared->mVertices.push_back(made);
    }
    for (const Spring& edge : edges) {
      JPH::SoftBodySharedSettings::Edge made(edge.a, edge.b, float(1 / edge.stiffness));
      made.mRestLength = float(edge.rest_length);
      shared->mEdgeConstraints.push_back(made);
    }
    shared->Optimize();
    const JPH::RVec3 position(origin[0], origin[1], origin[2]);
    JPH::SoftBodyCreationSettings creation(shared, position, JPH::Quat::sIdentity(), layer);
    creation.mNumIterations = static_cast<JPH::uint32>(iterations);
    creation.mLinearDamping = float(damping);
    creation.mMaxLinearVelocity = 1e15f;  // m/s
    creation.mUpdatePosition = false;
    creation.mAllowSleeping = false;
    creation.mFriction = 1;
    creation.mRestitution = 0;
    JPH::BodyInterface& all = system.GetBodyInterface();
    body = all.CreateSoftBody(creation);
    if (!body) throw std::runtime_error("Jolt could not create the soft body");
    all.AddBody(body->GetID(), JPH::EActivation::Activate);
    for (const Sphere& s : spheres) {
      const JPH::RVec3 centre(s.centre[0], s.centre[1], s.centre[2]);
      JPH::BodyCreationSettings sphere(new JPH::SphereShape(float(s.contact_radius())), centre, JPH::Quat::sIdentity(),
                                       JPH::EMotionType::Static, layer);
      sphere.mFriction = float(s.friction * s.friction);
      sphere.mRestitution = float(s.restitution);
      balls.push_back(all.CreateBody(sphere));
      if (!balls.back()) throw std::runtime_error("Jolt could not create a ball");
      all.AddBody(balls.back()->GetID(), JPH::EActivation::DontActivate);
    }
  }
  SoftBody(const SoftBody&) = delete;
  SoftBody& operator=(const SoftBody&) = delete;
  ~SoftBody() {
    balls.push_back(body);
    for (JPH::Body* one : balls) {
      system.GetBodyInterface().RemoveBody(one->GetID());
      system.GetBodyInterface().DestroyBody(one->GetID());
    }
  }

  void step(double h) {
    if (system.Update(float(h), 1, &temporary_, &jobs_) != JPH::EPhysicsUpdateError::None)
      throw std::runtime_error("Jolt ran out of contact buffers");
  }
  JPH::SoftBodyMotionProperties& motion() const {
    return *static_cast<JPH::SoftBodyMotionProperties*>(body->GetMotionProperties());
  }
  JPH::SoftBodyVertex& vertex(int i) const { return motion().GetVertex(static_cast<JPH::uint>(i)); }
  Vec origin() const { return from_jolt(body->GetCenterOfMassPosition()); }

  JPH::PhysicsSystem system;
  JPH::Body* body = nullptr;
  std::vector<JPH::Body*> balls;

 private:
  JPH::ObjectLayerPairFilterTable pairs_{1};
  JPH::BroadPhaseLayerInterfaceTable layers_{1, 1};
  std::unique_ptr<JPH::ObjectVsBroadPhaseLayerFilterTable> filter_;
  JPH::TempAllocatorImplWithMallocFallback temporary_{memory};
  JPH::JobSystemSingleThreaded jobs_{JPH::cMaxPhysicsJobs};
};

/// Refuses unsupported ingredients. Returns the linear damping (1/s).
double supported_damping(const Scene& scene, int iterations) {
  for (const auto& [term, why] :
       {std::pair("bending", "Jolt bends by angles between triangles, not by a rigidity in N m"),
        std::pair("dashpots", "Jolt damps velocities only, not along springs"),
        std::pair("aerodynamics", "Jolt has no aerodynamic forces on triangles")})
    if (scene.term(term)) unsupported(std::string("not in Jolt: ") + term + ": " + why);
  scene.require_only({"springs", "constraints", "gravity", "drag", "wind", "sphere"});
  if (scene.spring_law != "hooke") unsupported("springs of the law " + scene.spring_law + ": Jolt has only Hooke's");
  scene.require_resting_surfaces("in contact, Jolt treats the velocity of a kinematic sphere as zero");
  std::optional<double> rate;
  for (size_t i = 0; i < scene.x.size(); ++i) {
    if (scene.pinned[i]) continue;
    const double gamma = scene.drag[i] / scene.mass[i];
    // rates recovered from c = m gamma differ by up to a few roundings
    if (rate && std::abs(gamma - *rate) > 4 * std::numeric_limits<double>::epsilon() * *rate)
      unsupported("drag that differs between particles: Jolt has one damping (1/s) per body");
    if (!rate) rate = gamma;
  }
  if (rate.value_or(0) * scene.step >= iterations) unsupported("drag that removes all speed in one sub-step");
  return rate.value_or(0);
}

/// Springs, then hard distances, which are infinitely stiff.
std::vector<Spring> edges_of(const Scene& scene) {
  std::vector<Spring> edges = scene.springs;
  edges.insert(edges.end(), scene.constraints.begin(), scene.constraints.end());
  return edges;
}

std::vector<Vertex> vertices_of(const Scene& scene) {
  std::vector<Vertex> vertices;
  for (size_t i = 0; i < scene.x.size(); ++i)
    vertices.push_back({scene.x[i], scene.v[i], scene.pinned[i] ? 0 : 1 / scene.mass[i]});
  return vertices;
}

/// Middle of the scene's bounding box (m, single precision), relative to which coordinates are smallest.
Vec middle_of(const Scene& scene) {
  Vec low = scene.x.at(0), high = low;
  for (const Vec& x : scene.x)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  return {float((low[0] + high[0]) / 2), float((low[1] + high[1]) / 2), float((low[2] + high[2]) / 2)};
}

/// Spring forces (N) at x as Jolt computes them, measured as in jolt.mjs.
std::vector<Vec> spring_forces(const Scene& scene, const std::vector<Vec>& x) {
  std::vector<Vec> forces(x.size(), Vec{});
  constexpr double d = 1. / 1024;  // s
  constexpr size_t at_once = 500;  // Jolt sorts a body's edges in time quadratic in their number
  const std::vector<Spring>& all = scene.springs;
  for (size_t first = 0; first < all.size(); first += at_once) {
    const int count = static_cast<int>(std::min(at_once, all.size() - first));
    std::vector<Vertex> vertices;
    std::vector<Spring> edges;
    for (int i = 0; i < count; ++i) {
      const Spring& s = all[first + i];
      vertices.push_back({{}, {}, 1e-6 / (s.stiffness * d * d)});
      vertices.push_back({x[s.b] - x[s.a], {}, 0});
      edges.push_back({2 * i, 2 * i + 1, s.stiffness, s.rest_length});
    }
    SoftBody body(vertices, edges, {}, {}, 1, 0);
    body.system.SetGravity(JPH::Vec3::sZero());
    body.step(d);
    for (int i = 0; i < count; ++i) {
      const JPH::SoftBodyVertex& vertex = body.vertex(2 * i);
      const Vec force = 1 / (double(vertex.mInvMass) * d * d) * from_jolt(vertex.mPosition);
      forces[all[first + i].a] = forces[all[first + i].a] + force;
      forces[all[first + i].b] = forces[all[first + i].b] - force;
    }
  }
  return forces;
}

class JoltWorld : public World {
 public:
  JoltWorld(const Scene& scene, int iterations, bool frame_of_world)
      : scene_(scene),
        frame_(frame_of_world ? "world" : "scene"),
        body_(vertices_of(scene), edges_of(scene), scene.spheres, frame_of_world ? Vec{} : middle_of(scene), iterations,
              supported_damping(scene, iterations)) {
    body_.system.SetGravity(to_jolt(scene.gravity));
  }

  void step(double t) override {
    // gravity and wind give all free particles the same acceleration
    if (scene_.wind) body_.system.SetGravity(to_jolt(scene_.gravity + scene_.wind_at(t)));
    const double h = scene_.step;
    // jolt.mjs explains why held vertices get both velocity and position
    const Motion& motion = scene_.pin_motion;
    if (scene_.pins_move)
      for (const int pin : scene_.pins)
        body_.vertex(pin).mVelocity = to_jolt(1 / h * (motion.displacement(t + h) - motion.displacement(t)));
    body_.step(h);
    for (size_t p = 0; p < scene_.pins.size() && scene_.pins_move; ++p)
      body_.vertex(scene_.pins[p]).mPosition = to_jolt(scene_.pin_at(p, t + h) - body_.origin());
  }

  void read(std::vector<Vec>& x, std::vector<Vec>& v) override {
    for (size_t i = 0; i < x.size(); ++i) {
      const JPH::SoftBodyVertex& vertex = body_.vertex(static_cast<int>(i));
      x[i] = body_.origin() + from_jolt(vertex.mPosition);
      v[i] = from_jolt(vertex.mVelocity);
    }
  }

  void report(RunReport& run) override {
    const JPH::SoftBodyMotionProperties& motion = body_.motion();
    const int iterations = static_cast<int>(motion.GetNumIterations());
    run.engine = "Jolt " + std::to_string(JPH_VERSION_MAJOR) + "." + std::to_string(JPH_VERSION_MINOR) + "." +
                 std::to_string(JPH_VERSION_PATCH);
    run.force_evaluations = 2 * iterations * run.steps;  // as mysim's xpbd counts its passes
    Readback& r = *run.readback;
    for (size_t i = 0; i < scene_.x.size(); ++i) {
      const double w = body_.vertex(static_cast<int>(i)).mInvMass;
      r.mass.push_back(w > 0 ? 1 / w : 0);
      r.pinned.push_back(w == 0);
    }
    read_edges(r);
    const auto gravity = [&] { return double(motion.GetGravityFactor()) * from_jolt(body_.system.GetGravity()); };
    body_.system.SetGravity(to_jolt(scene_.gravity));
    r.gravity = gravity();
    r.drag.emplace(scene_.x.size(), motion.GetLinearDamping());
    r.spheres.emplace();
    for (const JPH::Body* ball : body_.balls) {
      const double radius = static_cast<const JPH::SphereShape*>(ball->GetShape())->GetRadius();
      r.spheres->push_back({from_jolt(ball->GetPosition()), radius + double(motion.GetVertexRadius()),
                            std::sqrt(double(ball->GetFriction()) * double(body_.body->GetFriction())),
                            std::max(ball->GetRestitution(), body_.body->GetRestitution())});
      if (r.later) r.later->centres.push_back(r.spheres->back().centre);
    }
    Probe probe = probe_state(scene_);
    probe.t = 0.3;  // s; gusts have begun
    probe.springs = spring_forces(scene_, probe.x);
    probe.dashpots = probe.wind = std::vector<Vec>(scene_.x.size(), Vec{});
    body_.system.SetGravity(to_jolt(scene_.gravity + scene_.wind_at(probe.t)));
    for (size_t i = 0; i < probe.wind.size(); ++i) probe.wind[i] = r.mass[i] * (gravity() - *r.gravity);
    r.probe = probe;
    r.step = float(scene_.step);
    r.precision = "single";
    r.may_sleep = body_.body->GetAllowSleeping();
    r.mapped = {{"stiffness", "compliance of an edge, 1 / k (m/N)"}, {"drag", "linear damping (1/s)"}};
    if (scene_.wind) r.mapped["wind"] = "gravity, set anew before each step";
    if (!r.spheres->empty()) r.mapped["spheres"] = "static spheres of radius + margin, vertices without radius";
    r.settings = {{"Jolt", JPH::GetConfigurationString()},
                  {"iterations", std::to_string(iterations)},
                  {"frame", frame_},
                  {"largest speed", JsonWriter::of(motion.GetMaxLinearVelocity()) + " m/s"}};
    // jolt.mjs explains the additional half of v^2 / R
    for (const Sphere& s : scene_.spheres)
      if (s.friction > 0 && run.different_law.empty())
        run.different_law.push_back(
            "friction: on a ball of radius R it is mu m (g_n - 3/2 v^2 / R) with one iteration, not mu m (g_n - v^2 / "
            "R)");
  }

 private:
  /// Jolt's edges in the scene's order; parallel edges keep their own order.
  void read_edges(Readback& r) const {
    std::multimap<std::pair<int, int>, Spring> found;
    for (const auto& edge : body_.motion().GetSettings()->mEdgeConstraints) {
      const int a = static_cast<int>(edge.mVertex[0]), b = static_cast<int>(edge.mVertex[1]);
      found.emplace(std::pair(a, b), Spring{a, b, 1 / double(edge.mCompliance), edge.mRestLength});
    }
    for (const Spring& wanted : edges_of(scene_)) {
      const auto at = found.lower_bound({wanted.a, wanted.b});
      if (at == found.end() || at->first != std::pair(wanted.a, wanted.b))
        throw std::runtime_error("an edge that was given to Jolt is missing in its body");
      r.links.push_back(at->second);
      found.erase(at);
    }
  }

  const Scene& scene_;
  std::string frame_;
  SoftBody body_;
};

std::unique_ptr<World> make(const Scene& scene) {
  Options options(scene);
  const int iterations = options.get("n", 1);
  const bool world = options.get("frame", {"scene", "world"}) == "world";
  options.refuse_others();
  return std::make_unique<JoltWorld>(scene, iterations, world);
}

}  // namespace

int main(int argc, char** argv) {
  JPH::RegisterDefaultAllocator();
  JPH::Factory::sInstance = new JPH::Factory;
  JPH::RegisterTypes();
  return run_program(argc, argv, make);
}
