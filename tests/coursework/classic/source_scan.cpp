// The tokeniser, the queries on its tokens, and the choice of a submission's files.
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

/// Position after the comment, string or preprocessor line that begins at `at`; `at` itself if none does.
std::size_t skip(const std::string& text, std::size_t at, bool first_of_line) {
  const auto past = [&](const char* end, std::size_t from) {
    const std::size_t found = text.find(end, from);
    return found == std::string::npos ? text.size() : found + std::string(end).size();
  };
  if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
  if (text.compare(at, 2, "/*") == 0) return past("*/", at + 2);
  if (text[at] == '#' && first_of_line) {
    while (at < text.size() && text[at] != '\n') at += text[at] == '\\' && at + 1 < text.size() ? 2 : 1;
    return std::min(at, text.size());
  }
  if (text[at] != '"' && text[at] != '\'') return at;
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

}  // namespace

std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  bool first = true;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    if (std::isspace(static_cast<unsigned char>(c))) {
      first = first || c == '\n';
      ++at;
      continue;
    }
    if (const std::size_t next = skip(text, at, first); next != at) {
      at = next;
      continue;
    }
    first = false;
    std::size_t end = at + 1;
    if (in_word(c))
      while (end < text.size() && in_word(text[end])) ++end;
    if (starts_word(c) || !in_word(c)) tokens.push_back(text.substr(at, end - at));
    at = end;
  }
  return tokens;
}

std::vector<ClassInfo> classes_in(const std::vector<std::string>& tokens, const std::string& file) {
  static const std::set<std::string> no_bases = {"public", "protected", "private", "virtual", "typename"};
  const auto at = [&](std::size_t i) { return i < tokens.size() ? tokens[i] : std::string(" "); };
  std::vector<ClassInfo> found;
  std::vector<std::pair<std::string, bool>> open;  // name of each open brace, and whether it is a scope
  std::pair<std::string, bool> next;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i] == "{") {
      open.push_back(std::exchange(next, {}));
    } else if (tokens[i] == "}") {
      if (!open.empty()) open.pop_back();
    } else if (tokens[i] == "extern" && at(i + 1) == "{") {
      next.second = true;
    } else if (tokens[i] == "namespace") {
      std::string name;
      for (; starts_word(at(i + 1)[0]) || at(i + 1) == ":"; ++i) name += at(i + 1);
      if (at(i + 1) == "{") next = {name, true};
    } else if ((tokens[i] == "class" || tokens[i] == "struct") && starts_word(at(i + 1)[0])) {
      const std::string before = i > 0 ? tokens[i - 1] : "";
      std::size_t end = i + 2;
      if (at(end) == "final") ++end;
      if (before == "enum" || before == "friend" || (at(end) != ":" && at(end) != "{")) continue;
      ClassInfo one{tokens[i + 1], "", file, {}, before != ">"};
      next = {one.name, true};
      for (; end < tokens.size() && at(end) != "{" && at(end) != ";"; ++end)
        if (starts_word(at(end)[0]) && !no_bases.count(at(end))) one.bases.push_back(at(end));
      for (const auto& [name, is_scope] : open) {
        one.usable = one.usable && is_scope;
        if (!name.empty()) one.scope += (one.scope.empty() ? "" : "::") + name;
      }
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

std::string with_includes(const std::string& text,
                          const std::function<std::string(const std::string& name, bool in_brackets)>& lead) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    std::size_t at = line.find_first_not_of(" \t");
    if (at == std::string::npos || line[at] != '#') continue;
    at = line.find_first_not_of(" \t", at + 1);
    if (at == std::string::npos || line.compare(at, 7, "include") != 0) continue;
    at = line.find_first_of("\"<", at + 7);
    if (at == std::string::npos) continue;
    const bool in_brackets = line[at] == '<';
    const std::size_t end = line.find(in_brackets ? '>' : '"', at + 1);
    if (end == std::string::npos) continue;
    if (const std::string to = lead(line.substr(at + 1, end - at - 1), in_brackets); !to.empty())
      line.replace(at, end + 1 - at, to);
  }
  return out;
}

namespace {

bool ends(const std::string& path, const std::set<std::string>& endings) {
  const std::size_t dot = path.rfind('.');
  return dot != std::string::npos && endings.count(lower(path.substr(dot + 1))) > 0;
}
std::string stem(const std::string& path) {
  const std::string name = flat_name(path);
  return name.substr(0, name.rfind('.'));
}

bool counts(const std::string& path) {
  // rejects hidden files, and characters that a quoted name in an option or an include cannot contain
  const bool plain = std::none_of(path.begin(), path.end(), [](char c) {
    return static_cast<unsigned char>(c) < 32 || c == '"' || c == '\\' || c == '<' || c == '>';
  });
  return plain && (is_header(path) || is_source(path)) && path[0] != '.' && path.find("/.") == std::string::npos &&
         !in_library(path);
}

/// Folder of the hand-out's `check`, with a trailing slash, if it was handed in along with the rest.
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

bool is_header(const std::string& path) { return ends(path, {"h", "hpp", "hh", "hxx", "inl"}); }
bool is_source(const std::string& path) { return ends(path, {"cpp", "cc", "cxx", "c++"}); }
std::string flat_name(const std::string& path) { return lower(base_name(without_copy_marks(path))); }

Selection choose_files(const Files& all, const std::string& preferred) {
  Selection chosen;
  const std::string check = folder_of_check(all);
  std::vector<std::string> paths;
  bool own_vecmath = false;
  for (const auto& [path, content] : all) {
    if (!counts(path) || path.starts_with(check)) continue;
    paths.push_back(path);
    // the header alone suffices if it computes lengths itself
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
    return std::tuple(!path.starts_with(preferred), is_backup(path), std::count(path.begin(), path.end(), '/'));
  };
  std::sort(paths.begin(), paths.end(),
            [&](const auto& a, const auto& b) { return std::tuple(rank(a), a) < std::tuple(rank(b), b); });
  std::map<std::string, std::string> by_name;
  for (const std::string& path : paths) {
    const std::string name = flat_name(path);
    constexpr std::size_t longest = 200;  // byte; file systems take 255
    if (name.size() > longest)
      chosen.notes.push_back({"whole.name", {path.substr(0, 100) + "..."}});
    else if (const auto [at, added] = by_name.emplace(name, path); added)
      chosen.files[path] = all.at(path);
    else
      leave_out("whole.twice", path, at->second);
  }

  // sources of different names that define the same classes: prefers the one named after its class
  std::map<std::string, std::set<std::string>> owners;
  std::erase_if(paths, [&](const std::string& path) { return !is_source(path) || !chosen.files.count(path); });
  for (const std::string& path : paths) owners[path] = owners_in(all.at(path));
  const auto called_otherwise = [&](const std::string& path) {
    return std::none_of(owners[path].begin(), owners[path].end(),
                        [&](const auto& x) { return lower(x) == stem(path); });
  };
  std::stable_sort(paths.begin(), paths.end(), [&](const auto& a, const auto& b) {
    return std::tuple(!a.starts_with(preferred), called_otherwise(a)) <
           std::tuple(!b.starts_with(preferred), called_otherwise(b));
  });
  std::map<std::string, std::string> defined;  // class -> path
  for (const std::string& path : paths) {
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
