// /proc/meminfo, control groups, resource limits, statvfs.
#include "mysim/free_room.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

namespace crosscheck {
namespace fs = std::filesystem;
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

double available_to_all() {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);)
    if (double kib = 0; std::sscanf(line.c_str(), "MemAvailable: %lf", &kib) == 1) return 1024 * kib;
  return unlimited;
}

/// A number in a file; nothing where there is none ("max").
std::optional<double> number_of_file(const fs::path& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// Bytes of files that the group's memory holds and gives up when it is needed: counted as used there.
double given_up_by_group(const fs::path& group, std::string_view key) {
  std::ifstream in(group / "memory.stat");
  double bytes = 0;
  for (std::string word; in >> word >> bytes;)
    if (word == key) return bytes;
  return 0;
}

/// What the groups of this process leave, version 2 or 1, each one up to the root.
double left_by_groups() {
  double least = unlimited;
  std::ifstream in("/proc/self/cgroup");
  for (std::string line; std::getline(in, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool both = controllers.empty();  // version 2
    if (!both && controllers.find("memory") == std::string::npos) continue;
    const fs::path root = both ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    std::string at = line.substr(second + 1);
    for (;; at = at.substr(0, at.rfind('/'))) {
      const fs::path group = root / fs::path(at).relative_path();
      const auto limit = number_of_file(group / (both ? "memory.max" : "memory.limit_in_bytes"));
      const auto used = number_of_file(group / (both ? "memory.current" : "memory.usage_in_bytes"));
      if (limit && used)
        least =
            std::min(least, *limit - *used + given_up_by_group(group, both ? "inactive_file" : "total_inactive_file"));
      if (at.find_first_not_of('/') == std::string::npos) break;
    }
  }
  return std::max(least, 0.);
}

double left_of_address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return std::max(0., static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

double free_memory() { return std::min({available_to_all(), left_by_groups(), left_of_address_space()}); }

double free_disk(const fs::path& folder) {
  std::error_code unknown;
  fs::path place = fs::absolute(folder, unknown);
  while (!fs::exists(place, unknown) && place.has_relative_path()) place = place.parent_path();
  struct statvfs about {};
  if (statvfs(place.c_str(), &about) != 0) return unlimited;
  return static_cast<double>(about.f_bavail) * static_cast<double>(about.f_frsize);
}

std::string in_bytes(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB", "PB", "EB"};
  int unit = 0;
  while (bytes >= 999.5 && unit < 6) bytes /= 1000, ++unit;
  return unit == 6 && bytes >= 999.5 ? fmt::format("{:.2g} EB", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

}  // namespace crosscheck
