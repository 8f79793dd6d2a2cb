// Names of files as Moodle, Canvas and Gradescope make them, and folders that hold several people's work.
#include "tests/coursework/grader/layouts.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "mysim/base/names.h"
#include "mysim/base/pattern.h"

namespace coursework {
namespace fs = std::filesystem;
namespace {

/// How names of files are made where they are exported: groups of whose it is, and of the file's own name.
struct Layout {
  const char* name;
  const char* pattern;
  int person, number, file;  // groups; 0: none
};
constexpr Layout layouts[] = {
    {"Moodle", "(.+)_([0-9]+)_assignsubmission_(file|onlinetext)_?(.*)", 1, 2, 4},
    {"Canvas", "([^_]+)(_LATE)?_([0-9]{2,})_([0-9]{2,})_(.+)", 1, 3, 5},
};

struct Exported {
  const char* layout;  // null: none of them
  std::string person, file;
};

Exported taken_apart(const std::string& name) {
  for (const Layout& layout : layouts)
    if (const auto parts = crosscheck::Pattern(layout.pattern).match(name)) {
      const auto group = [&](int i) { return (*parts)[static_cast<std::size_t>(i)]; };
      // Canvas numbers what is handed in again: rk4-1.cpp
      return {layout.name, group(layout.person) + "_" + group(layout.number),
              crosscheck::Pattern("-[0-9]+(\\.[^.]+)$").replaced_in(group(layout.file), "$1")};
    }
  return {nullptr, name, name};
}

constexpr const char* gradescope_file = "submission_metadata.yml";

/// Names of those who handed in, by submission: lines "submission_N:", below it "- :name: NAME" of each of them.
std::map<std::string, std::string> gradescope_names(const fs::path& folder) {
  std::map<std::string, std::string> names;
  std::ifstream in(crosscheck::path_inside(folder, gradescope_file));
  const crosscheck::Pattern begins("(submission_[0-9]+):\\s*"), is_name("\\s*-?\\s*:name:\\s*['\"]?(.*?)['\"]?\\s*");
  std::string submission;
  for (std::string line; std::getline(in, line);) {
    if (const auto found = begins.match(line))
      submission = (*found)[1];
    else if (const auto name = is_name.match(line); name && !submission.empty())
      names[submission] += (names[submission].empty() ? "" : " + ") + (*name)[1];
  }
  return names;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string()[0] != '.') entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// Of the C++ files in it or one folder below, in lower case.
std::set<std::string> sources_in(const fs::path& folder) {
  std::set<std::string> names;
  const auto options = fs::directory_options::skip_permission_denied;
  for (auto at = fs::recursive_directory_iterator(folder, options); at != fs::recursive_directory_iterator(); ++at) {
    if (at.depth() >= 1) at.disable_recursion_pending();
    const std::string name = lower(at->path().filename().string());
    if (is_cpp(name) && name.find(".c") != std::string::npos) names.insert(name);
  }
  return names;
}

}  // namespace

std::vector<Handed> submissions_in(const fs::path& folder) {
  const std::map<std::string, std::string> names = gradescope_names(folder);
  std::map<std::string, Handed> all;
  for (const fs::path& entry : entries_of(folder)) {
    const std::string name = entry.filename().string();
    if (name == gradescope_file) continue;
    const Exported one = taken_apart(name);
    const auto known = names.find(name);
    Handed& handed = all[one.person];
    handed.name = known == names.end() ? one.person : fmt::format("{} ({})", known->second, name);
    handed.files.emplace_back(entry, one.file.empty() ? name : one.file);
  }
  std::vector<Handed> list;
  for (auto& [person, handed] : all) list.push_back(std::move(handed));
  return list;
}

std::string class_layout(const fs::path& folder, const std::vector<std::string>& wanted) {
  if (!fs::is_directory(folder)) return "";
  if (fs::exists(folder / gradescope_file)) return "Gradescope";
  std::map<std::string, std::set<std::string>> people;  // by layout
  std::map<std::string, int> holds;                     // how many folders hold a source of that name
  int clones = 0, archives = 0;
  for (const fs::path& entry : entries_of(folder)) {
    const std::string name = entry.filename().string();
    const Exported one = taken_apart(name);
    if (one.layout) people[one.layout].insert(one.person);
    if (fs::is_directory(entry)) {
      clones += fs::exists(entry / ".git");
      for (const std::string& source : sources_in(entry))
        if (wanted.empty() || std::find(wanted.begin(), wanted.end(), source) != wanted.end()) ++holds[source];
    } else if (is_cpp(name) && !one.layout) {
      return "";  // of one
    } else {
      archives += is_archive(entry);
    }
  }
  for (const auto& [layout, who] : people)
    if (who.size() > 1) return layout;
  if (clones > 1) return "Git";
  // two are somebody's program and a copy of it
  const bool alike = std::any_of(holds.begin(), holds.end(), [](const auto& each) { return each.second > 2; });
  return alike || archives > 2 ? "folders" : "";
}

}  // namespace coursework
