#include "report/figures/chart_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ranges>
#include <set>

namespace crosscheck {
namespace {

/// Six digits are more than a screen shows.
Json short_number(double value) { return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr); }

Json pair_json(const std::pair<double, double>& p) {
  return Json::array({short_number(p.first), short_number(p.second)});
}

Json pairs_json(const std::vector<std::pair<double, double>>& pairs) {
  Json list = Json::array();
  for (const auto& p : pairs) list.push_back(pair_json(p));
  return list;
}

/// How finely curves are drawn along an axis: a ten-thousandth of what it shows, or of each value where it is
/// logarithmic. The csv has all digits.
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
  double unit_ = 0;  // of a linear axis
};

/// Whether what stands behind the slash is a unit, and not the lower part of a ratio.
bool is_unit(std::string_view text) { return text.size() <= 6 && text.find_first_of(" ()") == std::string_view::npos; }

Json axis_json(const Axis& axis) {
  size_t unit = axis.label.rfind(" / ");
  if (unit != std::string::npos && !is_unit(std::string_view(axis.label).substr(unit + 3))) unit = std::string::npos;
  Json json{{"label", axis.label.substr(0, unit)}};
  if (unit != std::string::npos) json["unit"] = axis.label.substr(unit + 3);
  if (axis.logarithmic) json["log"] = true;
  if (axis.low) json["low"] = short_number(*axis.low);
  if (axis.high) json["high"] = short_number(*axis.high);
  return json;
}

/// Places of the points that stay of a curve.
std::vector<size_t> thinned(const std::vector<std::pair<double, double>>& points) {
  constexpr size_t most = 600, of_each = 4;
  std::vector<size_t> kept;
  if (points.size() <= most) {
    for (size_t i = 0; i < points.size(); ++i) kept.push_back(i);
    return kept;
  }
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
  Json json{{"name", curve.title}};
  const std::string named = method_in(curve.title), &method = named.empty() ? curve.method : named;
  if (!method.empty()) json["method"] = method;
  if (!curve.method.empty()) json["hero"] = true;
  if (!curve.line) json["line"] = false;
  if (!curve.markers) json["marks"] = false;
  const bool law = method.empty() && curve.style.marker < 0;  // a line of theory
  if (curve.style.marker == no_marker || law) json["beside"] = true;
  const std::vector<size_t> kept = thinned(curve.points);
  Json points = Json::array(), open = Json::array(), tips = Json::array();
  bool any_open = false;
  for (const size_t i : kept) {
    points.push_back(Json::array({x.of(curve.points[i].first), y.of(curve.points[i].second)}));
    open.push_back(scaled.contains(curve.points[i]) ? 1 : 0), any_open |= scaled.contains(curve.points[i]);
    if (i < curve.tooltips.size()) add_tooltip(tips.emplace_back(Json::object()), curve.tooltips[i]);
  }
  json["points"] = std::move(points);
  if (any_open) json["open"] = std::move(open);
  if (!curve.tooltips.empty()) json["tips"] = std::move(tips);
  return json;
}

Json numbers_of(const Figure& f) {
  Json json{{"kind", "curves"}, {"x", axis_json(f.x)}, {"y", axis_json(f.y)}};
  if (f.cut && (!f.y.low || *f.y.low < *f.cut)) json["y"]["low"] = short_number(*f.cut);
  std::set<std::pair<double, double>> scaled;
  for (const Curve& curve : f.curves)
    if (curve.title == scaled_times) scaled.insert(curve.points.begin(), curve.points.end());
  // what is ringed on paper is open here
  if (!scaled.empty()) json["x"]["label"] = f.x.label.substr(0, f.x.label.find(", ringed"));
  json["series"] = Json::array();
  const Fineness x(f.x, f.curves, &std::pair<double, double>::first),
      y(f.y, f.curves, &std::pair<double, double>::second);
  for (const Curve& curve : f.curves)
    if (curve.title != scaled_times && !curve.points.empty())
      json["series"].push_back(series_json(curve, scaled, x, y));
  if (!f.failures.empty()) json["failures"] = Json::array();
  for (const FailureMark& mark : f.failures) {
    Json failure{{"x", short_number(mark.x)}, {"kind", mark.kind}, {"method", method_in(mark.title)}};
    add_tooltip(failure, mark.tooltips);
    json["failures"].push_back(std::move(failure));
  }
  if (!f.pareto.empty()) json["pareto"] = pairs_json(f.pareto);
  if (f.floor) json["floor"] = Json{{"text", f.floor->first}, {"y", short_number(f.floor->second)}};
  if (f.window) json["window"] = Json{{"x", short_number(f.window->first)}, {"text", f.window->second}};
  if (!f.categories.empty()) json["categories"] = Json::array();
  for (const auto& [at, text] : f.categories) json["categories"].push_back(Json::array({short_number(at), text}));
  for (const Guide& guide : f.guides) {
    if (json["guides"].is_null()) json["guides"] = Json::array();
    json["guides"].push_back({{"axis", guide.of_x ? "x" : "y"}, {"at", short_number(guide.at)}, {"text", guide.text}});
  }
  const OnPage& page = f.on_page;
  if (page.motion) json["motion"] = short_number(*page.motion);
  if (page.duration) json["duration"] = short_number(*page.duration);
  if (page.flat) json["flat"] = true;
  if (const auto& take = page.take)
    json["take"] =
        Json{{"x", short_number(take->x)}, {"y", short_number(take->y)}, {"name", take->name}, {"more", take->more}};
  if (const auto& critical = page.critical)
    json["critical"] = Json{{"x", short_number(critical->x)}, {"name", critical->name}, {"beyond", critical->beyond}};
  return json;
}

Json numbers_of(const StackedBars& bars) {
  Json json{{"kind", "bars"}, {"x", axis_json({bars.label})}, {"names", bars.names}};
  json["parts"] = Json::array();
  for (const StackedBars::Part& part : bars.parts) {
    Json heights = Json::array();
    for (const double height : part.height) heights.push_back(short_number(height));
    json["parts"].push_back(
        {{"title", part.title}, {"colour", part.colour}, {"hatched", part.hatched}, {"height", heights}});
  }
  return json;
}

Json numbers_of(const DotPlot& plot) {
  Json json{{"kind", "dots"}, {"x", axis_json({plot.label, true})}, {"names", plot.names}};
  json["headings"] = Json::array();
  for (const auto& [line, heading] : plot.headings) json["headings"].push_back(Json::array({line, heading}));
  json["series"] = Json::array();
  for (const DotPlot::Series& series : plot.series) {
    Json dots = Json::array();
    for (const auto& dot : series.dots)
      dots.push_back(dot ? Json::array({short_number(dot->value), short_number(dot->low), short_number(dot->high)})
                         : Json());
    Json own{{"name", series.title}, {"dots", std::move(dots)}};
    if (const std::string method = method_in(series.title); !method.empty()) own["method"] = method;
    json["series"].push_back(std::move(own));
  }
  return json;
}

Json numbers_of(const HeatMap& map) {
  Json json{{"kind", "map"}, {"x", axis_json({map.x_label, true})}, {"y", axis_json({map.y_label, true})}};
  json["kinds"] = Json::array();
  for (const CellKind& kind : map.kinds) json["kinds"].push_back({{"title", kind.title}, {"colour", kind.colour}});
  json["panels"] = Json::array();
  for (const HeatMap::Panel& panel : map.panels) {
    Json cells = Json::array();
    for (const HeatMap::HeatCell& cell : panel.cells)
      cells.push_back(
          Json::array({short_number(cell.x), short_number(cell.y), cell.kind, cell.tooltips.words, cell.tooltips.run}));
    json["panels"].push_back({{"title", panel.title},
                              {"cells", std::move(cells)},
                              {"predicted", pairs_json(panel.predicted)},
                              {"measured", pairs_json(panel.measured)}});
  }
  return json;
}

Json numbers_of(const StepLimits& limits) {
  Json json{{"kind", "limits"}, {"names", limits.names}, {"columns", limits.columns_of}};
  json["scenes"] = Json::array();
  for (const auto& [name, omega] : limits.scenes) json["scenes"].push_back(Json::array({name, short_number(omega)}));
  json["rows"] = Json::array();
  for (const StepLimits::Row& row : limits.rows) {
    Json marks = Json::array();
    for (const StepLimits::Mark& mark : row.marks)
      marks.push_back(Json::array({mark.scene, short_number(mark.measured),
                                   mark.predicted ? short_number(*mark.predicted) : Json(), mark.words}));
    json["rows"].push_back({{"held", short_number(row.held)},
                            {"open", row.open},
                            {"words", row.words},
                            {"marks", std::move(marks)},
                            {"measured", row.measured},
                            {"predicted", row.predicted}});
  }
  return json;
}

}  // namespace

Json chart_json(const Chart& chart) {
  return std::visit(
      []<class F>(const F& figure) -> Json {
        if constexpr (std::derived_from<F, FigureInfo>) {
          Json json{{"name", figure.name}, {"title", figure.title}, {"finding", figure.finding}};
          json.update(numbers_of(figure));
          return json;
        }
        return nullptr;
      },
      chart.figure);
}

namespace {

/// The cheapest explicit rule of order two, which is the one to beat.
const Stepper* usual_rule() {
  for (const Stepper& rule : steppers())
    if (rule.order == 2 && rule.evaluations == 1 && rule.symplectic) return &rule;
  return nullptr;
}

std::string rule_of(const std::string& name) {
  std::string rule = name.substr(name.find('/') + 1);
  std::ranges::replace(rule, '-', ' ');
  if (const size_t at = rule.find("euler"); at != std::string::npos) rule[at] = 'E';
  if (const size_t at = rule.find('+'); at != std::string::npos) rule.replace(at, 1, ", ");
  return rule;
}

std::string title_of(const std::string& name, std::span<const std::string> beside) {
  const MethodFamily& family = family_of(name);
  if (family.role == Role::outside) return program_title(name, beside);
  return family.is_subject() ? rule_of(name) : fmt::format("{} {}", family.title, rule_of(name));
}

/// Two shades for each engine: its representative, and what else of it is in question.
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
  // a colour and a mark for each program (style.css)
  constexpr std::string_view colours[] = {"outside2", "outside3", "outside4", "outside5", "outside6"},
                             marks[] = {"triangle", "diamond", "square", "circle"};
  Json json = Json::object();
  size_t programs = 0;
  for (const std::string& name : methods) {
    const MethodFamily& family = family_of(name);
    const bool program = family.role == Role::outside;
    const std::string title = title_of(name, methods);
    const Method* method = builtin_method(name);
    const bool representative = name == family.representative;
    const bool positions = method && method->position_based && !family.is_subject();
    const bool usual = method && method->stepper && method->stepper == usual_rule();
    json[name] = {{"title", title},
                  {"engine", program ? title : std::string(family.title)},
                  {"rule", program ? "" : rule_of(name)},
                  {"colour", program ? colours[programs % std::size(colours)] : colour_of(family, representative)},
                  {"mark", program                     ? marks[programs % std::size(marks)]
                           : family.is_subject()       ? "circle"
                           : family.role != Role::peer ? "triangle"
                           : positions                 ? "diamond"
                                                       : "square"},
                  {"hero", (family.by_default() && (representative || positions || usual)) || program}};
    programs += program;
  }
  return json;
}

}  // namespace crosscheck
