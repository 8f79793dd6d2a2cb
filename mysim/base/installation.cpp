// Reads crosscheck.folders.
#include "mysim/base/installation.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr auto name_of_list = "crosscheck.folders";

struct Folders {
  fs::path data, programs;
};

/// Each line is a key and a folder.
Folders read_folders(const fs::path& list) {
  std::ifstream in(list);
  Folders found;
  std::string key, folder;
  while (in >> key && std::getline(in >> std::ws, folder)) {
    const fs::path path = fs::weakly_canonical(list.parent_path() / folder);
    if (key == "data") found.data = path;
    if (key == "programs") found.programs = path;
  }
  if (found.data.empty() || found.programs.empty())
    throw std::runtime_error(fmt::format("{}: expected two lines, 'data FOLDER' and 'programs FOLDER'", list.string()));
  return found;
}

const Folders& folders() {
  static const Folders found = [] {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    for (fs::path at = program.parent_path();; at = at.parent_path()) {
      if (fs::exists(at / name_of_list)) return read_folders(at / name_of_list);
      if (at == at.parent_path()) break;
    }
    throw std::runtime_error(fmt::format(
        "{}: there is no file {} beside it or above: a program works where it was built or installed, not as a copy",
        program.string(), name_of_list));
  }();
  return found;
}

fs::path named(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace

fs::path data_folder() { return folders().data; }
fs::path programs_folder() { return folders().programs; }

std::optional<fs::path> cache_folder() {
  if (const fs::path own = named("CROSSCHECK_CACHE"); !own.empty()) return fs::absolute(own);
  if (const fs::path caches = named("XDG_CACHE_HOME"); !caches.empty()) return caches / "crosscheck";
  if (const fs::path home = named("HOME"); !home.empty()) return home / ".cache" / "crosscheck";
  return std::nullopt;
}

}  // namespace crosscheck
