// ODE as a program of the engine protocol.
//
// Particles are bodies, pins are kinematic bodies. springs=forces (default): dBodyAddForce applies all forces, which
// makes ODE's step symplectic Euler. springs=dball: springs, with the dashpots between the same ends, are distance
// joints with ERP = h k / (h k + c) and CFM = 1 / (h k + c), an implicit step along the line between the ends.
#include <ode/ode.h>

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

Vec vec(const dReal* v) { return {v[0], v[1], v[2]}; }

class OdeWorld : public World {
 public:
  explicit OdeWorld(const Scene& scene) : scene_(scene), forced_(scene), x_(scene.x), v_(scene.v), f_(x_.size()) {
    scene.require_only({"springs", "dashpots", "bending", "gravity", "drag", "wind", "sphere", "plane"});
    Options options(scene);
    const bool joints = options.get("springs", {"forces", "dball"}) == "dball";
    iterations_ = options.get("n", 20);  // iterations of the solver of joints and contacts
    options.refuse_others();
    scene.require_resting_surfaces("this adapter supports only contact with bodies at rest");
    if (joints && scene.spring_law != "hooke") unsupported("springs=dball: ODE's joints have Hooke's law");
    dInitODE2(0);
    world_ = dWorldCreate();
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, scene.gravity[0], scene.gravity[1], scene.gravity[2]);
    dWorldSetAutoDisableFlag(world_, 0);
    dWorldSetQuickStepNumIterations(world_, iterations_);
    for (size_t i = 0; i < x_.size(); ++i) {
      bodies_.push_back(dBodyCreate(world_));
      dMass mass;
      dMassSetSphereTotal(&mass, scene.mass[i],
                          1);  // any radius: all forces act at the centres, so bodies do not rotate
      dBodySetMass(bodies_[i], &mass);
      if (scene.pinned[i]) dBodySetKinematic(bodies_[i]);
      place(i, scene.x[i], scene.v[i]);
    }
    if (joints) make_joints();
  }

  void step(double t) override {
    read(x_, v_);
    set_forces(forced_, x_, v_, t, f_);
    for (size_t i = 0; i < x_.size(); ++i) {
      if (scene_.pinned[i]) continue;
      const Vec f = f_[i] - scene_.drag[i] * v_[i];
      dBodyAddForce(bodies_[i], f[0], f[1], f[2]);
      for (const Sphere& s : scene_.spheres)
        touch(i, s, length(x_[i] - s.centre) - s.contact_radius(), x_[i] - s.centre);
      for (const Plane& p : scene_.planes) touch(i, p, dot(x_[i] - p.contact_point_at(t), p.normal), p.normal);
    }
    if (!dWorldQuickStep(world_, scene_.step)) throw std::runtime_error("ODE ran out of memory in a step");
    dJointGroupEmpty(contacts_);
    scene_.place_pins(t + scene_.step, x_, v_);
    for (const int pin : scene_.pins) place(pin, x_[pin], v_[pin]);
  }

  void read(std::vector<Vec>& x, std::vector<Vec>& v) override {
    for (size_t i = 0; i < x.size(); ++i)
      x[i] = vec(dBodyGetPosition(bodies_[i])), v[i] = vec(dBodyGetLinearVel(bodies_[i]));
  }

  void report(RunReport& run) override {
    run.engine = "ODE " dODE_VERSION;
    run.force_evaluations = joints_.empty() ? run.steps : run.steps * (1 + iterations_);
    Readback& r = *run.readback;
    r.drag.emplace();
    for (size_t i = 0; i < x_.size(); ++i) {
      dMass mass;
      dBodyGetMass(bodies_[i], &mass);
      r.mass.push_back(mass.mass);
      r.pinned.push_back(dBodyIsKinematic(bodies_[i]) != 0);
      r.drag->push_back(scene_.drag[i] / scene_.mass[i]);
    }
    dVector3 g;
    dWorldGetGravity(world_, g);
    r.gravity = vec(g);
    r.may_sleep = dWorldGetAutoDisableFlag(world_) != 0;
    r.precision = sizeof(dReal) == sizeof(double) ? "double" : "single";
    std::vector<SoftJoint> joints;
    for (dJointID joint : joints_) {
      const dReal erp = dJointGetDBallParam(joint, dParamERP), cfm = dJointGetDBallParam(joint, dParamCFM);
      joints.push_back({erp / (cfm * scene_.step), dJointGetDBallDistance(joint), (1 - erp) / cfm});
    }
    read_back_joints(scene_, forced_, joints, "an implicit step along the line between the ends", run);
    r.spheres.emplace(), r.planes.emplace();
    for (const Sphere& s : scene_.spheres) {
      r.spheres->push_back({s.centre, s.contact_radius(), s.friction, s.restitution});
      if (r.later) r.later->centres.push_back(s.centre);
      r.margin = s.margin;
    }
    for (const Plane& p : scene_.planes) {
      r.planes->push_back({p.contact_point_at(0), p.normal, p.friction, p.restitution});
      if (r.later) r.later->points.push_back(p.contact_point_at(0));
    }
    r.mapped = {{"drag", "force"}, {"springs", joints_.empty() ? "forces" : "distance joints with ERP and CFM"}};
    r.settings = {{"iterations", std::to_string(iterations_)}};
  }

 private:
  void place(size_t i, const Vec& x, const Vec& v) {
    dBodySetPosition(bodies_[i], x[0], x[1], x[2]);
    dBodySetLinearVel(bodies_[i], v[0], v[1], v[2]);
  }

  void make_joints() {
    forced_.springs.clear(), forced_.dashpots.clear();
    const std::vector<double> damping = damping_of_springs(scene_, forced_.dashpots);
    for (size_t i = 0; i < damping.size(); ++i) {
      const Spring& s = scene_.springs[i];
      const Vec &a = scene_.x[s.a], &b = scene_.x[s.b];
      if (length(a - b) == 0) unsupported("springs=dball: a joint whose ends coincide pulls in an arbitrary direction");
      const double hk = scene_.step * s.stiffness, c = damping[i];
      joints_.push_back(dJointCreateDBall(world_, nullptr));
      dJointAttach(joints_.back(), bodies_[s.a], bodies_[s.b]);
      dJointSetDBallAnchor1(joints_.back(), a[0], a[1], a[2]);
      dJointSetDBallAnchor2(joints_.back(), b[0], b[1], b[2]);
      dJointSetDBallDistance(joints_.back(), s.rest_length);
      dJointSetDBallParam(joints_.back(), dParamERP, hk / (hk + c));
      dJointSetDBallParam(joints_.back(), dParamCFM, 1 / (hk + c));
    }
  }

  /// Adds a contact of particle i with a sphere or plane, at the particle itself, so that friction does not rotate it.
  template <class Surface>
  void touch(size_t i, const Surface& surface, double gap, const Vec& outward) {
    if (gap >= 0) return;
    const Vec n = 1 / length(outward) * outward, along = v_[i] - dot(v_[i], n) * n;
    dContact contact{};
    contact.surface.mode = dContactBounce | dContactApprox1;
    contact.surface.mu = surface.friction, contact.surface.bounce = surface.restitution;
    contact.geom.depth = -gap;
    for (int k = 0; k < 3; ++k) contact.geom.pos[k] = x_[i][k], contact.geom.normal[k] = n[k];
    if (const double speed = length(along);
        speed > 0) {  // ODE bounds friction by a rectangle, with one side along the sliding direction
      contact.surface.mode |= dContactFDir1;
      for (int k = 0; k < 3; ++k) contact.fdir1[k] = along[k] / speed;
    }
    dJointAttach(dJointCreateContact(world_, contacts_, &contact), bodies_[i], nullptr);
  }

  const Scene& scene_;
  Scene forced_;  // contains only the springs and dashpots that are applied as forces
  int iterations_ = 20;
  dWorldID world_;
  dJointGroupID contacts_;
  std::vector<dBodyID> bodies_;
  std::vector<dJointID> joints_;  // one per spring, or none
  std::vector<Vec> x_, v_, f_;
};

}  // namespace

int main(int argc, char** argv) { return run_program<OdeWorld>(argc, argv); }
