#include "tests/coursework/grader/layouts.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "mysim/base/errors.h"
#include "mysim/base/hash.h"
#include "mysim/base/names.h"
#include "mysim/base/pattern.h"
#include "tests/coursework/grader/result.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// Pattern of exported file names, with groups for the person and for the original file name.
struct Layout {
  const char* name;
  const char* pattern;
  int person, late, number, file;  // groups of the pattern, 0 if missing
};
constexpr Layout layouts[] = {
    {"Moodle", "(.+)_([0-9]+)_assignsubmission_(file|onlinetext)_?(.*)", 1, 0, 2, 4},
    {"Canvas", "([^_]+)(_LATE)?_([0-9]{2,})_([0-9]{2,})_(.+)", 1, 2, 3, 5},
};

struct Exported {
  std::string layout;  // empty if the name has no known layout
  std::string person, id, file;
  bool late = false;
  std::string key() const { return id.empty() ? person : person + "_" + id; }
};

Exported taken_apart(const std::string& name) {
  for (const Layout& layout : layouts)
    if (const auto parts = crosscheck::Pattern(layout.pattern).match(name)) {
      const auto group = [&](int i) { return (*parts)[static_cast<std::size_t>(i)]; };
      // Canvas appends a number to resubmissions: rk4-1.cpp
      return {layout.name, group(layout.person), group(layout.number),
              crosscheck::Pattern("-[0-9]+(\\.[^.]+)$").replaced_in(group(layout.file), "$1"),
              layout.late > 0 && !group(layout.late).empty()};
    }
  return {"", name, "", name};
}

constexpr const char* gradescope_file = "submission_metadata.yml";

/// People by submission. The file has lines "submission_N:", followed by "- :name: NAME" for each person, then ids.
std::map<std::string, std::vector<Person>> gradescope_people(const fs::path& folder) {
  std::map<std::string, std::vector<Person>> people;
  std::ifstream in(crosscheck::path_inside(folder, gradescope_file));
  const crosscheck::Pattern begins("(submission_[0-9]+):\\s*"), is_name("\\s*-?\\s*:name:\\s*['\"]?(.*?)['\"]?\\s*"),
      is_id("\\s*:(?:sid|email):\\s*['\"]?(.*?)['\"]?\\s*");
  std::string submission;
  for (std::string line; std::getline(in, line);) {
    if (const auto found = begins.match(line))
      submission = (*found)[1];
    else if (const auto name = is_name.match(line); name && !submission.empty())
      people[submission].push_back({(*name)[1]});
    else if (const auto id = is_id.match(line); id && !people[submission].empty())
      if (Person& last = people[submission].back(); last.id.empty()) last.id = (*id)[1];
  }
  return people;
}

/// True for files that macOS, Windows and Git leave in folders.
bool left_by_system(const std::string& name) {
  static constexpr const char* names[] = {".DS_Store", "__MACOSX",       ".git",       ".gitignore",
                                          "Thumbs.db", ".gitattributes", "desktop.ini"};
  return name.starts_with("._") || std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// The name on one line. If characters must be replaced by '?', a hash is appended.
std::string shown_name(const std::string& name) {
  if (const std::string text = plain_utf8(name); crosscheck::is_printable(text)) return text;
  return fmt::format("{} ({:08x})", printable(crosscheck::printable(name)), crosscheck::Fnv1a::of(name) & 0xffffffffu);
}

std::vector<fs::path> entries_of(const fs::path& folder, std::vector<std::string>* skipped = nullptr) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder))
    if (!left_by_system(entry.path().filename().string()))
      entries.push_back(entry.path());
    else if (skipped)
      skipped->push_back(shown_name(entry.path().filename().string()));
  std::sort(entries.begin(), entries.end());
  if (skipped) std::sort(skipped->begin(), skipped->end());
  return entries;
}

/// Names of the C++ files in the folder or one folder below, in lower case.
std::set<std::string> sources_in(const fs::path& folder) {
  std::set<std::string> names;
  const auto options = fs::directory_options::skip_permission_denied;
  for (auto at = fs::recursive_directory_iterator(folder, options); at != fs::recursive_directory_iterator(); ++at) {
    if (at.depth() >= 1) at.disable_recursion_pending();
    const std::string name = lower(at->path().filename().string());
    if ((is_cpp(name) && name.find(".c") != std::string::npos) || is_python(name)) names.insert(name);
  }
  return names;
}

}  // namespace

std::string without_archive_ending(std::string name) {
  while (is_archive(name) && !fs::path(name).stem().empty()) name = fs::path(name).stem().string();
  return name;
}

std::vector<Handed> submissions_in(const fs::path& folder, std::vector<std::string>* skipped) {
  if (!fs::is_directory(folder))
    throw crosscheck::InputError(fmt::format("{}: expected a folder of submissions", folder.string()));
  const std::map<std::string, std::vector<Person>> people = gradescope_people(folder);
  std::map<std::string, Handed> all;
  for (const fs::path& entry : entries_of(folder, skipped)) {
    const std::string name = entry.filename().string();
    if (name == gradescope_file) continue;
    const Exported one = taken_apart(name);
    Handed& handed = all[one.key()];
    handed.late |= one.late;
    handed.files.emplace_back(entry, one.file.empty() ? name : one.file);
    if (handed.files.size() > 1) continue;
    handed.layout = one.layout;
    handed.name = shown_name(one.key());
    handed.people = {{shown_name(one.layout.empty() ? without_archive_ending(name) : one.person), one.id}};
    if (const auto known = people.find(name); known != people.end() && !known->second.empty()) {
      handed.layout = "Gradescope";
      handed.people = known->second;
      std::string names;
      for (const Person& person : handed.people) names += (names.empty() ? "" : " + ") + person.name;
      handed.name = shown_name(fmt::format("{} ({})", names, name));
    }
  }
  std::vector<Handed> list;
  std::set<std::string> names;
  for (auto& [key, handed] : all) {
    if (!names.insert(handed.name).second)
      handed.name = fmt::format("{} ({:08x})", handed.name, crosscheck::Fnv1a::of(key) & 0xffffffffu);
    list.push_back(std::move(handed));
  }
  return list;
}

std::string class_layout(const fs::path& folder, const std::vector<std::string>& wanted) {
  if (!fs::is_directory(folder)) return "";
  if (fs::exists(folder / gradescope_file)) return "Gradescope";
  std::map<std::string, std::set<std::string>> people;  // by layout
  std::map<std::string, int> holds;                     // source name -> number of folders with such a source
  int clones = 0, archives = 0;
  for (const fs::path& entry : entries_of(folder)) {
    const std::string name = entry.filename().string();
    if (name[0] == '.') continue;  // skips settings and histories of editors
    const Exported one = taken_apart(name);
    if (!one.layout.empty()) people[one.layout].insert(one.key());
    if (fs::is_directory(entry)) {
      clones += fs::exists(entry / ".git");
      for (const std::string& source : sources_in(entry))
        if (wanted.empty() || std::find(wanted.begin(), wanted.end(), source) != wanted.end()) ++holds[source];
    } else if ((is_cpp(name) || is_python(name)) && one.layout.empty()) {
      return "";  // a single person
    } else {
      archives += is_archive(entry);
    }
  }
  for (const auto& [layout, who] : people)
    if (who.size() > 1) return layout;
  if (clones > 1) return "Git";
  // requires more than two folders, because two could be a program and its copy
  const bool alike = std::any_of(holds.begin(), holds.end(), [](const auto& each) { return each.second > 2; });
  return alike || archives > 2 ? "folders" : "";
}

}  // namespace coursework
