// Simbody as a program of the engine protocol.
//
// Particles are bodies on Translation mobilizers, pins have a prescribed motion, springs and dashpots are Simbody's
// two-point elements, drag is a mobility damper, hard distances are rods. One custom force applies bending, wind,
// bullet-link springs, and springs that start at zero length, for which Simbody's element would divide by zero.
#include <Simbody.h>

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

using SimTK::MobilizedBody;
using SimTK::SpatialVec;
using SimTK::State;
using Bodies = std::vector<MobilizedBody::Translation>;

SimTK::Vec3 to_simbody(const Vec& v) { return {v[0], v[1], v[2]}; }
Vec from_simbody(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

/// Prescribes a pin's position. The body's frame is the world's, so coordinates are positions.
class PinMotion : public SimTK::Motion::Custom::Implementation {
 public:
  PinMotion(const Scene& scene, size_t pin) : scene_(scene), pin_(pin) {}
  SimTK::Motion::Level getLevel(const State&) const override { return SimTK::Motion::Position; }
  void calcPrescribedPosition(const State& s, int, SimTK::Real* q) const override {
    set(scene_.pin_at(pin_, s.getTime()), q);
  }
  void calcPrescribedPositionDot(const State& s, int, SimTK::Real* q) const override {
    set(scene_.pins_move ? scene_.pin_motion.velocity(s.getTime()) : Vec{}, q);
  }
  void calcPrescribedPositionDotDot(const State& s, int, SimTK::Real* q) const override {
    set(scene_.pins_move ? scene_.pin_motion.acceleration(s.getTime()) : Vec{}, q);
  }

 private:
  static void set(const Vec& v, SimTK::Real* q) { std::copy(v.begin(), v.end(), q); }
  const Scene& scene_;
  size_t pin_;
};

class HeaderForces : public SimTK::Force::Custom::Implementation {
 public:
  HeaderForces(const Scene& scene, const Bodies& bodies) : scene_(scene), bodies_(bodies) {}
  void calcForce(const State& s, SimTK::Vector_<SpatialVec>& forces, SimTK::Vector_<SimTK::Vec3>&,
                 SimTK::Vector&) const override {
    std::vector<Vec> x(bodies_.size()), f(bodies_.size(), Vec{});
    for (size_t i = 0; i < x.size(); ++i) x[i] = from_simbody(bodies_[i].getBodyOriginLocation(s));
    add_springs(scene_, x, f);
    add_bending(scene_, x, f);
    add_wind(scene_, s.getTime(), f);
    for (size_t i = 0; i < x.size(); ++i) forces[bodies_[i].getMobilizedBodyIndex()][1] += to_simbody(f[i]);
  }
  SimTK::Real calcPotentialEnergy(const State&) const override { return 0; }

 private:
  const Scene& scene_;
  const Bodies& bodies_;
};

class SimbodyWorld : public World {
 public:
  explicit SimbodyWorld(const Scene& scene) : scene_(scene), called_(scene), matter_(system_), forces_(system_) {
    scene.require_only({"springs", "dashpots", "bending", "constraints", "gravity", "drag", "wind"});
    Options options(scene);
    name_ = options.get("integrator", {"semi-explicit-euler", "verlet", "rk3", "merson", "feldberg", "cpodes"});
    options.refuse_others();
    gravity_ = std::make_unique<SimTK::Force::UniformGravity>(forces_, matter_, to_simbody(scene.gravity));
    for (size_t i = 0; i < scene.x.size(); ++i) {
      const SimTK::MassProperties mass(scene.mass[i], SimTK::Vec3(0), SimTK::Inertia(scene.mass[i]));
      bodies_.emplace_back(matter_.Ground(), SimTK::Body::Rigid(mass));
      for (int k = 0; k < 3 && scene.drag[i] != 0; ++k)
        SimTK::Force::MobilityLinearDamper(forces_, bodies_[i], SimTK::MobilizerUIndex(k), scene.drag[i]);
    }
    for (size_t p = 0; p < scene.pins.size(); ++p)
      SimTK::Motion::Custom(bodies_[scene.pins[p]], new PinMotion(scene, p));
    called_.springs.clear();
    for (const Spring& s : scene.springs)
      if (scene.spring_law == "hooke" && length(scene.x[s.a] - scene.x[s.b]) > 0)
        springs_.push_back(SimTK::Force::TwoPointLinearSpring(forces_, bodies_[s.a], SimTK::Vec3(0), bodies_[s.b],
                                                              SimTK::Vec3(0), s.stiffness, s.rest_length));
      else
        called_.springs.push_back(s);
    for (const Dashpot& p : scene.dashpots)
      dashpots_.push_back(SimTK::Force::TwoPointLinearDamper(forces_, bodies_[p.a], SimTK::Vec3(0), bodies_[p.b],
                                                             SimTK::Vec3(0), p.coefficient));
    for (const Spring& c : scene.constraints)
      rods_.emplace_back(bodies_[c.a], SimTK::Vec3(0), bodies_[c.b], SimTK::Vec3(0), c.rest_length);
    if (scene.wind || called_.springs.size() + called_.bending.size() > 0)
      SimTK::Force::Custom(forces_, new HeaderForces(called_, bodies_));
    State start = system_.realizeTopology();
    place(start, scene.x, scene.v);
    system_.realize(start, SimTK::Stage::Velocity);
    make_integrator();
    integrator_->initialize(start);
  }

  void step(double) override {
    const double end = static_cast<double>(++steps_) * scene_.step;  // a sum of steps would accumulate rounding errors
    while (integrator_->getTime() < end) integrator_->stepTo(end);   // the first call returns at t = 0
  }

  void read(std::vector<Vec>& x, std::vector<Vec>& v) override {
    const State& s = integrator_->getState();
    system_.realize(s, SimTK::Stage::Velocity);
    for (size_t i = 0; i < x.size(); ++i) {
      x[i] = from_simbody(bodies_[i].getBodyOriginLocation(s));
      v[i] = from_simbody(bodies_[i].getBodyOriginVelocity(s));
    }
  }

  void report(RunReport& run) override {
    int major = 0, minor = 0, build = 0;
    SimTK_version_simbody(&major, &minor, &build);
    run.engine = "Simbody " + std::to_string(major) + "." + std::to_string(minor);
    run.force_evaluations = integrator_->getNumRealizations();
    run.adaptive = adaptive();
    if (adaptive()) run.steps = integrator_->getNumStepsTaken();
    if (adaptive()) run.step = scene_.samples * scene_.steps_per_sample * scene_.step / std::max(1l, run.steps);
    Readback& r = *run.readback;
    State s = integrator_->getState();
    r.drag.emplace();
    for (size_t i = 0; i < bodies_.size(); ++i) {
      r.mass.push_back(bodies_[i].getBodyMass(s));
      r.pinned.push_back(bodies_[i].hasMotion());
      r.drag->push_back(scene_.drag[i] / scene_.mass[i]);
    }
    r.links = scene_.springs;  // the elements do not expose their parameters; the probe shows them
    for (size_t i = 0; i < rods_.size(); ++i)
      r.links.push_back({scene_.constraints[i].a, scene_.constraints[i].b, hard, rods_[i].getDefaultRodLength()});
    r.gravity = from_simbody(gravity_->getGravity());
    r.may_sleep = false;
    r.spheres.emplace(), r.planes.emplace();
    if (adaptive()) r.step = unknown;
    Probe p = probe_of_forces(called_, probe_state(scene_));
    place(s, p.x, p.v);
    system_.realize(s, SimTK::Stage::Velocity);
    p.dashpots.assign(p.x.size(), Vec{});
    for (const auto& element : springs_) add_contribution(element, s, p.springs);
    for (const auto& element : dashpots_) add_contribution(element, s, p.dashpots);
    r.probe = p;
    r.mapped = {
        {"springs", "TwoPointLinearSpring"}, {"dashpots", "TwoPointLinearDamper"}, {"drag", "MobilityLinearDamper"}};
    r.settings = {{"integrator", name_}};
  }

 private:
  bool adaptive() const { return name_ == "cpodes"; }

  void make_integrator() {
    using namespace SimTK;
    const double h = scene_.step;
    if (name_ == "semi-explicit-euler") integrator_ = std::make_unique<SemiExplicitEulerIntegrator>(system_, h);
    if (name_ == "verlet") integrator_ = std::make_unique<VerletIntegrator>(system_, h);
    if (name_ == "rk3") integrator_ = std::make_unique<RungeKutta3Integrator>(system_);
    if (name_ == "merson") integrator_ = std::make_unique<RungeKuttaMersonIntegrator>(system_);
    if (name_ == "feldberg") integrator_ = std::make_unique<RungeKuttaFeldbergIntegrator>(system_);
    if (adaptive()) integrator_ = std::make_unique<CPodesIntegrator>(system_);
    if (adaptive())
      integrator_->setAccuracy(scene_.json["run"]["tolerance"].number());
    else
      integrator_->setFixedStepSize(h);
  }

  void place(State& s, const std::vector<Vec>& x, const std::vector<Vec>& v) const {
    for (size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].setQ(s, to_simbody(x[i]));
      bodies_[i].setU(s, to_simbody(v[i]));
    }
  }

  void add_contribution(const SimTK::Force& element, const State& s, std::vector<Vec>& f) const {
    SimTK::Vector_<SpatialVec> forces;
    SimTK::Vector_<SimTK::Vec3> none;
    SimTK::Vector mobility;
    element.calcForceContribution(s, forces, none, mobility);
    for (size_t i = 0; i < f.size(); ++i) f[i] = f[i] + from_simbody(forces[bodies_[i].getMobilizedBodyIndex()][1]);
  }

  const Scene& scene_;
  Scene called_;  // contains only the springs that the custom force applies
  std::string name_;
  long steps_ = 0;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_;
  SimTK::GeneralForceSubsystem forces_;
  std::unique_ptr<SimTK::Force::UniformGravity> gravity_;
  Bodies bodies_;
  std::vector<SimTK::Force> springs_, dashpots_;
  std::vector<SimTK::Constraint::Rod> rods_;
  std::unique_ptr<SimTK::Integrator> integrator_;
};

}  // namespace

int main(int argc, char** argv) { return run_program<SimbodyWorld>(argc, argv); }
