// Classes as far as their heads and two functions say what they are, and the ranks by which roles are given to them.
#include "tests/coursework/classic/class_list.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "tests/coursework/grader/submission.h"

namespace coursework::classic {
namespace {

using Tokens = std::vector<std::string>;

bool is_word(const std::string& token) { return std::isalpha(static_cast<unsigned char>(token[0])) || token[0] == '_'; }

/// Behind the bracket that closes the one at `at`.
std::size_t behind(const Tokens& tokens, std::size_t at, const char* open, const char* close) {
  int depth = 0;
  for (; at < tokens.size(); ++at) {
    depth += tokens[at] == open;
    depth -= tokens[at] == close;
    if (depth == 0) return at + 1;
  }
  return at;
}

/// "): public a::B, private C<D> {": the names B and C; `at` is left at the brace.
std::vector<std::string> bases_from(const Tokens& tokens, std::size_t& at) {
  static const std::set<std::string> no_names = {"public", "protected", "private", "virtual"};
  std::vector<std::string> bases;
  std::string last;
  for (; at < tokens.size() && tokens[at] != "{" && tokens[at] != ";"; ++at) {
    if (tokens[at] == "<") {
      at = behind(tokens, at, "<", ">") - 1;
    } else if (tokens[at] == ",") {
      if (!last.empty()) bases.push_back(last);
      last.clear();
    } else if (is_word(tokens[at]) && no_names.count(tokens[at]) == 0) {
      last = tokens[at];
    }
  }
  if (!last.empty()) bases.push_back(last);
  return bases;
}

void read_body(const Tokens& tokens, std::size_t begin, std::size_t end, ClassInfo& into) {
  int depth = 0;
  for (std::size_t i = begin; i < end; ++i) {
    depth += tokens[i] == "{";
    depth -= tokens[i] == "}";
    const bool eval = tokens[i] == "evalF", step = tokens[i] == "takeStep";
    if (depth != 1 || !(eval || step) || i + 1 >= end || tokens[i + 1] != "(") continue;
    (eval ? into.declares_eval : into.declares_step) = true;
    std::size_t at = behind(tokens, i + 1, "(", ")");
    while (at < end && is_word(tokens[at])) ++at;
    // "= 0;": numbers are no tokens
    into.abstract = into.abstract || (at + 1 < end && tokens[at] == "=" && tokens[at + 1] == ";");
  }
}

}  // namespace

std::vector<ClassInfo> classes_in(const Tokens& tokens, const std::string& file) {
  std::vector<ClassInfo> found;
  std::vector<std::pair<std::string, bool>> scopes;  // name, whether a namespace
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i] == "}") {
      if (!scopes.empty()) scopes.pop_back();
    } else if (tokens[i] == "namespace") {
      std::string name;
      for (++i; i < tokens.size() && (is_word(tokens[i]) || tokens[i] == ":"); ++i) name += tokens[i];
      if (i < tokens.size() && tokens[i] == "{") scopes.emplace_back(name, true);
    } else if (tokens[i] == "{") {
      scopes.emplace_back("", false);
    } else if ((tokens[i] == "class" || tokens[i] == "struct") && i + 2 < tokens.size() && is_word(tokens[i + 1])) {
      if (i > 0 && (tokens[i - 1] == ">" || tokens[i - 1] == "enum" || tokens[i - 1] == "friend")) continue;
      ClassInfo one;
      one.name = tokens[i + 1];
      one.file = file;
      std::size_t at = i + 2;
      if (tokens[at] == "final") ++at;
      if (at >= tokens.size() || (tokens[at] != ":" && tokens[at] != "{")) continue;
      one.bases = bases_from(tokens, at);
      if (at >= tokens.size() || tokens[at] != "{") continue;
      const std::size_t end = behind(tokens, at, "{", "}");
      read_body(tokens, at, end, one);
      bool usable = true;
      for (const auto& [name, is_namespace] : scopes) {
        usable = usable && is_namespace;
        if (!name.empty()) one.scope += (one.scope.empty() ? "" : "::") + name;
      }
      if (usable) found.push_back(std::move(one));
      i = end - 1;
    }
  }
  return found;
}

const std::vector<Role>& roles() {
  static const std::vector<Role> all = {
      {"euler", "euler", true, {"ForwardEuler", "Euler", "ExplicitEuler", "EulerStepper"}, {"euler"}},
      {"trapezoidal",
       "trapezoidal",
       true,
       {"Trapzoidal", "Trapezoidal", "Trapezoid", "TrapezoidalRule"},
       {"trap", "heun"}},
      {"simple", "simple", false, {"SimpleSystem"}, {"simple", "circle"}},
      {"cloth", "cloth", false, {"ClothSystem", "Cloth"}, {"cloth", "fabric"}},
      {"pendulum", "pendulum", false, {"PendulumSystem", "Pendulum", "SimplePendulum"}, {"pendulum"}},
      {"chain",
       "pendulum",
       false,
       {"ChainSystem", "ParticleChain", "PendulumChain", "ChainPendulum"},
       {"chain", "rope"}},
  };
  return all;
}

std::span<const std::string_view> role_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const Role& role : roles()) all.push_back(role.name);
    return all;
  }();
  return names;
}

const Role& role_of(std::string_view name) {
  return *std::find_if(roles().begin(), roles().end(), [&](const Role& role) { return role.name == name; });
}

namespace {

bool same_name(std::string_view a, std::string_view b) { return lower(std::string(a)) == lower(std::string(b)); }

bool holds_word(const std::string& name, const Role& role) {
  const std::string small = lower(name);
  return std::any_of(role.words.begin(), role.words.end(),
                     [&](std::string_view word) { return small.find(word) != std::string::npos; });
}

/// The last role in the table whose word the name holds: "SimpleChain" and "PendulumChain" are chains. Null: none.
const Role* hinted(const std::string& name, bool steppers) {
  const Role* found = nullptr;
  for (const Role& role : roles())
    if (role.stepper == steppers && holds_word(name, role)) found = &role;
  return found;
}

}  // namespace

ClassList::ClassList(std::vector<ClassInfo> all) : all_(std::move(all)) {}

bool ClassList::derives(int i, const std::string& base) const {
  std::vector<std::string> open = at(i).bases;
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (same_name(name, base)) return true;
    if (!seen.insert(name).second) continue;
    for (const ClassInfo& one : all_)
      if (one.name == name) open.insert(open.end(), one.bases.begin(), one.bases.end());
  }
  return false;
}

std::vector<int> ClassList::candidates(bool steppers) const {
  const std::string root = steppers ? "TimeStepper" : "ParticleSystem";
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(all_.size()); ++i) {
    const ClassInfo& one = at(i);
    if (same_name(one.name, root) || one.abstract) continue;
    if ((steppers ? one.declares_step : one.declares_eval) || derives(i, root)) found.push_back(i);
  }
  return found;
}

std::optional<int> ClassList::named(std::string_view name) const {
  for (int i = 0; i < static_cast<int>(all_.size()); ++i)
    if (same_name(at(i).name, name)) return i;
  return {};
}

bool ClassList::is_named(int i, const Role& role) const {
  for (const bool ours : {false, true})
    for (const std::string_view name : role.names)
      if (const auto first = named(name); first && at(*first).ours == ours) return same_name(at(i).name, name);
  // a chain of any other name; of the others the names of old come first, and only then words
  return role.name == "chain" && hinted(at(i).name, false) == &role;
}

bool ClassList::ambiguous(bool steppers) const {
  const std::vector<int> all = candidates(steppers);
  std::map<std::string_view, int> count;
  std::vector<int> extra;
  for (const int i : all) {
    bool taken = false;
    for (const Role& role : roles())
      if (role.stepper == steppers && !taken && is_named(i, role)) taken = true, ++count[role.name];
    if (!taken) extra.push_back(i);
  }
  bool open = false;  // a role without a class, or with several
  for (const Role& role : roles())
    if (role.stepper == steppers)
      open = open || count[role.name] > 1 || (role.name != "chain" && count[role.name] == 0);
  if (steppers) {
    // beside the two that are asked for there is always RK4
    for (const int i : extra)
      for (const Role& role : roles())
        for (const std::string_view name : role.names) open = open || (role.stepper && derives(i, std::string(name)));
    return open && all.size() > 0 && (!extra.empty() || all.size() > count.size());
  }
  return !extra.empty() || (open && all.size() > count.size());
}

double ClassList::rank(int i, const Role& role, const std::map<int, Fits>& fits, const Chosen& so_far) const {
  const auto tried = fits.find(i);
  Fit fit;
  if (tried != fits.end())
    if (const auto found = tried->second.find(role.name); found != tried->second.end()) fit = found->second;
  const bool is = is_named(i, role);
  if (fits.empty()) return is ? 4 : 0;
  const Role* hint = hinted(at(i).name, role.stepper);
  const bool of_another = !is && hint && hint != &role;
  bool taken = false;
  for (const auto& [other, k] : so_far.of) taken = taken || k == i;
  bool child = false;
  for (const std::string_view name : role.names) child = child || derives(i, std::string(name));
  if (is || (child && !of_another)) {
    if (fit.alive && fit.shape) return 5;
    if (is && fit.alive) return 4;
    return child && fit.alive ? 2 : 1;
  }
  // the pendulum's class, with more particles
  const auto pendulum = so_far.of.find("pendulum");
  if (role.name == "chain" && pendulum != so_far.of.end() && pendulum->second == i) return fit.shape ? 3.8 : 1.5;
  if (taken) return 0;
  if (fit.alive && fit.shape) return of_another ? 0.6 : hint == &role ? 3.5 : 3;
  if (hint == &role) return fit.alive ? 2.5 : 0.8;
  return 0;
}

Chosen ClassList::choose(const std::map<int, Fits>& fits, const std::map<std::string, std::string>& wanted) const {
  Chosen chosen;
  for (const Role& role : roles())
    if (const auto says = wanted.find(std::string(role.name)); says != wanted.end())
      for (const int i : candidates(role.stepper))
        if (!chosen.of.count(role.name) && (at(i).name == says->second || at(i).full() == says->second))
          chosen.of[role.name] = i;
  for (const Role& role : roles()) {
    if (chosen.of.count(role.name)) continue;
    std::optional<int> best;
    std::pair<double, int> most{0, 0};
    for (const int i : candidates(role.stepper)) {
      int right = 0;
      if (const auto tried = fits.find(i); tried != fits.end())
        if (const auto fit = tried->second.find(role.name); fit != tried->second.end()) right = fit->second.right;
      const std::pair<double, int> here{rank(i, role, fits, chosen), right};
      if (here.first > 0 && here > most) most = here, best = i;
    }
    if (!best && role.name == "chain" && chosen.of.count("pendulum")) best = chosen.of.at("pendulum");
    if (best) chosen.of[role.name] = *best;
  }
  // a chain of a fixed size, where nothing else could be the pendulum
  if (!chosen.of.count("pendulum") && chosen.of.count("chain")) chosen.of["pendulum"] = chosen.of.at("chain");
  for (const bool steppers : {true, false})
    for (const int i : candidates(steppers)) {
      const bool taken =
          std::any_of(chosen.of.begin(), chosen.of.end(), [&](const auto& of) { return of.second == i; });
      if (!taken) chosen.others.push_back(i);
    }
  return chosen;
}

}  // namespace coursework::classic
