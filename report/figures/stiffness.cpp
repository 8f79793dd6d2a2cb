// Stiffness of position-based links, by formula and as measured, for one link and for a chain; effective stiffness of
// hanging nets by step and iterations.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "experiments/tables/stiffness.h"
#include "reference/bullet/parameters.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

const MethodStyle by_iterations[] = {
    {"#7A3B00", "1", 7}, {"#0072B2", "(6,3)", 5}, {"#009E73", "(2,2)", 9}, {"#CC79A7", "(10,3,2,3)", 13}};

std::string iterations_text(long n) { return counted(static_cast<size_t>(n), "iteration"); }

template <class Row, class T>
std::set<T> values_of(const std::vector<Row>& rows, T Row::*member) {
  const std::vector<T> all = distinct(rows, member);
  return {all.begin(), all.end()};
}

Chart single_links(const std::vector<LinkStiffnessRow>& rows, const std::string& commit) {
  Figure f;
  size_t style = 0;
  double worst = 0;
  for (const long n : values_of(rows, &LinkStiffnessRow::iterations)) {
    MethodStyle plain = by_iterations[style];
    plain.marker = -1;  // no marker, because markers are for measurements
    Curve formula{iterations_text(n) + ", formula", plain, {}},
        measured{iterations_text(n) + ", measured", by_iterations[style], {}, false, true};
    double low = 1, high = 0;
    for (const LinkStiffnessRow& row : rows | with(&LinkStiffnessRow::iterations, n)) {
      measured.points.emplace_back(row.kLST, row.measured * row.step * row.step);  // μ = 1 kg
      worst = std::max(worst, std::abs(row.deviation));
      low = std::min(low, row.kLST), high = std::max(high, row.kLST);
    }
    for (int i = 0; i <= 40; ++i) {
      const double kLST = low * std::pow(high / low, i / 40.);
      formula.points.emplace_back(kLST, bullet::newton_per_metre(kLST, 1, 1, static_cast<int>(n)));
    }
    f.curves.push_back(std::move(formula));
    f.curves.push_back(std::move(measured));
    style = std::min(style + 1, std::size(by_iterations) - 1);
  }
  std::vector<std::string> steps;
  for (const double h : values_of(rows, &LinkStiffnessRow::step))
    steps.push_back(fmt::format("1/{:g}", std::round(1 / h)));
  return described("stiffness", std::move(f), "steps"_a = joined(steps), "worst"_a = 100 * worst, "commit"_a = commit);
}

Chart networks(const std::vector<NetworkStiffnessRow>& rows, const std::string& commit) {
  Figure f;
  size_t style = 0;
  double holds = 0;
  std::vector<std::string> most;
  for (const long n : values_of(rows, &NetworkStiffnessRow::iterations)) {
    Curve curve{iterations_text(n), by_iterations[style++], {}, true, true};
    std::set<double> good, bad;  // k h² / μ
    double worst = 0;
    for (const NetworkStiffnessRow& row : rows | with(&NetworkStiffnessRow::iterations, n)) {
      if (row.deviation > 0) curve.points.emplace_back(row.stiffness, 100 * row.deviation);
      worst = std::max(worst, row.deviation);
      if (n == 1) (std::abs(row.deviation) < 0.01 ? good : bad).insert(row.stiffness);
    }
    for (const double x : good)
      if (bad.empty() || x < *bad.begin()) holds = x;
    if (worst > 0) most.push_back(fmt::format("{:.0f} % with {}", 100 * worst, iterations_text(n)));
    f.curves.push_back(std::move(curve));
  }
  f.finding = holds > 0
                  ? fmt::format("In a chain solved once per step the map holds to 1 % up to k h² / μ = {:.2g}.", holds)
                  : "In a chain the map holds to 1 % at none of these steps.";
  if (!most.empty()) f.finding += fmt::format(" The chain's excess sag is up to {}.", joined(most));
  return described("stiffness-network", std::move(f), "commit"_a = commit);
}

struct EffectiveMeasure {
  const char *name, *net;
  OptionalNumber EffectiveStiffnessRow::*value;
};
// the period is measured on a chain only: the cloths of the experiment are small, and oscillate so fast that implicit
// rules damp them before the second turning point
constexpr EffectiveMeasure effective_measures[] = {
    {"stiffness-effective", "cloth", &EffectiveStiffnessRow::by_sag},
    {"stiffness-effective-period", "chain", &EffectiveStiffnessRow::by_period}};

/// The number comes first because a title that begins with a method would be shortened to the method's name.
std::string curve_title(const EffectiveStiffnessRow& row) {
  return fmt::format("{} of {}", passes_text(row.method, row.iterations), row.method.substr(row.method.find('/') + 1));
}

/// Chart of effective stiffness; nullopt if the net was not measured. Methods without iterations are only in the table.
std::optional<Chart> effective_stiffness(const std::vector<EffectiveStiffnessRow>& rows,
                                         const EffectiveMeasure& measure, const std::string& commit) {
  Figure f;
  static constexpr const char *dashes[] = {"1", "(8,4)", "(2,2)", "(10,3,2,3)"},
                              *greys[] = {"#111111", "#555555", "#8A8A8A", "#333333"},
                              *browns[] = {"#7A3B00", "#D66A08", "#E8A33D", "#9A4200"};
  std::map<std::string, size_t> by_method;
  const EffectiveStiffnessRow* softest = nullptr;
  for (const EffectiveStiffnessRow& row : rows) {
    const Method* method = builtin_method(row.method);
    if (!row.net.starts_with(measure.net) || !(row.*measure.value) || !method || !method->position_based) continue;
    const std::string title = curve_title(row);
    auto curve = std::ranges::find(f.curves, title, &Curve::title);
    if (curve == f.curves.end()) {
      // use shades of the engine's colour, because curves of the same colour share a name
      const bool ours = method->family().is_subject();
      const size_t place = std::min<size_t>(by_method[row.method]++, 3);
      const MethodStyle style{(ours ? greys : browns)[place], dashes[place],
                              style_of(row.method).marker + static_cast<int>(place)};
      curve = f.curves.insert(f.curves.end(), {title, style, {}, true, true, {}, row.method});
    }
    curve->points.emplace_back(1e3 * row.step, 100 * *(row.*measure.value));
    if (!softest || *(row.*measure.value) < *(softest->*measure.value)) softest = &row;
  }
  for (Curve& curve : f.curves) std::ranges::sort(curve.points);
  if (!softest) return std::nullopt;
  return described(measure.name, std::move(f), "step"_a = step_text(softest->step), "softest"_a = curve_title(*softest),
                   "times"_a = times_text(1 / *(softest->*measure.value)), "net"_a = softest->net,
                   "stiffness"_a = softest->stiffness, "commit"_a = commit);
}

/// Young's modulus against the angle of the pull: by formula (lines), and from energies of strained nets (marks).
Chart pulled_sheets(const std::vector<PulledSheetRow>& rows, const std::string& commit) {
  Figure f;
  f.y.low = 0;
  size_t style = 0;
  double worst = 0;
  for (const PulledSheetRow& row : rows) {
    if (f.curves.empty() || f.curves.back().title != row.net + ", measured") {
      MethodStyle plain = by_iterations[style];
      plain.marker = -1;
      f.curves.push_back({row.net, plain, {}});
      f.curves.push_back({row.net + ", measured", by_iterations[style], {}, false, true});
      style = std::min(style + 1, std::size(by_iterations) - 1);
    }
    f.curves[f.curves.size() - 2].points.emplace_back(row.angle, row.predicted);
    f.curves.back().points.emplace_back(row.angle, row.measured);
    worst = std::max(worst, std::abs(row.deviation));
  }
  return described("stiffness-sheets", std::move(f), "worst"_a = nice(100 * worst), "commit"_a = commit);
}

}  // namespace

std::vector<Chart> stiffness_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  if (const auto rows = rows_of<LinkStiffnessRow>(input.result); !rows.empty())
    charts.push_back(single_links(rows, input.commit));
  if (const auto rows = rows_of<NetworkStiffnessRow>(input.result); !rows.empty())
    charts.push_back(networks(rows, input.commit));
  for (const EffectiveMeasure& measure : effective_measures)
    if (auto chart = effective_stiffness(rows_of<EffectiveStiffnessRow>(input.result), measure, input.commit))
      charts.push_back(std::move(*chart));
  if (const auto rows = rows_of<PulledSheetRow>(input.result); !rows.empty())
    charts.push_back(pulled_sheets(rows, input.commit));
  return charts;
}

}  // namespace crosscheck
