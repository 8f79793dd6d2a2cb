// Known disagreements: one figure each, with the scene's curve and Bullet's.

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "experiments/disagreements/disagreements.h"
#include "experiments/tables/table.h"
#include "report/figures/charts.h"

namespace crosscheck {
namespace {

/// The method's own style; a method that comes again, with other options, takes a spare colour.
class Styles {
 public:
  MethodStyle of(const std::string& method) {
    const std::string base = method.substr(0, method.find('+'));
    const int before = seen_[base]++;
    MethodStyle style = style_of(base);
    static constexpr const char* spare[] = {"#E69F00", "#CC79A7", "#332288", "#999933"};
    static constexpr const char* dashes[] = {"(6,3)", "(2,2)", "(10,3,2,3)", "(16,3,2,3)"};
    if (before > 0) style = {spare[(before - 1) % 4], dashes[(before - 1) % 4], style.marker + before};
    return style;
  }

 private:
  std::map<std::string, int> seen_;
};

std::string state_in_words(const std::string& state, const std::string& threads) {
  return fmt::format("Upstream: {}; here {}.", threads.empty() ? "no report known" : threads, state);
}

}  // namespace

std::vector<Chart> disagreement_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  const Table* summary = input.result.table("disagreements");
  const auto known = disagreements();
  for (size_t row = 0; summary && row < summary->rows.size(); ++row) {
    const std::string& name = text_at(*summary, row, "name");
    const Table& table = *input.result.table(name + "-disagreement");
    const Column& quantity = table.columns.back();
    Figure f;
    f.name = name + "-disagreement";
    f.title = text_at(*summary, row, "what");
    f.finding = text_at(*summary, row, "effect");
    f.caption = fmt::format("Scene {}; commit {}.", name, input.commit);
    f.tier = "mysim or the closed form in the same scene";
    f.x = {"t / s", false, 0.0, std::nullopt};
    f.y = {quantity.unit.find('/') == std::string::npos ? fmt::format("{} / {}", quantity.name, quantity.unit)
                                                        : fmt::format("{} / ({})", quantity.name, quantity.unit),
           false, std::nullopt, std::nullopt};
    const auto found = std::find_if(known.begin(), known.end(), [&](const Disagreement& d) { return d.name == name; });
    f.y.logarithmic = found != known.end() && !found->value;
    Styles styles;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      const std::string& curve = text_at(table, i, "curve");
      if (f.curves.empty() || f.curves.back().title != curve)
        f.curves.push_back({curve, styles.of(text_at(table, i, "method")), {}});
      const double t = *number_at(table, i, "t"), y = *number_at(table, i, quantity.name);
      if (y > 0 || !f.y.logarithmic) f.curves.back().points.emplace_back(t, y);
      const std::string& verdict = text_at(table, i, "verdict");
      const bool last = i + 1 == table.rows.size() || text_at(table, i + 1, "curve") != curve;
      if (last && verdict != "ok" && !f.curves.back().points.empty())
        f.failures.push_back({fmt::format("{}: {}", curve, failure_class(verdict)), f.curves.back().style,
                              f.curves.back().points.back().first, f.curves.back().points.back().second});
    }
    // the curve that the others are compared with, and a run that delivered nothing, which is a cross
    std::erase_if(f.curves, [](const Curve& c) { return c.points.size() < 2; });
    charts.push_back({"", std::move(f), "disagreements",
                      fmt::format("{}: {} {}", text_at(*summary, row, "world"), text_at(*summary, row, "cause"),
                                  state_in_words(text_at(*summary, row, "state"), text_at(*summary, row, "threads")))});
  }
  return charts;
}

}  // namespace crosscheck
