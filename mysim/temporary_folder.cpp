// mkdtemp and remove_all.
#include "mysim/temporary_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "mysim/errors.h"

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

/// The start of a process in clock ticks since the boot; empty where there is none of that number.
std::string start_of(const std::string& process) {
  std::ifstream in("/proc/" + process + "/stat");
  std::string text;
  std::getline(in, text, '\0');
  // the name, which may hold anything, stands in brackets; 19 fields lie between the state and the start
  const size_t bracket = text.rfind(')');
  if (bracket == std::string::npos) return "";
  std::istringstream fields(text.substr(bracket + 1));
  std::string field;
  for (int i = 0; i < 20; ++i) fields >> field;
  return field;
}

std::string process_namespace() {
  std::error_code error;
  std::string link = fs::read_symlink("/proc/self/ns/pid", error).string();  // "pid:[4026531836]"
  std::erase_if(link, [](char c) { return c < '0' || c > '9'; });
  return link.empty() ? "0" : link;
}

}  // namespace

std::string temporary_name(std::string_view purpose) {
  const std::string self = fmt::format("{}", getpid());
  return (fs::temp_directory_path() /
          fmt::format("crosscheck-{}-{}.{}.{}-XXXXXX", purpose, self, start_of(self), process_namespace()))
      .string();
}

TemporaryFolder::TemporaryFolder(std::string_view purpose) {
  std::string name = temporary_name(purpose);
  if (!mkdtemp(name.data()))
    throw InputError(fmt::format("{}: no folder can be made there; expected a place for temporary files", name));
  path = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

void sweep_temporary_folders() {
  static const std::regex ours(R"(crosscheck-[a-z]+-([0-9]+)\.([0-9]*)\.([0-9]+)-[A-Za-z0-9]{6})");
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  const std::string here = process_namespace();
  for (fs::directory_iterator at(place, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    std::smatch parts;
    if (!name.starts_with("crosscheck-") || !std::regex_match(name, parts, ours) || parts[3] != here) continue;
    if (start_of(parts[1]) == parts[2] && !parts[2].str().empty()) continue;
    struct stat about {};
    if (lstat(at->path().c_str(), &about) != 0 || !S_ISDIR(about.st_mode)) continue;
    std::error_code ignored;
    if (about.st_uid == geteuid() || geteuid() == 0) fs::remove_all(at->path(), ignored);
  }
}

}  // namespace crosscheck
