// The tokeniser, what is read off its tokens, and which files of a submission count.
#include "tests/coursework/classic/source_scan.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace coursework::classic {
namespace {

bool starts_word(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Behind the comment, string or line of the preprocessor that begins at `at`; `at` itself where none does.
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

std::optional<std::string> defines_class(const std::vector<std::string>& tokens, const std::string& name) {
  for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
    if ((tokens[i] != "class" && tokens[i] != "struct") || lower(tokens[i + 1]) != lower(name)) continue;
    const std::string& next = tokens[i + 2] == "final" && i + 3 < tokens.size() ? tokens[i + 3] : tokens[i + 2];
    if (next == ":" || next == "{") return tokens[i + 1];
  }
  return {};
}

bool defines_member(const std::vector<std::string>& tokens, const std::string& owner, const std::string& name) {
  for (std::size_t i = 0; i + 3 < tokens.size(); ++i)
    if (tokens[i] == owner && tokens[i + 1] == ":" && tokens[i + 2] == ":" && tokens[i + 3] == name) return true;
  return false;
}

GlNames gl_names_in(const std::vector<std::string>& tokens) {
  GlNames found;
  std::set<std::string> own;
  const auto begins = [](const std::string& word, const char* prefix) {
    const std::size_t size = std::string(prefix).size();
    return word.size() > size && word.compare(0, size, prefix) == 0;
  };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& word = tokens[i];
    for (const char* prefix : {"GL_", "GLU_", "GLUT_", "GLFW_"})
      if (begins(word, prefix)) found.constants.insert(word);
    const bool called = i + 1 < tokens.size() && tokens[i + 1] == "(";
    if (!called || (i > 0 && (tokens[i - 1] == "." || tokens[i - 1] == ":" || tokens[i - 1] == ">"))) continue;
    for (const char* prefix : {"gl", "glu", "glut", "glfw"})
      if (begins(word, prefix) && std::isupper(static_cast<unsigned char>(word[std::string(prefix).size()])))
        found.functions.insert(word);
    // "void glFlag(": a function of the student's that is only called so
    if (i > 0 && starts_word(tokens[i - 1][0]) && tokens[i - 1] != "return" && tokens[i - 1] != "else")
      own.insert(word);
  }
  for (const std::string& word : own) found.functions.erase(word);
  return found;
}

namespace {

/// Where the name of an include begins and how long it is; nothing where the line is none.
std::optional<std::pair<std::size_t, std::size_t>> include_in(const std::string& line) {
  std::size_t at = line.find_first_not_of(" \t");
  if (at == std::string::npos || line[at] != '#') return {};
  at = line.find_first_not_of(" \t", at + 1);
  if (at == std::string::npos || line.compare(at, 7, "include") != 0) return {};
  at = line.find_first_of("\"<", at + 7);
  if (at == std::string::npos) return {};
  const std::size_t end = line.find(line[at] == '<' ? '>' : '"', at + 1);
  if (end == std::string::npos) return {};
  return std::pair{at + 1, end - at - 1};
}

}  // namespace

std::vector<std::string> includes_of(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto place = include_in(line)) found.push_back(line.substr(place->first, place->second));
  return found;
}

std::string with_includes(const std::string& text, std::string (*rename)(const std::string&)) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (const auto place = include_in(line))
      line.replace(place->first, place->second, rename(line.substr(place->first, place->second)));
    out += line + "\n";
  }
  return out;
}

namespace {

const std::set<std::string> of_vecmath = {"vecmath",  "vector2f", "vector3f", "vector4f",
                                          "matrix2f", "matrix3f", "matrix4f", "quat4f"};
std::string stem(const std::string& path) {
  const std::string name = lower(base_name(path));
  return name.substr(0, name.rfind('.'));
}

std::vector<std::string> words_of(const std::string& path) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t end; (end = path.find('/', begin)) != std::string::npos; begin = end + 1)
    words.push_back(path.substr(begin, end - begin));
  words.push_back(path.substr(begin));
  return words;
}

bool counts(const std::string& path) {
  if (!is_header(path) && !is_source(path)) return false;
  // what a quoted name in an option or an include cannot hold
  for (const char c : path)
    if (static_cast<unsigned char>(c) < 32 || c == '"' || c == '\\' || c == '<' || c == '>') return false;
  const std::vector<std::string> words = words_of(path);
  for (const std::string& word : words)
    if (word.empty() || word[0] == '.') return false;
  return !in_library(path);
}

/// Longer than file systems take, with room for the folders above.
bool too_long_name(const std::string& path) {
  const std::vector<std::string> words = words_of(path);
  return path.size() > 1000 ||
         std::any_of(words.begin(), words.end(), [](const std::string& word) { return word.size() > 255; });
}

/// A file that would have to be a folder for this one to be written.
std::string file_above(const Files& files, const std::string& path) {
  for (std::size_t at = 0; (at = path.find('/', at)) != std::string::npos; ++at)
    if (files.count(path.substr(0, at))) return path.substr(0, at);
  return "";
}

/// The hand-out's `check`, which comes along with whole folders; its files would stand in for the student's of the same
/// name. With a slash at its end; empty: there is none.
std::string folder_of_check(const Files& files) {
  for (const auto& [path, content] : files)
    if (base_name(path) == "check_main.cpp" && base_name(folder_name(path)) == "check") return folder_name(path) + "/";
  return "";
}

bool brings_vecmath(const Files& files) {
  for (const auto& [path, content] : files) {
    if (stem(path) != "vector3f") continue;
    if (is_source(path)) return true;
    // or header only: the length is computed there
    const std::vector<std::string> tokens = tokens_of(content);
    const std::vector<std::string> body = {"abs", "(", ")", "const", "{"};
    if (std::search(tokens.begin(), tokens.end(), body.begin(), body.end()) != tokens.end()) return true;
  }
  return false;
}

}  // namespace

std::string folder_name(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}
namespace {
bool ends(const std::string& path, const std::set<std::string>& endings) {
  const std::size_t dot = path.rfind('.');
  return dot != std::string::npos && endings.count(lower(path.substr(dot + 1))) > 0;
}
}  // namespace
bool is_header(const std::string& path) { return ends(path, {"h", "hpp", "hh", "hxx", "inl"}); }
bool is_source(const std::string& path) { return ends(path, {"cpp", "cc", "cxx", "c++"}); }

namespace {

/// Whether the text is about particles: such files say which of two copies of a whole is the submission.
bool about_particles(const std::vector<std::string>& tokens) {
  return std::any_of(tokens.begin(), tokens.end(), [](const std::string& word) {
    return word == "evalF" || word == "takeStep" || word == "ParticleSystem" || word == "TimeStepper";
  });
}

/// Owners of what stands outside of its class: "A" of "A::evalF(" and "A::takeStep(".
std::set<std::string> owners_in(const std::vector<std::string>& tokens) {
  std::set<std::string> owners;
  for (std::size_t i = 0; i + 4 < tokens.size(); ++i)
    if (tokens[i + 1] == ":" && tokens[i + 2] == ":" && (tokens[i + 3] == "evalF" || tokens[i + 3] == "takeStep") &&
        tokens[i + 4] == "(" && (i == 0 || (tokens[i - 1] != "." && tokens[i - 1] != ";" && tokens[i - 1] != "=")))
      owners.insert(tokens[i]);
  return owners;
}

/// Sources that define nothing but what others define too, whatever they are called: the linker would take one of them.
void leave_out_doubles(Files& files, const FullerCopy& fuller, std::vector<Remark>& notes) {
  std::map<std::string, std::set<std::string>> owners;  // by path
  std::map<std::string, std::vector<std::string>> paths;
  for (const auto& [path, content] : files)
    if (is_source(path))
      for (const std::string& owner : owners[path] = owners_in(tokens_of(content))) paths[owner].push_back(path);
  const auto better = [&](const std::string& a, const std::string& b) {
    // the one that is called as a class that it defines
    const auto fits = [&](const std::string& path) {
      return std::any_of(owners[path].begin(), owners[path].end(),
                         [&](const std::string& owner) { return lower(owner) == stem(path); });
    };
    if (fits(a) != fits(b)) return fits(a);
    if (owners[a].size() != owners[b].size()) return owners[a].size() > owners[b].size();
    return fuller(a, b);
  };
  for (const auto& [path, mine] : owners) {
    std::string kept;
    const bool others = !mine.empty() && std::all_of(mine.begin(), mine.end(), [&](const std::string& owner) {
      const auto& all = paths[owner];
      const auto best = std::min_element(all.begin(), all.end(), better);
      kept = *best;
      return *best != path;
    });
    if (!others) continue;
    notes.push_back({"whole.same_class", {path, kept, *mine.begin()}});
    files.erase(path);
  }
}

}  // namespace

Files choose_files(const Files& all, std::vector<Remark>& notes) {
  Files files;
  const std::string check = folder_of_check(all);
  for (const auto& [path, content] : all) {
    if (!counts(path) || (!check.empty() && path.rfind(check, 0) == 0)) continue;
    if (too_long_name(path))
      notes.push_back({"whole.name", {path.substr(0, 100) + "..."}});
    else
      files[path] = content;
  }
  if (!brings_vecmath(files))
    for (auto it = files.begin(); it != files.end();)
      it = of_vecmath.count(stem(it->first)) ? files.erase(it) : std::next(it);

  std::map<std::string, double> weights;
  for (const auto& [path, content] : files)
    if (!of_vecmath.count(stem(path))) weights[path] = about_particles(tokens_of(content)) ? 1000 : 1;
  const FullerCopy fuller(std::move(weights));
  std::map<std::string, std::string> taken;  // lower-case name, without what backups add -> path
  const auto key = [](const std::string& path) { return lower(base_name(without_copy_marks(path))); };
  for (const auto& [path, content] : files) {
    std::string& chosen = taken[key(path)];
    if (chosen.empty() || fuller(path, chosen)) chosen = path;
  }
  Files kept;
  for (const auto& [path, content] : files) {
    const std::string& chosen = taken[key(path)];
    if (chosen != path)
      notes.push_back({"whole.twice", {path, chosen}});
    else
      kept[without_copy_marks(path)] = content;  // where only the copy is there, includes mean it by its old name
  }
  files = std::move(kept);
  leave_out_doubles(files, fuller, notes);
  // an archive may hold a file and files below it; the shorter name comes first
  for (auto it = files.begin(); it != files.end();) {
    const std::string above = file_above(files, it->first);
    if (!above.empty()) notes.push_back({"whole.below", {it->first, above}});
    it = above.empty() ? std::next(it) : files.erase(it);
  }
  return files;
}

}  // namespace coursework::classic
