// Error against step, whose slope is the order of the method; and the distance from the same method's own finest run:
// where the two part, the method converges to something else.
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "report/charts/charts.h"

namespace crosscheck {
namespace {

/// "rk4: order 4, measured 3.99"; methods of others promise none.
std::string title_of(const Table& slopes, const std::string& scene, const std::string& method) {
  const std::string shown = method.starts_with("mysim/") ? method.substr(method.find('/') + 1) : method;
  for (size_t i = 0; i < slopes.rows.size(); ++i)
    if (std::get<std::string>(slopes.at(i, "scene")) == scene &&
        std::get<std::string>(slopes.at(i, "method")) == method)
      return fmt::format("{}: order {}, measured {:.2f}", shown, std::get<long>(slopes.at(i, "declared order")),
                         std::get<double>(slopes.at(i, "measured order")));
  return method == shown ? shown : shown + ": no order seen";
}

using Points2 = std::vector<std::pair<double, double>>;

/// Step and value of one method's rows, in the order of the table: from long steps to short ones.
Points2 column_of(const Table& points, const std::string& scene, const std::string& method, const char* column) {
  Points2 out;
  for (size_t row = 0; row < points.rows.size(); ++row)
    if (std::get<std::string>(points.at(row, "scene")) == scene &&
        std::get<std::string>(points.at(row, "method")) == method)
      if (const auto* value = std::get_if<double>(&points.at(row, column)); value && *value > 0)
        out.emplace_back(std::get<double>(points.at(row, "step")), *value);
  return out;
}

/// The error at the smallest step over the last distance to it: about 1 for a method that converges to the truth at
/// order 1, less at higher orders; large where it converges to something else.
double astray(const Points2& errors, const Points2& own) {
  return errors.empty() || own.empty() ? 0 : errors.back().second / own.back().second;
}

}  // namespace

std::vector<Chart> order_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* points = input.result.table("order");
  const Table* slopes = input.result.table("order-slopes");
  for (size_t i = 0; i < input.scenes.size() && points && slopes; ++i) {
    const Scene& scene = input.scenes[i];
    Figure f;
    f.title = scene.name + ": error against step";
    f.x = {"step / s", true, std::nullopt, std::nullopt};
    f.y = {"largest RMS error / m", true, std::nullopt, std::nullopt};
    f.name = scene.name + "-order";
    std::vector<std::string> elsewhere;
    const double bar = input.facts[i].bar;
    for (const MethodFacts& m : input.facts[i].methods) {
      Curve curve{title_of(*slopes, scene.name, m.method), style_of(m.method), {}, true, true};
      Points2 errors = column_of(*points, scene.name, m.method, "error");
      Points2 own = column_of(*points, scene.name, m.method, "distance to own finest");
      // 4: a rule of first order whose last two errors are e and 2 e is at 1; a slower start may make it 2
      const bool else_where = astray(errors, own) > 4 && errors.back().second > 10 * bar;
      // below its error bar the truth tells nothing
      std::erase_if(errors, [&](const auto& p) { return p.second <= bar; });
      curve.points = std::move(errors);
      for (size_t row = 0; row < points->rows.size(); ++row)
        if (std::get<std::string>(points->at(row, "scene")) == scene.name &&
            std::get<std::string>(points->at(row, "method")) == m.method &&
            std::get<std::string>(points->at(row, "verdict")) != "ok")
          f.failures.push_back({m.method.substr(m.method.find('/') + 1) + ": " + m.failure(), style_of(m.method),
                                std::get<double>(points->at(row, "step")), 10 * scene.size()});
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
      // where a method converges to the truth both curves are nearly one: only the others' are drawn
      if (else_where) {
        elsewhere.push_back(m.method);
        MethodStyle open = style_of(m.method);
        open.dash = "(1,3)";
        open.marker = 6;
        f.curves.push_back({m.method + ": from its own finest run", open, std::move(own), true, true});
      }
    }
    if (f.curves.empty()) continue;
    f.floor = {"error bar of the truth", input.facts[i].bar};
    f.caption = caption_of(scene, input.facts[i], input.commit, true);
    f.finding = "The error falls with the step by the power that the method's order promises.";
    if (!elsewhere.empty())
      f.finding += fmt::format(
          " Not so {}: with shorter steps it nears its own finest run and not the truth, it converges to something "
          "else.",
          fmt::join(elsewhere, ", "));
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
