#include "experiments/regress/cause.h"

#include <fmt/ranges.h>

#include <algorithm>
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

}  // namespace

std::string cause_of(std::span<const Question> questions, std::span<const Compared> rows) {
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
