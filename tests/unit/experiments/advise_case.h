// One trial of `advise`: computes the advice, repeats the run of its file, and compares it with all candidates that
// `advise` tried.
#pragma once

#include "experiments/advise/advice.h"
#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck::testing_tools {

struct AdviseCase {
  bool promised = false, met = false;
  bool cheaper = false;  // a tried candidate met the tolerance at less than 0.8 of the advised cost
  std::string why;       // reason if nothing was promised
  std::string method;
  double tolerance = 0, error = 0;  // m
};

/// Runs a trial whose tolerance is the fraction `part` of the scene's motion.
inline AdviseCase advise_case(const Scene& scene, double part) {
  AdviseCase c;
  const auto truth = truth_of(scene, default_run(scene));
  const double motion = truth ? motion_of(truth->trajectory) : 0;
  c.tolerance = truth ? part * motion : part;
  std::vector<Method> methods;
  for (Method& m : all_methods())
    if (m.name.starts_with("mysim/")) methods.push_back(std::move(m));
  try {
    const Advice a = advise(scene, c.tolerance, std::move(methods));
    c.promised = true;
    const Scene written = parse_scene(a.toml, scene.name);
    const MethodRun again = run_and_record(written.method, written, default_run(written));
    c.method = written.method;
    c.error = largest_rms_distance(again.trajectory, truth->trajectory, a.until);
    c.met = again.outcome.verdict == Verdict::ok && c.error <= c.tolerance;
    for (const Trial& t : a.trials) c.cheaper |= t.meets && t.cost() < 0.8 * a.trials[a.chosen].cost();
  } catch (const CannotGuarantee& e) {
    c.why = e.what();
  }
  return c;
}

/// Result of a trial on a scene with contact, whose tolerance is a fraction of the motion. The advised file is compared
/// with the event-driven solution after every step.
struct ContactCase {
  bool promised = false, met = false;
  std::string why, method;
  int particles = 0;
  long steps = 0;
  double duration = 0, until = 0, step = 0, tolerance = 0, error = 0, bar = 0;  // s and m
};

class StepRecorder : public Observer {
 public:
  bool every_step() const override { return true; }
  Verdict observe(const State& state, bool) override {
    states.push_back(state);
    return Verdict::ok;
  }
  std::vector<State> states;
};

inline ContactCase contact_case(const Scene& scene, double part) {
  ContactCase c{.particles = scene.model.particles.size(), .duration = scene.duration};
  Recorder plain;
  run_method(find_method("leapfrog"), scene, default_run(scene), {&plain});
  c.tolerance = part * motion_of(plain.trajectory);
  try {
    const Advice a = advise(scene, c.tolerance, candidates(scene));
    c.promised = true, c.until = a.until, c.bar = a.error_bar, c.step = a.trials[a.chosen].step;
    const Scene written = parse_scene(a.toml, scene.name);
    const Method method = find_method(written.method);
    c.method = written.method;
    StepRecorder run;
    const Outcome out = run_method(method, written, default_run(written), {&run});
    // samples the event-driven solution at every step of the run until the promise ends, or for adaptive methods at the
    // spacing of the maximum step
    Run dense = default_run(scene);
    const double h = method.adaptive ? written.step : out.step;
    dense.samples = scene.samples * std::max(1, static_cast<int>(std::lround(scene.duration / scene.samples / h)));
    dense.tolerance = 1e-12;
    Recorder truth;
    run_event_driven(scene, dense, truth);
    const Trajectory& path = truth.trajectory;
    for (const State& s : run.states) {
      if (s.t > a.until * (1 + 1e-9)) break;
      const auto at = static_cast<size_t>(std::lround(s.t / scene.duration * dense.samples));
      if (std::abs(path.t[at] - s.t) > 1e-9 * scene.duration) continue;
      c.error = std::max(c.error, rms_distance(s.x, path.x[at]));
      ++c.steps;
    }
    c.met = out.verdict == Verdict::ok && c.steps > 1 && c.error <= c.tolerance;
  } catch (const CannotGuarantee& e) {
    c.why = e.what();
  }
  return c;
}

}  // namespace crosscheck::testing_tools
