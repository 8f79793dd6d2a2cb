// Experiment `matrix`: what sets engines apart, one answer of each to each question. Runs only where an outside engine
// is among the methods.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/stability/spectrum.h"
#include "experiments/tables/check.h"
#include "experiments/tables/energy.h"
#include "experiments/tables/matrix.h"
#include "experiments/tables/order.h"
#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/stability.h"
#include "experiments/timing/timing.h"
#include "mysim/model/energy.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

using Answer = MatrixRow<false>;
using CostAnswer = MatrixRow<true>;

/// The chain without drag, let go from its slowest mode about its rest; no particle is further from rest than a
/// thousandth of the scene's size, so that the motion is linear to a thousandth.
struct ModeOfChain {
  Scene scene = load_scene("chain");
  double omega = 0, energy_at_rest = 0;  // rad/s, J

  ModeOfChain() {
    std::erase_if(scene.model.terms, [](const Term& term) { return std::holds_alternative<Drag>(term); });
    const State rest = equilibrium_of(scene).rest.value();
    const Spectrum spectrum = spectrum_of(scene, rest);
    omega = spectrum.modes.front().omega;
    energy_at_rest = energy_of(scene.model, rest).total();
    const Points shape = spectrum.system.offsets(spectrum.shapes.col(0), scene.model.particles.size());
    scene.start = rest;
    scene.start.x += 1e-3 * scene.size() / std::sqrt(shape.colwise().squaredNorm().maxCoeff()) * shape;
    scene.hash = hash_of(scene);
  }
};

/// Minus the slope of ln(energy) over time, least squares: the drag rate (1/s) that would damp as much.
double rate_of(std::span<const std::pair<double, double>> logs) {
  double n = 0, t1 = 0, y1 = 0, tt = 0, ty = 0;
  for (const auto& [t, y] : logs) n += 1, t1 += t, y1 += y, tt += t * t, ty += t * y;
  return -(n * ty - t1 * y1) / (n * tt - t1 * t1);
}

/// Damping over ten periods. A drag rate is the same in both halves of the run; their difference is the error bar.
Answer damping_of_chain(const Method& method) {
  Answer cell{.method = method.name, .question = EngineQuestion::damping_of_chain, .unit = "1/s"};
  const ModeOfChain mode;
  constexpr int samples = 400;
  const Run run{.step = mode.scene.step, .duration = 20 * M_PI / mode.omega, .samples = samples, .timed = false};
  Recorder recorder;
  const Outcome out = run_method(method, mode.scene, run, {&recorder});
  const Trajectory& path = recorder.trajectory;
  std::vector<std::pair<double, double>> logs;  // time, ln(energy)
  for (int i = 0; i < path.frames(); ++i) {
    if (path.v[i].cols() != path.x[i].cols() || !path.x[i].allFinite()) break;
    const double energy = energy_of(mode.scene.model, {path.t[i], path.x[i], path.v[i]}).total() - mode.energy_at_rest;
    if (!logs.empty() && !(energy > 1e-4 * std::exp(logs[0].second))) break;  // below lies rounding in single precision
    logs.emplace_back(path.t[i], std::log(energy));
  }
  if (out.verdict != Verdict::ok || logs.size() < 20) {
    cell.words = out.verdict == Verdict::unsupported ? "refused: " + out.reason
                 : out.verdict != Verdict::ok        ? fmt::format("{} at {:.3g} s", in_words(out.verdict), out.end)
                                                     : "no velocities";
    return cell;
  }
  const std::span all(logs);
  cell.value = rate_of(all);
  cell.bar = std::abs(rate_of(all.first(logs.size() / 2)) - rate_of(all.subspan(logs.size() / 2)));
  cell.tier = "exact";
  return cell;
}

Answer rule_cell(const Method& method) {
  Answer cell{.method = method.name, .question = EngineQuestion::rule, .unit = "1"};
  if (!method.identify) {
    cell.words = rule_of(method).empty() ? method.rule : rule_of(method);
    return cell;
  }
  const FoundRule& found = method.identify();
  cell.words = found.kind == FoundRule::unknown ? found.reason : sentence_of(found);
  if (found.kind == FoundRule::same || found.kind == FoundRule::nearest) cell.value = found.distance;
  cell.tier = "mysim";
  return cell;
}

/// CPU time of a step in which one particle falls: what the engine and its bridge take before there is anything to do.
CostAnswer empty_step(const Method& method) {
  CostAnswer cell{.method = method.name, .question = EngineQuestion::empty_step, .unit = "s", .tier = "measured"};
  const Scene scene = parse_scene(
      "question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = 1e-3\nwindow = 1\n"
      "tolerance = 1e-6\nmethod = \"leapfrog\"\n[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[gravity]\n"
      "acceleration = [0, -9.81, 0]\n",
      "one-particle");
  std::vector<double> times;
  for (int i = 0; i < 5; ++i) {
    NullObserver nothing;
    const Outcome out = run_method(method, scene, {1e-3, 5, 1}, {&nothing});
    if (out.verdict != Verdict::ok || !(out.cpu_seconds > 0)) {
      cell.words = out.verdict == Verdict::ok ? "it does not tell its CPU time" : std::string(in_words(out.verdict));
      return cell;
    }
    times.push_back(out.cpu_seconds / static_cast<double>(out.steps > 0 ? out.steps : 5000));
  }
  const Timing timing = timing_of(times);
  cell.value = timing.median, cell.bar = (timing.high - timing.low) / 2;
  return cell;
}

template <class Row>
std::vector<Row> rows_in(const TableSet& tables) {
  const Table* table = tables.table(std::string(Row::table));
  return table ? rows_of<Row>(*table) : std::vector<Row>();
}

template <class Row>
void add_cell(TableSet& tables, const Row& row) {
  Table table = table_of<Row>();
  add(table, row);
  tables.add(table);
}

std::vector<Answer> cells_from(const TableSet& tables, const std::string& method) {
  std::vector<Answer> cells;
  const auto add = [&](EngineQuestion question, const std::string& unit) -> Answer& {
    return cells.emplace_back(Answer{.method = method, .question = question, .unit = unit});
  };
  for (const OrderSlopeRow& row : rows_in<OrderSlopeRow>(tables))
    if (row.method == method && row.scene == "chain") {
      Answer& cell = add(EngineQuestion::order, "1");
      cell.value = row.measured_order, cell.bar = 0.15, cell.tier = "converged";
      cell.words = "on chain";
    }
  for (const DampingRow& row : rows_in<DampingRow>(tables))
    if (row.method == method && std::abs(row.h_omega - 0.1) < 1e-9) {
      Answer& cell = add(EngineQuestion::damping_of_spring, "1/s");
      cell.value = row.equivalent_drag, cell.tier = "exact";
      cell.words = fmt::format("{}, h omega = 0.1", name_of(row.verdict));
    }
  long asked = 0, held = 0;
  std::string broken;
  for (const RelationRow& row : rows_in<RelationRow>(tables)) {
    if (row.method != method || row.mark == RelationMark::not_asked) continue;
    ++asked, held += row.mark == RelationMark::holds;
    if (row.mark != RelationMark::holds)
      broken += fmt::format("{}{} {}", broken.empty() ? "" : ", ", name_of(row.mark), row.relation);
  }
  if (asked > 0) {
    Answer& cell = add(EngineQuestion::invariants, "1");
    cell.value = static_cast<double>(held), cell.tier = "exact";
    cell.words = fmt::format("{} of {} hold{}", held, asked, broken.empty() ? "" : "; " + broken);
  }
  for (const LimitRow& row : rows_in<LimitRow>(tables))
    if (row.method == method && row.scene == "chain") {
      Answer& cell = add(EngineQuestion::largest_step, "s");
      cell.value = row.measured, cell.tier = row.predicted ? "linear theory" : "measured";
      if (row.precision && row.measured) cell.bar = *row.measured * *row.precision / 2;
      cell.words = fmt::format("on chain: {}", name_of(row.measurement));
    }
  return cells;
}

}  // namespace

std::vector<Point> matrix_points(const Request& request) {
  if (std::ranges::none_of(request.methods, [](const Method& m) { return m.family().role == Role::outside; }))
    return {};
  std::vector<Point> points;
  for (const Method& method : request.methods) {
    points.push_back({"matrix: " + method.name, method.fingerprint, [method](TableSet& tables) {
                        add_cell(tables, rule_cell(method));
                        add_cell(tables, damping_of_chain(method));
                      }});
    if (!method.adaptive)
      points.push_back({"matrix, empty step: " + method.name, method.fingerprint,
                        [method](TableSet& tables) { add_cell(tables, empty_step(method)); }, true});
  }
  return points;
}

void conclude_matrix(TableSet& tables) {
  std::vector<std::string> methods;
  for (const Answer& row : rows_in<Answer>(tables))
    if (row.question == EngineQuestion::rule) methods.push_back(row.method);
  for (const std::string& method : methods)
    for (const Answer& cell : cells_from(tables, method)) add_cell(tables, cell);
  for (const EngineSpeedRow& row : rows_in<EngineSpeedRow>(tables))
    if (row.scene == "chain" && std::abs(row.part_of_motion - 0.01) < 1e-9 && std::ranges::count(methods, row.method))
      add_cell(tables,
               CostAnswer{.method = row.method,
                          .question = EngineQuestion::cost,
                          .value = row.cpu,
                          .unit = "s",
                          .tier = "measured",
                          .words = row.times_mysim ? fmt::format("{:.3g} times mysim's", *row.times_mysim) : ""});
}

}  // namespace crosscheck
