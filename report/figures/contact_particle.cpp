// A particle on balls and planes: Coulomb's law on slopes, height of rebound, separation.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "experiments/tables/contact.h"
#include "reference/engines/engines.h"
#include "report/figures/chapter_parts.h"
#include "report/figures/plot_layout.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

/// A method's results on the slopes of one surface, at one step.
struct ConeAnswers {
  std::vector<std::pair<double, double>> points;  // friction / tan(slope), distance slid / frictionless distance
  int right = 0, all = 0, creeping = 0, stuck = 0;
  std::string failed;

  ConeAnswers(const std::vector<ConeRow>& rows, const std::string& method, double step) {
    for (const ConeRow& row : rows | with(&ConeRow::method, method)) {
      if (row.step != step) continue;
      all += row.verdict != Verdict::unsupported;
      if (row.verdict != Verdict::ok) {
        failed = row.verdict == Verdict::unsupported ? row.reason : failure_class(row.verdict);
        continue;
      }
      const double angle = row.angle * std::numbers::pi / 180, ratio = row.friction / std::tan(angle);
      if (ratio <= 2.5) points.emplace_back(ratio, *row.distance / (9.81 * std::sin(angle) / 8));
      right += row.state == row.state_by_theory;
      creeping += row.state == ContactState::neither;
      stuck += row.state == ContactState::sticks && row.state_by_theory == ContactState::slides;
    }
  }
  std::string count() const { return fmt::format("{} of {}", right, all); }
};

/// Coulomb's law on slopes: distance slid against friction coefficient / tan(slope), and a table of results. For
/// planes, draws only methods with wrong results.
Chart cone_law(const std::vector<ConeRow>& rows, const std::vector<ConeRow>& planes, const std::string& commit) {
  Figure f;
  f.x.low = 0, f.x.high = 2.5, f.y.low = -0.05, f.y.high = 1.05;
  f.curves.push_back({"Coulomb, exact", {"#555555", "1", -1}, {{0, 1}, {1, 0}, {2.5, 0}}});
  const double step = usual_step(rows);
  PageTable page{fmt::format("Stick or slide, at a time step of {}", step_text(step)),
                 {"method", "correct cases", "cases", "wrong cases"},
                 {}};
  if (!planes.empty()) page.header.insert(page.header.begin() + 3, "correct on planes");
  const std::vector<std::string> always = representatives_in_contact();
  std::vector<std::string> differing;
  for (const std::string& method : distinct(rows, &ConeRow::method)) {
    const ConeAnswers ball(rows, method, step), flat(planes, method, step);
    std::string wrong;
    if (ball.creeping) wrong += fmt::format("creeps in {}", ball.creeping);
    if (ball.stuck) wrong += fmt::format("{}sticks where it should slide in {}", wrong.empty() ? "" : ", ", ball.stuck);
    if (!ball.failed.empty()) wrong += (wrong.empty() ? "" : "; ") + ball.failed;
    std::vector<std::string>& texts = page.rows.emplace_back();
    texts = {without_folders(method), ball.all > 0 ? std::to_string(ball.right) : "", std::to_string(ball.all), wrong};
    if (!planes.empty()) texts.insert(texts.begin() + 3, flat.all > 0 ? std::to_string(flat.right) : "");
    if (ball.points.empty()) continue;
    const bool errs = ball.right < ball.all || flat.right < flat.all;
    if (errs)
      differing.push_back(fmt::format("{} (right in {}{})", name_in_sentence(method), ball.count(),
                                      flat.all == 0 ? "" : fmt::format(" on balls, {} on planes", flat.right)));
    if (errs || std::ranges::find(always, method) != always.end())
      f.curves.push_back({method, style_of(method), ball.points, false, true});
    if (flat.right < flat.all && method != sticky_sphere && !flat.points.empty()) {
      Curve curve{reader_name(method) + ", plane", style_of(method), flat.points, false, true, {}, method};
      --curve.style.marker;  // gnuplot's open marker precedes the filled one
      f.curves.push_back(std::move(curve));
    }
  }
  f.finding =
      "On slopes of 10 to 50 degrees with friction coefficients of 0 to 1.2 all results must fall on one line. " +
      (differing.empty() ? "Those of all methods do." : fmt::format("Exceptions: {}.", joined(differing)));
  Chart chart = described("sphere-cone", std::move(f), "step"_a = step_text(step), "commit"_a = commit);
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart rebound_chart(const std::vector<ReboundRow>& rows, const std::string& commit) {
  Figure f;
  f.y.low = 1e-2, f.y.high = 1e3;
  PageTable page{"Rebound height in mm at a time step of 1/240 s", {"method"}, {}};
  const std::vector<double> parts = distinct(rows, &ReboundRow::restitution);
  for (const double e : parts) page.header.push_back(fmt::format("e = {:g} (exact {:.4g})", e, 300 * e * e));
  for (const std::string& method : distinct(rows, &ReboundRow::method)) {
    Curve curve{method, style_of(method), {}, true, true};
    std::vector<std::string>& texts = page.rows.emplace_back(page.header.size());
    texts[0] = method;
    // if the method refuses restitution, draw its run without restitution
    const bool refused = std::ranges::any_of(
        rows, [&](const ReboundRow& row) { return row.method == method && row.verdict == Verdict::unsupported; });
    for (const ReboundRow& row : rows | with(&ReboundRow::method, method)) {
      const double e = row.restitution;
      if (std::abs(row.step - 1. / 240) < 1e-9)
        texts[1 + static_cast<size_t>(std::ranges::find(parts, e) - parts.begin())] =
            row.rebound ? fmt::format("{:.4g}", 1e3 * *row.rebound) : failure_class(row.verdict);
      if (e == (refused ? 0 : 0.5) && row.rebound)
        if (const double off = std::abs(*row.rebound - 0.3 * e * e) * 1e3; off > 1e-2)
          curve.points.emplace_back(row.step, off);
    }
    if (refused) curve.title += " (e = 0)";
    if (!curve.points.empty()) f.curves.push_back(std::move(curve));
  }
  Chart chart = described("sphere-rebound", std::move(f), "commit"_a = commit);
  chart.tables.push_back(std::move(page));
  return chart;
}

std::optional<Chart> leaving_chart(const std::vector<LeavingRow>& rows, const std::string& commit) {
  Figure f;
  for (const LeavingRow& row : rows)
    if (row.angle)
      curve_of(f, row.method, style_of(row.method)).points.emplace_back(row.step, *row.angle - row.angle_by_theory);
  if (f.curves.empty()) return std::nullopt;
  f.floor = {"exact", 0};
  return described("sphere-leaving", std::move(f), "angle"_a = rows.back().angle_by_theory,
                   "speed"_a = rows.back().speed_by_theory, "commit"_a = commit);
}

/// Error against step for a particle that slides with friction off a ball, for methods run with and without +events.
std::optional<Chart> contact_order_chart(const std::vector<ContactOrderRow>& all, const std::string& commit) {
  constexpr std::string_view events = "+events";
  Figure f;
  std::map<bool, std::pair<double, double>> slopes;  // smallest and largest slope; key: true for +events
  std::vector<ContactOrderRow> rows;
  std::ranges::copy(all | with(&ContactOrderRow::probe, "leaves with friction"), std::back_inserter(rows));
  for (const std::string& method : distinct(rows, &ContactOrderRow::method)) {
    const bool located = method.ends_with(events);
    const std::string other = located ? method.substr(0, method.size() - events.size()) : method + std::string(events);
    // first-order rules have no +events option
    if (std::ranges::find(rows, other, &ContactOrderRow::method) == rows.end()) continue;
    Curve curve{method, style_of(method), {}, true, true};
    std::optional<double> slope;  // order at the two shortest steps with a known error
    for (const ContactOrderRow& row : rows | with(&ContactOrderRow::method, method))
      if (row.error && *row.error > 30 * row.truth_bar) {
        curve.points.emplace_back(row.step, *row.error);
        if (row.order) slope = row.order;
      }
    if (!slope) continue;
    curve.title = fmt::format("{}: order {:.2f}", short_name(method), *slope);
    auto& [least, largest] = slopes.try_emplace(located, *slope, *slope).first->second;
    least = std::min(least, *slope), largest = std::max(largest, *slope);
    f.curves.push_back(std::move(curve));
  }
  if (slopes.size() < 2) return std::nullopt;
  const auto orders = [&](bool located) {
    return range(fmt::format("{:.2f}", slopes[located].first), fmt::format("{:.2f}", slopes[located].second));
  };
  return described("sphere-order", std::move(f), "plain"_a = orders(false), "events"_a = orders(true),
                   "commit"_a = commit);
}

}  // namespace

std::vector<Chart> particle_charts(const TableSet& tables, const std::string& commit) {
  std::vector<Chart> charts;
  if (const auto rows = rows_of<ConeRow>(tables); !rows.empty())
    charts.push_back(cone_law(rows, plane_cones(tables), commit));
  if (const auto rows = rows_of<ReboundRow>(tables); !rows.empty()) charts.push_back(rebound_chart(rows, commit));
  if (auto chart = leaving_chart(rows_of<LeavingRow>(tables), commit)) charts.push_back(std::move(*chart));
  if (auto chart = contact_order_chart(rows_of<ContactOrderRow>(tables), commit)) charts.push_back(std::move(*chart));
  return charts;
}

}  // namespace crosscheck
