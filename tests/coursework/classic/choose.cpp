// Which files of a submission count.
#include <algorithm>
#include <cctype>

#include "tests/coursework/classic/survey.h"

namespace coursework::classic {
namespace {

const std::set<std::string> of_vecmath = {"vecmath",  "vector2f", "vector3f", "vector4f",
                                          "matrix2f", "matrix3f", "matrix4f", "quat4f"};
/// Libraries for drawing that some submissions bring along: ours do nothing and need no display.
const std::set<std::string> drawing_folders = {"gl",   "glu", "glut", "freeglut", "glfw",       "opengl",
                                               "glad", "khr", "glew", "build",    "cmakefiles", "__macosx"};

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
  return std::none_of(words.begin(), words.end() - 1,
                      [](const std::string& word) { return drawing_folders.count(lower(word)) > 0; });
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

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}
std::string base_name(const std::string& path) { return path.substr(path.rfind('/') + 1); }
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

  std::map<std::string, int> crowd;
  for (const auto& [path, content] : files)
    if (!of_vecmath.count(stem(path))) ++crowd[folder_name(path)];
  std::map<std::string, std::string> taken;  // lower-case name -> path
  const auto better = [&](const std::string& a, const std::string& b) {
    const std::string in_a = folder_name(a), in_b = folder_name(b);
    if (crowd[in_a] != crowd[in_b]) return crowd[in_a] > crowd[in_b];
    const auto depth = [](const std::string& p) { return std::count(p.begin(), p.end(), '/'); };
    return depth(a) != depth(b) ? depth(a) < depth(b) : a < b;
  };
  for (const auto& [path, content] : files) {
    std::string& chosen = taken[lower(base_name(path))];
    if (chosen.empty() || better(path, chosen)) chosen = path;
  }
  for (auto it = files.begin(); it != files.end();) {
    const std::string& chosen = taken[lower(base_name(it->first))];
    if (chosen != it->first) notes.push_back({"whole.twice", {it->first, chosen}});
    it = chosen != it->first ? files.erase(it) : std::next(it);
  }
  // an archive may hold a file and files below it; the shorter name comes first
  for (auto it = files.begin(); it != files.end();) {
    const std::string above = file_above(files, it->first);
    if (!above.empty()) notes.push_back({"whole.below", {it->first, above}});
    it = above.empty() ? std::next(it) : files.erase(it);
  }
  return files;
}

}  // namespace coursework::classic
