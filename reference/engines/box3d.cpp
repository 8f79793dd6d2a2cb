// Box3D as a program of the engine protocol (tried: version 0.2.0, commit 30c67b5e6d0a). Built by box3d/CMakeLists.txt.
//
// springs=joint (default): springs, with the dashpots between the same ends, are distance joints with a frequency and a
// damping ratio. springs=forces: springs and dashpots are forces, which Box3D repeats in each of its n sub-steps. In a
// step, a body then moves by h v + h^2 a (n + 1) / (2 n), so springs gain energy unless n is 1.
#include <box3d/box3d.h>

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

b3Vec3 to_box3d(const Vec& v) { return {float(v[0]), float(v[1]), float(v[2])}; }
b3Pos to_position(const Vec& v) {
  b3Pos p{};
  p.x = static_cast<decltype(p.x)>(v[0]), p.y = static_cast<decltype(p.y)>(v[1]),
  p.z = static_cast<decltype(p.z)>(v[2]);
  return p;
}
template <class Vector>
Vec from_box3d(const Vector& v) {
  return {v.x, v.y, v.z};
}

class Box3dWorld : public World {
 public:
  explicit Box3dWorld(const Scene& scene) : scene_(scene), forced_(scene), x_(scene.x), v_(scene.v), f_(x_.size()) {
    scene.require_only({"springs", "dashpots", "bending", "gravity", "drag", "wind"});
    Options options(scene);
    substeps_ = options.get("n", 4);
    const bool joints = options.get("springs", {"joint", "forces"}) == "joint" && scene.spring_law == "hooke";
    options.refuse_others();
    b3WorldDef world = b3DefaultWorldDef();
    world.gravity = to_box3d(scene.gravity);
    world.enableSleep = false;
    world.maximumLinearSpeed = 1e9f;  // m/s; default 400, above which bodies are silently slowed down
    world_ = b3CreateWorld(&world);
    for (size_t i = 0; i < x_.size(); ++i) {
      b3BodyDef body = b3DefaultBodyDef();
      body.type = scene.pinned[i] ? b3_kinematicBody : b3_dynamicBody;
      body.position = to_position(x_[i]);
      body.linearVelocity = to_box3d(v_[i]);
      body.linearDamping = scene.pinned[i] ? 0 : float(scene.drag[i] / scene.mass[i]);
      body.enableSleep = false;
      bodies_.push_back(b3CreateBody(world_, &body));
      const auto mass = float(scene.mass[i]);
      b3MassData data{};
      data.mass = mass;
      data.inertia = {{mass, 0, 0}, {0, mass, 0}, {0, 0, mass}};
      if (!scene.pinned[i]) b3Body_SetMassData(bodies_[i], data);
    }
    if (joints) make_joints();
  }

  void step(double t) override {
    read(x_, v_);
    set_forces(forced_, x_, v_, t, f_);
    for (size_t i = 0; i < x_.size(); ++i)
      if (!scene_.pinned[i]) b3Body_ApplyForceToCenter(bodies_[i], to_box3d(f_[i]), true);
    const double h = scene_.step;
    for (size_t p = 0; p < scene_.pins.size() && scene_.pins_move;
         ++p)  // a velocity moves the pin to its place at the end of the step
      b3Body_SetLinearVelocity(bodies_[scene_.pins[p]],
                               to_box3d(1 / h * (scene_.pin_at(p, t + h) - x_[scene_.pins[p]])));
    b3World_Step(world_, float(h), substeps_);
    read(x_, v_);
    scene_.place_pins(t + h, x_, v_);
    for (const int pin : scene_.pins) {
      b3Body_SetTransform(bodies_[pin], to_position(x_[pin]), b3Body_GetRotation(bodies_[pin]));
      b3Body_SetLinearVelocity(bodies_[pin], to_box3d(v_[pin]));
    }
  }

  void read(std::vector<Vec>& x, std::vector<Vec>& v) override {
    for (size_t i = 0; i < x.size(); ++i) {
      x[i] = from_box3d(b3Body_GetPosition(bodies_[i]));
      v[i] = from_box3d(b3Body_GetLinearVelocity(bodies_[i]));
    }
  }

  void report(RunReport& run) override {
    const b3Version version = b3GetVersion();
    run.engine = "Box3D " + std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
                 std::to_string(version.revision);
    run.force_evaluations = run.steps * (joints_.empty() ? 1 : 1 + 2 * substeps_);  // each sub-step is solved twice
    Readback& r = *run.readback;
    r.drag.emplace();
    for (size_t i = 0; i < x_.size(); ++i) {
      r.mass.push_back(b3Body_GetMass(bodies_[i]));
      r.pinned.push_back(b3Body_GetType(bodies_[i]) != b3_dynamicBody);
      r.drag->push_back(b3Body_GetLinearDamping(bodies_[i]));
    }
    std::vector<SoftJoint> joints;
    for (size_t i = 0; i < joints_.size(); ++i) {
      const double omega = 2 * pi * b3DistanceJoint_GetSpringHertz(joints_[i]), mass = reduced_mass(scene_.springs[i]);
      const double damping = 2 * mass * omega * b3DistanceJoint_GetSpringDampingRatio(joints_[i]);
      joints.push_back({omega * omega * mass, b3DistanceJoint_GetLength(joints_[i]), damping});
    }
    read_back_joints(scene_, forced_, joints,
                     "soft constraints, implicit along the line between the ends in each sub-step", run);
    r.gravity = from_box3d(b3World_GetGravity(world_));
    r.precision = "single";  // velocities are single in both builds
    r.may_sleep = b3World_IsSleepingEnabled(world_);
    r.step = float(scene_.step);
    r.spheres.emplace(), r.planes.emplace();
    r.mapped = {{"springs", joints_.empty() ? "forces" : "distance joints with frequency and damping ratio"},
                {"drag", "linear damping (1/s)"}};
    r.settings = {{"sub-steps", std::to_string(substeps_)}};
    if (joints_.empty() && substeps_ > 1)
      run.different_law.push_back("springs: forces repeat in each sub-step and move a body by h^2 a (n + 1) / (2 n)");
  }

 private:
  /// Reduced mass (kg) of a joint's ends.
  double reduced_mass(const Spring& s) const {
    double inverse = 0;
    for (const int end : {s.a, s.b})
      if (!scene_.pinned[end]) inverse += 1. / b3Body_GetMass(bodies_[end]);
    return inverse > 0 ? 1 / inverse : 1;
  }

  void make_joints() {
    forced_.springs.clear(), forced_.dashpots.clear();
    const std::vector<double> damping = damping_of_springs(scene_, forced_.dashpots);
    for (size_t i = 0; i < damping.size(); ++i) {
      const Spring& s = scene_.springs[i];
      b3DistanceJointDef joint = b3DefaultDistanceJointDef();
      joint.base.bodyIdA = bodies_[s.a], joint.base.bodyIdB = bodies_[s.b];
      joint.length = float(s.rest_length);
      joint.enableSpring = true;
      const double mass = reduced_mass(s), omega = std::sqrt(s.stiffness / mass);
      joint.hertz = float(omega / (2 * pi));
      joint.dampingRatio = float(damping[i] / (2 * mass * omega));
      joints_.push_back(b3CreateDistanceJoint(world_, &joint));
    }
  }

  const Scene& scene_;
  Scene forced_;  // contains only the springs and dashpots that are applied as forces
  int substeps_;
  b3WorldId world_;
  std::vector<b3BodyId> bodies_;
  std::vector<b3JointId> joints_;  // one per spring, or none
  std::vector<Vec> x_, v_, f_;
};

}  // namespace

int main(int argc, char** argv) { return run_program<Box3dWorld>(argc, argv); }
