#include "tests/coursework/classic/source_scan.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace coursework::classic {
namespace {

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

}  // namespace

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  std::istringstream lines(code_of(text));
  bool directive = false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find_first_not_of(" \t"), last = line.find_last_not_of(" \t\r");
    directive = directive || (first != line.npos && line[first] == '#');
    for (std::size_t at = 0, end; at < line.size() && !directive; at = end) {
      end = at + 1;
      while (in_word(line[at]) && end < line.size() && in_word(line[end])) ++end;
      const auto c = static_cast<unsigned char>(line[at]);
      if (!std::isspace(c) && !std::isdigit(c)) tokens.push_back(line.substr(at, end - at));
    }
    directive = directive && last != line.npos && line[last] == '\\';  // continued
  }
  return tokens;
}

std::vector<ClassInfo> classes_in(const std::vector<std::string>& tokens, const std::string& file) {
  static const std::set<std::string> no_bases = {"public", "protected", "private", "virtual", "typename"};
  const auto at = [&](std::size_t i) { return i < tokens.size() ? tokens[i] : std::string(" "); };
  std::vector<ClassInfo> found;
  std::vector<std::string> open;  // for each open brace, the name of the scope that it begins, or an empty string
  std::string next;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i] == "{") {
      open.push_back(std::exchange(next, ""));
    } else if (tokens[i] == "}") {
      if (!open.empty()) open.pop_back();
    } else if (tokens[i] == "namespace") {
      for (next.clear(); starts_word(at(i + 1)[0]) || at(i + 1) == ":"; ++i) next += at(i + 1);
      if (at(i + 1) != "{") next.clear();
    } else if ((tokens[i] == "class" || tokens[i] == "struct") && starts_word(at(i + 1)[0])) {
      const std::string before = i > 0 ? tokens[i - 1] : "";
      std::size_t end = i + 2;
      if (at(end) == "final") ++end;
      if (before == "enum" || before == "friend" || (at(end) != ":" && at(end) != "{")) continue;
      ClassInfo one{tokens[i + 1], "", file, {}};
      next = one.name;
      for (; end < tokens.size() && at(end) != "{" && at(end) != ";"; ++end)
        if (starts_word(at(end)[0]) && !no_bases.count(at(end))) one.bases.push_back(at(end));
      for (const std::string& name : open)
        if (!name.empty()) one.scope += (one.scope.empty() ? "" : "::") + name;
      found.push_back(std::move(one));
      i = end - 1;
    }
  }
  return found;
}

bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name) {
  const std::string words[] = {owner, ":", ":", name};
  return std::search(tokens.begin(), tokens.end(), std::begin(words), std::end(words)) != tokens.end();
}

const std::vector<Role>& roles() {
  static const std::vector<Role> all = {
      {"euler", "euler", true, {"ForwardEuler", "Euler", "ExplicitEuler", "EulerStepper"}},
      {"trapezoidal", "trapezoidal", true, {"Trapzoidal", "Trapezoidal", "Trapezoid", "TrapezoidalRule"}},
      {"simple", "simple", false, {"SimpleSystem"}},
      {"cloth", "cloth", false, {"ClothSystem", "Cloth"}},
      {"pendulum", "pendulum", false, {"PendulumSystem", "Pendulum", "SimplePendulum"}},
      {"chain", "pendulum", false, {"ChainSystem", "ParticleChain", "PendulumChain", "ChainPendulum"}},
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

/// The role with this name, or null.
const Role* named_role(const std::string& name) {
  for (const Role& role : roles())
    for (const std::string_view known : role.names)
      if (same_name(known, name)) return &role;
  return nullptr;
}

}  // namespace

bool is_kind(const ClassList& all, const ClassInfo& one, bool stepper) {
  std::vector<std::string> open = one.bases;
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    if (same_name(name, stepper ? "TimeStepper" : "ParticleSystem")) return true;
    if (!seen.insert(name).second) continue;
    for (const ClassInfo& base : all)
      if (base.name == name) open.insert(open.end(), base.bases.begin(), base.bases.end());
  }
  return false;
}

std::vector<Candidate> candidates(const ClassList& all, const Role& role,
                                  const std::map<std::string, std::string>& wanted) {
  const auto says = wanted.find(std::string(role.name));
  std::vector<Candidate> named, others;
  for (const ClassInfo& one : all) {
    if (says != wanted.end() && (one.name == says->second || one.full() == says->second)) return {{&one, true, true}};
    // A class that is named like a pendulum may also be the chain, and vice versa: a pendulum with more particles is a
    // chain, and a chain of two particles is a pendulum.
    if (const Role* bears = named_role(one.name); bears == &role)
      named.push_back({&one, true, true});
    else if ((!bears || bears->part == role.part) && is_kind(all, one, role.stepper) && !same_name(one.name, "RK4"))
      others.push_back({&one, false, bears != nullptr});
  }
  named.insert(named.end(), others.begin(), others.end());
  return named;
}

const ClassInfo* named(const ClassList& all, std::string_view name) {
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const ClassInfo& one) { return same_name(one.name, name); });
  return found == all.end() ? nullptr : &*found;
}

namespace {

std::string stem(const std::string& path) {
  const std::string name = flat_name(path);
  return name.substr(0, name.rfind('.'));
}

/// Returns false for hidden files, and for names with characters that a quoted name in an option or an include cannot
/// contain.
bool counts(const std::string& path) {
  return path[0] != '.' && path.find("/.") == path.npos && std::none_of(path.begin(), path.end(), [](char c) {
           return static_cast<unsigned char>(c) < 32 || c == '"' || c == '\\' || c == '<' || c == '>';
         });
}

/// Folder of the hand-out's `check` with a trailing slash, if it was handed in too.
std::string folder_of_check(const Files& files) {
  for (const auto& [path, content] : files)
    if (path.ends_with("check/check_main.cpp")) return path.substr(0, path.rfind('/') + 1);
  return "/";  // no path begins like this
}

bool is_of_vecmath(const std::string& path) {
  static const std::set<std::string> stems = {"vecmath",  "vector2f", "vector3f", "vector4f",
                                              "matrix2f", "matrix3f", "matrix4f", "quat4f"};
  return stems.count(stem(path)) > 0;
}

/// Classes whose evalF or takeStep is defined out of class: "A" for "A::evalF(".
std::set<std::string> owners_in(const std::string& text) {
  const std::vector<std::string> tokens = tokens_of(text);
  std::set<std::string> owners;
  for (std::size_t i = 0; i + 4 < tokens.size(); ++i)
    if (tokens[i + 1] == ":" && tokens[i + 2] == ":" && (tokens[i + 3] == "evalF" || tokens[i + 3] == "takeStep") &&
        tokens[i + 4] == "(" && (i == 0 || (tokens[i - 1] != "." && tokens[i - 1] != ";" && tokens[i - 1] != "=")))
      owners.insert(tokens[i]);
  return owners;
}

/// The highest folder that contains `path` but not `other`; `path` itself if they are in the same folder.
std::string apart_from(const std::string& path, const std::string& other) {
  const auto differ = std::mismatch(path.begin(), path.end(), other.begin(), other.end()).first;
  const std::size_t slash = path.find('/', static_cast<std::size_t>(differ - path.begin()));
  return slash == std::string::npos ? path : path.substr(0, slash + 1);
}

}  // namespace

bool is_header(const std::string& path) { return is_cpp(path) && !is_source(path); }
std::string flat_name(const std::string& path) { return lower(base_name(without_copy_marks(path))); }

Selection choose_files(const Files& all, const std::string& preferred) {
  Selection chosen;
  const std::string check = folder_of_check(all);
  std::vector<std::string> paths;
  std::map<std::string, std::set<std::string>> owners;  // source -> classes that it defines
  bool own_vecmath = false;
  for (const auto& [path, content] : all) {
    if (!counts(path) || path.starts_with(check)) continue;
    paths.push_back(path);
    if (is_source(path)) owners[path] = owners_in(content);
    // the header alone suffices if it computes lengths itself with sqrt
    own_vecmath =
        own_vecmath || (stem(path) == "vector3f" && (is_source(path) || content.find("sqrt") != content.npos));
  }
  if (!own_vecmath) std::erase_if(paths, is_of_vecmath);
  const auto leave_out = [&](const char* key, const std::string& path, const std::string& kept,
                             const std::string& word = "") {
    chosen.notes.push_back({key, {path, kept, word}});
    chosen.files.erase(path);
    if (const std::string other = apart_from(path, kept);
        all.at(path) != all.at(kept) && !std::count(chosen.others.begin(), chosen.others.end(), other))
      chosen.others.push_back(other);
  };

  const auto rank = [&](const std::string& path) {
    const bool called_otherwise = std::none_of(owners[path].begin(), owners[path].end(),
                                               [&](const std::string& owner) { return lower(owner) == stem(path); });
    return std::tuple(!path.starts_with(preferred), is_backup(path), is_source(path) && called_otherwise,
                      std::count(path.begin(), path.end(), '/'), path);
  };
  std::sort(paths.begin(), paths.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  std::map<std::string, std::string> by_name, defined;  // flat name -> path, class -> path
  for (const std::string& path : paths) {
    const std::string name = flat_name(path);
    constexpr std::size_t longest = 200;  // bytes; file systems accept 255
    if (name.size() > longest) {
      chosen.notes.push_back({"whole.name", {path.substr(0, 100) + "..."}});
      continue;
    }
    if (const auto [at, added] = by_name.emplace(name, path); !added) {
      leave_out("whole.twice", path, at->second);
      continue;
    }
    chosen.files[path] = all.at(path);
    // detects sources of different names that define the same classes
    std::string clash;
    bool needed = owners[path].empty();
    for (const std::string& owner : owners[path])
      if (const auto [at, added] = defined.emplace(owner, path); added)
        needed = true;
      else
        clash = at->second;
    if (!needed)
      leave_out("whole.same_class", path, clash, *owners[path].begin());
    else if (!clash.empty())
      chosen.others.push_back(path);
  }
  return chosen;
}

}  // namespace coursework::classic
