// Error against step, with the method's order as its slope; and the difference from the same method's own finest run:
// where the two differ, the method converges to something else.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "experiments/tables/table.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// "rk4: order 4, measured 3.99", or "my-engine: order measured 1.02" where the rule is unknown.
std::string title_of(const Table& slopes, const std::string& scene, const std::string& method) {
  const std::string shown = short_name(method);
  for (size_t i = 0; i < slopes.rows.size(); ++i)
    if (text_at(slopes, i, "scene") == scene && text_at(slopes, i, "method") == method) {
      const auto declared = number_at(slopes, i, "declared order");
      return fmt::format("{}: order {}measured {:.2f}", shown, declared ? fmt::format("{:g}, ", *declared) : "",
                         *number_at(slopes, i, "measured order"));
    }
  return method == shown ? shown : shown + ": no order seen";
}

using Points2 = std::vector<std::pair<double, double>>;

/// Step and value of one method's rows, in the order of the table: from long steps to short ones.
Points2 column_of(const Table& points, const std::string& scene, const std::string& method, const char* column) {
  Points2 out;
  for (size_t row = 0; row < points.rows.size(); ++row)
    if (text_at(points, row, "scene") == scene && text_at(points, row, "method") == method)
      if (const auto value = number_at(points, row, column); value && *value > 0)
        out.emplace_back(*number_at(points, row, "step"), *value);
  return out;
}

/// The methods that have rows of this scene, in the order of the table.
std::vector<std::string> methods_in(const Table& points, const std::string& scene) {
  std::vector<std::string> names;
  for (size_t i = 0; i < points.rows.size(); ++i)
    if (const std::string& name = text_at(points, i, "method");
        text_at(points, i, "scene") == scene && std::ranges::find(names, name) == names.end())
      names.push_back(name);
  return names;
}

/// The error at the smallest step over the difference of the last two steps: about 1 for a method that converges to the
/// truth at order 1, less at higher orders; large where it converges to something else.
double error_over_difference(const Points2& errors, const Points2& own) {
  return errors.empty() || own.empty() ? 0 : errors.back().second / own.back().second;
}

/// Compares the measured orders on a scene with the declared ones.
std::string slopes_sentence(const Table& slopes, const std::string& scene) {
  constexpr double close = 0.1;  // contribution of the next order at the finest three steps of a smooth scene
  std::vector<std::string> other;
  int seen = 0;
  double off = 0;
  for (size_t i = 0; i < slopes.rows.size(); ++i) {
    if (text_at(slopes, i, "scene") != scene || !number_at(slopes, i, "declared order")) continue;
    const double declared = *number_at(slopes, i, "declared order"), measured = *number_at(slopes, i, "measured order");
    ++seen;
    if (std::abs(measured - declared) > close)
      other.push_back(fmt::format("{} ({:.2f} instead of {:g})", text_at(slopes, i, "method"), measured, declared));
    else
      off = std::max(off, std::abs(measured - declared));
  }
  if (seen == 0) return "No order is read off here: no error of a method that promises one falls as a steady power.";
  std::string text;
  if (seen > static_cast<int>(other.size()))
    text = fmt::format("The measured order of {} method{} is the declared one, within {:.2g}.", seen - other.size(),
                       seen - other.size() == 1 ? "" : "s", off);
  if (!other.empty())
    text += fmt::format("{}By another power falls that of {}.", text.empty() ? "" : " ", joined(other));
  return text;
}

}  // namespace

std::vector<Chart> order_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* points = input.result.table("order");
  const Table* slopes = input.result.table("order-slopes");
  for (size_t i = 0; i < input.scenes.size() && points && slopes; ++i) {
    const Scene& scene = input.scenes[i];
    Figure f;
    f.title = scene.name + ": error against time step";
    f.x = {"time step / s", true, std::nullopt, std::nullopt};
    f.y = {"largest RMS position error / m", true, std::nullopt, std::nullopt};
    f.name = scene.name + "-order";
    std::vector<std::string> elsewhere;
    size_t first = 0;  // row of this scene
    while (first < points->rows.size() && text_at(*points, first, "scene") != scene.name) ++first;
    if (first == points->rows.size()) continue;
    const double error_bar = *number_at(*points, first, "truth bar");
    for (const std::string& method : methods_in(*points, scene.name)) {
      Curve curve{title_of(*slopes, scene.name, method), style_of(method), {}, true, true};
      Points2 errors = column_of(*points, scene.name, method, "error");
      Points2 own = column_of(*points, scene.name, method, "distance to own finest");
      // 4: a rule of first order with last two errors e and 2 e is at 1; a slower start may make it 2
      const bool converges_elsewhere = error_over_difference(errors, own) > 4 && errors.back().second > 10 * error_bar;
      // errors below the truth's error bar are not known
      std::erase_if(errors, [&](const auto& p) { return p.second <= error_bar; });
      curve.points = std::move(errors);
      // a mark is named after its curve, if there is one
      const std::string& marked = curve.points.empty() ? method : curve.title;
      for (size_t row = 0; row < points->rows.size(); ++row)
        if (text_at(*points, row, "scene") == scene.name && text_at(*points, row, "method") == method)
          if (const std::string& verdict = text_at(*points, row, "verdict"); verdict != "ok")
            f.failures.push_back({marked + ": " + failure_class(verdict), style_of(method),
                                  *number_at(*points, row, "step"), 10 * scene.size(), failure_class(verdict)});
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
      // where a method converges to the truth both curves are nearly one: only the others' are drawn
      if (converges_elsewhere) {
        elsewhere.push_back(method);
        MethodStyle open = style_of(method);
        open.dash = "(1,3)";
        open.marker = 6;
        f.curves.push_back({method + ": difference from its own finest run", open, std::move(own), true, true});
      }
    }
    if (f.curves.empty() && f.failures.empty()) continue;
    f.floor = {"error bar of the truth", error_bar};
    f.caption = caption_of(scene, input.commit);
    SceneData truth;  // from this table alone: other experiments may not have run
    truth.tier = text_at(*points, first, "truth tier"), truth.truth = text_at(*points, first, "truth"),
    truth.error_bar = error_bar;
    f.tier = tier_of(truth);
    f.finding = slopes_sentence(*slopes, scene.name);
    if (!elsewhere.empty())
      f.finding +=
          fmt::format(" With shorter steps {} {} own finest run and not the truth: what {} to is something else.",
                      joined(elsewhere), elsewhere.size() == 1 ? "nears its" : "near their",
                      elsewhere.size() == 1 ? "it converges" : "they converge");
    charts.push_back({scene.name, std::move(f)});
  }
  return charts;
}

}  // namespace crosscheck
