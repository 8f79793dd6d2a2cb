// Error against step: the slope is the order of the method.
#include <fmt/format.h>

#include "report/charts/charts.h"

namespace crosscheck {
namespace {

/// "rk4: order 4, measured 3.99" (all methods of this chart are mysim's)
std::string title_of(const Table& slopes, const std::string& scene, const std::string& method) {
  for (size_t i = 0; i < slopes.rows.size(); ++i)
    if (std::get<std::string>(slopes.at(i, "scene")) == scene &&
        std::get<std::string>(slopes.at(i, "method")) == method)
      return fmt::format("{}: order {}, measured {:.2f}", method.substr(method.find('/') + 1),
                         std::get<long>(slopes.at(i, "declared order")),
                         std::get<double>(slopes.at(i, "measured order")));
  return method.substr(method.find('/') + 1) + ": no order seen";
}

}  // namespace

std::vector<Chart> order_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* points = input.result.table("order");
  const Table* slopes = input.result.table("order-slopes");
  for (size_t i = 0; i < input.scenes.size() && points && slopes; ++i) {
    const Scene& scene = input.scenes[i];
    Figure f;
    f.name = scene.name + "-order";
    f.title = scene.name + ": error against step";
    f.x = {"step / s", true, std::nullopt, std::nullopt};
    f.y = {"largest RMS error / m", true, std::nullopt, std::nullopt};
    for (const MethodFacts& m : input.facts[i].methods) {
      Curve curve{title_of(*slopes, scene.name, m.method), style_of(m.method), {}, true, true};
      for (size_t row = 0; row < points->rows.size(); ++row) {
        if (std::get<std::string>(points->at(row, "scene")) != scene.name ||
            std::get<std::string>(points->at(row, "method")) != m.method)
          continue;
        const double step = std::get<double>(points->at(row, "step"));
        // below its error bar the truth tells nothing
        if (const auto* error = std::get_if<double>(&points->at(row, "error"))) {
          if (*error > input.facts[i].bar) curve.points.emplace_back(step, *error);
        } else
          f.failures.push_back({m.method.substr(m.method.find('/') + 1) + ": " + m.failure(), style_of(m.method), step,
                                10 * scene.size()});
      }
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
    }
    if (f.curves.empty()) continue;
    f.floor = {"error bar of the truth", input.facts[i].bar};
    f.caption = caption_of(scene, input.facts[i], input.commit, true);
    f.finding = "The error falls with the step by the power that the method's order promises.";
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
