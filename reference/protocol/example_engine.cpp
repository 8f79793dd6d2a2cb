// An engine for crosscheck in C++17: symplectic Euler with springs, drag, gravity and moved pins. Build it with any
// compiler: c++ -std=c++17 -O2 example_engine.cpp -o engine

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

class SymplecticEuler : public World {
 public:
  explicit SymplecticEuler(const Scene& scene) : scene_(scene), x_(scene.x), v_(scene.v), f_(scene.x.size()) {
    scene.require_only({"springs", "drag", "gravity"});
  }

  void step(double t) override {
    const double h = scene_.step;
    for (size_t i = 0; i < x_.size(); ++i) f_[i] = scene_.mass[i] * scene_.gravity - scene_.drag[i] * v_[i];
    add_springs(scene_, x_, f_);
    for (size_t i = 0; i < x_.size(); ++i) {
      v_[i] = v_[i] + (h / scene_.mass[i]) * f_[i];
      x_[i] = x_[i] + h * v_[i];
    }
    scene_.place_pins(t + h, x_, v_);
  }

  void read(std::vector<Vec>& x, std::vector<Vec>& v) override { x = x_, v = v_; }

  /// This engine uses the scene's own lists, and has no dashpots, wind or obstacles.
  void report(RunReport& run) override {
    run.force_evaluations = run.steps;
    Readback& r = *run.readback;
    r.mass = scene_.mass, r.pinned = scene_.pinned, r.links = scene_.springs, r.gravity = scene_.gravity;
    r.drag = scene_.drag;
    for (size_t i = 0; i < scene_.mass.size(); ++i) (*r.drag)[i] /= scene_.mass[i];
    r.spheres.emplace(), r.planes.emplace();
    r.may_sleep = false;
    r.probe = probe_of_forces(scene_);
  }

 private:
  const Scene& scene_;
  std::vector<Vec> x_, v_, f_;  // m, m/s, N
};

}  // namespace

int main(int argc, char** argv) { return run_program<SymplecticEuler>(argc, argv); }
