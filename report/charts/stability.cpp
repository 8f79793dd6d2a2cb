// Where methods break: limits by theory and as measured, maps of what becomes of runs, and pictures of the moment.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/cells.h"
#include "report/charts/charts.h"

namespace crosscheck {
namespace {

constexpr auto chapter = "stability";

std::string percent_text(double share) { return fmt::format("{:+.2g} %", 100 * share); }

/// "0.655 ms"
std::string time_text(double seconds) { return seconds < 1 ? nice(1e3 * seconds) + " ms" : nice(seconds) + " s"; }

/// Rows of one scene as people read them.
PageTable limits_table(const Table& table, const std::string& scene) {
  PageTable page{fmt::format("The largest stable step on {}.", scene),
                 {"method", "by theory", "as measured", "apart", "just above", "why apart"},
                 {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene || text_at(table, i, "measurement") == "unsupported") continue;
    const auto predicted = number_at(table, i, "predicted limit"), measured = number_at(table, i, "measured limit"),
               off = number_at(table, i, "deviation");
    const std::string& theory = text_at(table, i, "prediction");
    const auto* above = std::get_if<std::string>(&table.at(i, "verdict above"));
    page.rows.push_back({text_at(table, i, "method"),
                         theory == "limit"  ? time_text(*predicted)
                         : theory == "none" ? "no theory"
                                            : theory,
                         measured ? time_text(*measured) : text_at(table, i, "measurement"),
                         off ? percent_text(*off) : "", above ? *above : "", text_at(table, i, "reason")});
  }
  return page;
}

/// Size of the deviation of every method on every scene that theory has a limit for.
std::optional<Chart> deviations(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "stability-limits";
  f.title = "Largest stable step: measurement beside theory";
  f.x = {"", false, std::nullopt, std::nullopt};
  f.y = {"difference from theory / %", true, std::nullopt, std::nullopt};
  std::map<std::string, int> scene_at;
  std::vector<std::string> order;
  constexpr double finest = 0.05;  // %, of the axis: the search stops at a tenth or a fifth of a per cent
  double worst = 0;
  int count = 0;
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto off = number_at(table, i, "deviation");
    if (!off) continue;
    const std::string &scene = text_at(table, i, "scene"), &method = text_at(table, i, "method");
    if (scene_at.try_emplace(scene, static_cast<int>(scene_at.size())).second) order.push_back(scene);
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == method; });
    if (curve == f.curves.end()) {
      f.curves.push_back({method, style_of(method), {}, false, true});
      curve = f.curves.end() - 1;
    }
    curve->points.emplace_back(scene_at[scene], std::max(finest, 100 * std::abs(*off)));
    if (text_at(table, i, "state") == "rest") worst = std::max(worst, std::abs(*off)), ++count;
  }
  if (f.curves.empty()) return std::nullopt;
  // side by side, so that no marker hides another
  for (size_t c = 0; c < f.curves.size(); ++c)
    for (auto& point : f.curves[c].points)
      point.first += 0.6 * ((static_cast<double>(c) + 0.5) / static_cast<double>(f.curves.size()) - 0.5);
  for (size_t i = 0; i < order.size(); ++i) f.categories.emplace_back(static_cast<double>(i), order[i]);
  f.x.low = -0.5, f.x.high = static_cast<double>(order.size()) - 0.5;
  f.floor = {"1 %", 1};
  f.finding = fmt::format(
      "{} limits of scenes that can rest, found by running, lie within {:.2g} % of what the "
      "eigenvalues of the scene's Jacobian predict.",
      count, 100 * worst);
  f.caption = fmt::format(
      "Differences below {} % are drawn there. Theory looks at small motion about rest, or about the start where a "
      "scene has no rest; commit {}.",
      finest, commit);
  return Chart{"", std::move(f), chapter,
               "Theory takes the scene's Jacobian, its eigenvalues, and for each of them the step at which the method "
               "begins to grow; the least of these steps is the limit. The measurement knows nothing of that: it kicks "
               "the scene at rest by a hundred-millionth of a spring, runs it for thousands of steps, and halves the "
               "step until what holds and what fails lie within a fifth of a per cent."};
}

/// Growth where no step is stable, or just beside a limit.
std::optional<PageTable> growth_table(const Table& table, bool without_limit) {
  PageTable page{
      without_limit ? "Growth of the fastest vibration in each step, where no step is stable."
                    : "Growth (+) or decay (-) of the binding vibration in each step, beside the limit, where explicit "
                      "Euler and the trapezoidal rule grow too slowly to be seen blowing up.",
      {"scene", "method", without_limit ? "h omega" : "step over limit", "by theory", "as measured"},
      {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    const auto share = number_at(table, i, "share of limit");
    const std::string& method = text_at(table, i, "method");
    if (share.has_value() == without_limit) continue;
    if (!without_limit && method != "mysim/explicit-euler" && method != "mysim/trapezoidal") continue;
    page.rows.push_back({text_at(table, i, "scene"), method,
                         fmt::format("{:.2g}", without_limit ? *number_at(table, i, "h omega") : *share),
                         fmt::format("{:+.4g}", *number_at(table, i, "predicted growth")),
                         fmt::format("{:+.4g}", *number_at(table, i, "measured growth"))});
  }
  if (page.rows.empty()) return std::nullopt;
  return page;
}

/// The kinds of cells, from whole to broken; and the words that verdicts have in the key.
struct Fate {
  const char *verdict, *title, *colour;
};
constexpr Fate fates[] = {
    {"ok", "holds", "#D8E8F0"},
    {"energy", "energy from nothing", "#D55E00"},
    {"nan", "not a number", "#5B1A4F"},
    {"stretch", "overstretched", "#E9B44C"},
    {"solver", "solver gives up", "#7F7F7F"},
    {"frozen", "frozen", "#56B4E9"},
    {"timeout", "out of time", "#009E73"},
    {"crash", "program fails", "#222222"},
};
int kind_of(const std::string& verdict) {
  for (size_t i = 0; i < std::size(fates); ++i)
    if (verdict == fates[i].verdict) return static_cast<int>(i);
  return 1;
}

HeatMap map_of(const Table& cells, const Table& limits, const std::string& scene, const std::string& kind,
               const std::string& commit) {
  HeatMap map;
  map.name = fmt::format("{}-{}-map", scene, kind);
  map.title = kind == "drag" ? fmt::format("{}: what becomes of a run, over step and drag", scene)
                             : fmt::format("{}: what becomes of a run, over step and stiffness", scene);
  map.x_label = "step / s";
  map.y_label = kind == "drag" ? "drag rate / (1/s)" : "stiffness / the scene's own";
  for (const Fate& fate : fates) map.kinds.push_back({fate.title, fate.colour});
  const auto panel = [&](const std::string& method) -> HeatMap::Panel& {
    for (HeatMap::Panel& p : map.panels)
      if (p.title == method) return p;
    return map.panels.emplace_back(HeatMap::Panel{method, {}, {}, {}});
  };
  for (size_t i = 0; i < cells.rows.size(); ++i)
    if (text_at(cells, i, "scene") == scene && text_at(cells, i, "map") == kind)
      panel(text_at(cells, i, "method"))
          .cells.push_back(
              {*number_at(cells, i, "step"), *number_at(cells, i, "value"), kind_of(text_at(cells, i, "verdict"))});
  double worst = 0;
  int rows = 0;
  for (size_t i = 0; i < limits.rows.size(); ++i) {
    if (text_at(limits, i, "scene") != scene || text_at(limits, i, "map") != kind) continue;
    HeatMap::Panel& p = panel(text_at(limits, i, "method"));
    const double value = *number_at(limits, i, "value");
    const auto predicted = number_at(limits, i, "predicted limit"), held = number_at(limits, i, "held"),
               failed = number_at(limits, i, "failed");
    if (predicted && *predicted > 0) p.predicted.emplace_back(*predicted, value);
    if (held && failed) {
      p.measured.emplace_back(std::sqrt(*held * *failed), value);
      if (predicted && *predicted > 0)
        worst = std::max(worst, std::abs(p.measured.back().first / *predicted - 1)), ++rows;
    }
  }
  map.finding = rows > 0
                    ? fmt::format(
                          "Where the dashed line of theory crosses a row, the run begins to fail: on {} rows of all "
                          "panels the measured limit is at most {:.2g} % away.",
                          rows, 100 * worst)
                    : "No method here has a limit by linear theory.";
  map.caption =
      fmt::format("Scene {}; each cell one run from rest, kicked by at most a ten-thousandth of a spring; commit {}.",
                  scene, commit);
  return map;
}

/// Cloth by symplectic Euler, a twentieth below its limit and a twentieth above.
std::optional<Snapshot> moment_of_failure(const ChartInput& input, const Table& table) {
  constexpr auto method = "mysim/symplectic-euler";
  for (const Scene& scene : input.scenes) {
    if (scene.name != "cloth-hang") continue;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      const auto limit = number_at(table, i, "measured limit");
      if (text_at(table, i, "scene") != scene.name || text_at(table, i, "method") != method || !limit) continue;
      Snapshot s;
      s.name = "stability-moment";
      s.scene = scene;
      for (const double part : {0.95, 1.05}) {
        // one step per sample: the run must not shorten it
        const double h = part * *limit;
        const int samples = static_cast<int>(0.6 / h);
        s.panels.push_back({method, {h, h * samples, samples}});
      }
      s.caption = fmt::format(
          "The cloth of cloth-hang, let go from the horizontal, by symplectic Euler at steps a twentieth below its "
          "limit of {} (left) and a twentieth above (right), both at the moment at which the right one's energy passes "
          "all that it had to work with: from one particle to the next its springs are stretched and pressed in turn.",
          time_text(*limit));
      s.shot.mode = Mode::stretch;
      s.shot.at_first_failure = true;
      s.shot.width = 1280;
      s.shot.height = 560;
      return s;
    }
  }
  return std::nullopt;
}

}  // namespace

std::vector<Chart> stability_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* table = input.result.table("stability");
  if (!table) return charts;
  std::vector<std::string> scenes;
  for (size_t i = 0; i < table->rows.size(); ++i)
    if (std::find(scenes.begin(), scenes.end(), text_at(*table, i, "scene")) == scenes.end())
      scenes.push_back(text_at(*table, i, "scene"));

  if (auto chart = deviations(*table, input.commit)) {
    for (const std::string& scene : scenes) chart->tables.push_back(limits_table(*table, scene));
    charts.push_back(std::move(*chart));
  }
  if (auto moment = moment_of_failure(input, *table)) {
    Chart chart{"", std::monostate{}, chapter,
                "What a limit means: a tenth of a step more or less decides between a cloth and none.",
                "The moment of failure"};
    chart.snapshots.push_back(std::move(*moment));
    charts.push_back(std::move(chart));
  }
  const Table *cells = input.result.table("stability-map"), *limits = input.result.table("stability-map-limit");
  std::vector<std::pair<std::string, std::string>> maps;  // scene, kind
  for (size_t i = 0; cells && i < cells->rows.size(); ++i) {
    const std::pair each{text_at(*cells, i, "scene"), text_at(*cells, i, "map")};
    if (std::find(maps.begin(), maps.end(), each) == maps.end()) maps.push_back(each);
  }
  for (const auto& [scene, kind] : maps)
    charts.push_back({"", map_of(*cells, *limits, scene, kind, input.commit), chapter,
                      kind == "drag" ? "Drag decides which steps of explicit Euler hold at all, and shortens the step "
                                       "of symplectic Euler once it is as fast as the springs."
                                     : "Four times the stiffness halves the step of every explicit rule; implicit and "
                                       "position-based worlds go on, at the price of accuracy."});
  if (const Table* growth = input.result.table("stability-growth")) {
    Chart chart{
        "", std::monostate{}, chapter,
        "Explicit Euler and the explicit trapezoidal rule have no stable step without drag. What they gain in a "
        "step is so little that short runs look fine; theory and measurement agree on how much.",
        "Slow blow-ups"};
    for (const bool without_limit : {true, false})
      if (auto page = growth_table(*growth, without_limit)) chart.tables.push_back(std::move(*page));
    if (!chart.tables.empty()) charts.push_back(std::move(chart));
  }
  return charts;
}

}  // namespace crosscheck
