// Descriptions of additions, stored next to this file: a new file with its text, and changed lines of existing files.
#pragma once

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "mysim/base/files.h"

namespace crosscheck::testing_tools {

struct Addition {
  std::map<std::string, std::string> created;  // text by path
  struct Change {
    std::string line;         // must occur in the file exactly once
    std::string replacement;  // the old line with added lines, or lines that replace it
  };
  std::map<std::string, std::vector<Change>> edited;  // tables, by path
  std::map<std::string, std::vector<Change>> listed;  // CMake files with source lists, by path
};

/// Reads `new: PATH` and the file's text; then `in: PATH` and `list: PATH`, each followed by pairs of lines `after:`
/// and `add:`, or `line:` and `becomes:`.
inline Addition read_addition(const std::filesystem::path& file) {
  Addition addition;
  std::string* text = nullptr;
  std::vector<Addition::Change>* changes = nullptr;
  std::istringstream in(read_file(file, "an addition"));
  for (std::string line; std::getline(in, line);) {
    const auto rest = [&](std::string_view key) { return line.substr(std::min(line.size(), key.size())); };
    if (line.starts_with("new: ")) {
      text = &addition.created[rest("new: ")];
    } else if (line.starts_with("in: ")) {
      changes = &addition.edited[rest("in: ")];
    } else if (line.starts_with("list: ")) {
      changes = &addition.listed[rest("list: ")];
    } else if (!changes && text) {
      *text += line + "\n";
    } else if (changes && line.starts_with("after: ")) {
      changes->push_back({rest("after: "), rest("after: ")});
    } else if (changes && line.starts_with("line: ")) {
      changes->push_back({rest("line: "), ""});
    } else if (changes && !changes->empty() && line.starts_with("add: ")) {
      changes->back().replacement += "\n" + rest("add: ");
    } else if (changes && !changes->empty() && line.starts_with("becomes: ")) {
      changes->back().replacement = rest("becomes: ");
    } else {
      throw std::invalid_argument(fmt::format("{}: unexpected line '{}'", file.string(), line));
    }
  }
  return addition;
}

/// Applies changes to a text. Throws std::invalid_argument if a line to change does not occur exactly once.
inline std::string with_changes(std::string text, const std::vector<Addition::Change>& changes) {
  for (const Addition::Change& change : changes) {
    const std::string line = "\n" + change.line + "\n";
    const size_t at = text.find(line);
    if (at == std::string::npos || text.find(line, at + 1) != std::string::npos)
      throw std::invalid_argument(fmt::format("expected exactly once: '{}'", change.line));
    text.replace(at + 1, change.line.size(), change.replacement);
  }
  return text;
}

/// Writes the new and the changed files below `out`. A new scene's folder also gets links to the existing scenes.
inline void write_addition(const Addition& addition, const std::filesystem::path& source,
                           const std::filesystem::path& out) {
  for (const auto& [path, text] : addition.created) {
    write_file(out / path, text);
    if (!path.ends_with(".toml")) continue;
    for (const auto& entry : std::filesystem::directory_iterator((source / path).parent_path())) {
      const auto link = (out / path).parent_path() / entry.path().filename();
      if (!std::filesystem::exists(link) && (entry.is_directory() || entry.path().extension() == ".toml"))
        std::filesystem::create_symlink(entry.path(), link);
    }
  }
  for (const auto& [path, changes] : addition.edited) {
    try {
      write_file(out / path, with_changes(read_file(source / path, "a source"), changes));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(path + ": " + error.what());
    }
  }
}

}  // namespace crosscheck::testing_tools
