// The table of rules, and how a finding's sentence follows from its rule.

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

#include "report/findings/findings.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

const std::vector<FindingRule>& finding_rules() {
  static constexpr std::string_view apart = "largest RMS position difference", error = "largest RMS position error",
                                    error_of_motion = "largest RMS position error over the motion",
                                    times_cpu = "CPU time over that of mysim", ball = "energy",
                                    speed = "speed-accuracy", same = "same-answer", other_engine = "another engine",
                                    measured = "measured", discrete = "exact for the discrete rule",
                                    coulomb = "exact (Coulomb's law)";
  // clang-format off
  static const std::vector<FindingRule> rules = {
      // what the page opens with
      {"answer-agreement", "answer", same, apart, "m", other_engine,
       "Yes: same rule, same step, and mysim{programs} and {other} part by {most} on {scenes}{contact}.",
       "over scenes without contact: max of largest difference of methods of the same rule; with contact: the same",
       {"engines"}},
      {"answer-agreement-no", "answer", same, apart, "m", other_engine,
       "No: with the same rule and step, mysim and {other} part by up to {value}, beyond round-off, on {where}.",
       "over scenes without contact where largest difference exceeds the round-off bound: its max", {"engines"}},
      {"answer-agreement-contact", "answer", same, apart, "m", other_engine,
       "Nearly: with contact, the same rule at the same step parts by at most {value}, on {where}.",
       "over scenes with contact: max of largest difference of methods of the same rule", {"engines"}},
      {"answer-same-motion", "answer", same, apart, "m", other_engine,
       "Yes: at the same step {other} and mysim's {method} part by at most {value}, within round-off, on {where}.",
       "over scenes without contact: max of largest difference of a program; at most the round-off bound on each",
       {"engines"}},
      {"answer-chaotic", "answer", same, "growth of a perturbation of 1e-10 m", "1", other_engine,
       "It cannot be told: on {where} a perturbation grows {value}-fold, which parts correct engines, too.",
       "perturbation growth on scenes without contact and without a round-off bound, where no other is compared",
       {"engines"}},
      {"answer-difference", "answer", same, apart, "m", other_engine,
       "At the same step {other} and mysim's {method} part by up to {value}, on {where}; their rules may differ.",
       "over scenes: max of largest difference of the other engine's nearest method", {"engines"}},
      {"answer-method", "answer", speed, error_of_motion, "%", measured,
       "On {scene} take {method}, {setting}: error {value}, {speed} than real time{beside}.",
       "at part of motion = 0.01 on the main scene: the cheapest run, of those as cheap within noise the least "
       "largest error / motion, ± truth bar / motion; duration / cpu; times mysim",
       {"speed-accuracy-cheapest-cost", "speed-accuracy-cost", "speed-accuracy", "speed-accuracy-engines-cost"}},
      {"answer-limit", "answer", "stability", "critical time step", "s", discrete,
       "On {where} {method} blows up above {value}; theory says {theory}. {limits} within {within} of theory.",
       "measured and predicted limit at rest on the main scene, from held to failed; of all limits at rest max of "
       "|deviation| and failed / held - 1", {"stability", "speed-accuracy-cheapest-cost"}},
      {"answer-failed", "answer", "stability", "failed runs", "1", measured,
       "{value} of {runs} at the scenes' own steps failed: {which}.",
       "runs whose verdict is not ok", {"engines"}},
      {"answer-none-failed", "answer", "stability", "runs", "1", measured,
       "None of the {value} runs at the scenes' own steps failed.",
       "runs whose verdict is ok", {"engines"}},
      {"answer-ball", "answer", ball, "cases in agreement with Coulomb's law",
       "1", "exact (Coulomb's law); another engine",
       "{method} obeys Coulomb in {value} of {cases} cases{others}{drape}.",
       "cases whose answer is the answer by theory; largest difference of the last scene with contact",
       {"sphere-cone", "engines"}},
      {"answer-contact", "answer", ball, apart, "m", other_engine,
       "On {where}, with contact, {other} and mysim's {method} part by {value} until {until}.",
       "largest difference of the last scene with contact", {"engines"}},
      {"answer-energy", "answer", ball, "largest residual of the balance over the energy turned over", "%", measured,
       "On {where} {method} keeps the energy balance to {value}{damping}.",
       "largest residual / energy turned over; equivalent drag at h omega = 0.1 by the closed form's side",
       {"energy", "energy-damping"}},
      {"answer-model", "answer", "adequacy", "spring evaluations over those of the full model", "%", "converged",
       "On {scene}, for an error of 1 % leave out {one}; for 10 % {ten}: {value} of the work stays.",
       "left out at 1 % and 10 % of the main scene's motion, where it holds; cost of full", {"adequacy-least"}},
      {"answer-model-none", "answer", "adequacy", "spring evaluations over those of the full model", "%", "converged",
       "On {scene} nothing can be left out, not even for an error of 10 % of the motion.",
       "left out is empty at 1 % and 10 % of the main scene's motion", {"adequacy-least"}},
      {"answer-model-same", "answer", "adequacy", "spring evaluations over those of the full model", "%", "converged",
       "On {scene} leave out {one}, for 1 % and for 10 % of the motion: {value} of the work stays.",
       "left out at 1 % and 10 % of the main scene's motion, where it holds; cost of full", {"adequacy-least"}},

      // same scene, same answer?
      {"contact-of-all", "contact", same, apart, "m", other_engine,
       "With contact the same rule in mysim and {other} differs by at most {value}, most on {where}.",
       "over scenes with contact: max of largest difference of methods of the same rule", {"engines"}},
      {"chaotic", "failure", same, "scenes", "1", other_engine,
       "Nothing can be said of agreement with {other} on {where}: the motion is chaotic.",
       "scenes without contact and without a round-off bound", {"engines"}},
      {"cannot", "failure", same, "scenes", "1", measured,
       "{method} cannot model {where}: the tables of runs say why.",
       "verdict is unsupported", {"engines"}},
      {"known-disagreements", "failure", same, "known departures from the scene", "1", measured,
       "{method} departs from what a scene asks in {ways}, each measured in the smallest scene that shows it.",
       "rows that are explained or reproduced, by engine", {"disagreements"}},
      {"relations", "agreement", same, "relations that hold", "1", "none is needed",
       "Without any truth: of {asked} that any engine must answer alike, {method} does in {value}{rest}.",
       "rows whose mark is holds, by engine, of those whose mark is not cannot be asked", {"relations"}},
      {"relations-broken", "failure", same, "relations broken without a known cause", "1", "none is needed",
       "{method} breaks what must hold in any engine: {which}.",
       "relations of the rows whose mark is broken, by engine", {"relations"}},
      {"effective-stiffness", "failure", same, "stiffness asked for over the effective one", "1", "converged",
       "At a step of {step} with {passes}, {method} makes a hanging cloth {value} times softer than asked{more}.",
       "1 / stiffness by sag of the last net at the step nearest to 1/60 s with the fewest iterations; with the most",
       {"stiffness-effective"}, "stiffness-effective"},

      // speed against accuracy
      {"nearest-of-all", "accuracy", speed, "scenes", "1", "see each scene",
       "{method} has the method nearest to the truth, alone or within 5 %, on {value} of {scenes}.",
       "over scenes with a truth: whose least largest error, of runs that are ok, is within 1.05 times the least of "
       "all, or within the truth bar", {"engines"}, "scoreboard"},
      {"other-law-of-all", "accuracy", speed, error_of_motion, "%", "see each scene",
       "{method} errs by {range} of the motion at the scenes' own steps, most on {where}.",
       "over scenes: min and max of largest error / motion of a position-based method", {"engines"}, "scoreboard"},
      {"orders", "order", speed, "deviation of the order of accuracy", "1", "see each scene",
       "Measured orders of accuracy lie within {off} of the declared ones: {methods}, {scenes}.",
       "max of |measured order - declared order|; how many methods and scenes", {"order-slopes"}, "spring-order"},
      {"orders-differ", "failure", speed, "order of accuracy", "1", "see each scene",
       "The measured order of {method} on {where} is {off} instead of {declared}.",
       "the row of max of |measured order - declared order|, where that is above 0.1",
       {"order-slopes"}, "spring-order"},
      {"cheapest", "cost", speed, "scenes", "1", measured,
       "For an error of 1 % of the motion {method} is cheapest in CPU time, alone or tied, on {value} of {scenes}.",
       "at part of motion = 0.01 and measure = error: the engines of method and of what is as cheap within noise",
       {"speed-accuracy-cheapest-cost"}, "cheapest-1-percent-cost"},
      {"engine-times", "cost", speed, times_cpu, "1", measured,
       "For 1 % of the motion {method} needs {range} times mysim's CPU time, {where}.",
       "at part of motion = 0.01 and measure = error: min and max of times mysim over scenes",
       {"speed-accuracy-engines-cost"}, "cheapest-1-percent-cost"},
      {"engine-evaluations", "cost", speed, "force evaluations over those of mysim", "1", measured,
       "For 1 % of the motion {method} needs {range} times mysim's force evaluations, where runs are chosen by them.",
       "at part of motion = 0.01 and measure = error: min and max of Bullet / mysim", {"speed-accuracy-cheapest"}},
      {"engine-without-run", "cost", speed, "scenes", "1", measured,
       "No run of {method} that was tried is within 1 % of the motion on {where}.",
       "scenes with runs of an engine that have an answer, none of them ok with a largest error within 0.01 of the "
       "motion, and no row of it at part of motion = 0.01",
       {"speed-accuracy-engines-cost", "speed-accuracy"}},
      {"hardly-tried", "cost", speed, "pairs of a method and a scene", "1", measured,
       "Hardly tried, by less than two runs where the method takes the scene: {which}.",
       "methods of speed-accuracy with less than two runs on a scene that they take", {"speed-accuracy", "engines"}},
      {"size-cost-any", "cost", "cost", times_cpu, "1", measured,
       "On a cloth a step of symplectic Euler costs {other} ({build}) {range} times mysim's general solver, most at "
       "{where}.",
       "over sides: min and max of cpu per step of bullet/deformable-explicit / that of mysim/symplectic-euler+plain",
       {"size-cost"}, "size-cost"},
      {"size-cost-grid", "cost", "cost", times_cpu, "1", measured,
       "Against mysim's kernel for regular cloths{lacks} the step costs {other} {range} times as much, most at "
       "{where}.",
       "over sides: min and max of cpu per step of bullet/deformable-explicit / that of mysim/symplectic-euler",
       {"size-cost"}, "size-cost"},

      // where methods fail
      {"failed-of-all", "failure", "stability", "scenes", "1", measured,
       "{method} failed on {where}, where other methods hold at the same step.",
       "scenes on which its verdict is not ok and another method's is", {"engines"}, "scoreboard"},
      {"crashed-of-all", "failure", "stability", "scenes", "1", measured,
       "{method} gave no answer on {where}: the program failed or took too long.",
       "scenes on which its verdict is crash or timeout and another method's is ok", {"engines"}, "scoreboard"},
      {"failed-everywhere", "failure", "stability", "scenes", "1", measured,
       "No method that was asked comes to the end on {where}.",
       "scenes without a verdict ok", {"engines"}, "scoreboard"},
      {"step-limits", "agreement", "stability", "deviation of the critical time step from theory", "%", discrete,
       "{limits} within {value} of what the eigenvalues predict, on {scenes}.",
       "at rest, where |deviation| is at most 1 %: max of |deviation| and of failed / held - 1",
       {"stability"}, "stability-limits"},
      {"step-limits-coarse", "agreement", "stability", "width of the search's bracket", "%", measured,
       "Of the limits that were searched coarsely, {limits} around theory's, in brackets up to {value} wide.",
       "predicted limit between held and failed, deviation above 1 %: max of failed / held - 1",
       {"stability"}, "stability-limits"},
      {"step-limits-apart", "failure", "stability", "limits away from theory", "1", measured,
       "{limits} elsewhere than theory says; {method} on {where}: {how}.",
       "at rest: rows whose measurement contradicts the prediction; the largest deviation",
       {"stability"}, "stability-limits"},
      {"step-limits-at-start", "accuracy", "stability", "limits away from theory", "1", measured,
       "Where a scene has no rest, theory sees its start alone: {value} of {all} lie elsewhere.",
       "at the start: rows whose measurement contradicts the prediction", {"stability"}, "stability-limits"},
      {"limits-by-truth", "failure", "stability", "limits that the truth confirms", "1", "converged",
       "On {scene} the truth confirms {value} of {all}: {how}.",
       "rows with a truth: error below at most a tenth of motion and error above more; max of error below / motion, min "
       "of error above / motion", {"stability"}, "stability-limits"},
      {"no-stable-step", "failure", "stability", "scenes", "1", discrete,
       "{method} has no stable step at all on {where}, as theory says.",
       "rows at rest whose prediction and measurement are no stable step", {"stability"}, "stability-limits"},
      {"growth", "failure", "stability", "deviation of the growth in a step from theory", "%", discrete,
       "Where no step is stable, vibrations grow in each step as theory says, but for {value} at most ({method} on "
       "{where}).",
       "growth without share of limit: max of |deviation|", {"stability-growth"}},

      // energy and the ball
      {"symplectic-energy", "energy", ball, "largest energy residual over the energy turned over",
       "%", "exact balance",
       "In {steps} undamped steps symplectic rules keep the energy to {value} of what is turned over{drift}.",
       "over runs of symplectic rules on undamped scenes whose balance closes: max of largest residual / energy "
       "turned over", {"energy"}, "*-energy-drift"},
      {"symplectic-drift", "energy", ball, "growth of the energy residual", "1", "exact balance",
       "On {where} {method}, though symplectic, {how}: its energy residual is not bounded.",
       "growth of the residual above 0.5, or largest residual above 0.3 of the energy turned over",
       {"energy"}, "*-energy-drift"},
      {"symplectic-failed", "failure", ball, "time of failure", "s", measured,
       "{method} is symplectic, and yet fails on {where} after {value} ({how}).",
       "runs of symplectic rules on undamped scenes whose verdict is not ok, at their end",
       {"energy"}, "*-energy-drift"},
      {"energy-failed", "energy", ball, "time of failure", "s", measured,
       "On {where} {method} fails after {value} ({how}).",
       "the run of a rule that is not symplectic on the first undamped scene, at its end",
       {"energy"}, "*-energy-drift"},
      {"energy-damps", "energy", ball, "equivalent drag rate", "1/s", "exact balance",
       "On {where} {method} damps like a drag of {value}, at steps of {step}.",
       "equivalent drag of a rule that is not symplectic on the first undamped scene", {"energy"}, "*-energy-drift"},
      {"energy-adds", "energy", ball, "largest energy residual over the energy turned over", "%", "exact balance",
       "On {where} {method} adds {value} of the energy turned over, at steps of {step}.",
       "largest residual / energy turned over of a rule that is not symplectic on the first undamped scene",
       {"energy"}, "*-energy-drift"},
      {"open-balance", "energy", ball, "largest energy residual over what drag and contact took", "%", "exact balance",
       "On {where}, symplectic rules leave {range} of what drag and contact take unaccounted for, most with "
       "{method}.",
       "over runs of symplectic rules: min and max of largest residual / (|drag took| + |dashpots took| + |contact "
       "took|)", {"energy"}},
      {"contact-energy", "energy", ball, "deviation of what contact takes from the truth", "%", "converged",
       "Until {until} {scene}'s ball {takes}; {method} {off}{others}.",
       "|contact took - contact takes in truth| / contact takes in truth, ± its bar, of mysim/symplectic-euler; beside it "
       "mysim's furthest off, and other engines'", {"engines-energy"}, "{}-energy"},
      {"numerical-damping", "energy", ball, "deviation of the numerical damping from theory", "%", "exact",
       "{method} damps by itself{rate}; theory agrees to within {value}.",
       "max of |equivalent drag / by theory - 1|; equivalent drag / omega at h omega = 0.1",
       {"energy-damping"}, "energy-damping"},
      {"cone", "contact", ball, "cases in agreement with Coulomb's law", "1", coulomb,
       "On slopes {method} sticks or slides as Coulomb's law says in {value} of {cases} cases.",
       "cases whose answer is the answer by theory, of those whose verdict is ok", {"sphere-cone"}, "sphere-cone"},
      {"leaving", "contact", ball, "deviation of the separation angle", "degrees", "exact",
       "With {method}{which}, particles leave the ball {off} at {step}{worse}.",
       "angle - angle by theory at the shortest step, of mysim's methods the largest; and at the longest step",
       {"sphere-leaving"}, "sphere-leaving"},
      {"slides-off", "contact", ball, "height of the centre of mass", "m", other_engine,
       "With {method} the cloth dropped beside the middle is off the ball after {end}.",
       "creep is empty, of drop-aside at the finest step of mysim/symplectic-euler",
       {"sphere-drape"}, "drop-aside-sliding"},
      {"still-touches", "contact", ball, "mean sliding speed", "m/s", other_engine,
       "With {method} the cloth dropped beside the middle still touches the ball after {end}, sliding at {value}.",
       "creep of drop-aside at the finest step of mysim/symplectic-euler", {"sphere-drape"}, "drop-aside-sliding"},
      {"after-contact", "contact", ball, "largest RMS position difference over the whole run", "m", other_engine,
       "On {scene} beyond {window}, {rules} of mysim's rules agree within {own}; {other} departs by up to {value}.",
       "max of difference over the whole run, of mysim's rules of order two and more and of the other method, in "
       "the scene's own table; the other's is more than three times theirs", {"engines"}, "{}-agreement"},
      {"after-contact-open", "contact", ball, "largest RMS position difference over the whole run", "m", other_engine,
       "On {scene} beyond {window} single positions say nothing: mysim's rules part by {own}, {other} by {value}.",
       "the same, where the other's is at most three times theirs", {"engines"}, "{}-agreement"},
      {"final-lengths", "contact", ball, "largest difference of height and outline at the end", "m", measured,
       "On {scene} {why}; perturbed starts move final height and outline by {spread}, other methods by up to {value}.",
       "in the scene's table of statistics, over quantities in m at the end: max of deviation of mysim/symplectic-euler; "
       "max of |mean - its mean|", {"engines"}},
      {"penetration", "contact", ball, "penetration depth over the radius", "%", measured,
       "With {method} particles of a cloth sink into a ball by up to {value} of its radius, triangles by "
       "{triangles}.",
       "over runs of an engine that are ok: max of particles and of triangles",
       {"sphere-penetration"}, "drop-centred-penetration"},
      {"penetration-of-triangles", "contact", ball, "penetration depth over the radius", "%", measured,
       "With {method} no particle of a cloth sinks into a ball; its triangles do, by up to {value} of the radius.",
       "over runs of an engine that are ok, where particles are at most 1e-9: max of triangles",
       {"sphere-penetration"}, "drop-centred-penetration"},

      // how little model is enough
      {"least-model", "adequacy", "adequacy", "spring evaluations saved", "%", "converged",
       "On {scene}, {within}, {gone} can be left out, which saves {value} of the work.",
       "left out where it holds, up to the window; 1 - cost of full", {"adequacy-least"}, "{}-adequacy"},
      {"least-model-full", "adequacy", "adequacy", "spring evaluations saved", "%", "converged",
       "On {scene}, {within}, all ingredients are needed.",
       "left out is empty and holds", {"adequacy-least"}, "{}-adequacy"},
      {"least-model-fails", "adequacy", "adequacy", "starts from which it fails", "1", "converged",
       "On {scene}, {within}, a model without {gone} fails from {value} of {starts} other starts.",
       "unseen errors above the tolerance where the least model does not hold", {"adequacy-least"}, "{}-adequacy"},
      {"least-model-none", "adequacy", "adequacy", "scenes", "1", "see each scene",
       "Nothing can be left out of {where}, not even for 10 % of the motion.",
       "scenes whose left out is empty at every tolerance", {"adequacy-least"}},
      {"families", "adequacy", "adequacy", error_of_motion, "%", "converged",
       "Without {most} springs {scene} is {value} of its motion off; without {least} springs {low}.",
       "over rows that lack one family of springs: min and max of error / motion", {"adequacy"}, "{}-adequacy"},
      {"grid-powers", "adequacy", "adequacy", "power of the number of cells", "1", measured,
       "For the same sag on a finer grid, stiffnesses of {scene} go as the number of cells to the power {value±}.",
       "slope of log stiffness over log cells at the same sag", {"adequacy-scaling"}, "adequacy-scaling"},
      {"bend-power", "adequacy", "adequacy", "power of the number of cells", "1", measured,
       "For the same droop, bend springs stiffen as cells to the power {value±}, against {derived} derived for many "
       "cells{open}.",
       "slope of log stiffness of bend springs over log cells at the same droop",
       {"adequacy-scaling", "adequacy-bending"}, "adequacy-scaling"},
      {"bend-power-by-springs", "adequacy", "adequacy", "power of the number of bend springs", "1", measured,
       "Counted in bend springs along a line the power is {value±}: {part} of the difference comes from the free "
       "end.",
       "slope of log stiffness of bend springs over log of their number along a line",
       {"adequacy-bending", "adequacy-scaling"}, "adequacy-scaling"},

      // of one scene
      {"same-rule", "agreement", "", apart, "m", other_engine,
       "Same rule, same step: {other} parts from mysim by at most {value} in {window}; round-off allows {bound}.",
       "largest difference = max over samples up to the window of the RMS distance from mysim/symplectic-euler; at "
       "most the round-off bound", {"engines"}, "{}-agreement"},
      {"same-rule-differs", "failure", "", apart, "m", other_engine,
       "The same rule at the same step does NOT give the same motion: {other} parts by {value}; {bound} would be "
       "round-off.",
       "largest difference above the round-off bound", {"engines"}, "{}-agreement"},
      {"same-rule-contact", "agreement", "", apart, "m", other_engine,
       "With contact, {other} and {method} part by at most {value} until {window}.",
       "largest difference of methods of the same rule on a scene with contact", {"engines"}, "{}-agreement"},
      {"same-rule-chaotic", "failure", "", "growth of a perturbation of 1e-10 m", "1", other_engine,
       "Nothing can be said of agreement: within {window} a perturbation grows {value}-fold; {other} parts by "
       "{apart}.",
       "perturbation growth; largest difference", {"engines"}, "{}-agreement"},
      {"same-motion", "agreement", "", apart, "m", other_engine,
       "At the same step {other} parts from mysim's {method} by at most {value} in {window}; round-off allows "
       "{bound}.",
       "largest difference of a program, whose rule is not known; at most the round-off bound",
       {"engines"}, "{}-agreement"},
      {"unknown-rule", "agreement", "", apart, "m", other_engine,
       "{other} and {method} part by at most {value} in {window}; whether they follow the same rule is not known.",
       "largest difference of a program, whose rule is not known", {"engines"}, "{}-agreement"},
      {"different-rule", "agreement", "", apart, "m", other_engine,
       "{other} and {method} part by at most {value} in {window}; they do not follow the same rule and laws.",
       "largest difference of methods of different rules", {"engines"}, "{}-agreement"},
      {"centres", "agreement", "", "largest difference of the centres of mass", "m", other_engine,
       "Over the whole run the centres of mass stay within {value}: {other} and {method}.",
       "largest difference of centres", {"engines"}, "{}-centres"},
      {"nearest", "accuracy", "", error, "m", "",
       "Nearest to the truth at the scene's own step is {method}{others}: {off} off in {window}.",
       "least of largest error = max over samples up to the window of the RMS distance from the truth, over runs "
       "that are ok, ± truth bar; never said to be less than the truth bar", {"engines"}, "{}-error"},
      {"nearest-single", "accuracy", "", error, "m", "",
       "Of methods with one force evaluation a step the nearest is {method}: {off} off.",
       "the same over runs with one evaluation a step", {"engines"}, "{}-error"},
      {"nearest-of-engine", "accuracy", "", error, "m", "",
       "{method} is {off} off, {share} of the motion{best}.",
       "the same over runs of one engine", {"engines"}, "{}-error"},
      {"other-law", "accuracy", "", error_of_motion, "%", "",
       "{method} is {off} off, {value} of the motion: {why}.",
       "largest error / motion of a position-based method", {"engines"}, "{}-error"},
      {"other-law-difference", "accuracy", "", apart, "m", other_engine,
       "{method} differs by up to {value} until {window}: {why}.",
       "largest difference of a position-based method", {"engines"}, "{}-agreement"},
      {"failed", "failure", "", "failed runs", "1", measured,
       "At a step of {step}, {value} of {methods} failed{first} {method} after {end}{limit}.",
       "runs whose verdict is not ok, at their end; predicted step limit where it is below the step",
       {"engines"}, "{}-error"},
      {"sinks-in", "contact", "", "penetration depth", "m", measured,
       "Deepest inside the contact surface are particles by {method}: by {value}.",
       "max of -smallest clearance over runs that are ok, where that is above round-off", {"engines"}, "{}-clearance"},
      {"converged-contact", "contact", "", "largest RMS position difference from converged contact",
       "m", "converged, in-house contact rule",
       "{method} is up to {value} from what the in-house contact rule converges to, until {window}.",
       "largest difference from converged contact, up to truth until, ± truth bar", {"engines"}, "{}-converged"},
      {"sticky", "failure", "", "largest difference of the centres of mass", "m", other_engine,
       "The assignment's sticky sphere freezes what touches it: the centre of mass ends up to {value} away.",
       "largest difference of centres of mysim/symplectic-euler+sticky", {"engines"}, "{}-centres"},
      {"take", "choice", "", error_of_motion, "%", "",
       "For 1 % of the motion take {method}, {setting}: error {value}, {speed} than real time; {bound} bounds the "
       "step.",
       "at part of motion = 0.01: the cheapest run, of those as cheap within noise the least largest error / "
       "motion, ± truth bar / motion; duration / cpu; bound: how the next longer step misses 1 %",
       {"speed-accuracy-cheapest-cost", "speed-accuracy-cost", "speed-accuracy"}},
      {"take-tied", "choice", "", "methods tied in speed", "1", measured,
       "As fast, as far as the clock can tell, but further from the truth: {which}.",
       "as cheap within noise", {"speed-accuracy-cheapest-cost", "speed-accuracy"}},
      {"take-beside", "choice", "", times_cpu, "1", measured,
       "For 1 % of the motion {other} needs {value} times mysim's CPU time.",
       "at part of motion = 0.01 and measure = error: times mysim, from low to high", {"speed-accuracy-engines-cost"}},
  };
  // clang-format on
  return rules;
}

const FindingRule& finding_rule(std::string_view name) {
  for (const FindingRule& rule : finding_rules())
    if (rule.name == name) return rule;
  throw std::logic_error("no rule for findings named " + std::string(name));
}

namespace {

std::string number_text(double value) {
  if (value == std::round(value) && std::abs(value) < 1e6) return count_text(std::lround(value));
  return std::abs(value) < 1e4 ? times_text(value) : nice(value);
}

std::string in_unit(double value, std::string_view unit) {
  static const std::pair<std::string_view, std::string (*)(double)> forms[] = {
      {"m", nice_length},
      {"s", step_text},
      {"%", [](double v) { return percent(v, 100); }},
      {"m/s", [](double v) { return nice(1e3 * v) + " mm/s"; }},
      {"1/s", [](double v) { return fmt::format("{:.2g} per second", v); }},
      {"degrees", [](double v) { return fmt::format("{:.2g} degrees", v); }},
      {"1", number_text}};
  for (const auto& [name, form] : forms)
    if (name == unit) return form(value);
  throw std::logic_error("no form for the unit " + std::string(unit));
}

/// What stands for a name in braces.
std::string filled(const Finding& f, const FindingRule& rule, const std::string& name) {
  if (name == "scene") return f.scene;
  if (name == "method") return name_in_sentence(f.method);
  if (name == "other") return name_in_sentence(f.other);
  if (name == "value") return in_unit(f.value, rule.unit);
  if (name == "low" && f.low) return in_unit(*f.low, rule.unit);
  if (name == "high" && f.high) return in_unit(*f.high, rule.unit);
  if (name == "range" && f.low && f.high) return range(in_unit(*f.low, rule.unit), in_unit(*f.high, rule.unit));
  if (name == "value±" && f.high) return fmt::format("{:.2f} ± {:.2f}", f.value, *f.high - f.value);
  if (const auto word = f.words.find(name); word != f.words.end()) return word->second;
  throw std::logic_error(fmt::format("a finding of {} lacks {}", f.rule, name));
}

}  // namespace

std::string sentence_of(const Finding& f) {
  const FindingRule& rule = finding_rule(f.rule);
  std::string out;
  for (size_t at = 0; at < rule.sentence.size();) {
    const size_t open = std::min(rule.sentence.find('{', at), rule.sentence.size());
    out += rule.sentence.substr(at, open - at);
    if (open == rule.sentence.size()) break;
    const size_t close = rule.sentence.find('}', open);
    out += filled(f, rule, std::string(rule.sentence.substr(open + 1, close - open - 1)));
    at = close + 1;
  }
  return out;
}

std::string tier_of(const Finding& f) { return f.tier.empty() ? std::string(finding_rule(f.rule).tier) : f.tier; }

Json json_of(const Finding& f) {
  const FindingRule& rule = finding_rule(f.rule);
  return {{"scene", f.scene},
          {"topic", rule.topic},
          {"sentence", sentence_of(f)},
          {"tier", tier_of(f)},
          {"method", f.method},
          {"other_method", f.other},
          {"quantity", rule.quantity},
          {"value", f.value},
          {"unit", rule.unit},
          {"low", f.low ? Json(*f.low) : Json()},
          {"high", f.high ? Json(*f.high) : Json()},
          {"chapter", rule.chapter},
          {"rule", f.rule},
          {"formula", rule.formula}};
}

std::string sentences_of(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& f : findings) out += (out.empty() ? "" : " ") + sentence_of(f);
  return out;
}

}  // namespace crosscheck
