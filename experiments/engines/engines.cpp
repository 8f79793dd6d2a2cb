
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "experiments/estimate.h"
#include "experiments/experiment.h"
#include "experiments/metrics.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/engines.h"
#include "mysim/model/system.h"

namespace crosscheck {

// Experiment `engines` compares all methods on the same scene at the same step: distance from the truth and from each
// other, energies, and cost.

namespace {

/// The largest value up to time `until` (s); nullopt if no row has a value.
std::optional<double> largest(const std::vector<EngineTimeRow>& rows, std::optional<double> EngineTimeRow::*member,
                              double until) {
  double most = -1;
  for (const EngineTimeRow& row : rows)
    if (row.t <= until * (1 + 1e-9)) most = std::max(most, (row.*member).value_or(-1));
  return most < 0 ? std::nullopt : std::optional(most);
}

/// Largest stable step (s) of the method's rule for the scene's fastest vibration at the start. Returns nullopt if the
/// rule has no limit or chooses its own steps, or if the particles' drag rates differ.
std::optional<double> predicted_limit(const Method& method, const Scene& scene, double omega) {
  const auto gamma = uniform_drag_rate(scene.model);
  if (const Stepper* rule = stepper_of(method); rule && !rule->adaptive && omega > 0 && gamma)
    if (const double limit = rule->limit(omega, *gamma); std::isfinite(limit)) return limit;
  return {};
}

void add_statistics(const Request& request, const Scene& scene, const Run& run, MethodResults& results,
                    TableSet& tables) {
  Table table = table_of<StatisticRow>(scene.name + "-statistics");
  std::vector<Statistic> reference;   // statistics of the engine under test
  constexpr double rounding = 1e-12;  // relative to the mean: a smaller spread is caused by rounding, not by the motion
  const auto add_rows = [&](const Method& method, const std::vector<Statistic>& statistics, bool of_one_run) {
    for (size_t i = 0; i < statistics.size(); ++i) {
      const Statistic& s = statistics[i];
      StatisticRow row{method.name, s.quantity, s.unit, s.mean};
      if (!of_one_run) row.deviation = s.deviation;
      if (!reference.empty() && reference[i].deviation > rounding * std::abs(reference[i].mean))
        row.apart = std::abs(s.mean - reference[i].mean) / reference[i].deviation;
      add(table, row);
    }
  };
  std::vector<std::string> perturbed_methods;
  // only representatives of the engines are varied: sixteen runs of every method would show no more
  for (const MethodFamily& family : method_families()) {
    if (!family.by_default()) continue;
    const auto methods = methods_of(request, scene);
    const auto method =
        std::find_if(methods.begin(), methods.end(), [&](const Method& m) { return m.name == family.representative; });
    if (method == methods.end()) continue;
    if (!request.full && estimated_seconds(*method, scene, run) > 0.15) {
      tables.notes.push_back(fmt::format("statistics leave out {} on {}: sixteen runs take too long; --full has them",
                                         family.representative, scene.name));
      continue;
    }
    const MethodResult& result = result_of(request, scene, *method, results);
    if (result.outcome.verdict != Verdict::ok) continue;
    const std::vector<Statistic> statistics = contact_statistics(*method, scene, run);
    add_rows(*method, statistics, false);
    if (family.is_subject()) reference = statistics;
    perturbed_methods.push_back(method->name);
  }
  // other methods use the existing run if there is a spread with which it can be compared
  for (const Method& method : methods_of(request, scene)) {
    const MethodResult& result = result_of(request, scene, method, results);
    const bool runs = result.outcome.verdict == Verdict::ok && result.trajectory.frames() > 0 &&
                      result.trajectory.v.back().cols() == result.trajectory.x.back().cols();
    if (!reference.empty() && runs && std::ranges::find(perturbed_methods, method.name) == perturbed_methods.end())
      add_rows(method, contact_quantities(scene, result.trajectory), true);
  }
  if (!table.rows.empty()) tables.add(table);
}

struct Standards {
  Standards(const Request& request, const Scene& scene, const Run& run, MethodResults& results)
      : truth(truth_of(scene, run)), of_rule(truth && truth->under_contact_rule) {
    const std::string of(request.reference.empty() ? subject().representative : request.reference);
    const auto requested = std::ranges::find(request.methods, of, &Method::name);
    method = requested == request.methods.end() ? find_method(of) : *requested;
    // differences from a failed run are meaningless
    const MethodResult& result = result_of(request, scene, method, results);
    if (result.outcome.verdict == Verdict::ok) reference = result.trajectory;
    const bool known = reference.frames() > 0;
    const Method probe = find_method(known ? std::string(subject().representative) : scene.method);
    growing = growth_of(probe, scene, run, known ? &reference : nullptr);
    motion = motion_of(truth && !of_rule ? truth->trajectory : reference);
    omega = scene.model.first_order() ? 0 : highest_frequency(scene.model, scene.start);
  }

  std::optional<Truth> truth;
  bool of_rule;          // true if the truth is that of mysim's own contact rule
  Method method;         // all runs are compared with the run of this method
  Trajectory reference;  // empty if that run failed
  Growth growing;
  double motion = 0;  // m
  double omega = 0;   // rad/s, fastest vibration at the start
};

/// Certifies the scene that the engine built. If it differs, the run counts as unsupported.
void certify_result(const Method& method, const Scene& scene, Outcome& out, TableSet& tables) {
  if (out.verdict == Verdict::unsupported || method.stepper) return;
  tables.certificates.push_back(certify(method.name, scene, out));
  if (!tables.certificates.back().mismatch()) return;
  out.verdict = Verdict::unsupported;
  out.reason = "it built another scene, see its parity certificate";
}

std::vector<EngineTimeRow> compared_samples(const Scene& scene, const Method& method, const Trajectory& path,
                                            const Standards& standards) {
  std::vector<EngineTimeRow> samples;
  const Trajectory& reference = standards.reference;
  for (int i = 0; i < path.frames(); ++i) {
    EngineTimeRow& row = samples.emplace_back(EngineTimeRow{.method = method.name, .t = path.t[i]});
    if (standards.truth && i < standards.truth->trajectory.frames())
      (standards.of_rule ? row.contact_difference : row.error) =
          rms_distance(path.x[i], standards.truth->trajectory.x[i]);
    if (i < reference.frames() && reference.x[i].cols() == path.x[i].cols()) {
      row.difference = rms_distance(path.x[i], reference.x[i]);
      row.centre_difference = (centre_of_mass(scene, path.x[i]) - centre_of_mass(scene, reference.x[i])).norm();
    }
    row.clearance = clearance(scene, path.t[i], path.x[i]);
    row.creep = creep(scene, path.t[i], path.x[i], path.v[i]);
  }
  return samples;
}

EngineRow summary_of(const Request& request, const Scene& scene, const Method& method, const MethodResult& result,
                     const Standards& standards, const std::vector<EngineTimeRow>& samples) {
  const Outcome& out = result.outcome;
  const TimeGrid grid = time_grid(run_of(request, scene));
  const double growth = standards.growing.until(scene.window);
  EngineRow row{.scene = scene.name,
                .method = method.name,
                .verdict = out.verdict,
                .reason = out.reason,
                .end = out.end,
                .step = out.step,
                .steps = out.steps,
                .evaluations = out.evaluations,
                .coincident = out.degenerate_springs,
                .motion = standards.motion,
                .window = scene.window,
                .measured_window = standards.growing.window(),
                .growth = growth,
                .round_off_bound = round_off_bound_of(method, scene, standards.motion, growth,
                                                      1L * grid.steps_per_sample * grid.samples),
                .same_rule = same_rule(method, standards.method, scene.model),
                .step_limit = predicted_limit(method, scene, standards.omega),
                .different_law = fmt::format("{}", fmt::join(out.different_law, "; "))};
  if (const auto& truth = standards.truth) {
    row.truth = truth->how, row.truth_kind = {truth->tier, standards.of_rule}, row.truth_bar = truth->error_bar;
    if (std::isfinite(truth->until)) row.truth_until = truth->until;
  }
  if (out.verdict == Verdict::ok) {
    row.error = largest(samples, &EngineTimeRow::error, scene.window);
    row.contact_difference = largest(samples, &EngineTimeRow::contact_difference, scene.window);
    row.difference = largest(samples, &EngineTimeRow::difference, scene.window);
    row.centre_difference = largest(samples, &EngineTimeRow::centre_difference, scene.duration);
    for (const EngineTimeRow& sample : samples)
      if (sample.clearance) row.clearance = std::min(row.clearance.value_or(*sample.clearance), *sample.clearance);
    if (!samples.empty()) row.creep = samples.back().creep;
  }
  return row;
}

EngineCostRow cost_of(const Scene& scene, const Method& method, const Outcome& out) {
  EngineCostRow row{.scene = scene.name, .method = method.name};
  // external programs need not report their own time
  if (out.process_seconds == 0 || out.cpu_seconds > 0) {
    row.cpu = out.cpu_seconds;
    if (out.steps) row.cpu_per_step = out.cpu_seconds / static_cast<double>(out.steps);
  }
  if (out.cpu_seconds > 0) row.simulated_per_cpu = out.end / out.cpu_seconds;
  if (out.process_seconds > 0) row.process_cpu = out.process_seconds;
  return row;
}

}  // namespace

void engines_on(const Request& request, const Scene& scene, MethodResults& results, TableSet& tables) {
  Table summary = table_of<EngineRow>(), cost = table_of<EngineCostRow>();
  Table table = table_of<EngineTimeRow>(scene.name + "-engines");
  const Run run = run_of(request, scene);
  const Standards standards(request, scene, run, results);
  for (const Method& method : methods_of(request, scene)) {
    MethodResult& result = result_of(request, scene, method, results);
    Outcome& out = result.outcome;
    certify_result(method, scene, out, tables);
    const bool unsupported = out.verdict == Verdict::unsupported;
    if (unsupported) result.trajectory = {};
    const Trajectory& path = result.trajectory;
    if (request.on_runs && path.frames() > 0) request.on_runs({"engines", scene, method.name, {{out, path}}});
    const std::vector<EngineTimeRow> samples = compared_samples(scene, method, path, standards);
    for (const EngineTimeRow& row : samples) add(table, row);
    add(summary, summary_of(request, scene, method, result, standards, samples));
    if (!out.remark.empty()) tables.notes.push_back(fmt::format("{} on {}: {}", method.name, scene.name, out.remark));
    if (!unsupported) add(cost, cost_of(scene, method, out));
  }
  tables.add(table);
  if (has_contact(scene.model) && scene.model.particles.size() > 1)
    add_statistics(request, scene, run, results, tables);
  tables.add(summary);
  tables.add(cost);
  add_energies(request, scene, standards.truth, results, tables);
}

std::vector<Point> engines_points(const Request& request) {
  return one_point_per_scene(request, "engines", [](const Request& alone, const Scene& scene, TableSet& tables) {
    MethodResults results;
    engines_on(alone, scene, results, tables);
  });
}

void add_energies(const Request& request, const Scene& scene, const std::optional<Truth>& truth, MethodResults& results,
                  TableSet& tables) {
  Table summary = table_of<EngineEnergyRow>();
  if (scene.model.first_order()) {
    tables.notes.push_back(fmt::format("energies leave out {}: a first-order system has no energy", scene.name));
    tables.add(summary);
    return;
  }
  Table table = table_of<SceneEnergyRow>(scene.name + "-energy");
  for (const Method& method : methods_of(request, scene)) {
    const MethodResult& result = result_of(request, scene, method, results);
    const Outcome& out = result.outcome;
    if (out.verdict == Verdict::unsupported) continue;
    if (result.ledger.empty()) {
      tables.notes.push_back(fmt::format("energies leave out {} on {}: no velocities", method.name, scene.name));
      continue;
    }
    const double start = result.ledger.front().balance();
    double worst = 0, energy_scale = 0;
    add_ledger(table, method.name, result.ledger, result.contact_inferred);
    for (const LedgerRow& row : result.ledger) {
      worst = std::max(worst, std::abs(row.balance() - start));
      energy_scale = std::max({energy_scale, row.energy.kinetic,
                               std::abs(row.energy.gravitational - result.ledger[0].energy.gravitational)});
    }
    EngineEnergyRow row{.scene = scene.name,
                        .method = method.name,
                        .verdict = out.verdict,
                        .end = out.end,
                        .turned_over = energy_scale,
                        .contact_inferred = result.contact_inferred};
    if (out.verdict == Verdict::ok && !result.contact_inferred) {
      row.balance_error = worst;
      if (energy_scale > 0) row.relative_balance_error = worst / energy_scale;
    }
    if (const size_t known = truth ? truth->contact.size() : 0; known > 0 && result.ledger.size() >= known) {
      row.contact = result.ledger[known - 1].contact, row.contact_until = result.ledger[known - 1].t;
      row.contact_in_truth = truth->contact.back(), row.contact_bar = truth->contact_bars.back();
    }
    add(summary, row);
  }
  tables.add(table);
  tables.add(summary);
}

}  // namespace crosscheck
