#include <algorithm>
#include <stdexcept>

#include "report/findings/findings.h"

namespace crosscheck {

const std::vector<FindingRule>& finding_rules() {
  static constexpr std::string_view apart = "largest RMS position difference", error = "largest RMS position error",
                                    error_of_motion = "largest RMS position error over the motion",
                                    residual = "largest energy residual over the energy exchanged",
                                    times_cpu = "CPU time over that of mysim",
                                    growth = "growth of a perturbation of 1e-10 m", other_engine = "another engine",
                                    measured = "measured", converged = "converged",
                                    discrete = "exact for the discrete rule", balance = "exact balance",
                                    coulomb = "exact (Coulomb's law)", same = "same-answer", speed = "speed-accuracy",
                                    limits = "stability", energy = "energy", model = "adequacy";
  // clang-format off
  static const std::vector<FindingRule> rules = {
      // the first screen
      {"answer-agreement", agreement_answer, "answer", same, apart, "m", other_engine, "names scenes contact others where", {"engines"}},
      {"answer-chaotic", agreement_answer, "answer", same, growth, "1", other_engine, "where", {"engines"}},
      {"answer-method", method_answer, "answer", speed, error_of_motion, "%", measured, "setting cpu duration next times",
       {"speed-accuracy", "speed-accuracy-cost", "speed-accuracy-engines-cost"}},
      {"answer-limit", failure_answer, "answer", limits, "critical time step", "s", discrete, "where theory confirmed all deviation",
       {"stability", "speed-accuracy"}},
      {"answer-failed", failure_answer, "answer", limits, "failed runs", "1", measured, "runs which", {"engines"}},
      {"answer-ball", ball_answer, "answer", energy, "cases in agreement with Coulomb's law", "1", "exact (Coulomb's law); another engine",
       "cases others planes drape apart until final", {"sphere-cone", "plane-cone", "engines"}},
      {"answer-contact", ball_answer, "answer", energy, apart, "m", other_engine, "where until final", {"engines"}},
      {"answer-energy", energy_answer, "answer", energy, residual, "%", balance, "where damping", {"energy"}, "{}-energy-drift"},
      {"answer-model", model_answer, "answer", model, "spring evaluations saved", "%", converged, "one ten until", {"adequacy-least"}},

      // same scene, same answer?
      {"relations", relation_findings, "agreement", same, "invariants that hold", "1", "none is needed", "asked known", {"relations"}},
      {"relations-broken", relation_findings, "failure", same, "invariants broken without a known cause", "1", "none is needed", "which", {"relations"}},

      // speed against accuracy
      {"orders", order_findings, "order", speed, "deviation of the order of accuracy", "1", "see each scene",
       "methods scenes where order declared", {"order-slopes"}, "spring-order"},
      {"engine-times", speed_findings, "cost", speed, times_cpu, "1", measured, "where built", {"speed-accuracy-engines-cost"}, "cheapest-1-percent-cost"},
      {"engine-without-run", speed_findings, "cost", speed, "scenes", "1", measured, "where", {"speed-accuracy-engines-cost", "speed-accuracy"}},
      {"size-cost", cost_findings, "cost", "cost", times_cpu, "1", measured, "where build", {"size-cost"}, "size-cost"},

      // failure
      {"failed-of-all", failure_findings, "failure", limits, "scenes", "1", measured, "where", {"engines"}, "scoreboard"},
      {"step-limits", limit_findings, "agreement", limits, "deviation of the critical time step from theory", "%", discrete,
       "confirmed all bracket scenes", {"stability"}, "stability-limits"},
      {"step-limits-apart", limit_findings, "failure", limits, "limits that contradict theory", "1", discrete, "where how all", {"stability"}, "stability-limits"},
      {"limits-by-truth", stability_findings, "failure", limits, "limits that the reference solution confirms", "1", converged,
       "all below above name step error", {"stability"}, "stability-limits"},
      {"no-stable-step", stability_findings, "failure", limits, "scenes", "1", discrete, "where", {"stability"}, "stability-limits"},
      {"growth", stability_findings, "failure", limits, "deviation of the growth per step from theory", "%", discrete, "where", {"stability-growth"}},

      // energy and contact
      {"symplectic-energy", energy_findings, "energy", energy, residual, "%", balance, "steps bounded all", {"energy"}, "*-energy-drift"},
      {"symplectic-drift", energy_findings, "energy", energy, "growth of the energy residual", "1", balance, "where how", {"energy"}, "*-energy-drift"},
      {"energy-failed", energy_findings, "energy", energy, "time of failure", "s", measured, "where how", {"energy"}, "*-energy-drift"},
      {"contact-energy", energy_findings, "energy", energy, "deviation of the energy lost in contact", "%", converged,
       "until taken bar off others", {"engines-energy"}, "{}-energy"},
      {"numerical-damping", energy_findings, "energy", energy, "deviation of the numerical damping from theory", "%", "exact", "rate",
       {"energy-damping"}, "energy-damping"},
      {"engines-damp", energy_findings, "energy", energy, "drag rate that damps as much", "1/s", "exact", "others none gains", {"matrix"}},
      {"cone", cone_findings, "contact", energy, "cases in agreement with Coulomb's law", "1", coulomb, "cases planes", {"sphere-cone", "plane-cone"}, "sphere-cone"},
      {"planes", plane_findings, "contact", energy, "error of the third apex on a floor", "%", "exact", "step period refused", {"plane-probes"}},
      {"planes-rest", plane_findings, "contact", energy, "energy lost at rest over that of a free slide", "%", "exact", "moving share", {"plane-probes"}},
      {"leaving", leaving_findings, "contact", energy, "deviation of the separation angle", "degrees", "exact", "step longest off", {"sphere-leaving"}},
      {"slides-off", drape_findings, "contact", energy, "height of the centre of mass", "m", other_engine, "end", {"sphere-drape"}, "drop-aside-sliding"},
      {"still-touches", drape_findings, "contact", energy, "mean sliding speed", "m/s", other_engine, "end", {"sphere-drape"}, "drop-aside-sliding"},
      {"after-contact", contact_findings, "contact", energy, "RMS position difference at the end", "m", other_engine, "window rules own", {"engines"}, "{}-agreement"},

      // least model
      {"least-model", adequacy_findings, "adequacy", model, "spring evaluations saved", "%", converged, "within gone until", {"adequacy-least"}, "{}-adequacy"},
      {"least-model-fails", adequacy_findings, "adequacy", model, "starts from which it fails", "1", converged, "within gone starts", {"adequacy-least"}, "{}-adequacy"},
      {"least-model-none", adequacy_findings, "adequacy", model, "scenes", "1", "see each scene", "where", {"adequacy-least"}},
      {"bend-power", bend_findings, "adequacy", model, "power of the number of cells", "1", measured, "derived springs",
       {"adequacy-scaling", "adequacy-bending"}, "adequacy-scaling"},

      // one scene
      {"same-rule", scene_findings, "agreement", "", apart, "m", other_engine, "window bound", {"engines"}, "{}-agreement"},
      {"chaotic", scene_findings, "failure", "", growth, "1", other_engine, "window apart", {"engines"}, "{}-agreement"},
      {"nearest", scene_findings, "accuracy", "", error, "m", "", "off window others", {"engines"}, "{}-error"},
      {"failed", scene_findings, "failure", "", "failed runs", "1", measured, "step methods end limit", {"engines"}, "{}-error"},
      {"converged-contact", scene_findings, "contact", "", "largest RMS position difference from converged contact", "m",
       "converged, mysim's contact rule", "window", {"engines"}, "{}-converged"},
      {"sticky", scene_findings, "failure", "", "largest difference of the centres of mass", "m", other_engine, "", {"engines"}, "{}-centres"},
      {"take", recommendation_findings, "choice", "", error_of_motion, "%", "", "setting evaluations cpu bound tied",
       {"speed-accuracy", "speed-accuracy-cost"}},
  };
  // clang-format on
  return rules;
}

const FindingRule& finding_rule(std::string_view key) {
  const std::string_view rule = key.substr(0, key.find('.'));
  const auto found = std::ranges::find(finding_rules(), rule, &FindingRule::key);
  if (found == finding_rules().end()) throw std::logic_error("no rule for findings named " + std::string(key));
  return *found;
}

Findings found_by_rules(const Facts& facts, bool of_scene) {
  Findings all;
  std::vector<Findings (*)(const Facts&)> called;
  for (const FindingRule& rule : finding_rules()) {
    if (rule.chapter.empty() != of_scene || std::ranges::count(called, rule.find) > 0) continue;
    called.push_back(rule.find);
    for (Finding& f : rule.find(facts)) all.push_back(std::move(f));
  }
  return all;
}

}  // namespace crosscheck
