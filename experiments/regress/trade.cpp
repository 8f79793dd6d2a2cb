// The words for each case.
#include "experiments/regress/trade.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace crosscheck {
namespace {

/// What says how far the answer is from right, the better word first.
constexpr std::string_view errors[] = {"error against truth", "change at half the step"};

/// What an answer cost is no part of it.
bool is_work(const Compared& row) { return row.quantity == "steps" || row.quantity == "force evaluations"; }

bool moved(const Compared& row) {
  return row.state == Standing::moved || row.state == Standing::not_finite || row.state == Standing::gone;
}

/// 1 where the error grew, -1 where it shrank, 0 where it is the same to its tolerance.
int growth_of(const Compared& row) {
  if (!row.was || !row.is || !(std::abs(*row.is - *row.was) > row.tolerance)) return 0;
  return *row.is > *row.was ? 1 : -1;
}

double times(const Compared& row) { return std::max(*row.is, *row.was) / std::min(*row.is, *row.was); }

std::string factor_in_words(double factor) {
  return factor < 100 ? fmt::format("{:.2g}", factor) : fmt::format("{:.0f}", factor);
}

std::string in_words(const Compared& row, bool name_scene) {
  const char* word = growth_of(row) > 0 ? "larger" : "smaller";
  const std::string size = std::isfinite(times(row))
                               ? fmt::format("{} times {}", factor_in_words(times(row)), word)
                               : fmt::format("{}: from {:.2g} to {:.2g} m", word, *row.was, *row.is);
  return fmt::format("{} {}{}", row.quantity, size, name_scene ? " on " + row.scene : "");
}

/// What the answers tell of accuracy.
struct Evidence {
  bool asked = false, has_moved = false, error_known = false;
  const Compared *larger = nullptr, *smaller = nullptr;  // the errors that changed most
  std::string failure;                                   // another verdict
};

Evidence evidence_of(std::span<const Compared> rows) {
  Evidence all;
  std::map<std::string, const Compared*> best;  // of each scene
  for (const Compared& row : rows) {
    all.asked = true;
    all.has_moved |= moved(row) && !is_work(row);
    if (row.quantity == "verdict" && row.state == Standing::moved && row.was_word == "ok")
      all.failure = fmt::format("the run of {} now ends with the verdict '{}'", row.scene, row.is_word);
    for (const std::string_view name : errors)
      if (row.quantity == name && row.was && row.is) {
        const Compared*& known = best[row.scene];
        if (!known || known->quantity != errors[0]) known = &row;
      }
  }
  all.error_known = !best.empty();
  for (const auto& [scene, row] : best) {
    const int growth = growth_of(*row);
    const Compared*& place = growth > 0 ? all.larger : all.smaller;
    if (growth != 0 && (!place || times(*row) > times(*place))) place = row;
  }
  return all;
}

}  // namespace

std::string trade_of(const SpeedCompared& speed, std::span<const Compared> answers) {
  if (speed.state != Pace::slower && speed.state != Pace::faster) return "";
  std::vector<Compared> same_scene, same_method;
  for (const Compared& row : answers) {
    if (row.method != speed.method || !row.without.empty()) continue;
    same_method.push_back(row);
    if (row.scene == speed.scene) same_scene.push_back(row);
  }
  const bool elsewhere = same_scene.empty();
  const Evidence seen = evidence_of(elsewhere ? same_method : same_scene);
  const bool faster = speed.state == Pace::faster;
  const double factor = faster ? 1 / speed.change.median : speed.change.median;
  const std::string pace = fmt::format("{:.3g} times {}", factor, faster ? "faster" : "slower");
  if (!seen.asked) return fmt::format("{}; its answer was not asked for", pace);
  if (!seen.failure.empty()) return fmt::format("{}, and {}", pace, seen.failure);
  if (seen.larger && seen.smaller)
    return fmt::format("{}, more accurate here and less there: {}, {}", pace, in_words(*seen.larger, elsewhere),
                       in_words(*seen.smaller, elsewhere));
  if (seen.larger)
    return fmt::format("{}: {}, {}", faster ? "buys speed with accuracy" : "slower and less accurate", pace,
                       in_words(*seen.larger, elsewhere));
  if (seen.smaller)
    return fmt::format("{}: {}, {}", faster ? "faster and more accurate" : "buys accuracy with speed", pace,
                       in_words(*seen.smaller, elsewhere));
  if (!seen.has_moved) return fmt::format("{} at the same answer: {}", faster ? "faster" : "slower", pace);
  if (seen.error_known) return fmt::format("{}, and the answer moved; its error is the same", pace);
  return fmt::format("{}, and the answer moved; whether for the better is not known", pace);
}

std::vector<std::string> tell_trades(std::vector<SpeedCompared>& speeds, std::span<const Compared> answers) {
  std::vector<std::string> told;
  for (SpeedCompared& speed : speeds) {
    speed.sentence = trade_of(speed, answers);
    if (!speed.sentence.empty())
      told.push_back(fmt::format("{} under {}: {}", speed.scene, speed.method, speed.sentence));
  }
  return told;
}

}  // namespace crosscheck
