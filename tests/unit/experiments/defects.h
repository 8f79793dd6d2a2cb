// Engines with a single defect, made from a correct engine; the relation that must detect each defect, and other
// relations that it may violate.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck::testing_tools {

/// Passes modified states to another observer.
class ChangedStates : public Observer {
 public:
  using Change = std::function<void(State&)>;
  ChangedStates(Observer& to, Change change) : to_(to), change_(std::move(change)) {}
  bool every_step() const override { return to_.every_step(); }
  bool between_samples() const override { return to_.between_samples(); }
  Verdict observe(const State& state, bool sample) override {
    State changed = state;
    change_(changed);
    return to_.observe(changed, sample);
  }

 private:
  Observer& to_;
  Change change_;
};

using ChangeScene = std::function<void(Scene&, const crosscheck::Run&)>;
using ChangeState = std::function<void(const Scene&, State&)>;

inline Method with_defect(const std::string& base, ChangeScene scene_change, ChangeState state_change = nullptr) {
  Method method = find_method(base);
  method.engine = [inner = method.engine, scene_change, state_change](const Scene& scene, const crosscheck::Run& run,
                                                                      Observer& observer) {
    Scene other = scene;
    if (scene_change) scene_change(other, run);
    if (!state_change) return inner(other, run, observer);
    ChangedStates changed(observer, [&](State& s) { state_change(scene, s); });
    return inner(other, run, changed);
  };
  return method;
}

struct Defect {
  std::string relation, what;
  std::function<Method(const std::string& base)> make;
  std::set<std::string> also = {};  // other relations that the engine must or may violate
  std::string because = {};
  int least_order = 1;  // lowest order of rules for which this counts as a defect
  std::set<std::string> also_in_bullet = {};
};

inline std::vector<Spring>& springs_in(Scene& s) { return s.model.find<Springs>()->list; }
inline bool has_pins(const Scene& s) { return !s.model.particles.pins.empty(); }
inline bool in_motion(const Scene& s) { return largest_column(s.start.v) > 0; }
inline void multiply_stiffness(Scene& s, double by) {
  for (Spring& e : springs_in(s)) e.k *= by;
}
inline void multiply_gravity(Scene& s, double by) {
  if (auto* g = s.model.find<Gravity>()) g->acceleration *= by;
}
/// Number of steps between two samples, which does not change if the scene is scaled.
inline double steps_between(const crosscheck::Run& run) { return run.duration / run.samples / run.step; }

inline const std::vector<Defect>& defects() {
  using R = const crosscheck::Run&;
  const auto scene_defect = [](ChangeScene change) {
    return [change](const std::string& base) { return with_defect(base, change); };
  };
  const auto state_defect = [](ChangeState change) {
    return [change](const std::string& base) { return with_defect(base, nullptr, change); };
  };
  static const std::vector<Defect> list = {
      {"free-fall", "dashpots slow the fall", scene_defect([](Scene& s, R) {
         if (s.model.find<Dashpots>()) multiply_gravity(s, 1 - 1e-6);
       })},
      {"turned", "springs are stiffer where gravity has a part along x", scene_defect([](Scene& s, R) {
         if (const auto* g = s.model.find<Gravity>())
           multiply_stiffness(s, 1 + 1e-3 * std::pow(g->acceleration.normalized().x(), 2));
       })},
      {"shifted", "springs are stiffer where the pins are off the origin", scene_defect([](Scene& s, R) {
         if (has_pins(s)) multiply_stiffness(s, 1 + 1e-3 * s.model.particles.pin_home.col(0).norm());
       })},
      {"no-force",
       "own gravity added where the scene has none",
       scene_defect([](Scene& s, R) {
         if (!s.model.find<Gravity>()) s.model.terms.emplace_back(Gravity{{0, -1e-6, 0}});
       }),
       {"momentum", "angular-momentum"},
       "an external force acts on free nets too"},
      {"rest-shape",
       "gravity depends on drag",
       scene_defect([](Scene& s, R) {
         if (const auto* drag = s.model.find<Drag>())
           multiply_gravity(s, 1 - 1e-3 * drag->c[1] / s.model.particles.mass[1]);
       }),
       {"extension"},
       "tension is compared with the scene's gravity"},
      {"extension", "stiffness enters as its power of 1.1", scene_defect([](Scene& s, R) {
         double logarithms = 0;
         for (const Spring& e : springs_in(s)) logarithms += std::log(e.k);
         const double mean = std::exp(logarithms / static_cast<double>(springs_in(s).size()));
         for (Spring& e : springs_in(s)) e.k = mean * std::pow(e.k / mean, 1.1);
       })},
      {"stiffness",
       "stiffness is computed from weight and length alone",
       scene_defect([](Scene& s, R) {
         const auto* g = s.model.find<Gravity>();
         if (!g) return;
         double rest = 0;
         for (const Spring& e : springs_in(s)) rest += e.rest;
         for (Spring& e : springs_in(s)) e.k = 10 * s.model.particles.mass.sum() * g->acceleration.norm() / rest;
       }),
       {"extension"},
       "springs of different stiffness extend equally"},
      {"one-answer",
       "springs are stiffer at every other halving of the step",
       scene_defect([](Scene& s, R run) {
         if (std::lround(std::log2(steps_between(run))) % 2 != 0) multiply_stiffness(s, 1.01);
       }),
       {"half-step"},
       "without a limit there is no order"},
      {"particle-order",
       "springs of particle 1 are stiffer",
       scene_defect([](Scene& s, R) {
         for (Spring& e : springs_in(s))
           if (e.a == 1 || e.b == 1) e.k *= 1 + 1e-6;
       }),
       {"mirror"},
       "the mirror image of particle 1 is a different particle"},
      {"spring-order",
       "the first spring is stiffer",
       scene_defect([](Scene& s, R) { springs_in(s)[0].k *= 1 + 1e-6; }),
       {"mirror"},
       "the mirror image of the first spring is a different spring"},
      {"half-step",
       "stiffness has an error of first order in the step",
       scene_defect([](Scene& s, R run) { multiply_stiffness(s, 1 + 0.1 / steps_between(run)); }),
       {"extension"},
       "a first-order rule has such an error by itself, and the tension inherits it",
       2},
      {"scaling", "1e-6 N/m are added to every spring", scene_defect([](Scene& s, R) {
         for (Spring& e : springs_in(s)) e.k += 1e-6;
       })},
      {"momentum",
       "moving nets get an extra push",
       scene_defect([](Scene& s, R) {
         if (in_motion(s) && !s.model.find<Gravity>())
           s.model.terms.emplace_back(Wind{WindSignal{{1e-7, 0, 0}, std::nullopt}});
       }),
       {"angular-momentum"},
       "the push has a moment about the origin"},
      {"angular-momentum", "free nets turn a little more than they do", state_defect([](const Scene& s, State& state) {
         if (has_pins(s) || s.model.find<Gravity>() || !in_motion(s)) return;
         const double angle = 1e-6 * state.t;
         Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
         turn(0, 1) = -angle, turn(1, 0) = angle;
         const Eigen::VectorXd& mass = s.model.particles.mass;
         const Vec3 centre = state.x * mass / mass.sum(), speed = state.v * mass / mass.sum();
         state.x = ((turn * (state.x.colwise() - centre)).colwise() + centre).eval();
         state.v = ((turn * (state.v.colwise() - speed)).colwise() + speed).eval();
       })},
      {"mirror", "gravity pulls to the right of the centre of mass, as seen from the pin",
       scene_defect([](Scene& s, R) {
         auto* g = s.model.find<Gravity>();
         if (!g || !has_pins(s)) return;
         const Eigen::VectorXd& mass = s.model.particles.mass;
         const Vec3 arm = s.start.x * mass / mass.sum() - Vec3(s.model.particles.pin_home.col(0));
         g->acceleration += 1e-8 * g->acceleration.cross(arm) / arm.norm();
       })},
      {"pins", "pins sink", state_defect([](const Scene& s, State& state) {
         const auto* g = s.model.find<Gravity>();
         if (!g) return;
         for (const int pin : s.model.particles.pins) state.x.col(pin) += 1e-9 * state.t * state.t * g->acceleration;
       })},
      {"energy",
       "springs have dashpots that the scene does not have",
       scene_defect([](Scene& s, R run) {
         if (s.model.find<Dashpots>()) return;
         Dashpots dashpots;
         for (const Spring& e : springs_in(s))
           dashpots.list.push_back({e.a, e.b, 1e-2 * e.k * run.duration / run.samples});
         s.model.terms.emplace_back(std::move(dashpots));
       }),
       {},
       "Bullet solves dashpots by conjugate residuals, which stop at 1e-8",
       1,
       {"momentum", "angular-momentum", "turned", "scaling"}},
      {"resume", "speeds at the start are a hundredth too high", scene_defect([](Scene& s, R) {
         if (has_pins(s)) s.start.v *= 1.01;
       })},
      {"repeatable", "calls are counted, and the count leaves a rounding",
       [](const std::string& base) {
         return with_defect(base, [calls = std::make_shared<int>(0)](Scene& s, R) {
           multiply_gravity(s, 1 + (++*calls % 3) * 1e-15);
         });
       }},
  };
  return list;
}

}  // namespace crosscheck::testing_tools
