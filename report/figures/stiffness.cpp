// Stiffness of position-based links: formula and measurement, for one link and for a chain; and the effective stiffness
// of hanging nets over step and iterations.

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

std::string iterations_text(long n) { return n == 1 ? "1 iteration" : fmt::format("{} iterations", n); }

/// The numbers of iterations, ascending.
std::set<long> iterations_of(const Table& table) {
  std::set<long> all;
  for (size_t i = 0; i < table.rows.size(); ++i) all.insert(std::get<long>(table.at(i, "iterations")));
  return all;
}

/// The values of a column, ascending.
std::set<double> column_values(const Table& table, const char* column) {
  std::set<double> all;
  for (size_t i = 0; i < table.rows.size(); ++i) all.insert(std::get<double>(table.at(i, column)));
  return all;
}

Chart single_links(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "stiffness";
  f.title = "Stiffness of one position-based link";
  f.x = {"link stiffness setting kLST", true, std::nullopt, std::nullopt};
  f.y = {"dimensionless stiffness k h² / μ", true, std::nullopt, std::nullopt};
  size_t style = 0;
  double worst = 0;
  for (const long n : iterations_of(table)) {
    MethodStyle plain = by_iterations[style];
    plain.marker = -1;  // markers are measurements
    Curve formula{iterations_text(n) + ", formula", plain, {}},
        measured{iterations_text(n) + ", measured", by_iterations[style], {}, false, true};
    double low = 1, high = 0;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (std::get<long>(table.at(i, "iterations")) != n) continue;
      const double h = std::get<double>(table.at(i, "step")), kLST = std::get<double>(table.at(i, "kLST"));
      measured.points.emplace_back(kLST, std::get<double>(table.at(i, "measured")) * h * h);  // of 1 kg: μ = 1 kg
      worst = std::max(worst, std::abs(std::get<double>(table.at(i, "deviation"))));
      low = std::min(low, kLST), high = std::max(high, kLST);
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
  for (const double h : column_values(table, "step")) steps.push_back(fmt::format("1/{:g}", std::round(1 / h)));
  f.finding = fmt::format(
      "By the formula one link has a stiffness of k = μ / h² ((1 - kLST)⁻ⁿ - 1). At steps of {} s force over extension "
      "is off by {:.2g} % at most.",
      joined(steps), 100 * worst);
  f.caption = fmt::format("One mass on one link at rest, strain at most 1e-4; commit {}.", commit);
  f.tier = "exact for the discrete rule (the formula above), to strains of second order";
  return {
      "", std::move(f), "stiffness",
      "Bullet's position-based links have no stiffness in N/m. Relaxed n times in a step of h, a link between masses "
      "of reduced mass μ acts like a spring in an implicit Euler step; this is how the suite maps stiffness."};
}

Chart networks(const Table& table, const std::string& commit) {
  Figure f;
  f.name = "stiffness-network";
  f.title = "Excess sag of a chain of three position-based links";
  f.x = {"dimensionless stiffness k h² / μ", true, std::nullopt, std::nullopt};
  f.y = {"excess sag / %", true, std::nullopt, std::nullopt};
  size_t style = 0;
  double holds = 0;
  std::vector<std::string> most;
  for (const long n : iterations_of(table)) {
    Curve curve{iterations_text(n), by_iterations[style++], {}, true, true};
    std::set<double> good, bad;  // k h² / μ
    double worst = 0;
    for (size_t i = 0; i < table.rows.size(); ++i) {
      if (std::get<long>(table.at(i, "iterations")) != n) continue;
      const double x = std::get<double>(table.at(i, "k h^2/mu")), off = std::get<double>(table.at(i, "deviation"));
      if (off > 0) curve.points.emplace_back(x, 100 * off);
      worst = std::max(worst, off);
      if (n == 1) (std::abs(off) < 0.01 ? good : bad).insert(x);
    }
    for (const double x : good)
      if (bad.empty() || x < *bad.begin()) holds = x;
    if (worst > 0) most.push_back(fmt::format("{:.0f} % with {}", 100 * worst, iterations_text(n)));
    f.curves.push_back(std::move(curve));
  }
  f.finding = holds > 0
                  ? fmt::format("In a chain solved once in a step the map holds to 1 % up to k h² / μ = {:.2g}.", holds)
                  : "In a chain the map holds to 1 % at none of these steps.";
  if (!most.empty()) f.finding += fmt::format(" The chain sags too far by up to {}.", joined(most));
  f.caption = fmt::format("Three masses on links of 1000 N/m, at rest; commit {}.", commit);
  f.tier = "exact (Hooke's springs at rest)";
  return {"", std::move(f), "stiffness",
          "In a network each link is solved in its turn and spoilt by its neighbours, so that the map of single links "
          "holds for short steps only."};
}

/// A measure of the effective stiffness: its column, the net that shows it, and the words of its figure.
struct EffectiveMeasure {
  std::string_view name, net, title, quantity, how, tier;
  std::optional<double> EffectiveStiffnessRow::*value;
};
// by its period a chain alone: a cloth this small swings so fast that implicit rules stop it before it turns twice
constexpr EffectiveMeasure effective_measures[] = {
    {"stiffness-effective", "cloth", "Effective stiffness of a hanging cloth, by its sag", "by sag",
     "Sag asked over sag", "converged (dynamic relaxation)", &EffectiveStiffnessRow::by_sag},
    {"stiffness-effective-period", "chain", "Effective stiffness of a hanging chain, by its period", "by period",
     "Square of period asked over period", "converged (rk4 at a small step)", &EffectiveStiffnessRow::by_period}};

/// "4 iterations of pbd": a name that begins with a method's is cut to that at a curve's end.
std::string curve_title(const EffectiveStiffnessRow& row) {
  return fmt::format("{} of {}", passes_text(row.method, row.iterations), row.method.substr(row.method.find('/') + 1));
}

/// Methods that have no iterations to choose stand in the table alone.
Chart effective_stiffness(const std::vector<EffectiveStiffnessRow>& rows, const EffectiveMeasure& measure,
                          const std::string& commit) {
  Figure f;
  f.name = measure.name;
  f.title = measure.title;
  f.x = {"time step / ms", true, std::nullopt, std::nullopt};
  f.y = {fmt::format("effective stiffness {} / % of that asked", measure.quantity), true, std::nullopt, std::nullopt};
  static constexpr const char *dashes[] = {"1", "(8,4)", "(2,2)", "(10,3,2,3)"},
                              *greys[] = {"#111111", "#555555", "#8A8A8A", "#333333"},
                              *browns[] = {"#7A3B00", "#D66A08", "#E8A33D", "#9A4200"};
  std::map<std::string, size_t> by_method;  // curves so far
  const EffectiveStiffnessRow* softest = nullptr;
  for (const EffectiveStiffnessRow& row : rows) {
    const Method* method = builtin_method(row.method);
    if (!row.net.starts_with(measure.net) || !(row.*measure.value) || !method || !method->position_based) continue;
    const std::string title = curve_title(row);
    auto curve = std::ranges::find(f.curves, title, &Curve::title);
    if (curve == f.curves.end()) {
      // shades of the engine's colour: curves of one colour would share one name
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
  if (softest) {
    f.finding = fmt::format("At a step of {} with {} the {} is {} times softer than asked.", step_text(softest->step),
                            curve_title(*softest), measure.net, times_text(1 / *(softest->*measure.value)));
    f.caption = fmt::format(
        "{}; a {} that hangs from its upper end, of k h² / μ = {:.2g} at a step of {}; strains of some "
        "thousandths at most; commit {}.",
        measure.how, softest->net, softest->stiffness, step_text(softest->step), commit);
  }
  f.tier = measure.tier;
  return {"", std::move(f), "stiffness",
          "Solved for a few times in a step, a net is softer than its springs: sag and period tell by how much. "
          "Iterations that share a link's stiffness among them do not help; sub-steps in their place do."};
}

/// Young's modulus over the angle of the pull: lines by the formula, marks by energies of strained nets.
Chart pulled_sheets(const std::vector<PulledSheetRow>& rows, const std::string& commit) {
  Figure f;
  f.name = "stiffness-sheets";
  f.title = "Young's modulus of a sheet of springs, by the direction of the pull";
  f.x = {"angle between pull and rows / °", false, std::nullopt, std::nullopt};
  f.y = {"Young's modulus / (N/m)", false, 0, std::nullopt};
  size_t style = 0;
  double worst = 0;
  for (const PulledSheetRow& row : rows) {
    if (f.curves.empty() || f.curves.back().title != row.net + ", measured") {
      MethodStyle plain = by_iterations[style];
      plain.marker = -1;  // marks are measurements
      f.curves.push_back({row.net, plain, {}});
      f.curves.push_back({row.net + ", measured", by_iterations[style], {}, false, true});
      style = std::min(style + 1, std::size(by_iterations) - 1);
    }
    f.curves[f.curves.size() - 2].points.emplace_back(row.angle, row.predicted);
    f.curves.back().points.emplace_back(row.angle, row.measured);
    worst = std::max(worst, std::abs(row.deviation));
  }
  f.finding = fmt::format("Measured and predicted differ by at most {} %.", nice(100 * worst));
  f.caption = fmt::format("Square nets of springs at rest, strains of 1e-4; commit {}.", commit);
  f.tier = "exact (central forces, uniform strain)";
  return {
      "", std::move(f), "stiffness",
      "Outside its scene a net of springs is known by its moduli: C11 = k(structural) + k(shear) + 4 k(bend), C12 = "
      "C66 = k(shear). Skip-one springs stiffen rows and columns fourfold, diagonals not at all."};
}

}  // namespace

std::vector<Chart> stiffness_charts(const ChartInput& input) {
  std::vector<Chart> charts;
  if (const Table* table = input.result.table("stiffness")) charts.push_back(single_links(*table, input.commit));
  if (const Table* table = input.result.table("stiffness-network")) charts.push_back(networks(*table, input.commit));
  if (const auto rows = rows_of<EffectiveStiffnessRow>(input.result); !rows.empty())
    for (const EffectiveMeasure& measure : effective_measures)
      if (std::ranges::any_of(rows, [&](const auto& row) {
            return row.net.starts_with(measure.net) && (row.*measure.value).has_value();
          }))
        charts.push_back(effective_stiffness(rows, measure, input.commit));
  if (const auto rows = rows_of<PulledSheetRow>(input.result); !rows.empty())
    charts.push_back(pulled_sheets(rows, input.commit));
  return charts;
}

}  // namespace crosscheck
