// Experiment `matrix`: one answer from each engine to each question. Runs only if an external engine is among the
// methods.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "experiments/energy/long_run.h"
#include "experiments/experiment.h"
#include "experiments/scenes/scenes.h"
#include "experiments/stability/spectrum.h"
#include "experiments/tables/check.h"
#include "experiments/tables/contact.h"
#include "experiments/tables/matrix.h"
#include "experiments/tables/order.h"
#include "experiments/tables/speed_accuracy.h"
#include "experiments/tables/stability.h"
#include "experiments/timing/timing.h"
#include "mysim/model/energy.h"
#include "reference/engines/engines.h"
#include "reference/which_rule.h"

namespace crosscheck {
namespace {

using Answer = MatrixRow<false>;
using CostAnswer = MatrixRow<true>;

/// An undamped motion in one mode, and the step at which its numerical damping is measured.
struct UndampedMode {
  EngineQuestion question;
  Scene scene;
  double omega, energy_at_rest, step;  // rad/s, J, s
};

/// The oscillator of experiment `energy`, with a step of a 72nd of a period.
UndampedMode mode_of_spring() {
  return {EngineQuestion::damping_of_spring, undamped_oscillator(), oscillator_omega, 0,
          2 * std::numbers::pi / oscillator_omega / 72};
}

/// The chain without drag, released in its slowest mode about its state of rest, with an amplitude of a thousandth of
/// the scene's size, so that the motion is linear to within a thousandth.
UndampedMode mode_of_chain() {
  Scene scene = load_scene("chain");
  std::erase_if(scene.model.terms, [](const Term& term) { return std::holds_alternative<Drag>(term); });
  const State rest = equilibrium_of(scene).rest.value();
  const Spectrum spectrum = spectrum_of(scene, rest);
  const Points shape = spectrum.system.offsets(spectrum.shapes.col(0), scene.model.particles.size());
  scene.start = rest;
  scene.start.x += 1e-3 * scene.size() / std::sqrt(shape.colwise().squaredNorm().maxCoeff()) * shape;
  scene.hash = hash_of(scene);
  const double energy_at_rest = energy_of(scene.model, rest).total(), step = scene.step;
  return {EngineQuestion::damping_of_chain, std::move(scene), spectrum.modes.front().omega, energy_at_rest, step};
}

/// Drag rate with the same damping as the method, over ten periods. Averages the logarithm of the energy over each
/// period, because the energy of symplectic rules oscillates twice per period. The period of the rule differs slightly
/// from that of the mode, which leaves a remainder of the oscillation; averages that begin a quarter of a period later
/// have a remainder of opposite sign. The rate is the mean of both. The error bar is the largest of three values: half
/// their difference; the difference between the rates of the run's two halves, which should agree; and the effect of
/// rounding, which changes the energy by a relative 1e-14 (1e-5 in single precision).
Answer damping_of(const Method& method, const UndampedMode& mode) {
  constexpr int periods = 10, samples = 24, quarter = samples / 4;
  Answer answer{.method = method.name, .question = mode.question, .unit = "1/s"};
  const double period = 2 * std::numbers::pi / mode.omega;
  const Run run{
      .step = mode.step * (1 + 1e-9), .duration = periods * period, .samples = periods * samples, .timed = false};
  Recorder recorder;
  const Outcome out = run_method(method, mode.scene, run, {&recorder});
  const Trajectory& path = recorder.trajectory;
  std::vector<double> logs;  // ln(energy) of each frame
  for (int i = 0; i < path.frames(); ++i) {
    const bool whole = path.v[i].cols() == path.x[i].cols() && path.x[i].allFinite();
    logs.push_back(std::log(
        whole ? energy_of(mode.scene.model, {path.t[i], path.x[i], path.v[i]}).total() - mode.energy_at_rest : NAN));
  }
  const auto means_from = [&](int first) {
    std::vector<std::pair<double, double>> means;  // time (s), mean of ln(energy) over the period that begins then
    for (; first + samples <= static_cast<int>(logs.size()); first += samples) {
      const double mean = std::accumulate(&logs[first], &logs[first] + samples, 0.) / samples;
      // rounding in single precision dominates below this energy
      if (!std::isfinite(mean) || mean < logs[0] - std::log(1e4)) break;
      means.emplace_back(first / samples * period, mean);
    }
    return means;
  };
  const auto means = means_from(0), later = means_from(quarter);
  if (out.verdict != Verdict::ok || later.size() < 4) {
    answer.words = out.verdict == Verdict::unsupported ? "refused: " + out.reason
                   : out.verdict != Verdict::ok        ? fmt::format("{} at {:.3g} s", in_words(out.verdict), out.end)
                   : path.frames() > 0 && path.v[0].cols() == 0 ? "no velocities"
                                                                : "at rest within four periods";
    return answer;
  }
  const std::span all(means);
  const size_t half = means.size() / 2;
  const double rounding = out.readback && out.readback->precision == "single" ? 1e-5 : 1e-14, early = decay_rate(all),
               late = decay_rate(later);
  answer.value = (early + late) / 2;
  answer.bar = std::max({std::abs(early - late) / 2,
                         std::abs(decay_rate(all.first(half)) - decay_rate(all.subspan(means.size() - half))),
                         rounding / (periods * period)});
  answer.tier = "exact";
  return answer;
}

/// Damping of a spring that acts through user-supplied forces, for engines whose own springs follow another rule.
std::optional<Answer> damping_by_forces(const Method& method) {
  const std::optional<OutsideEngine> engine = kept_engine_of(method.name);
  if (!engine || engine->forces.empty() || method.name.find('+') != std::string::npos) return std::nullopt;
  Answer answer = damping_of(find_method(method.name + "+" + engine->forces), mode_of_spring());
  answer.method = method.name, answer.question = EngineQuestion::damping_by_forces;
  return answer;
}

/// The answer is "rk4", "symplectic-euler, implicit drag" or "nearest: xpbd"; its value is the distance from that rule
/// in units of the net's size.
Answer rule_answer(const Method& method) {
  Answer answer{.method = method.name, .question = EngineQuestion::rule, .unit = "1"};
  if (!method.identify) {
    answer.words = rule_of(method).empty() ? method.rule : rule_of(method);
    return answer;
  }
  const FoundRule& found = method.identify();
  const bool near = found.kind == FoundRule::nearest;
  answer.tier = "mysim";
  if (found.kind == FoundRule::same || near) {
    answer.value = found.distance;
    answer.words = (near ? "nearest: " : "") + found.rule;
    if (!near && !found.own_drag && !found.drag.empty()) answer.words += fmt::format(", {} drag", found.drag);
  } else {
    answer.words = found.kind == FoundRule::own_steps ? "chooses its steps" : sentence_of(found);
  }
  return answer;
}

Answer build_answer(const Method& method) {
  const UndampedMode mode = mode_of_spring();
  NullObserver nothing;
  const Outcome out = run_method(method, mode.scene, {mode.step, mode.step, 1}, {&nothing});
  const std::optional<OutsideEngine> engine = kept_engine_of(method.name);
  const std::string name = !out.engine.empty() ? out.engine : engine ? engine->title : "";
  std::vector<std::string> parts{name.empty() ? std::string(method.family().title) : name};
  if (engine) parts.push_back(engine->built);
  if (out.readback) parts.push_back(out.readback->precision + " precision");
  return {.method = method.name,
          .question = EngineQuestion::build,
          .unit = "1",
          .words = fmt::format("{}", fmt::join(parts, ", "))};
}

/// CPU time of a step with one falling particle, which is the overhead of the engine and its bridge.
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
    const Outcome out = run_method(method, scene, {1e-3, 20, 1}, {&nothing});
    if (out.verdict != Verdict::ok || !(out.cpu_seconds > 0)) {
      cell.words = out.verdict == Verdict::ok ? "it does not report its CPU time" : std::string(in_words(out.verdict));
      return cell;
    }
    times.push_back(out.cpu_seconds / static_cast<double>(out.steps > 0 ? out.steps : 20000));
  }
  const Timing timing = timing_of(times);
  cell.value = timing.median, cell.bar = (timing.high - timing.low) / 2;
  if (*cell.value < *cell.bar) cell.words = "less than the clock resolves";
  return cell;
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
  for (const OrderSlopeRow& row : rows_of<OrderSlopeRow>(tables))
    if (row.method == method && row.scene == "chain") {
      Answer& cell = add(EngineQuestion::order, "1");
      cell.value = row.measured_order, cell.bar = 0.15, cell.tier = "converged";
      cell.words = "on chain";
    }
  long asked = 0, held = 0;
  std::string broken;
  for (const RelationRow& row : rows_of<RelationRow>(tables)) {
    if (row.method != method || row.mark == RelationMark::not_applicable) continue;
    ++asked, held += row.mark == RelationMark::holds;
    if (row.mark != RelationMark::holds)
      broken += fmt::format("{}{} {}", broken.empty() ? "" : ", ", name_of(row.mark), row.relation);
  }
  if (asked > 0) {
    Answer& cell = add(EngineQuestion::invariants, "1");
    cell.value = static_cast<double>(held), cell.tier = "exact";
    cell.words = fmt::format("{} of {} hold{}", held, asked, broken.empty() ? "" : "; " + broken);
  }
  long cases = 0, right = 0;
  std::string refusal;
  const auto count = [&](const ConeRow& row) {
    if (row.method != method) return;
    if (row.verdict == Verdict::unsupported) refusal = row.reason;
    if (row.verdict == Verdict::ok) ++cases, right += row.state == row.state_by_theory;
  };
  for (const ConeRow& row : rows_of<ConeRow>(tables)) count(row);
  for (const PlaneConeRow& row : rows_of<PlaneConeRow>(tables)) count(row);
  if (cases > 0 || !refusal.empty()) {
    Answer& answer = add(EngineQuestion::friction, "1");
    answer.tier = "exact";
    answer.words = cases > 0 ? fmt::format("{} of {}", right, cases) : "refused: " + refusal;
    if (cases > 0) answer.value = static_cast<double>(right);
  }
  if (std::ranges::none_of(cells, [](const Answer& a) { return a.question == EngineQuestion::order; }))
    for (const OrderRow& row : rows_of<OrderRow>(tables))
      if (row.method == method && row.scene == "chain") {
        add(EngineQuestion::order, "1").words = "no steady slope";
        break;
      }
  for (const LimitRow& row : rows_of<LimitRow>(tables))
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
                        add_cell(tables, build_answer(method));
                        add_cell(tables, rule_answer(method));
                        add_cell(tables, damping_of(method, mode_of_spring()));
                        add_cell(tables, damping_of(method, mode_of_chain()));
                        if (const auto answer = damping_by_forces(method)) add_cell(tables, *answer);
                      }});
    if (!method.adaptive)
      points.push_back({"matrix, empty step: " + method.name, method.fingerprint,
                        [method](TableSet& tables) { add_cell(tables, empty_step(method)); }, true});
  }
  return points;
}

void conclude_matrix(TableSet& tables) {
  std::vector<std::string> methods;
  for (const Answer& row : rows_of<Answer>(tables))
    if (row.question == EngineQuestion::rule) methods.push_back(row.method);
  for (const std::string& method : methods)
    for (const Answer& cell : cells_from(tables, method)) add_cell(tables, cell);
  for (const EngineSpeedRow& row : rows_of<EngineSpeedRow>(tables))
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
