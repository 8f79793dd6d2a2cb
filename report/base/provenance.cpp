#include "report/base/provenance.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <fstream>

#include "mysim/base/files.h"
#include "mysim/base/installation.h"
#include "mysim/base/process.h"

namespace crosscheck {
namespace {

/// Commit of the sources: from commit.txt in an installation, from git in a source tree.
std::string commit() {
  if (const auto written = try_read_file(data_folder() / "commit.txt")) return written->substr(0, written->find('\n'));
  try {
    const auto git =
        run_program({"git", "describe", "--always", "--dirty=, with uncommitted changes", "--abbrev=12", "--exclude=*"},
                    data_folder());
    if (git.status == 0 && !git.out.empty()) return git.out.substr(0, git.out.find('\n'));
  } catch (const std::exception&) {
  }
  return "unknown (no git)";
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

Provenance provenance(const std::string& command) {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  return {{"command", command},
          {"commit", commit()},
          {"compiler", CROSSCHECK_COMPILER},
          {"cpu", processor()},
          {"engines", "mysim (double), Bullet " CROSSCHECK_BULLET_VERSION " (double)"},
          {"date", fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(now))}};
}

Provenance with_scene(Provenance lines, const Scene& scene) {
  std::string value = fmt::format("{} {}", scene.name, scene.hash);
  const auto* wind = scene.model.find<Wind>();
  const auto* air = scene.model.find<Aerodynamics>();
  for (const WindSignal* wind_signal : {wind ? &wind->acceleration : nullptr, air ? &air->velocity : nullptr})
    if (wind_signal && wind_signal->gusts) value += fmt::format(", seed {}", wind_signal->gusts->seed);
  lines.emplace_back("scene", value);
  return lines;
}

Provenance with_scenes(Provenance lines, const std::vector<Scene>& scenes) {
  for (const Scene& scene : scenes) lines = with_scene(std::move(lines), scene);
  return lines;
}

std::string value_of(const Provenance& lines, const std::string& key) {
  for (const auto& [k, v] : lines)
    if (k == key) return v;
  return "";
}

}  // namespace crosscheck
