#include "tests/coursework/grader/copies.h"

#include <iconv.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

#include "mysim/base/text.h"
#include "mysim/scene/toml.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {
namespace {

constexpr const char* leading[] = {"copy of ", "backup of ", "old_", "old ", "bak_"};
/// The marks include the separator, so that "threshold" stays unchanged.
constexpr const char* trailing[] = {
    " - copy", " - kopie", " - 副本", "- copy", "-copy",     "_copy", " copy",     "_old",  "-old",   ".old",
    " old",    ".orig",    "_orig",   "-orig",  "_original", "_bak",  ".bak",      "-bak",  "~",      "_backup",
    "-backup", ".backup",  " backup", ".save",  "_prev",     "-prev", "_previous", " 副本", "的副本", "副本"};
const std::set<std::string> backup_folders = {"old",      "backup", "backups", "bak",        "archive", "archived",
                                              "previous", "prev",   "trash",   "deprecated", "unused",  "copy"};
/// Prefixes of folder names of libraries that some students hand in. vecmath is absent, because students may change it.
constexpr const char* library_folders[] = {"glfw",  "glew",       "freeglut",   "eigen",  "glm",
                                           "imgui", "nanogui",    "boost",      "assimp", "sdl2",
                                           "stb",   "cmakefiles", "cmake-build"};
const std::set<std::string> whole_library_folders = {"fl",   "fltk", "gl",    "glu",          "glut",    "opengl",
                                                     "glad", "khr",  "build", "node_modules", "__macosx"};

bool ends(const std::string& text, const std::string& with) {
  return text.size() > with.size() && text.ends_with(with);
}

/// Removes " (2)" and "(2)", or a number after " copy" and " 副本"; returns false if there is none.
bool cut_number(std::string& stem) {
  std::size_t at = stem.size();
  const bool bracket = at > 0 && stem[at - 1] == ')';
  if (bracket) --at;
  const std::size_t behind = at;
  while (at > 0 && std::isdigit(static_cast<unsigned char>(stem[at - 1]))) --at;
  if (at == behind || at == 0) return false;
  const std::string before = lower(stem.substr(0, at));
  if (bracket ? stem[at - 1] != '(' : !ends(before, " copy ") && !ends(before, " 副本 ")) return false;
  at -= 1;
  while (at > 0 && stem[at - 1] == ' ') --at;
  if (at == 0) return false;
  stem.resize(at);
  return true;
}

std::string unmarked(std::string stem) {
  for (bool more = true; more;) {
    more = cut_number(stem);
    const std::string small = lower(stem);
    for (const std::string mark : leading)
      if (!more && small.starts_with(mark) && small.size() > mark.size()) stem = stem.substr(mark.size()), more = true;
    for (const std::string mark : trailing)
      if (!more && ends(small, mark)) stem.resize(stem.size() - mark.size()), more = true;
  }
  return stem;
}

std::vector<std::string> folders_above(const std::string& path) {
  std::vector<std::string> names;
  std::size_t begin = 0;
  for (std::size_t end; (end = path.find('/', begin)) != std::string::npos; begin = end + 1)
    names.push_back(path.substr(begin, end - begin));
  return names;
}

}  // namespace

std::string without_copy_marks(const std::string& path) {
  const std::size_t slash = path.rfind('/') + 1, dot = path.rfind('.');
  if (dot == std::string::npos || dot <= slash) return path;
  return path.substr(0, slash) + unmarked(path.substr(slash, dot - slash)) + path.substr(dot);
}

bool is_backup(const std::string& path) {
  if (without_copy_marks(path) != path) return true;
  const std::vector<std::string> above = folders_above(path);
  return std::any_of(above.begin(), above.end(), [](const std::string& name) {
    return backup_folders.count(lower(name)) > 0 || unmarked(name) != name || name[0] == '.';
  });
}

bool in_library(const std::string& path) {
  const std::vector<std::string> above = folders_above(path);
  return std::any_of(above.begin(), above.end(), [](const std::string& name) {
    const std::string small = lower(name);
    return whole_library_folders.count(small) > 0 ||
           std::any_of(std::begin(library_folders), std::end(library_folders), [&](const std::string& begin) {
             return small.starts_with(begin) && !std::isalpha(static_cast<unsigned char>(small[begin.size()]));
           });
  });
}

bool is_utf8(std::string_view text) {
  std::size_t at = 0, length = 0;
  while (at < text.size() && (length = crosscheck::utf8_length(text, at)) > 0) at += length;
  return at == text.size();
}

namespace {

/// The text converted to UTF-8; nullopt if it is not in this encoding.
std::optional<std::string> converted(std::string_view text, const char* encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding);
  if (converter == iconv_t(-1)) return {};
  std::string out(2 * text.size(), '\0');  // two input bytes become at most three
  char *from = const_cast<char*>(text.data()), *to = out.data();
  std::size_t left = text.size(), room = out.size();
  const bool whole = iconv(converter, &from, &left, &to, &room) != std::size_t(-1) && left == 0;
  iconv_close(converter);
  if (!whole) return {};
  out.resize(out.size() - room);
  return out;
}

}  // namespace

std::string plain_utf8(std::string text) {
  if (text.starts_with("\xef\xbb\xbf")) return text.substr(3);
  const bool little = text.starts_with("\xff\xfe");
  if (little || text.starts_with("\xfe\xff"))
    return converted(std::string_view(text).substr(2, text.size() / 2 * 2 - 2), little ? "UTF-16LE" : "UTF-16BE")
        .value_or(text);
  return is_utf8(text) ? text : converted(text, "GB18030").value_or(text);
}

std::ptrdiff_t FullerCopy::files_in(const std::string& folder, const std::string& apart_from) const {
  return std::count_if(paths_.begin(), paths_.end(), [&](const std::string& path) {
    return path.starts_with(folder) && (apart_from.empty() || !path.starts_with(apart_from));
  });
}

bool FullerCopy::operator()(const std::string& a, const std::string& b) const {
  if (a == b) return false;
  if (is_backup(a) != is_backup(b)) return is_backup(b);
  const std::vector<std::string> in_a = folders_above(a), in_b = folders_above(b);
  std::string root_a, root_b;  // the common folder, and below it the next folder of a or b, if any
  std::size_t i = 0;
  for (; i < in_a.size() && i < in_b.size() && in_a[i] == in_b[i]; ++i) root_a += in_a[i] + "/";
  root_b = root_a;
  if (i < in_a.size()) root_a += in_a[i] + "/";
  if (i < in_b.size()) root_b += in_b[i] + "/";
  if (root_a != root_b) {
    const auto of_a = files_in(root_a, root_b.starts_with(root_a) ? root_b : "");
    const auto of_b = files_in(root_b, root_a.starts_with(root_b) ? root_a : "");
    if (of_a != of_b) return of_a > of_b;
  }
  if (in_a.size() != in_b.size()) return in_a.size() < in_b.size();
  return a < b;
}

bool StudentChoice::takes(const std::string& path) const {
  if (!path.starts_with(folder)) return false;
  return std::none_of(left_out.begin(), left_out.end(),
                      [&](const std::string& out) { return path == out || path.starts_with(out + "/"); });
}

StudentChoice read_choice(const std::string& text, const std::vector<std::string>& paths,
                          const std::vector<std::string>& roles) {
  const crosscheck::TomlTable table = crosscheck::TomlTable::parse_text(text, choice_file);
  StudentChoice choice;
  const auto clean = [](std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    while (path.starts_with("./")) path.erase(0, 2);
    while (!path.empty() && path.back() == '/') path.pop_back();
    return path;
  };
  const auto holds = [&](const std::string& folder) {
    return std::any_of(paths.begin(), paths.end(),
                       [&](const std::string& path) { return path.starts_with(folder + "/"); });
  };
  if (table.has("folder")) {
    choice.folder = clean(table.text("folder", "a folder of the submission, in quotes"));
    if (!holds(choice.folder)) table.fail("folder", "a folder of the submission that holds sources");
    choice.folder += "/";
  }
  for (const crosscheck::TomlTable& one : table.sections("leave_out")) {
    choice.left_out.push_back(clean(one.text("path", "a file or folder of the submission, in quotes")));
    const std::string& path = choice.left_out.back();
    if (std::find(paths.begin(), paths.end(), path) == paths.end() && !holds(path))
      one.fail("path", "a file or folder of the submission");
  }
  if (!roles.empty() && table.has("classes")) {
    const crosscheck::TomlTable classes = table.section("classes");
    for (const std::string& role : roles)
      if (classes.has(role)) choice.classes[role] = classes.text(role, "the name of a class, in quotes");
  }
  table.finish();
  return choice;
}

}  // namespace coursework
