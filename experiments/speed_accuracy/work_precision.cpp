// Pareto lines and the cheapest methods, from the rows of all points.
#include "experiments/speed_accuracy/work_precision.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/speed_accuracy/speed_accuracy.h"
#include "experiments/tables/table.h"

namespace crosscheck {

std::vector<WorkPrecisionPoint> pareto_line(std::vector<WorkPrecisionPoint> points, double floor) {
  std::erase_if(points, [](const WorkPrecisionPoint& p) { return !p.ok || !p.error; });
  for (WorkPrecisionPoint& p : points) p.error = std::max(*p.error, floor);
  // among equal costs the better one first: the other then is no step down
  std::stable_sort(points.begin(), points.end(), [](const WorkPrecisionPoint& a, const WorkPrecisionPoint& b) {
    return a.cost != b.cost ? a.cost < b.cost : *a.error < *b.error;
  });
  std::vector<WorkPrecisionPoint> line;
  for (WorkPrecisionPoint& p : points)
    if (line.empty() || *p.error < *line.back().error) line.push_back(std::move(p));
  return line;
}

const WorkPrecisionPoint* cheapest(const std::vector<WorkPrecisionPoint>& points, double bound,
                                   bool (MethodFamily::*asked)() const) {
  const WorkPrecisionPoint* best = nullptr;
  for (const WorkPrecisionPoint& p : points)
    if (p.ok && p.error && *p.error <= bound && (!asked || (family_of(p.method).*asked)()) &&
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

/// The runs of one scene, in evaluations, and what is known of its truth.
struct SceneRuns {
  std::string scene;
  double motion = 0;
  std::optional<double> error_bar;  // m; none: no truth
  bool difference = false;          // from the answer of the in-house contact rule: no error
  std::vector<size_t> rows;         // in the table, of the points
  std::vector<WorkPrecisionPoint> points;
};

std::vector<SceneRuns> runs_of(const Table& t) {
  std::vector<SceneRuns> scenes;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    if (scenes.empty() || scenes.back().scene != text_or_none(t, i, "scene")) {
      scenes.push_back({text_or_none(t, i, "scene"), *number_at(t, i, "motion"), number_at(t, i, "truth bar")});
      scenes.back().difference = text_or_none(t, i, "truth").find("contact rule") != std::string::npos;
    }
    SceneRuns& s = scenes.back();
    const auto error = number_at(t, i, s.difference ? "largest difference from converged contact" : "largest error");
    s.rows.push_back(i);
    s.points.push_back({text_or_none(t, i, "method"), text_or_none(t, i, "setting"), *number_at(t, i, "asked"),
                        text_or_none(t, i, "verdict") == "ok", error,
                        static_cast<double>(std::get<long>(t.at(i, "evaluations")))});
  }
  return scenes;
}

/// The same runs with the time they took; what was not timed is left out. Fills `noise`.
std::vector<WorkPrecisionPoint> timed_points(const SceneRuns& s, const Table& timing, double& noise, Table& cost) {
  std::vector<WorkPrecisionPoint> points;
  for (const WorkPrecisionPoint& p : s.points)
    for (size_t i = 0; i < timing.rows.size(); ++i) {
      if (text_or_none(timing, i, "scene") != s.scene || text_or_none(timing, i, "method") != p.method ||
          text_or_none(timing, i, "setting") != p.setting || *number_at(timing, i, "asked") != p.asked)
        continue;
      const auto measured = static_cast<double>(std::get<long>(timing.at(i, "evaluations")));
      const double part = *number_at(timing, i, "part of the run");
      // a failed run ended earlier than its timed twin, which nobody watched, or later
      const double factor = measured > 0 && p.cost > 0 ? p.cost / measured : 1 / part;
      WorkPrecisionPoint timed = p;
      timed.time = Timing{*number_at(timing, i, "cpu"), *number_at(timing, i, "cpu low"),
                          *number_at(timing, i, "cpu high"), std::get<long>(timing.at(i, "repetitions"))}
                       .times(factor);
      timed.cost = timed.time->median;
      timed.part = part;
      noise = *number_at(timing, i, "noise");
      cost.add({s.scene, p.method, p.setting, p.asked, std::string(p.ok ? "ok" : "failed"), timed.cost, timed.time->low,
                timed.time->high, timed.time->repetitions, part, noise, build_of(p.method)});
      points.push_back(std::move(timed));
    }
  return points;
}

void add_pareto(const SceneRuns& s, const std::vector<WorkPrecisionPoint>& points, Table& table) {
  if (!s.error_bar) return;
  for (const WorkPrecisionPoint& p : pareto_line(points, *s.error_bar))
    table.add({s.scene, p.cost, *p.error, p.method, p.setting, p.asked});
}

constexpr double parts_of_motion[] = {0.1, 0.01, 0.001};

void add_cheapest(const SceneRuns& s, const std::vector<WorkPrecisionPoint>& points, double noise, Table& table) {
  if (!s.error_bar) return;
  for (const double part : parts_of_motion) {
    // the truth may err as well: what is met is met whatever the truth is within its bar
    const double bound = part * s.motion, left = bound - *s.error_bar;
    std::vector<Cell> row{s.scene, part, bound, std::string(s.difference ? "difference" : "error")};
    const WorkPrecisionPoint *best = cheapest(points, left),
                             *bullet = cheapest(points, left, &MethodFamily::is_default_peer),
                             *ours = cheapest(points, left, &MethodFamily::is_subject);
    for (const WorkPrecisionPoint* p : {best, bullet}) {
      row.push_back(p ? Cell(p->method) : Cell());
      row.push_back(p ? Cell(p->setting) : Cell());
      row.push_back(p ? Cell(p->asked) : Cell());
      row.push_back(p ? Cell(p->cost) : Cell());
      row.push_back(p ? Cell(*p->error) : Cell());
    }
    row.push_back(ours && bullet ? Cell(bullet->cost / ours->cost) : Cell());
    row.push_back(best ? Cell(fmt::format("{}", fmt::join(statistically_tied(points, *best, left, noise), ", ")))
                       : Cell());
    row.push_back(left < 0 ? Cell(std::string("below the error bar of the truth"))
                  : best   ? Cell()
                           : Cell(std::string("no run tried meets it")));
    table.add(std::move(row));
  }
}

Table pareto_table(const std::string& name, const Column& cost) {
  return {
      name, {{"scene", "1"}, cost, {"distance", "m"}, {"method", "1"}, {"setting", "1"}, {"asked", "see setting"}}, {}};
}

Table cheapest_table(const std::string& name, const std::string& cost, const std::string& unit) {
  return {name,
          {{"scene", "1"},
           {"part of motion", "1"},
           {"bound", "m"},
           {"measure", "1"},
           {"method", "1"},
           {"setting", "1"},
           {"asked", "see setting"},
           {cost, unit},
           {"distance", "m"},
           {"best of Bullet", "1"},
           {"setting of Bullet", "1"},
           {"asked of Bullet", "see setting"},
           {cost + " of Bullet", unit},
           {"distance of Bullet", "m"},
           {"Bullet / mysim", "1"},
           {"as cheap within noise", "1"},
           {"remark", "1"}},
          {}};
}

}  // namespace

void conclude_speed_accuracy(Rows& rows) {
  const Table* results = rows.table("speed-accuracy");
  if (!results) return;  // a part of a sweep
  const Table* timing = rows.table("speed-accuracy-timing-cost");
  Table pareto = pareto_table("speed-accuracy-pareto", {"evaluations", "1"}),
        pareto_time = pareto_table("speed-accuracy-pareto-cost", {"cpu", "s"}),
        best = cheapest_table("speed-accuracy-cheapest", "evaluations", "1"),
        best_time = cheapest_table("speed-accuracy-cheapest-cost", "cpu", "s"),
        cost{"speed-accuracy-cost",
             {{"scene", "1"},
              {"method", "1"},
              {"setting", "1"},
              {"asked", "see setting"},
              {"verdict", "1"},
              {"cpu", "s"},
              {"cpu low", "s"},
              {"cpu high", "s"},
              {"repetitions", "1"},
              {"part timed", "1"},
              {"noise", "1"},
              {"build", "1"}},
             {}},
        engines = engines_cost_table();
  for (const SceneRuns& s : runs_of(*results)) {
    // an outside program need not count its evaluations, and of Bullet's implicit and position-based worlds the steps
    // alone are known: what their solvers take for each would pass for nothing
    std::vector<WorkPrecisionPoint> counted = s.points;
    std::erase_if(counted, [](const WorkPrecisionPoint& p) {
      return !(p.cost > 0) || p.method.find("/deformable-implicit") != std::string::npos ||
             p.method.find("/pbd") != std::string::npos;
    });
    add_pareto(s, counted, pareto);
    add_cheapest(s, counted, 0, best);
    if (!timing) continue;
    double noise = 0;
    const std::vector<WorkPrecisionPoint> points = timed_points(s, *timing, noise, cost);
    add_pareto(s, points, pareto_time);
    add_cheapest(s, points, noise, best_time);
    for (const double part : parts_of_motion)
      if (s.error_bar)
        add_by_engine(s.scene, part, s.difference ? "difference" : "error", part * s.motion - *s.error_bar, points,
                      engines);
  }
  for (const Table& table : {pareto, best, cost, pareto_time, best_time, engines}) rows.add(table);
}

std::string engine_of(const std::string& method) { return method.substr(0, method.find('/')); }

Table engines_cost_table() {
  return {"speed-accuracy-engines-cost",
          {{"scene", "1"},
           {"part of motion", "1"},
           {"measure", "1"},
           {"engine", "1"},
           {"method", "1"},
           {"setting", "1"},
           {"asked", "see setting"},
           {"cpu", "s"},
           {"distance", "m"},
           {"times mysim", "1"},
           {"times mysim low", "1"},
           {"times mysim high", "1"},
           {"part timed", "1"},
           {"part timed of mysim", "1"}},
          {}};
}

void add_by_engine(const std::string& scene, double part_of_motion, const std::string& measure, double bound,
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
    const Timing* beside = ours && ours->time && ours->time->low > 0 ? &*ours->time : nullptr;
    table.add({scene, part_of_motion, measure, engine, best->method, best->setting, best->asked, best->cost,
               *best->error, beside ? Cell(best->cost / ours->cost) : Cell(),
               beside ? Cell(best->time->low / beside->high) : Cell(),
               beside ? Cell(best->time->high / beside->low) : Cell(), best->part, ours ? Cell(ours->part) : Cell()});
  }
}

}  // namespace crosscheck
