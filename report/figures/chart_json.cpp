#include "report/figures/chart_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <ranges>
#include <set>

#include "report/figures/curve_plot.h"

namespace crosscheck {
namespace {

/// Six digits: more than a screen resolves.
Json short_number(double value) { return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr); }

Json pairs_json(const std::vector<std::pair<double, double>>& pairs) {
  Json list = Json::array();
  for (const auto& [x, y] : pairs) list.push_back(Json::array({short_number(x), short_number(y)}));
  return list;
}

/// Resolution of curves along an axis: a ten-thousandth of its range or, on a logarithmic axis, of each value.
class Fineness {
 public:
  Fineness(const Axis& axis, const std::vector<Curve>& curves, double std::pair<double, double>::*coordinate) {
    double low = axis.low.value_or(INFINITY), high = axis.high.value_or(-INFINITY);
    for (const Curve& curve : curves)
      for (const auto& point : curve.points) {
        const double value = point.*coordinate;
        if (!std::isfinite(value)) continue;
        if (!axis.low) low = std::min(low, value);
        if (!axis.high) high = std::max(high, value);
      }
    if (!axis.logarithmic && high > low) unit_ = std::pow(10, std::floor(std::log10((high - low) / 1e4)));
  }
  Json of(double value) const {
    const std::string text =
        unit_ > 0 ? fmt::format("{:.12g}", std::round(value / unit_) * unit_) : fmt::format("{:.4g}", value);
    return std::strtod(text.c_str(), nullptr);
  }

 private:
  double unit_ = 0;  // linear axes only
};

/// True for a unit, as in "quantity / unit"; false for the denominator of a ratio.
bool is_unit(std::string_view text) {
  constexpr std::string_view units[] = {"s", "ms", "ns",  "m",    "cm", "mm",      "µm",   "J",    "N",    "kg",
                                        "°", "%",  "rad", "mrad", "1",  "degrees", "flop", "byte", "Gflop"};
  if (text.starts_with("% of ")) return true;
  if (text.starts_with('(') && text.ends_with(')')) text = text.substr(1, text.size() - 2);
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find('/', begin), text.size());
    if (std::ranges::find(units, text.substr(begin, end - begin)) == std::end(units)) return false;
    begin = end + 1;
  }
  return true;
}

Json axis_json(const Axis& axis) {
  size_t slash = axis.label.rfind(" / ");
  if (slash != std::string::npos && !is_unit(std::string_view(axis.label).substr(slash + 3))) slash = std::string::npos;
  Json json{{"label", axis.label.substr(0, slash)}};
  if (slash != std::string::npos) {
    const std::string unit = axis.label.substr(slash + 3);
    json["unit"] = unit.starts_with('(') ? unit.substr(1, unit.size() - 2) : unit;
  }
  if (axis.logarithmic) json["log"] = true;
  if (axis.low) json["low"] = short_number(*axis.low);
  if (axis.high) json["high"] = short_number(*axis.high);
  return json;
}

/// Name of a colour that style.css defines for light and dark mode, or the colour itself.
std::string colour_name(const std::string& colour) {
  constexpr std::pair<std::string_view, const char*> named[] = {{"#1D6FB5", "mysim2"},
                                                                {"#0B4F94", "mysim"},
                                                                {"#803500", "bullet"},
                                                                {"#B05200", "bullet2"},
                                                                {"#0A7D5A", "outside"}};
  const auto* found = std::ranges::find(named, colour, &std::pair<std::string_view, const char*>::first);
  return found == std::end(named) ? colour : found->second;
}

void add_mark(Json& json, int marker) {
  constexpr const char* names[] = {"plus",     "cross", "star",    "square",  "circle",
                                   "triangle", "down",  "diamond", "pentagon"};
  if (marker <= 0 || marker > 15) return;
  json["mark"] = names[marker <= 3 ? marker - 1 : marker / 2 + 1];
  if (marker > 3 && marker % 2 == 0) json["open"] = true;
}

/// Adds the lengths of dashes and gaps, in line widths.
void add_dash(Json& json, const std::string& dash) {
  if (!dash.starts_with('(')) return;
  std::string lengths = dash.substr(1, dash.size() - 2);
  std::ranges::replace(lengths, ',', ' ');
  json["dash"] = lengths;
}

Json name_json(const std::string& title, const std::vector<std::string>& beside) {
  Json json{{"name", reader_name(title, beside)}};
  if (const std::string method = method_named(title); !method.empty()) json["method"] = method;
  return json;
}

Json names_json(const std::vector<std::string>& titles) {
  Json list = Json::array();
  for (const std::string& title : titles) list.push_back(name_json(title, titles));
  return list;
}

std::vector<size_t> thinned(const std::vector<std::pair<double, double>>& points) {
  constexpr size_t most = 600, of_each = 4;
  std::vector<size_t> kept(points.size());
  std::iota(kept.begin(), kept.end(), size_t{0});
  if (points.size() <= most) return kept;
  kept.clear();
  const size_t stretches = most / of_each;
  for (size_t s = 0; s < stretches; ++s) {
    const size_t begin = s * points.size() / stretches, end = (s + 1) * points.size() / stretches;
    size_t low = begin, high = begin;
    for (size_t i = begin; i < end; ++i) {
      if (points[i].second < points[low].second) low = i;
      if (points[i].second > points[high].second) high = i;
    }
    const std::set<size_t> these{begin, low, high, end - 1};
    kept.insert(kept.end(), these.begin(), these.end());
  }
  return kept;
}

void add_tooltip(Json& json, const Tooltip& tip) {
  if (!tip.words.empty()) json["words"] = tip.words;
  if (!tip.run.empty()) json["run"] = tip.run;
}

Json series_json(const Curve& curve, const std::set<std::pair<double, double>>& scaled, const Fineness& x,
                 const Fineness& y) {
  Json json{{"title", curve.title}};
  if (curve.line) json["line"] = true;
  add_dash(json, curve.style.dash);
  add_mark(json, curve.style.marker);
  // a line without a marker on every point gets a few marks that distinguish it from other lines
  if (curve.line && !curve.markers) json["few"] = true;
  const std::vector<size_t> kept = thinned(curve.points);
  Json points = Json::array(), open = Json::array(), tips = Json::array();
  bool any_open = false;
  for (const size_t i : kept) {
    points.push_back(Json::array({x.of(curve.points[i].first), y.of(curve.points[i].second)}));
    open.push_back(scaled.contains(curve.points[i]) ? 1 : 0), any_open |= scaled.contains(curve.points[i]);
    if (i < curve.tooltips.size()) add_tooltip(tips.emplace_back(Json::object()), curve.tooltips[i]);
  }
  json["points"] = std::move(points);
  if (any_open) json["scaled"] = std::move(open);
  if (!curve.tooltips.empty()) json["tips"] = std::move(tips);
  return json;
}

Json parts_json(const Figure& f, const std::vector<NamedCurves>& named,
                const std::set<std::pair<double, double>>& scaled) {
  const Fineness x(f.x, f.curves, &std::pair<double, double>::first),
      y(f.y, f.curves, &std::pair<double, double>::second);
  std::vector<std::string> titles;
  for (const NamedCurves& part : named) titles.push_back(part.title);
  Json parts = Json::array();
  for (const NamedCurves& part : named) {
    Json json = name_json(part.title, titles);
    if (!json.contains("method") && !part.curves.empty() && !part.curves[0]->method.empty())
      json["method"] = part.curves[0]->method;
    json["colour"] = colour_name(part.style.colour);
    if (part.coloured) json["hero"] = true;
    if (named_in_key(f, named, part)) json["keyed"] = true;
    json["series"] = Json::array(), json["failures"] = Json::array();
    for (const Curve* curve : part.curves) json["series"].push_back(series_json(*curve, scaled, x, y));
    for (const FailureMark* mark : part.failures) {
      Json failure{{"x", short_number(mark->x)}, {"kind", kind_of(*mark)}};
      add_mark(failure, mark->cross);
      add_tooltip(failure, mark->tooltips);
      json["failures"].push_back(std::move(failure));
    }
    parts.push_back(std::move(json));
  }
  return parts;
}

Json numbers_of(const Figure& f) {
  const std::vector<NamedCurves> named = named_parts(f);
  const PlotRange range = plot_range(f, named);
  Axis x = f.x, y = f.y;
  x.low = range.x_low, x.high = range.x_high, y.low = range.y_low, y.high = range.y_high;
  Json json{{"kind", "curves"}, {"x", axis_json(x)}, {"y", axis_json(y)}};
  std::set<std::pair<double, double>> scaled;
  for (const Curve& curve : f.curves)
    if (curve.title == scaled_times) scaled.insert(curve.points.begin(), curve.points.end());
  // markers that are ringed on paper are open here
  if (!scaled.empty()) json["x"]["label"] = f.x.label.substr(0, f.x.label.find(", ringed"));
  json["parts"] = parts_json(f, named, scaled);
  json["key"] = Json::array();
  for (const auto& [text, marker] : mark_meanings(f, range.y_floor))
    add_mark(json["key"].emplace_back(Json{{"text", text}}), marker);
  if (!f.pareto.empty()) json["key"].push_back({{"text", pareto_title}, {"line", true}});
  if (!f.pareto.empty()) json["pareto"] = pairs_json(f.pareto);
  if (f.window) json["window"] = short_number(f.window->first);
  if (!f.categories.empty()) json["categories"] = Json::array();
  std::vector<std::string> texts;
  for (const auto& [at, text] : f.categories) texts.push_back(text);
  for (const auto& [at, text] : f.categories)
    json["categories"].push_back(Json::array({short_number(at), reader_name(text, texts)}));
  json["guides"] = Json::array();
  const auto add_guide = [&](bool of_x, double at, const std::string& text) {
    json["guides"].push_back({{"axis", of_x ? "x" : "y"}, {"at", short_number(at)}, {"text", text}});
  };
  for (const Guide& guide : f.guides) add_guide(guide.of_x, guide.at, guide.text);
  if (f.window) add_guide(true, f.window->first, f.window->second);
  if (f.floor) add_guide(false, f.floor->second, f.floor->first), json["guides"].back()["kind"] = "floor";
  const OnPage& page = f.on_page;
  if (page.flat) json["flat"] = true;
  if (const auto& take = page.take)
    json["take"] =
        Json{{"x", short_number(take->x)}, {"y", short_number(take->y)}, {"name", take->name}, {"more", take->more}};
  return json;
}

Json numbers_of(const StackedBars& bars) {
  Json json{{"kind", "bars"}, {"x", axis_json({bars.label})}, {"names", names_json(bars.names)}};
  json["parts"] = Json::array();
  for (const StackedBars::Part& part : bars.parts) {
    if (std::ranges::all_of(part.height, [](double height) { return height == 0; })) continue;
    Json heights = Json::array();
    for (const double height : part.height) heights.push_back(short_number(height));
    json["parts"].push_back(
        {{"title", part.title}, {"colour", part.colour}, {"hatched", part.hatched}, {"height", heights}});
  }
  return json;
}

Json numbers_of(const DotPlot& plot) {
  Json json{{"kind", "dots"}, {"x", axis_json({plot.label, true})}, {"names", names_json(plot.names)}};
  std::vector<std::string> titles;
  for (const DotPlot::Series& series : plot.series) titles.push_back(series.title);
  json["headings"] = Json::array();
  for (const auto& [line, heading] : plot.headings) json["headings"].push_back(Json::array({line, heading}));
  json["series"] = Json::array();
  for (const DotPlot::Series& series : plot.series) {
    Json dots = Json::array();
    for (const auto& dot : series.dots)
      dots.push_back(dot ? Json::array({short_number(dot->value), short_number(dot->low), short_number(dot->high)})
                         : Json());
    Json own = name_json(series.title, titles);
    own["colour"] = colour_name(series.style.colour), own["dots"] = std::move(dots);
    add_mark(own, series.style.marker);
    json["series"].push_back(std::move(own));
  }
  if (!plot.right_of_one.empty())
    json["guides"] = Json::array({{{"axis", "x"}, {"at", 1}, {"text", plot.right_of_one}}});
  return json;
}

Json numbers_of(const HeatMap& map) {
  Json json{{"kind", "map"}, {"x", axis_json({map.x_label, true})}, {"y", axis_json({map.y_label, true})}};
  json["kinds"] = Json::array();
  for (const CellKind& kind : map.kinds) json["kinds"].push_back({{"title", kind.title}, {"colour", kind.colour}});
  std::vector<std::string> titles;
  for (const HeatMap::Panel& panel : map.panels) titles.push_back(panel.title);
  json["panels"] = Json::array();
  for (const HeatMap::Panel& panel : map.panels) {
    Json cells = Json::array();
    for (const HeatMap::HeatCell& cell : panel.cells)
      cells.push_back(
          Json::array({short_number(cell.x), short_number(cell.y), cell.kind, cell.tooltips.words, cell.tooltips.run}));
    Json own = name_json(panel.title, titles);
    own["cells"] = std::move(cells);
    own["predicted"] = pairs_json(panel.predicted), own["measured"] = pairs_json(panel.measured);
    json["panels"].push_back(std::move(own));
  }
  return json;
}

Json numbers_of(const StepLimits& limits) {
  Json json{{"kind", "limits"}, {"columns", limits.columns_of}};
  json["scenes"] = Json::array();
  for (const auto& [name, omega] : limits.scenes) json["scenes"].push_back(Json::array({name, short_number(omega)}));
  json["rows"] = Json::array();
  for (size_t i = 0; i < limits.rows.size(); ++i) {
    const StepLimits::Row& row = limits.rows[i];
    Json marks = Json::array();
    for (const StepLimits::Mark& mark : row.marks)
      marks.push_back(Json::array({mark.scene, short_number(mark.measured),
                                   mark.predicted ? short_number(*mark.predicted) : Json(), mark.words}));
    Json own = name_json(limits.names[i], limits.names);
    own.update({{"colour", colour_name(style_of(limits.names[i]).colour)},
                {"held", short_number(row.held)},
                {"open", row.open},
                {"words", row.words},
                {"marks", std::move(marks)},
                {"measured", row.measured},
                {"predicted", row.predicted}});
    json["rows"].push_back(std::move(own));
  }
  return json;
}

}  // namespace

Json chart_json(const Chart& chart) {
  return std::visit(
      []<class F>(const F& figure) -> Json {
        if constexpr (std::derived_from<F, FigureInfo>) {
          Json json{
              {"name", figure.name}, {"title", figure.title}, {"finding", figure.finding}, {"caption", figure.caption}};
          json.update(numbers_of(figure));
          return json;
        }
        return nullptr;
      },
      chart.figure);
}

namespace {

/// The cheapest explicit rule of order two.
const Stepper* usual_rule() {
  for (const Stepper& rule : steppers())
    if (rule.order == 2 && rule.evaluations == 1 && rule.symplectic) return &rule;
  return nullptr;
}

/// Two shades per engine: for its representative, and for its other main methods.
const char* colour_of(const MethodFamily& family, bool representative) {
  switch (family.role) {
    case Role::subject:
      return representative ? "mysim2" : "mysim";
    case Role::peer:
      return representative ? "bullet" : "bullet2";
    case Role::truth:
      return "truth";
    case Role::integrator:
    case Role::outside:
      return "outside";
  }
  return "grey";
}

}  // namespace

Json method_looks_json(std::span<const std::string> methods) {
  // one colour per program (style.css); methods that differ only in the program's options have different marks
  constexpr std::string_view colours[] = {"outside2", "outside3", "outside4", "outside5",
                                          "outside6", "outside7", "outside8"},
                             marks[] = {"triangle", "diamond", "square", "circle"};
  Json json = Json::object();
  std::vector<std::pair<std::string, size_t>> programs;  // name without options, index of its next mark
  for (const std::string& name : methods) {
    const MethodFamily& family = family_of(name);
    const bool program = family.role == Role::outside;
    size_t colour = 0, mark = 0;
    if (program) {
      const std::string file = name.substr(0, name.find('+', name.rfind('/') + 1));
      auto own = std::ranges::find(programs, file, &std::pair<std::string, size_t>::first);
      if (own == programs.end()) own = programs.insert(own, {file, programs.size()});
      colour = static_cast<size_t>(own - programs.begin()), mark = own->second++;
    }
    const std::string title = program ? program_title(name, methods) : reader_name(name, methods);
    const Method* method = builtin_method(name);
    const bool representative = name == family.representative;
    const bool positions = method && method->position_based && !family.is_subject();
    const bool usual = method && method->stepper && method->stepper == usual_rule();
    json[name] = {{"title", title},
                  {"engine", program ? title : std::string(family.title)},
                  {"rule", program ? "" : rule_name(name)},
                  {"colour", program ? colours[colour % std::size(colours)] : colour_of(family, representative)},
                  {"mark", program                     ? marks[mark % std::size(marks)]
                           : family.is_subject()       ? "circle"
                           : family.role != Role::peer ? "triangle"
                           : positions                 ? "diamond"
                                                       : "square"},
                  {"hero", (family.by_default() && (representative || positions || usual)) || program}};
  }
  return json;
}

}  // namespace crosscheck
