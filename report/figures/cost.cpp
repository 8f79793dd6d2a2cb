// The cost of a step: against size, by phase, and against the machine's peaks.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/cost/cost.h"
#include "experiments/tables/table.h"
#include "report/figures/charts.h"
#include "report/findings/findings_text.h"

namespace crosscheck {
namespace {

constexpr auto builds =
    "CPU time, medians of runs in turns on one core; mysim built here, Bullet by Debian, both for generic x86-64";

Chart size_chart(const Table& t, const std::string& commit) {
  Figure f;
  f.name = "size-cost";
  f.from_costs = true;
  f.title = "CPU time per time step and particle, against the size of a cloth";
  f.x = {"particles", true, std::nullopt, std::nullopt};
  f.y = {"CPU time per time step and particle / ns", true, std::nullopt, std::nullopt};
  double largest = 0;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    const std::string& method = text_at(t, i, "method");
    auto curve = std::find_if(f.curves.begin(), f.curves.end(), [&](const Curve& c) { return c.title == method; });
    if (curve == f.curves.end()) curve = f.curves.insert(f.curves.end(), {method, style_of(method), {}, true, true});
    curve->points.emplace_back(number_at(t, i, "particles", 0), 1e9 * number_at(t, i, "cpu per step and particle", 0));
    largest = std::max(largest, number_at(t, i, "side", 0));
  }
  PageTable page{fmt::format("At {0:.0f} x {0:.0f} particles", largest),
                 {"method", "CPU time per time step / ms", "90 % interval", "force evaluations per time step",
                  "ns per particle", "relative to the cheapest"},
                 {}};
  double cheapest = 1e300;
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (number_at(t, i, "side", 0) == largest) cheapest = std::min(cheapest, number_at(t, i, "cpu per step", 0));
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (number_at(t, i, "side", 0) == largest)
      page.rows.push_back({text_at(t, i, "method"), nice(1e3 * number_at(t, i, "cpu per step", 0)),
                           fmt::format("{} to {}", nice(1e3 * number_at(t, i, "cpu low", 0)),
                                       nice(1e3 * number_at(t, i, "cpu high", 0))),
                           nice(number_at(t, i, "evaluations per step", 0)),
                           nice(1e9 * number_at(t, i, "cpu per step and particle", 0)),
                           times_text(number_at(t, i, "cpu per step", 0) / cheapest)});
  f.finding = "A flat line is a cost in proportion to the number of particles.";
  f.caption = fmt::format(
      "The cloth of cloth-hang at other resolutions, without contact, each at 0.45 of the explicit limit of its size; "
      "{}; "
      "commit {}.",
      builds, commit);
  f.tier = "measured: medians with intervals of one run on this machine";
  Chart chart{"", std::move(f), "cost"};
  chart.text =
      "All methods take the same step here, about half of what an explicit rule can take. An implicit rule may take "
      "longer ones: the chapter on speed against accuracy shows what that buys.";
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart phases_chart(const Table& t) {
  Chart chart{"", std::monostate{}, "cost"};
  chart.heading = "CPU time by phase of a time step";
  chart.text =
      "mysim's leapfrog on a cloth that touches a sphere, in the general engine: the fused step does all in one "
      "pass. "
      "Springs are timed alone; the other phases are differences of "
      "two timings, with the widest interval that follows: one that reaches below zero cannot be told from nothing. "
      "Bullet's worlds show the whole step only.";
  double largest = 0;  // the other sizes stand in the table's file
  for (size_t i = 0; i < t.rows.size(); ++i) largest = std::max(largest, number_at(t, i, "side", 0));
  PageTable page{fmt::format("CPU time of the phases of a time step, {0:.0f} x {0:.0f} particles", largest),
                 {"method", "phase", "µs per time step", "interval", "share", "measured as"},
                 {}};
  for (size_t i = 0; i < t.rows.size(); ++i)
    if (number_at(t, i, "side", 0) == largest)
      page.rows.push_back({text_at(t, i, "method"), text_at(t, i, "phase"),
                           nice(1e6 * number_at(t, i, "cpu per step", 0)),
                           fmt::format("{} to {}", nice(1e6 * number_at(t, i, "cpu low", 0)),
                                       nice(1e6 * number_at(t, i, "cpu high", 0))),
                           fmt::format("{:.0f} %", 100 * number_at(t, i, "share", 0)), text_at(t, i, "how")});
  chart.tables.push_back(std::move(page));
  return chart;
}

Chart roofline_chart(const Table& t, const std::string& commit) {
  Figure f;
  f.name = "roofline-cost";
  f.from_costs = true;
  f.title = "Roofline of the spring kernel";
  f.x = {"arithmetic intensity / (flop/byte)", true, 0.03, 10.};
  f.y = {"performance / (Gflop/s)", true, 0.3, std::nullopt};
  static const MethodStyle roofs[] = {{"#56B4E9", "1", -1}, {"#0072B2", "(6,3)", -1}, {"#332288", "(2,2)", -1}};
  double peak = 0, best = 0, at = 0;
  size_t roof = 0;
  Curve springs{"springs, 16 x 16 to", {"#D55E00", "1", 7}, {}, true, true};
  std::string last;
  for (size_t i = 0; i < t.rows.size(); ++i) {
    const std::string& what = text_at(t, i, "what");
    const double rate = number_at(t, i, "rate", 0) / 1e9;
    if (what.starts_with("peak")) peak = rate;
    if (what.starts_with("bandwidth")) {
      const double bandwidth = number_at(t, i, "bandwidth", 0) / 1e9, ridge = peak / bandwidth;
      f.curves.push_back({fmt::format("{}: {:.0f} GB/s", what, bandwidth),
                          roofs[std::min(roof++, std::size(roofs) - 1)],
                          {{0.03, 0.03 * bandwidth}, {ridge, peak}, {10, peak}}});
    }
    if (what.starts_with("springs")) {
      springs.points.emplace_back(number_at(t, i, "intensity", 0), rate);
      last = what.substr(what.find(',') + 2);
      if (rate > best) best = rate, at = number_at(t, i, "intensity", 0);
    }
  }
  springs.title += " " + last;
  f.curves.push_back(std::move(springs));
  f.finding = fmt::format(
      "The spring kernel does {} billion operations a second at {:.2g} per byte, {:.0f} % of the measured peak "
      "of {} billion.",
      times_text(best), at, 100 * best / peak, times_text(peak));
  f.caption = fmt::format(
      "Lines: what measured bandwidth and peak allow; the peak is that of independent multiplications and additions, "
      "by "
      "the kernel's instructions. Springs count as {:g} operations and {:g} bytes, particles as {:g} bytes, each read "
      "anew: what stays in a cache lifts a point above the line of a larger memory; commit {}.",
      flop_per_spring, bytes_per_spring, bytes_per_particle, commit);
  f.tier = "measured: bandwidth and peak of this machine in the same run";
  return {"", std::move(f), "cost"};
}

}  // namespace

std::vector<Chart> cost_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  if (const Table* t = input.result.table("size-cost"); t && !t->rows.empty())
    charts.push_back(size_chart(*t, input.commit));
  if (const Table* t = input.result.table("phases-cost"); t && !t->rows.empty()) charts.push_back(phases_chart(*t));
  if (const Table* t = input.result.table("roofline-cost"); t && !t->rows.empty())
    charts.push_back(roofline_chart(*t, input.commit));
  return charts;
}

}  // namespace crosscheck
