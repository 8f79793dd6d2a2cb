// Ingredients, steppers and settings that fit all failures; the sentence for each kind of change of speed.
#include "experiments/regress/attribution.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "experiments/scenes/ingredients.h"

namespace crosscheck {
namespace {

using Names = std::set<std::string>;

struct CaseStatus {
  std::string scene, method, without;
  Names ingredients;
  bool moved = false;
  bool ran = false;  // before: a case that was refused or failed then says nothing
};

std::vector<CaseStatus> case_statuses(std::span<const Case> cases, std::span<const Comparison> rows) {
  using Key = std::tuple<std::string, std::string, std::string>;
  std::set<Key> moved, ran;
  for (const Comparison& row : rows) {
    if (row.quantity == "verdict" && row.was_word == name_of(Verdict::ok))
      ran.emplace(row.scene, row.method, row.without);
    if (row.state == Status::moved || row.state == Status::not_finite || row.state == Status::gone)
      moved.emplace(row.scene, row.method, row.without);
  }
  std::vector<CaseStatus> all;
  for (const Case& q : cases) {
    const Key key{q.scene.name, q.method.name, q.without};
    CaseStatus seen{q.scene.name, q.method.name, q.without, {}, moved.contains(key), ran.contains(key)};
    for (const Ingredient& ingredient : ingredients_of(q.scene)) seen.ingredients.insert(ingredient.name);
    all.push_back(std::move(seen));
  }
  return all;
}

bool fits(const std::string& ingredient, const std::vector<CaseStatus>& all, const Names& methods) {
  bool vanished = false;
  for (const CaseStatus& s : all) {
    const bool has = s.ingredients.contains(ingredient);
    if (s.moved && !has) return false;
    if (s.ran && s.without.empty() && has && !s.moved && methods.contains(s.method)) return false;
    if (s.without == ingredient)
      vanished |= std::any_of(all.begin(), all.end(), [&](const CaseStatus& whole) {
        return whole.moved && whole.without.empty() && whole.scene == s.scene && whole.method == s.method;
      });
  }
  return vanished;
}

/// Whether the scenes that moved under these rules held under others.
bool others_held(const std::vector<CaseStatus>& all, const Names& methods) {
  return std::all_of(all.begin(), all.end(), [&](const CaseStatus& s) {
    return !s.moved || !s.without.empty() || std::any_of(all.begin(), all.end(), [&](const CaseStatus& other) {
      return other.scene == s.scene && other.without.empty() && !methods.contains(other.method) && other.ran &&
             !other.moved;
    });
  });
}

/// The settings that changed in every case that moved; empty where there is none.
std::string settings_in_common(std::span<const Comparison> rows) {
  using Changes = std::map<std::string, std::string>;  // name -> "was, is"
  using Key = std::tuple<std::string, std::string, std::string>;
  std::map<Key, Changes> moved;
  std::set<Key> refused;
  for (const Comparison& row : rows) {
    if (row.state != Status::moved && row.state != Status::not_finite && row.state != Status::gone) continue;
    Changes& changes = moved[{row.scene, row.method, row.without}];
    if (const std::string_view no = name_of(Verdict::unsupported); row.was_word == no || row.is_word == no)
      refused.emplace(row.scene, row.method, row.without);
    if (row.quantity.starts_with(setting_prefix) && row.state == Status::moved)
      changes[row.quantity.substr(std::string_view(setting_prefix).size())] =
          fmt::format("was {}, is {}", row.was_word, row.is_word);
  }
  for (const auto& test_case : refused) moved.erase(test_case);  // these say nothing
  if (moved.empty()) return "";
  Changes common = moved.begin()->second;
  for (const auto& [test_case, changes] : moved)
    for (auto it = common.begin(); it != common.end();) {
      const auto here = changes.find(it->first);
      if (here != changes.end() && here->second != it->second) it->second.clear();  // another value in each scene
      it = here == changes.end() ? common.erase(it) : std::next(it);
    }
  std::vector<std::string> words;
  for (const auto& [name, values] : common)
    words.push_back(values.empty() ? name : fmt::format("{} ({})", name, values));
  return words.empty()
             ? ""
             : fmt::format("{} {}", words.size() == 1 ? "the setting" : "the settings", fmt::join(words, ", "));
}

}  // namespace

std::string attribution_of(std::span<const Case> cases, std::span<const Comparison> rows) {
  if (const std::string settings = settings_in_common(rows); !settings.empty()) return settings;
  const std::vector<CaseStatus> all = case_statuses(cases, rows);
  Names methods, selected, ingredients, fitting;
  for (const CaseStatus& s : all) {
    selected.insert(s.method);
    if (!s.moved) continue;
    methods.insert(s.method);
    ingredients.insert(s.ingredients.begin(), s.ingredients.end());
  }
  if (methods.empty()) return "";
  for (const std::string& name : ingredients)
    if (fits(name, all, methods)) fitting.insert(name);
  const bool of_rules = methods.size() <= 3 && methods.size() < selected.size() && others_held(all, methods);
  const std::string rules =
      fmt::format("{} {}", methods.size() == 1 ? "the rule" : "the rules", fmt::join(methods, ", "));
  if (fitting.size() == 1) return of_rules ? fmt::format("{} under {}", *fitting.begin(), rules) : *fitting.begin();
  if (fitting.empty() && of_rules) return rules;
  return "";
}

namespace {

/// The quantities that say how far the result is from right, the better one first.
constexpr std::string_view errors[] = {"error against truth", "change at half the step"};

/// The cost of a result is no part of it.
bool is_work(const Comparison& row) { return row.quantity == "steps" || row.quantity == "force evaluations"; }

bool moved(const Comparison& row) {
  return row.state == Status::moved || row.state == Status::not_finite || row.state == Status::gone;
}

/// 1 where the error grew, -1 where it shrank, 0 where it is the same to its tolerance.
int growth_of(const Comparison& row) {
  if (!row.was || !row.is || !(std::abs(*row.is - *row.was) > row.tolerance)) return 0;
  return *row.is > *row.was ? 1 : -1;
}

double times(const Comparison& row) { return std::max(*row.is, *row.was) / std::min(*row.is, *row.was); }

std::string factor_in_words(double factor) {
  return factor < 100 ? fmt::format("{:.2g}", factor) : fmt::format("{:.0f}", factor);
}

std::string in_words(const Comparison& row, bool name_scene) {
  const char* word = growth_of(row) > 0 ? "larger" : "smaller";
  const std::string size = std::isfinite(times(row))
                               ? fmt::format("{} times {}", factor_in_words(times(row)), word)
                               : fmt::format("{}: from {:.2g} to {:.2g} m", word, *row.was, *row.is);
  return fmt::format("{} {}{}", row.quantity, size, name_scene ? " on " + row.scene : "");
}

/// Evidence of the quantities on accuracy.
struct Evidence {
  bool known = false, has_moved = false, error_known = false;
  const Comparison *larger = nullptr, *smaller = nullptr;  // the errors that changed most
  std::string failure;                                     // another verdict
};

Evidence evidence_of(std::span<const Comparison> rows) {
  Evidence all;
  std::map<std::string, const Comparison*> best;  // of each scene
  for (const Comparison& row : rows) {
    all.known = true;
    all.has_moved |= moved(row) && !is_work(row);
    if (row.quantity == "verdict" && row.state == Status::moved && row.was_word == "ok")
      all.failure = fmt::format("the run of {} now ends with the verdict '{}'", row.scene, row.is_word);
    for (const std::string_view name : errors)
      if (row.quantity == name && row.was && row.is) {
        const Comparison*& known = best[row.scene];
        if (!known || known->quantity != errors[0]) known = &row;
      }
  }
  all.error_known = !best.empty();
  for (const auto& [scene, row] : best) {
    const int growth = growth_of(*row);
    const Comparison*& place = growth > 0 ? all.larger : all.smaller;
    if (growth != 0 && (!place || times(*row) > times(*place))) place = row;
  }
  return all;
}

}  // namespace

std::string speed_accuracy_of(const SpeedComparison& speed, std::span<const Comparison> quantities) {
  if (speed.state != SpeedStatus::slower && speed.state != SpeedStatus::faster) return "";
  std::vector<Comparison> same_scene, same_method;
  for (const Comparison& row : quantities) {
    if (row.method != speed.method || !row.without.empty()) continue;
    same_method.push_back(row);
    if (row.scene == speed.scene) same_scene.push_back(row);
  }
  const bool elsewhere = same_scene.empty();
  const Evidence seen = evidence_of(elsewhere ? same_method : same_scene);
  const bool faster = speed.state == SpeedStatus::faster;
  const double factor = faster ? 1 / speed.change.median : speed.change.median;
  const std::string pace = fmt::format("{:.3g} times {}", factor, faster ? "faster" : "slower");
  if (!seen.known) return fmt::format("{}; its answer was not asked for", pace);
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

std::vector<std::string> explain_speeds(std::vector<SpeedComparison>& speeds, std::span<const Comparison> quantities) {
  std::vector<std::string> sentences;
  for (SpeedComparison& speed : speeds) {
    speed.sentence = speed_accuracy_of(speed, quantities);
    if (!speed.sentence.empty())
      sentences.push_back(fmt::format("{} under {}: {}", speed.scene, speed.method, speed.sentence));
  }
  return sentences;
}

}  // namespace crosscheck
