#include "mysim/base/installation.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// Folders in crosscheck.folders by their keys; each line has a key and a folder.
const std::map<std::string, fs::path>& folders() {
  static const auto found = [] {
    const fs::path program = fs::read_symlink("/proc/self/exe");
    for (fs::path at = program.parent_path();; at = at.parent_path()) {
      const fs::path list = at / "crosscheck.folders";
      std::map<std::string, fs::path> all;
      std::ifstream in(list);
      for (std::string key, folder; in >> key && std::getline(in >> std::ws, folder);)
        all[key] = fs::weakly_canonical(at / folder);
      if (all.contains("data") && all.contains("programs")) return all;
      if (fs::exists(list))
        throw std::runtime_error(list.string() + ": expected two lines, 'data FOLDER' and 'programs FOLDER'");
      if (at == at.parent_path())
        throw std::runtime_error(
            fmt::format("{}: found no file crosscheck.folders next to it or in a folder above; run the program where "
                        "it was built or installed, not a copy",
                        program.string()));
    }
  }();
  return found;
}

fs::path named(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace

fs::path data_folder() { return folders().at("data"); }
fs::path programs_folder() { return folders().at("programs"); }

std::optional<fs::path> cache_folder() {
  if (const fs::path own = named("CROSSCHECK_CACHE"); !own.empty()) return fs::absolute(own);
  if (const fs::path caches = named("XDG_CACHE_HOME"); !caches.empty()) return caches / "crosscheck";
  if (const fs::path home = named("HOME"); !home.empty()) return home / ".cache" / "crosscheck";
  return std::nullopt;
}

}  // namespace crosscheck
