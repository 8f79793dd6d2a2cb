// One trial of an advice: computed, written, run again from its file, and compared with everything that was tried.
#pragma once

#include "experiments/advise/advice.h"
#include "experiments/metrics.h"
#include "experiments/scenes/scenes.h"
#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/random_scenes.h"

namespace crosscheck::testing_tools {

struct AdviseCase {
  bool promised = false, met = false;
  bool cheaper = false;  // something that was tried met the tolerance at less than 0.8 of the advised cost
  std::string why;       // it was not promised
  std::string method;
  double tolerance = 0, error = 0;  // m
};

/// Advice within a part of the scene's motion.
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

}  // namespace crosscheck::testing_tools
