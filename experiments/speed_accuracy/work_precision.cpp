#include "experiments/speed_accuracy/work_precision.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/engines.h"

namespace crosscheck {

std::vector<WorkPrecisionPoint> pareto_line(std::vector<WorkPrecisionPoint> points, double floor) {
  std::erase_if(points, [](const WorkPrecisionPoint& p) { return !p.ok || !p.error; });
  for (WorkPrecisionPoint& p : points) p.error = std::max(*p.error, floor);
  // at equal cost the more accurate run comes first, so that the other one is not on the front
  std::stable_sort(points.begin(), points.end(), [](const WorkPrecisionPoint& a, const WorkPrecisionPoint& b) {
    return a.cost != b.cost ? a.cost < b.cost : *a.error < *b.error;
  });
  std::vector<WorkPrecisionPoint> line;
  for (WorkPrecisionPoint& p : points)
    if (line.empty() || *p.error < *line.back().error) line.push_back(std::move(p));
  return line;
}

const WorkPrecisionPoint* cheapest(const std::vector<WorkPrecisionPoint>& points, double bound,
                                   const FamilyFilter& is_eligible) {
  const WorkPrecisionPoint* best = nullptr;
  for (const WorkPrecisionPoint& p : points)
    if (p.ok && p.error && *p.error <= bound && (!is_eligible || is_eligible(family_of(p.method))) &&
        (!best || p.cost < best->cost))
      best = &p;
  return best;
}

std::vector<std::string> statistically_tied(const std::vector<WorkPrecisionPoint>& points,
                                            const WorkPrecisionPoint& best, double bound, double noise) {
  std::vector<std::string> names;
  for (const WorkPrecisionPoint& p : points)
    if (p.ok && p.error && *p.error <= bound && p.method != best.method && p.time && best.time &&
        !differ(*p.time, *best.time, noise) && std::find(names.begin(), names.end(), p.method) == names.end())
      names.push_back(p.method);
  return names;
}

namespace {

/// The runs of one scene, whose cost is the number of evaluations.
struct SceneRuns {
  std::string scene;
  double motion = 0;
  std::optional<double> error_bar;  // m; empty without truth
  Measure measure = Measure::error;
  std::vector<WorkPrecisionPoint> points;
};

std::vector<SceneRuns> runs_of(const Table& table) {
  std::vector<SceneRuns> scenes;
  for (const SpeedAccuracyRow& row : rows_of<SpeedAccuracyRow>(table)) {
    if (scenes.empty() || scenes.back().scene != row.scene) {
      const bool difference = row.truth && CellOf<TruthKind>::read(*row.truth).of_contact_rule;
      scenes.push_back({row.scene, row.motion, row.truth_bar, difference ? Measure::difference : Measure::error, {}});
    }
    SceneRuns& s = scenes.back();
    s.points.push_back({row.method, row.setting, row.requested, row.verdict == Verdict::ok,
                        s.measure == Measure::difference ? row.difference : row.error,
                        static_cast<double>(row.evaluations)});
  }
  return scenes;
}

/// The timed runs, whose cost is their time. Sets `noise`, and adds rows to `cost`.
std::vector<WorkPrecisionPoint> timed_points(const SceneRuns& s, const std::vector<SpeedAccuracyTimingRow>& timing,
                                             double& noise, Table& cost) {
  std::vector<WorkPrecisionPoint> points;
  for (const WorkPrecisionPoint& p : s.points)
    for (const SpeedAccuracyTimingRow& row : timing) {
      if (row.scene != s.scene || row.method != p.method || row.setting != p.setting || row.requested != p.requested)
        continue;
      const auto measured = static_cast<double>(row.evaluations);
      // a failed run may end at another time when it is timed without an observer
      const double factor = measured > 0 && p.cost > 0 ? p.cost / measured : 1 / row.part;
      WorkPrecisionPoint timed = p;
      timed.time = Timing{row.cpu, row.cpu_low, row.cpu_high, row.repetitions}.times(factor);
      timed.cost = timed.time->median;
      timed.part = row.part;
      noise = row.noise;
      add(cost, SpeedAccuracyCostRow{.scene = s.scene,
                                     .method = p.method,
                                     .setting = p.setting,
                                     .requested = p.requested,
                                     .verdict = p.ok ? RunEnd::ok : RunEnd::failed,
                                     .cpu = timed.cost,
                                     .cpu_low = timed.time->low,
                                     .cpu_high = timed.time->high,
                                     .repetitions = timed.time->repetitions,
                                     .part = row.part,
                                     .noise = noise,
                                     .build = build_of(p.method)});
      points.push_back(std::move(timed));
    }
  return points;
}

template <Cost kind>
void add_pareto(const SceneRuns& s, const std::vector<WorkPrecisionPoint>& points, Table& table) {
  if (!s.error_bar) return;
  for (const WorkPrecisionPoint& p : pareto_line(points, *s.error_bar))
    add(table, ParetoRow<kind>{s.scene, p.cost, *p.error, p.method, p.setting, p.requested});
}

/// False for solvers whose evaluations would be underestimated, because they count only their steps.
bool counts_evaluations(const std::string& method) {
  const Method* known = builtin_without_options(method);
  return !known || known->counts_evaluations;
}

constexpr double parts_of_motion[] = {0.1, 0.01, 0.001};

template <Cost kind>
void add_cheapest(const SceneRuns& s, const std::vector<WorkPrecisionPoint>& points, double noise, Table& table) {
  if (!s.error_bar) return;
  for (const double part : parts_of_motion) {
    // the bound is reduced by the error bar, so that the accuracy is met wherever the truth lies within its error bar
    const double bound = part * s.motion, left = bound - *s.error_bar;
    CheapestRow<kind> row{.scene = s.scene, .part_of_motion = part, .bound = bound, .measure = s.measure};
    const WorkPrecisionPoint *best = cheapest(points, left), *bullet = cheapest(points, left, is_first_peer),
                             *ours = cheapest(points, left, &MethodFamily::is_subject);
    if (best) {
      row.method = best->method, row.setting = best->setting, row.requested = best->requested, row.cost = best->cost;
      row.distance = best->error;
      row.tied = fmt::format("{}", fmt::join(statistically_tied(points, *best, left, noise), ", "));
    }
    if (bullet) {
      row.bullet = bullet->method, row.bullet_setting = bullet->setting, row.bullet_requested = bullet->requested;
      row.bullet_cost = bullet->cost, row.bullet_distance = bullet->error;
    }
    if (ours && bullet) row.bullet_over_mysim = bullet->cost / ours->cost;
    if (left < 0)
      row.remark = "below the error bar of the reference solution";
    else if (!best)
      row.remark = "no run that was tried meets it";
    add(table, row);
  }
}

}  // namespace

void conclude_speed_accuracy(TableSet& tables) {
  const Table* results = tables.table(std::string(SpeedAccuracyRow::table));
  if (!results) return;  // this part of a sweep has no results of the experiment
  std::vector<SpeedAccuracyTimingRow> timing;
  const Table* timed = tables.table(std::string(SpeedAccuracyTimingRow::table));
  if (timed) timing = rows_of<SpeedAccuracyTimingRow>(*timed);
  Table pareto = table_of<ParetoRow<Cost::evaluations>>(), pareto_time = table_of<ParetoRow<Cost::cpu>>(),
        best = table_of<CheapestRow<Cost::evaluations>>(), best_time = table_of<CheapestRow<Cost::cpu>>(),
        cost = table_of<SpeedAccuracyCostRow>(), engines = table_of<EngineSpeedRow>();
  for (const SceneRuns& s : runs_of(*results)) {
    // omits external programs that do not count their evaluations
    std::vector<WorkPrecisionPoint> counted = s.points;
    std::erase_if(counted, [](const WorkPrecisionPoint& p) { return !(p.cost > 0) || !counts_evaluations(p.method); });
    add_pareto<Cost::evaluations>(s, counted, pareto);
    add_cheapest<Cost::evaluations>(s, counted, 0, best);
    if (!timed) continue;
    double noise = 0;
    const std::vector<WorkPrecisionPoint> points = timed_points(s, timing, noise, cost);
    add_pareto<Cost::cpu>(s, points, pareto_time);
    add_cheapest<Cost::cpu>(s, points, noise, best_time);
    for (const double part : parts_of_motion)
      if (s.error_bar) add_by_engine(s.scene, part, s.measure, part * s.motion - *s.error_bar, points, engines);
  }
  for (const Table& table : {pareto, best, cost, pareto_time, best_time, engines}) tables.add(table);
}

std::string engine_of(const std::string& method) {
  return family_of(method).role == Role::outside ? method : method.substr(0, method.find('/'));
}

void add_by_engine(const std::string& scene, double part_of_motion, Measure measure, double bound,
                   const std::vector<WorkPrecisionPoint>& points, Table& table) {
  std::vector<std::string> engines;
  for (const WorkPrecisionPoint& p : points)
    if (const std::string engine = engine_of(p.method);
        std::find(engines.begin(), engines.end(), engine) == engines.end())
      engines.push_back(engine);
  const WorkPrecisionPoint* ours = cheapest(points, bound, &MethodFamily::is_subject);
  for (const std::string& engine : engines) {
    std::vector<WorkPrecisionPoint> its = points;
    std::erase_if(its, [&](const WorkPrecisionPoint& p) { return !p.time || engine_of(p.method) != engine; });
    const WorkPrecisionPoint* best = cheapest(its, bound);
    if (!best) continue;
    EngineSpeedRow row{.scene = scene,
                       .part_of_motion = part_of_motion,
                       .measure = measure,
                       .engine = engine,
                       .method = best->method,
                       .setting = best->setting,
                       .requested = best->requested,
                       .cpu = best->cost,
                       .distance = *best->error,
                       .part_timed = best->part};
    if (ours) row.part_timed_of_mysim = ours->part;
    if (const Timing* beside = ours && ours->time && ours->time->low > 0 ? &*ours->time : nullptr) {
      row.times_mysim = best->cost / ours->cost;
      row.times_mysim_low = best->time->low / beside->high, row.times_mysim_high = best->time->high / beside->low;
    }
    add(table, row);
  }
}

}  // namespace crosscheck
