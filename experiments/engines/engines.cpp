// Experiment `engines`: all methods on the same scene at the same step, with their energies.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/estimate.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/tables/energy.h"
#include "mysim/model/system.h"

namespace crosscheck {

// Experiment `engines`: all methods on the same scene at the same step; how far from the truth, how far from each
// other, at what cost.

namespace {

/// nan when the trajectories have no common time.
Cell largest(const Table& table, size_t from, const std::string& column, double until) {
  double most = -1;
  for (size_t i = from; i < table.rows.size(); ++i)
    if (std::get<double>(table.at(i, "t")) <= until * (1 + 1e-9))
      if (const auto* value = std::get_if<double>(&table.at(i, column))) most = std::max(most, *value);
  return most < 0 ? Cell() : Cell(most);
}

/// The largest stable step of the method's rule for the scene's fastest vibration at the start, s; empty where the rule
/// has none, chooses its own steps, or the particles' drag rates differ.
Cell predicted_limit(const Method& method, const Scene& scene, double omega) {
  const auto gamma = uniform_drag_rate(scene.model);
  if (const Stepper* rule = stepper_of(method); rule && !rule->adaptive && omega > 0 && gamma)
    if (const double limit = rule->limit(omega, *gamma); std::isfinite(limit)) return limit;
  return {};
}

/// Table SCENE-statistics: what perturbed runs have in common.
void add_statistics(const Request& request, const Scene& scene, const Run& run, Results& answers, Rows& rows) {
  Table table{scene.name + "-statistics",
              {{"method", "1"}, {"quantity", "1"}, {"unit", "1"}, {"mean", "see unit"}, {"deviation", "see unit"}},
              {}};
  // the rules that stand for the engines: sixteen runs of every method would tell no more
  for (const MethodFamily& family : method_families()) {
    if (!family.by_default()) continue;
    const auto methods = methods_of(request, scene);
    const auto asked =
        std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.name == family.representative; });
    if (asked == methods.end()) continue;
    if (!request.full && estimated_seconds(*asked, scene, run) > 0.3) {
      rows.notes.push_back(fmt::format("statistics leave out {} on {}: its sixteen runs cost much; --full has them",
                                       family.representative, scene.name));
      continue;
    }
    // who cannot take the scene, or failed on it, has no statistics
    const Result& answer = result_of(request, scene, *asked, answers);
    if (answer.outcome.verdict != Verdict::ok) continue;
    for (const Statistic& s : contact_statistics(*asked, scene, run))
      table.add({asked->name, s.quantity, s.unit, s.mean, s.deviation});
  }
  if (!table.rows.empty()) rows.add(table);
}

}  // namespace

void engines_on(const Request& request, const Scene& scene, Results& answers, Rows& rows) {
  Table summary{"engines",
                {{"scene", "1"},
                 {"method", "1"},
                 {"verdict", "1"},
                 {"reason", "1"},
                 {"end", "s"},
                 {"step", "s"},
                 {"steps", "1"},
                 {"evaluations", "1"},
                 {"coincident springs", "1"},
                 {"motion", "m"},
                 {"window", "s"},
                 {"measured window", "s"},
                 {"perturbation growth", "1"},
                 {"round-off bound", "m"},
                 {"truth", "1"},
                 {"truth tier", "1"},
                 {"truth bar", "m"},
                 {"truth until", "s"},
                 {"largest error", "m"},
                 {"largest difference from converged contact", "m"},
                 {"largest difference", "m"},
                 {"largest difference of centres", "m"},
                 {"smallest clearance", "m"},
                 {"creep at end", "m/s"},
                 {"predicted step limit", "s"},
                 {"different law", "1"}},
                {}};
  Table cost{"engines-cost",
             {{"scene", "1"},
              {"method", "1"},
              {"cpu", "s"},
              {"cpu per step", "s"},
              {"simulated per cpu", "s/s"},
              {"cpu of process", "s"}},
             {}};

  const Run run = run_of(request, scene);
  Table table{scene.name + "-engines",
              {{"method", "1"},
               {"t", "s"},
               {"error", "m"},
               {"difference from converged contact", "m"},
               {"difference", "m"},
               {"difference of centres", "m"},
               {"clearance", "m"},
               {"creep", "m/s"}},
              {}};
  const auto truth = truth_of(scene, run);
  // differences from a run that failed would tell nothing
  const Result& by_rule = result_of(request, scene, find_method(std::string(subject().representative)), answers);
  const Trajectory reference = by_rule.outcome.verdict == Verdict::ok ? by_rule.trajectory : Trajectory{};
  const Method probe = find_method(reference.frames() > 0 ? std::string(subject().representative) : scene.method);
  const Growth growing = growth_of(probe, scene, run, reference.frames() > 0 ? &reference : nullptr);
  const double growth = growing.until(scene.window);
  const double omega = scene.model.first_order() ? 0 : highest_frequency(scene.model, scene.start);
  // what others are apart from the converged in-house contact rule is a difference, no error
  const bool of_rule = truth && truth->under_contact_rule;
  const double motion = motion_of(truth && !of_rule ? truth->trajectory : reference);

  for (const Method& method : methods_of(request, scene)) {
    Result& answer = result_of(request, scene, method, answers);
    Outcome& out = answer.outcome;
    if (out.verdict != Verdict::unsupported && !method.stepper) {
      rows.certificates.push_back(certify(method.name, scene, out));
      if (rows.certificates.back().mismatch()) {
        // what answers another scene is no answer: no number of it is kept
        out.verdict = Verdict::unsupported;
        out.reason = "it built another scene, see its parity certificate";
      }
    }
    if (out.verdict == Verdict::unsupported) answer.trajectory = {};
    const Trajectory& path = answer.trajectory;
    const bool unsupported = out.verdict == Verdict::unsupported;
    const size_t first_row = table.rows.size();
    double lowest = 1e300;
    for (int i = 0; i < path.frames() && !unsupported; ++i) {
      const bool both = i < reference.frames() && reference.x[i].cols() == path.x[i].cols();
      const auto gap = clearance(scene, path.t[i], path.x[i]);
      if (gap) lowest = std::min(lowest, *gap);
      const Cell apart =
          truth && i < truth->trajectory.frames() ? Cell(rms_distance(path.x[i], truth->trajectory.x[i])) : Cell();
      table.add(
          {method.name, path.t[i], of_rule ? Cell() : apart, of_rule ? apart : Cell(),
           both ? Cell(rms_distance(path.x[i], reference.x[i])) : Cell(),
           both ? Cell((centre_of_mass(scene, path.x[i]) - centre_of_mass(scene, reference.x[i])).norm()) : Cell(),
           cell_of(gap), cell_of(creep(scene, path.t[i], path.x[i], path.v[i]))});
    }
    std::string laws;
    for (const std::string& law : out.different_law) laws += (laws.empty() ? "" : "; ") + law;
    const bool ok = out.verdict == Verdict::ok;
    summary.add({scene.name,
                 method.name,
                 std::string(name_of(out.verdict)),
                 out.reason,
                 out.end,
                 out.step,
                 out.steps,
                 out.evaluations,
                 out.degenerate_springs,
                 motion,
                 scene.window,
                 growing.window(),
                 growth,
                 cell_of(round_off_bound(scene, motion, growth)),
                 truth ? Cell(truth->how) : Cell(),
                 truth ? Cell(std::string(name_of(truth->tier)) + (of_rule ? ", in-house contact rule" : "")) : Cell(),
                 truth ? Cell(truth->error_bar) : Cell(),
                 of_rule ? Cell(truth->until) : Cell(),
                 ok ? largest(table, first_row, "error", scene.window) : Cell(),
                 ok ? largest(table, first_row, "difference from converged contact", scene.window) : Cell(),
                 ok ? largest(table, first_row, "difference", scene.window) : Cell(),
                 ok ? largest(table, first_row, "difference of centres", scene.duration) : Cell(),
                 ok && lowest < 1e300 ? Cell(lowest) : Cell(),
                 ok && path.frames() ? cell_of(creep(scene, path.t.back(), path.x.back(), path.v.back())) : Cell(),
                 predicted_limit(method, scene, omega),
                 laws});
    if (!out.remark.empty()) rows.notes.push_back(fmt::format("{} on {}: {}", method.name, scene.name, out.remark));
    // an outside program need not tell its own time
    const bool told = out.process_seconds == 0 || out.cpu_seconds > 0;
    if (!unsupported)
      cost.add({scene.name, method.name, told ? Cell(out.cpu_seconds) : Cell(),
                told && out.steps ? Cell(out.cpu_seconds / static_cast<double>(out.steps)) : Cell(),
                out.cpu_seconds > 0 ? Cell(out.end / out.cpu_seconds) : Cell(),
                out.process_seconds > 0 ? Cell(out.process_seconds) : Cell()});
  }
  rows.add(table);
  if (scene.model.find<Spheres>() && scene.model.particles.size() > 1)
    add_statistics(request, scene, run, answers, rows);
  rows.add(summary);
  rows.add(cost);
  add_energies(request, scene, answers, rows);
}

std::vector<Point> engines_points(const Request& request) {
  return one_point_per_scene(request, "engines", [](const Request& alone, const Scene& scene, Rows& rows) {
    Results answers;
    engines_on(alone, scene, answers, rows);
  });
}

void add_energies(const Request& request, const Scene& scene, Results& answers, Rows& rows) {
  Table summary{"engines-energy",
                {{"scene", "1"},
                 {"method", "1"},
                 {"verdict", "1"},
                 {"end", "s"},
                 {"energy turned over", "J"},
                 {"largest balance error", "J"},
                 {"relative balance error", "1"},
                 {"contact loss inferred", "1"}},
                {}};
  if (scene.model.first_order()) {
    rows.notes.push_back(fmt::format("energies leave out {}: a first-order system has no energy", scene.name));
    rows.add(summary);
    return;
  }
  Table table = ledger_table(scene.name + "-energy");
  for (const Method& method : methods_of(request, scene)) {
    const Result& answer = result_of(request, scene, method, answers);
    const Outcome& out = answer.outcome;
    if (out.verdict == Verdict::unsupported) continue;
    if (answer.ledger.empty()) {
      rows.notes.push_back(fmt::format("energies leave out {} on {}: it gave no velocities", method.name, scene.name));
      continue;
    }
    const double start = answer.ledger.front().balance();
    double worst = 0, energy_scale = 0;
    add_ledger(table, method.name, answer.ledger, answer.contact_inferred);
    for (const LedgerRow& row : answer.ledger) {
      worst = std::max(worst, std::abs(row.balance() - start));
      energy_scale = std::max({energy_scale, row.energy.kinetic,
                               std::abs(row.energy.gravitational - answer.ledger[0].energy.gravitational)});
    }
    const bool ok = out.verdict == Verdict::ok;
    const bool claimed = ok && !answer.contact_inferred;
    summary.add({scene.name, method.name, std::string(name_of(out.verdict)), out.end, energy_scale,
                 claimed ? Cell(worst) : Cell(), claimed && energy_scale > 0 ? Cell(worst / energy_scale) : Cell(),
                 answer.contact_inferred ? 1l : 0l});
  }
  rows.add(table);
  rows.add(summary);
}

}  // namespace crosscheck
