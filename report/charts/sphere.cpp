// Experiment `sphere`: friction, rebound, leaving, depth, and cloths that fall on a ball.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/cells.h"
#include "experiments/sphere_probes.h"
#include "report/charts/charts.h"
#include "report/findings_text.h"

namespace crosscheck {
namespace {

constexpr auto sticky = "mysim/symplectic-euler+sticky";
constexpr double degree = 0.017453292519943295;

std::vector<std::string> distinct(const Table& table, const std::string& column) {
  std::vector<std::string> all;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const std::string& text = text_at(table, i, column); std::find(all.begin(), all.end(), text) == all.end())
      all.push_back(text);
  return all;
}

/// The step of the table that is nearest to a millisecond, s.
double usual_step(const Table& table) {
  double best = 0;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const auto h = number_at(table, i, "step"); h && (best == 0 || std::abs(*h - 1e-3) < std::abs(best - 1e-3)))
      best = *h;
  return best;
}

/// Those that stand for the others, and those that answer differently.
bool shown_always(const std::string& method) {
  return method == ours || method == theirs || method == position_based || method == sticky;
}

Chart cone_law(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-cone";
  f.title = "Coulomb's law on a slope: how far it slides";
  f.x = {"friction / tan(slope)", false, 0.0, 2.5};
  f.y = {"way / way without friction", false, -0.05, 1.05};
  const double step = usual_step(table);
  Curve exact{"Coulomb, exact", {"#555555", "1", -1}, {{0, 1}, {1, 0}, {2.5, 0}}};
  f.curves.push_back(std::move(exact));
  PageTable page{fmt::format("Stick or slide, at a step of {} s", nice(step)),
                 {"method", "sticks or slides as it should", "of", "wrong answers"},
                 {}};
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, false, true};
    int right = 0, all = 0, creeping = 0, stuck = 0;
    std::string failed;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method || number_at(table, i, "step") != step) continue;
      if (text_at(table, i, "verdict") != "ok") {
        failed = text_at(table, i, "verdict") == "unsupported" ? text_at(table, i, "reason")
                                                               : failure_word(text_at(table, i, "verdict"));
        ++all;
        continue;
      }
      const double angle = *number_at(table, i, "angle") * degree, mu = *number_at(table, i, "friction");
      curve.points.emplace_back(mu / std::tan(angle), *number_at(table, i, "way") / (9.81 * std::sin(angle) / 8));
      const std::string& answer = text_at(table, i, "answer");
      ++all;
      right += answer == text_at(table, i, "answer by theory");
      creeping += answer == "neither";
      stuck += answer == "sticks" && text_at(table, i, "answer by theory") == "slides";
    }
    std::erase_if(curve.points, [](const auto& p) { return p.first > 2.5; });
    std::string wrong;
    if (creeping) wrong += fmt::format("creeps in {}", creeping);
    if (stuck) wrong += fmt::format("{}sticks where it should slide in {}", wrong.empty() ? "" : ", ", stuck);
    if (!failed.empty()) wrong += (wrong.empty() ? "" : "; ") + failed;
    page.rows.push_back({method, std::to_string(right), std::to_string(all), wrong});
    if ((right < all || shown_always(method)) && !curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "On slopes of 10 to 50 degrees with frictions of 0 to 1.2 all answers must fall on one line. The deformable "
      "worlds and mysim do; the position-based world hardly moves at any friction, the sticky sphere never.";
  f.caption = fmt::format(
      "A particle on a slope for 0.5 s, step {} s; truth: exact (Coulomb's law); methods that "
      "answer like mysim/symplectic-euler are in the table only; commit {}.",
      nice(step), commit);
  Chart chart{"", std::move(f), "sphere",
              "A particle at rest on a slope must stay where friction exceeds the slope's tangent, and otherwise slide "
              "by g (sin - mu cos) t^2 / 2."};
  chart.tables.push_back(std::move(page));
  return chart;
}

/// Which cell sticks, which slides, which does neither: of those that stand for the others, side by side in each cell.
std::optional<Chart> cone_map(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-cone-map";
  f.title = "Who sticks, who slides, who creeps";
  f.x = {"slope / degrees", false, 5.0, 55.0};
  f.y = {"friction", false, -0.05, 1.25};
  Curve limit{"tan(slope), exact", {"#555555", "1", -1}, {}};
  // level beside the methods of a slope, which stand beside each other
  for (const double slope : {10., 20., 30., 40., 50.})
    for (const double side : {-4., 4.}) limit.points.emplace_back(slope + side, std::tan(slope * degree));
  f.curves.push_back(std::move(limit));
  const double step = usual_step(table);
  const char* shown[] = {ours, theirs, position_based, sticky};
  const std::pair<const char*, int> answers[] = {{"sticks", 7}, {"slides", 6}, {"neither", 9}};
  for (size_t m = 0; m < std::size(shown); ++m)
    for (const auto& [answer, marker] : answers) {
      const std::string word = std::string(answer) == "neither" ? "creeps" : answer;
      Curve curve{fmt::format("{} {}", shown[m], word), {style_of(shown[m]).colour, "1", marker}, {}, false, true};
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != shown[m] || number_at(table, i, "step") != step ||
            text_at(table, i, "verdict") != "ok" || text_at(table, i, "answer") != answer)
          continue;
        curve.points.emplace_back(*number_at(table, i, "angle") + 1.7 * (static_cast<double>(m) - 1.5),
                                  *number_at(table, i, "friction"));
      }
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
  if (f.curves.size() == 1) return std::nullopt;  // none of these was asked
  f.finding =
      "Above the line it must stick (filled), below it slide (open); a triangle does neither: it moves at a "
      "steady creep.";
  f.caption = fmt::format("The same runs as above, methods side by side at each slope; step {} s; commit {}.",
                          nice(step), commit);
  return Chart{"", std::move(f), "sphere"};
}

Chart rebounds(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-rebound";
  f.title = "Rebound of a particle: error of its height";
  f.x = {"step / s", true, std::nullopt, std::nullopt};
  f.y = {"|rebound - e² 0.3 m| / mm", true, 1e-2, 1e3};
  PageTable page{"Rebound height in mm at a step of 1/240 s", {"method"}, {}};
  std::vector<double> parts;
  for (size_t i = 0; i < table.rows.size(); ++i)
    if (const double e = *number_at(table, i, "restitution"); std::find(parts.begin(), parts.end(), e) == parts.end())
      parts.push_back(e);
  for (const double e : parts) page.header.push_back(fmt::format("e = {:g} (exact {:.4g})", e, 300 * e * e));
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, true, true};
    std::vector<std::string> row{method};
    double of_curve = 0.5;  // Bullet returns nothing: its own rebound where none is asked
    if (method.starts_with("bullet/")) of_curve = 0;
    for (const double e : parts) {
      std::string said = "";
      for (size_t i = 0; i < table.rows.size(); ++i) {
        if (text_at(table, i, "method") != method || number_at(table, i, "restitution") != e) continue;
        const double h = *number_at(table, i, "step");
        const auto height = number_at(table, i, "rebound");
        if (std::abs(h - 1. / 240) < 1e-9)
          said = height                                          ? fmt::format("{:.4g}", 1e3 * *height)
                 : text_at(table, i, "verdict") == "unsupported" ? "cannot"
                                                                 : failure_word(text_at(table, i, "verdict"));
        if (e == of_curve && height)
          if (const double off = std::abs(*height - 0.3 * e * e) * 1e3; off > 1e-2) curve.points.emplace_back(h, off);
      }
      row.push_back(said);
    }
    page.rows.push_back(std::move(row));
    if (method.starts_with("bullet/")) curve.title += " (e = 0)";
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  f.finding =
      "mysim comes to the exact height as the step falls. Bullet's soft bodies have no restitution against an "
      "obstacle; "
      "its position-based world throws back by itself, by an amount that hangs on where in its step the impact falls.";
  f.caption = fmt::format(
      "Dropped by 0.3 m on a ball, e = 0.5 where nothing is said; truth: exact (parabolas); commit "
      "{}.",
      commit);
  Chart chart{"", std::monostate{}, "sphere",
              "A ball that returns the part e of the speed throws back to e² of the height.", f.title};
  if (!f.curves.empty()) chart.figure = std::move(f);  // none where all are within 0.01 mm, or fail
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart leavings(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "sphere-leaving";
  f.title = "Where a particle without friction leaves the ball";
  f.x = {"step / s", true, std::nullopt, std::nullopt};
  f.y = {"angle less the exact one / degrees", false, std::nullopt, std::nullopt};
  PageTable page{
      "Angle and speed where the gap passes 1 mm", {"method", "step / s", "angle / degrees", "speed / (m/s)"}, {}};
  double exact = 0, speed = 0;
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}, true, true};
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method) continue;
      exact = *number_at(table, i, "angle by theory"), speed = *number_at(table, i, "speed by theory");
      const auto angle = number_at(table, i, "angle");
      const double h = *number_at(table, i, "step");
      page.rows.push_back({method, nice(h),
                           angle                                  ? fmt::format("{:.2f}", *angle)
                           : text_at(table, i, "verdict") == "ok" ? "does not leave"
                                                                  : std::string(text_at(table, i, "verdict")),
                           angle ? fmt::format("{:.3f}", *number_at(table, i, "speed")) : ""});
      if (angle) curve.points.emplace_back(h, *angle - exact);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  page.rows.insert(page.rows.begin(), {"exact", "", fmt::format("{:.2f}", exact), fmt::format("{:.3f}", speed)});
  f.floor = {"exact", 0};
  f.finding = fmt::format(
      "Contact ends at 48.2 degrees, where cos = 2/3; the gap passes 1 mm at {:.2f} degrees and {:.3f} m/s, whatever "
      "the engine. A particle that never comes off, as on the sticky sphere, has no point here.",
      exact, speed);
  f.caption = fmt::format(
      "A ball of 1.02 m, no friction, started 1 degree off its top; truth: exact (energy on the ball, then free "
      "flight). "
      "The gap of 1 mm is compared, as some engines let the particle hop before it leaves; commit {}.",
      commit);
  Chart chart{"", std::monostate{}, "sphere", "", f.title};
  if (!f.curves.empty()) chart.figure = std::move(f);  // none where no particle leaves
  chart.tables.push_back(std::move(page));
  return chart;
}

/// Deepest particle and deepest triangle, by method, with one figure for all scenes with triangles.
std::optional<Chart> depths(const Table& table, const std::string& scene, const std::string& commit) {
  Figure f;
  f.name = scene + "-penetration";
  f.title = scene + ": deepest inside the contact surface";
  f.x = {"", false, std::nullopt, std::nullopt};
  f.y = {"depth / % of the radius", true, 1e-3, 10};
  PageTable page{scene + ": depth inside the contact surface in % of its radius",
                 {"method", "step / s", "particles", "triangles", "particles at end", "triangles at end"},
                 {}};
  double place = 0;
  std::map<double, std::pair<Curve, Curve>> by_step;
  const char* colours[] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00"};
  for (const std::string& method : distinct(table, "method")) {
    bool any = false;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "scene") != scene || text_at(table, i, "method") != method) continue;
      if (!any)
        f.categories.emplace_back(
            ++place, method == sticky ? "sticky sphere" : method.substr(method.starts_with("mysim/") ? 6 : 0));
      any = true;
      const auto h = number_at(table, i, "step"), nodes = number_at(table, i, "particles"),
                 triangles = number_at(table, i, "triangles");
      auto said = [&](const char* column) {
        const auto value = number_at(table, i, column);
        // round-off of the surface
        return value ? *value < 1e-9 ? std::string("0") : nice(*value) : std::string("");
      };
      if (text_at(table, i, "verdict") != "ok") {
        page.rows.push_back({method, nice(h.value_or(0)), text_at(table, i, "verdict"), "", "", ""});
        continue;
      }
      page.rows.push_back(
          {method, nice(*h), said("particles"), said("triangles"), said("particles at end"), said("triangles at end")});
      if (method.find("dopri5") != std::string::npos) continue;  // its steps are its own
      if (!by_step.contains(*h)) {
        const std::string colour = colours[by_step.size() % std::size(colours)];
        by_step[*h] = {{fmt::format("particles, step {} s", nice(*h)), {colour, "1", 6}, {}, false, true},
                       {fmt::format("triangles, step {} s", nice(*h)), {colour, "1", 9}, {}, false, true}};
      }
      if (nodes && *nodes > 1e-3) by_step[*h].first.points.emplace_back(place - 0.12, *nodes);
      if (triangles && *triangles > 1e-3) by_step[*h].second.points.emplace_back(place + 0.12, *triangles);
    }
  }
  for (auto& [h, curves] : by_step)
    for (Curve* curve : {&curves.first, &curves.second})
      if (!curve->points.empty()) f.curves.push_back(std::move(*curve));
  if (f.curves.empty()) return std::nullopt;
  f.x.low = 0.4, f.x.high = place + 0.6;
  f.finding =
      "No particle of mysim is ever inside; the triangles between them cut into the ball all the same, by what a chord "
      "is below its arc. Bullet's implicit world looks for contact where the particle was, and its position-based "
      "world "
      "pulls particles in by their links. Below 0.001 % nothing is drawn.";
  f.caption =
      fmt::format("Scene {}, largest at any sample, in per cent of the contact radius; commit {}.", scene, commit);
  Chart chart{"", std::move(f), "sphere"};
  chart.tables.push_back(std::move(page));
  return chart;
}

struct Course {
  const char *column, *name, *title, *label;
  double factor;
  bool logarithmic;
};

/// A quantity over time, at the usual step.
std::optional<Chart> course(const Table& table, const std::string& scene, const Course& what,
                            const std::string& finding, const std::string& commit) {
  Figure f;
  f.name = fmt::format("{}-{}", scene, what.name);
  f.title = fmt::format("{}: {}", scene, what.title);
  f.x = {"t / s", false, 0.0, std::nullopt};
  f.y = {what.label, what.logarithmic, std::nullopt, std::nullopt};
  const double step = usual_step(table);
  for (const std::string& method : distinct(table, "method")) {
    Curve curve{method, style_of(method), {}};
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (text_at(table, i, "method") != method || std::abs(*number_at(table, i, "step") / step - 1) > 1e-6) continue;
      const auto value = number_at(table, i, what.column);
      if (value && (!what.logarithmic || *value > 0))
        curve.points.emplace_back(*number_at(table, i, "t"), *value * what.factor);
    }
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  if (f.curves.empty()) return std::nullopt;
  f.finding = finding;
  f.caption =
      fmt::format("Scene {}, step {} s; contact rules differ, so these are differences and no errors; commit {}.",
                  scene, nice(step), commit);
  return Chart{"", std::move(f), "sphere"};
}

PageTable drape_table(const Table& table, const std::string& scene) {
  PageTable page{scene + ": how it ends",
                 {"method", "step / s", "settled after / s", "centre height / m", "moved aside / mm", "creep / (mm/s)",
                  "contact took / J", "asymmetry / m"},
                 {}};
  for (size_t i = 0; i < table.rows.size(); ++i) {
    if (text_at(table, i, "scene") != scene) continue;
    const std::string& method = text_at(table, i, "method");
    if (text_at(table, i, "verdict") != "ok") {
      const std::string why = text_at(table, i, "verdict") == "unsupported"
                                  ? "cannot: " + text_at(table, i, "reason")
                                  : fmt::format("{} at {:.3g} s", failure_word(text_at(table, i, "verdict")),
                                                number_at(table, i, "end").value_or(0));
      page.rows.push_back({method, nice(number_at(table, i, "step").value_or(0)), why, "", "", "", "", ""});
      continue;
    }
    auto said = [&](const char* column, double factor, const char* otherwise) {
      const auto value = number_at(table, i, column);
      return value ? nice(factor * *value) : std::string(otherwise);
    };
    const bool inferred = std::get<long>(table.at(i, "contact inferred")) != 0;
    page.rows.push_back({method, nice(*number_at(table, i, "step")), said("settled after", 1, "not at rest"),
                         said("centre height", 1, ""), said("centre moved aside", 1e3, ""),
                         said("creep", 1e3, "off the ball"),
                         said("contact took", 1, "") + (inferred ? " (inferred)" : ""), said("asymmetry", 1, "")});
  }
  return page;
}

/// The cloth that slides off, by four that answer differently.
Chart snapshot(const Table& table) {
  Snapshot s;
  s.name = "sphere-drop-aside";
  s.scene = drop_aside();
  Run run = default_run(s.scene);
  // before it has fallen out of the picture
  run.duration = 1.16, run.samples = 58;
  for (const char* method : {ours, theirs, position_based, sticky})
    if (const auto all = distinct(table, "method"); std::find(all.begin(), all.end(), method) != all.end())
      s.panels.push_back({method, run});
  s.shot.mode = Mode::stretch;
  s.shot.width = 1440, s.shot.height = 480;
  s.caption =
      "The cloth that is dropped 0.12 m aside with a friction of 0.25, after 1.16 s: by Coulomb's law it slides off; "
      "the position-based world holds it, the sticky sphere freezes it where it touched.";
  Chart chart{"", std::monostate{}, "sphere", "Dropped aside of the middle, with a friction that cannot hold it.",
              "A cloth that should slide off"};
  if (!s.panels.empty()) chart.snapshots.push_back(std::move(s));
  return chart;
}

}  // namespace

std::vector<Chart> sphere_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Rows& rows = input.result;
  const auto add = [&](std::optional<Chart> chart) {
    if (chart) charts.push_back(std::move(*chart));
  };
  if (const Table* table = rows.table("sphere-cone")) {
    add(cone_law(*table, input.commit));
    add(cone_map(*table, input.commit));
  }
  if (const Table* table = rows.table("sphere-rebound")) add(rebounds(*table, input.commit));
  if (const Table* table = rows.table("sphere-leaving")) add(leavings(*table, input.commit));
  const Table *drapes = rows.table("sphere-drape"), *deep = rows.table("sphere-penetration");
  if (!drapes || !deep) return charts;
  for (const std::string& scene : distinct(*drapes, "scene")) {
    const Table* over_time = rows.table(scene + "-drape");
    if (scene == "drop-aside") {
      Chart picture = snapshot(*drapes);
      picture.tables.push_back(drape_table(*drapes, scene));
      add(std::move(picture));
    }
    bool cloth = false, symmetric = false;
    for (size_t i = 0; i < over_time->rows.size(); ++i) {
      cloth |= number_at(*over_time, i, "triangles inside").has_value();
      symmetric |= number_at(*over_time, i, "asymmetry").has_value();
    }
    if (!cloth) continue;  // single particles have their scenes' own parts of the page
    add(course(*over_time, scene, {"creep", "sliding", "sliding speed of what touches", "speed / (mm/s)", 1e3, true},
               "How fast the touching particles slide. The position-based world's friction is a creep that never ends; "
               "the others come to rest, or slide off.",
               input.commit));
    if (symmetric) {
      add(course(*over_time, scene,
                 {"asymmetry", "asymmetry", "how far it is from its own mirror image", "asymmetry / m", 1, true},
                 "The scene is symmetric in two planes. mysim's rules that look at all particles alike part from it by "
                 "rounding "
                 "that grows; a sweep over links in an order (XPBD, the position-based world) and Bullet's contacts "
                 "break it at the first touch.",
                 input.commit));
      if (charts.back().figure.index() == 0) charts.back().tables.push_back(drape_table(*drapes, scene));
    }
    add(depths(*deep, scene, input.commit));
  }
  return charts;
}

}  // namespace crosscheck
