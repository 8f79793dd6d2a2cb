// Error against step, with the method's order as its slope. If the difference from the method's own finest run falls
// faster than the error, the method converges to another solution.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/order.h"
#include "reference/engines/engines.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// "rk4: order 4, measured 3.99"; for an unknown rule "my-engine: order measured 1.02".
std::string title_of(const std::vector<OrderSlopeRow>& slopes, const std::string& method) {
  const std::string shown = short_name(method);
  const auto slope = std::ranges::find(slopes, method, &OrderSlopeRow::method);
  if (slope == slopes.end()) return method == shown ? shown : shown + ": no order seen";
  return fmt::format("{}: order {}measured {:.2f}", shown,
                     slope->declared_order ? fmt::format("{}, ", *slope->declared_order) : "", slope->measured_order);
}

using Points2 = std::vector<std::pair<double, double>>;

/// (step, value) of one method's rows, from long steps to short ones.
Points2 column_of(const std::vector<OrderRow>& rows, const std::string& method, OptionalNumber OrderRow::*value) {
  Points2 out;
  for (const OrderRow& row : rows | with(&OrderRow::method, method))
    if (row.*value && *(row.*value) > 0) out.emplace_back(row.step, *(row.*value));
  return out;
}

/// Error at the smallest step / difference of the last two steps: about 1 for a first-order method, less for higher
/// orders, and large if the method converges to a solution other than the truth.
double error_over_difference(const Points2& errors, const Points2& own) {
  return errors.empty() || own.empty() ? 0 : errors.back().second / own.back().second;
}

std::string slopes_sentence(const std::vector<OrderSlopeRow>& slopes) {
  constexpr double close = 0.1;  // allows for the next order's effect on the slope of the finest three steps
  std::vector<std::string> other;
  size_t seen = 0;
  double off = 0;
  for (const OrderSlopeRow& row : slopes) {
    if (!row.declared_order) continue;
    const double apart = std::abs(row.measured_order - static_cast<double>(*row.declared_order));
    ++seen;
    if (apart > close)
      other.push_back(fmt::format("{} ({:.2f} instead of {})", without_folders(row.method), row.measured_order,
                                  *row.declared_order));
    else
      off = std::max(off, apart);
  }
  if (seen == 0)
    return "No order can be measured here: no error of a method with a declared order falls as a steady power.";
  std::string text;
  if (const size_t agreeing = seen - other.size(); agreeing > 0)
    text = fmt::format("The measured order of {} agrees with the declared one within {:.2g}.",
                       counted(agreeing, "method"), off);
  if (!other.empty()) text += fmt::format("{}Different order: {}.", text.empty() ? "" : " ", joined(other));
  return text;
}

}  // namespace

std::vector<Chart> order_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const auto all = rows_of<OrderRow>(input.result);
  const auto all_slopes = rows_of<OrderSlopeRow>(input.result);
  for (const Scene& scene : input.scenes) {
    std::vector<OrderRow> rows;
    std::vector<OrderSlopeRow> slopes;
    std::ranges::copy(all | with(&OrderRow::scene, scene.name), std::back_inserter(rows));
    std::ranges::copy(all_slopes | with(&OrderSlopeRow::scene, scene.name), std::back_inserter(slopes));
    if (rows.empty()) continue;
    Figure f;
    std::vector<std::string> elsewhere;
    const double error_bar = rows[0].truth_bar;
    for (const std::string& method : distinct(rows, &OrderRow::method)) {
      Curve curve{title_of(slopes, method), style_of(method), {}, true, true};
      Points2 errors = column_of(rows, method, &OrderRow::error),
              own = column_of(rows, method, &OrderRow::distance_to_finest);
      // 4, because the ratio is 1 for a first-order rule (whose last two errors are 2 e and e), and at most 2 if
      // convergence starts slowly
      const bool converges_elsewhere = error_over_difference(errors, own) > 4 && errors.back().second > 10 * error_bar;
      // errors below the truth's error bar are unknown
      std::erase_if(errors, [&](const auto& p) { return p.second <= error_bar; });
      curve.points = std::move(errors);
      // give marks the name of their curve, if there is one
      const std::string& marked = curve.points.empty() ? method : curve.title;
      for (const OrderRow& row : rows | with(&OrderRow::method, method))
        if (const std::string word = failure_class(row.verdict); row.verdict != Verdict::ok)
          f.failures.push_back({marked + ": " + word, style_of(method), row.step, 10 * scene.size(), word});
      if (!curve.points.empty()) f.curves.push_back(std::move(curve));
      // draw the difference only in this case; otherwise the two curves nearly coincide
      if (converges_elsewhere) {
        elsewhere.push_back(method);
        const MethodStyle open{style_of(method).colour, "(1,3)", 6};
        f.curves.push_back({method + ": difference from its own finest run", open, std::move(own), true, true});
      }
    }
    if (f.curves.empty() && f.failures.empty()) continue;
    f.floor = {"error bar of the reference", error_bar};
    f.caption = caption_of(scene, input.commit);
    SceneData truth;  // built from this table, because other experiments may not have run
    truth.tier = name_of(rows[0].truth_tier), truth.truth = rows[0].truth, truth.error_bar = error_bar;
    f.tier = tier_of(truth);
    f.finding = slopes_sentence(slopes);
    if (!elsewhere.empty())
      f.finding += fmt::format(" With shorter steps {} {} own finest run, not the reference: {} to another solution.",
                               joined(elsewhere), elsewhere.size() == 1 ? "approaches its" : "approach their",
                               elsewhere.size() == 1 ? "it converges" : "they converge");
    charts.push_back(described("{scene}-order", std::move(f), "scene"_a = scene.name));
    charts.back().scene = scene.name;
  }
  return charts;
}

}  // namespace crosscheck
