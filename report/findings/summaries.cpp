#include "report/findings/summaries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/tables/contact.h"
#include "mysim/base/text.h"
#include "report/findings/findings_text.h"

namespace crosscheck {

std::string residual_class(const EnergyRow& run) {
  const double worst = run.largest_residual.value_or(0), turned = run.turned_over.value_or(0);
  const bool lost = run.residual.value_or(0) < 0;
  if (run.verdict != Verdict::ok) return failure_class(run.verdict);
  // residuals below 1e5 times the rounding error of the accumulated energies are round-off
  if (worst < 1e-11 * turned) return residual_none;
  if (worst > 0.3 * turned) return lost ? "loses much of the energy" : "gains much energy";
  // growth in decades, relative to the first tenth of the run; growth proportional to time gives 1
  if (run.growth.value_or(0) > 0.5) return lost ? "drifts down" : "drifts up";
  return residual_bounded;
}

std::optional<PowerLaw> power_of(const TableSet& rows, const std::string& scene, ScalingQuantity quantity) {
  for (const ScalingRow& row : rows_of<ScalingRow>(rows))
    if (row.scene == scene && row.quantity == quantity) return PowerLaw{row.exponent, row.standard_error};
  return std::nullopt;
}

std::string power_text(const PowerLaw& power) {
  return fmt::format("{:.2f} ± {:.2f}", power.exponent, power.deviation);
}

std::string ingredients_text(const std::string& left_out, size_t most) {
  if (left_out.empty()) return "nothing";
  std::vector<std::string> all;
  for (std::string& each : split(left_out, ',')) all.push_back(each.substr(each.find_first_not_of(' ')));
  if (all.size() > most) return counted(all.size(), "ingredient");
  // write the common noun only once
  constexpr std::string_view noun = " springs";
  for (size_t i = 0; i + 1 < all.size(); ++i)
    if (all[i].ends_with(noun) && all[i + 1].ends_with(noun)) all[i].resize(all[i].size() - noun.size());
  return joined(all);
}

std::vector<ConeRow> plane_cones(const TableSet& rows) {
  const Table* table = rows.table("plane-cone");
  return table ? rows_of<ConeRow>(*table) : std::vector<ConeRow>();
}

const ConeCount* count_of(const std::vector<ConeCount>& counts, const std::string& method) {
  const auto at = std::ranges::find(counts, method, &ConeCount::method);
  return at == counts.end() ? nullptr : &*at;
}

std::vector<ConeCount> cone_counts(const std::vector<ConeRow>& rows) {
  std::vector<ConeCount> counts;
  for (const ConeRow& row : rows) {
    if (row.verdict != Verdict::ok) continue;
    auto at = std::ranges::find(counts, row.method, &ConeCount::method);
    if (at == counts.end()) at = counts.insert(counts.end(), {row.method});
    ++at->all, at->right += row.state == row.state_by_theory;
  }
  std::ranges::stable_partition(counts, [](const ConeCount& c) { return c.method == ours; });
  return counts;
}

std::string deviation_text(double off, double finest) {
  if (std::abs(off) < finest) return fmt::format("within ±{:.2g} %", 100 * finest);
  return off >= 1 ? fmt::format("{} times as long", nice(1 + off)) : fmt::format("{:+.2g} %", 100 * off);
}

namespace {

/// Largest relative deviation from theory with which a limit counts as agreeing.
constexpr double agrees_within = 0.01;

struct StepLimitComparison {
  enum Kind { agrees, coarse, apart } kind = agrees;
  std::optional<double> off;  // measured / predicted - 1, if both steps are finite
  std::string how;            // for `apart`
};

/// Returns nullopt if there is no theory, the method refuses the scene, or the predicted limit exceeds the steps tried.
std::optional<StepLimitComparison> compare_step_limit(const LimitRow& row) {
  using enum StepLimitComparison::Kind;
  const PredictionKind theory = row.prediction;
  const MeasuredLimit::Kind run = row.measurement;
  if (theory == PredictionKind::none || run == MeasuredLimit::unsupported) return std::nullopt;
  const bool both = theory == PredictionKind::limit && run == MeasuredLimit::found;
  const double held = row.held.value_or(0), failed = row.failed.value_or(INFINITY),
               predicted = theory == PredictionKind::limit ? *row.predicted : 0;
  if (both) {
    const double off = *row.deviation;
    if (std::abs(off) <= agrees_within) return StepLimitComparison{agrees, off, ""};
    if (held <= predicted && predicted <= failed) return StepLimitComparison{coarse, off, ""};
    return StepLimitComparison{apart, off,
                               off >= 1 ? fmt::format("stable at {} times the step", times_text(1 + off))
                                        : fmt::format("{:+.2g} % off", 100 * off)};
  }
  const bool refused = run == MeasuredLimit::refused_above, never = run == MeasuredLimit::no_step;
  // the predicted limit is beyond the steps tried, or beyond a step that the method refused
  if (theory == PredictionKind::limit && (never ? failed >= predicted : held <= predicted)) return std::nullopt;
  if (theory == PredictionKind::every_step && refused) return std::nullopt;
  if (theory != PredictionKind::limit && run != MeasuredLimit::found && (theory == PredictionKind::every_step) != never)
    return StepLimitComparison{};
  const std::string found = run == MeasuredLimit::found ? "holds up to " + step_text(*row.measured)
                            : refused                   ? "holds at least up to " + step_text(held)
                            : never                     ? "fails at every step tried"
                                                        : "holds at every step tried",
                    said = theory == PredictionKind::limit        ? "up to " + step_text(predicted)
                           : theory == PredictionKind::every_step ? "at every one"
                                                                  : "at none";
  return StepLimitComparison{apart, std::nullopt, fmt::format("{}, by theory {}", found, said)};
}

}  // namespace

StepLimitCounts step_limit_counts(const std::vector<LimitRow>& rows, LimitState state) {
  StepLimitCounts counts;
  double furthest = -1;
  for (const LimitRow& row : rows) {
    const auto found = row.state == state ? compare_step_limit(row) : std::nullopt;
    if (!found) continue;
    // relative distance between the last stable and the first failed step
    const double bracket = row.held && row.failed ? *row.failed / *row.held - 1 : 0;
    if (found->kind == StepLimitComparison::apart) {
      ++counts.apart;
      const double off = found->off ? std::abs(std::log1p(*found->off)) : INFINITY;
      if (off > furthest) furthest = off, counts.method = row.method, counts.where = row.scene, counts.how = found->how;
    } else if (found->kind == StepLimitComparison::coarse) {
      ++counts.coarse, counts.widest = std::max(counts.widest, bracket);
    } else if (found->off) {
      ++counts.agreeing, counts.deviation = std::max(counts.deviation, std::abs(*found->off));
      counts.widest = std::max(counts.widest, bracket);
      add_once(counts.scenes, row.scene);
    }
  }
  return counts;
}

bool confirmed_by_truth(const LimitRow& row) {
  return row.error_below && row.error_above && *row.error_below <= useless_from * *row.motion &&
         *row.error_above > useless_from * *row.motion;
}

}  // namespace crosscheck
