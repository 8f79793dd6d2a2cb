#include "experiments/regress/cause.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "experiments/adequacy/ingredients.h"

namespace crosscheck {
namespace {

using Names = std::set<std::string>;

struct Seen {
  std::string scene, method, without;
  Names ingredients;
  bool moved = false;
  bool ran = false;  // before: what was refused or failed then tells nothing
};

std::vector<Seen> seen_in(std::span<const Question> questions, std::span<const Compared> rows) {
  using Key = std::tuple<std::string, std::string, std::string>;
  std::set<Key> moved, ran;
  for (const Compared& row : rows) {
    if (row.quantity == "verdict" && row.was_word == name_of(Verdict::ok))
      ran.emplace(row.scene, row.method, row.without);
    if (row.state == Standing::moved || row.state == Standing::not_finite || row.state == Standing::gone)
      moved.emplace(row.scene, row.method, row.without);
  }
  std::vector<Seen> all;
  for (const Question& q : questions) {
    const Key key{q.scene.name, q.method.name, q.without};
    Seen seen{q.scene.name, q.method.name, q.without, {}, moved.contains(key), ran.contains(key)};
    for (const Ingredient& ingredient : ingredients_of(q.scene)) seen.ingredients.insert(ingredient.name);
    all.push_back(std::move(seen));
  }
  return all;
}

bool fits(const std::string& ingredient, const std::vector<Seen>& all, const Names& methods) {
  bool vanished = false;
  for (const Seen& s : all) {
    const bool has = s.ingredients.contains(ingredient);
    if (s.moved && !has) return false;
    if (s.ran && s.without.empty() && has && !s.moved && methods.contains(s.method)) return false;
    if (s.without == ingredient)
      vanished |= std::any_of(all.begin(), all.end(), [&](const Seen& whole) {
        return whole.moved && whole.without.empty() && whole.scene == s.scene && whole.method == s.method;
      });
  }
  return vanished;
}

/// Whether the scenes that moved under these rules held under others.
bool others_held(const std::vector<Seen>& all, const Names& methods) {
  return std::all_of(all.begin(), all.end(), [&](const Seen& s) {
    return !s.moved || !s.without.empty() || std::any_of(all.begin(), all.end(), [&](const Seen& other) {
      return other.scene == s.scene && other.without.empty() && !methods.contains(other.method) && other.ran &&
             !other.moved;
    });
  });
}

/// The settings that changed in every question that moved; empty where there is none.
std::string settings_in_common(std::span<const Compared> rows) {
  using Changes = std::map<std::string, std::string>;  // name -> "was, is"
  using Key = std::tuple<std::string, std::string, std::string>;
  std::map<Key, Changes> moved;
  std::set<Key> refused;
  for (const Compared& row : rows) {
    if (row.state != Standing::moved && row.state != Standing::not_finite && row.state != Standing::gone) continue;
    Changes& changes = moved[{row.scene, row.method, row.without}];
    if (const std::string_view no = name_of(Verdict::unsupported); row.was_word == no || row.is_word == no)
      refused.emplace(row.scene, row.method, row.without);
    if (row.quantity.starts_with(setting_prefix) && row.state == Standing::moved)
      changes[row.quantity.substr(std::string_view(setting_prefix).size())] =
          fmt::format("was {}, is {}", row.was_word, row.is_word);
  }
  for (const auto& question : refused) moved.erase(question);  // these tell nothing
  if (moved.empty()) return "";
  Changes common = moved.begin()->second;
  for (const auto& [question, changes] : moved)
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

std::string cause_of(std::span<const Question> questions, std::span<const Compared> rows) {
  if (const std::string settings = settings_in_common(rows); !settings.empty()) return settings;
  const std::vector<Seen> all = seen_in(questions, rows);
  Names methods, asked, ingredients, fitting;
  for (const Seen& s : all) {
    asked.insert(s.method);
    if (!s.moved) continue;
    methods.insert(s.method);
    ingredients.insert(s.ingredients.begin(), s.ingredients.end());
  }
  if (methods.empty()) return "";
  for (const std::string& name : ingredients)
    if (fits(name, all, methods)) fitting.insert(name);
  const bool of_rules = methods.size() <= 3 && methods.size() < asked.size() && others_held(all, methods);
  const std::string rules =
      fmt::format("{} {}", methods.size() == 1 ? "the rule" : "the rules", fmt::join(methods, ", "));
  if (fitting.size() == 1) return of_rules ? fmt::format("{} under {}", *fitting.begin(), rules) : *fitting.begin();
  if (fitting.empty() && of_rules) return rules;
  return "";
}

}  // namespace crosscheck
