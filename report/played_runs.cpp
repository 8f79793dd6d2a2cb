#include "report/played_runs.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/stability/map.h"
#include "mysim/files.h"
#include "report/player/cell_motions.h"
#include "report/player/player_data.h"
#include "report/player/run_motions.h"

namespace crosscheck {
namespace fs = std::filesystem;

void RunsFolder::keep(const WatchedRuns& watched, const Run& run) const {
  const std::string json = watched.of == "speed-accuracy" ? run_motions_json(watched, truth_of(watched.scene, run))
                                                          : cell_motions_json(watched);
  if (json.empty()) return;
  const std::string key = watched.scene.name + "-" + watched.of;
  write_file(folder_ / file_name_of(key) / (file_name_of(watched.method) + ".json"), json);
}

std::optional<PlayedRuns> RunsFolder::of(const std::string& key, std::vector<std::string>& notes) const {
  constexpr std::uintmax_t most = 600'000;  // bytes: no set of a quick report weighs as much
  const fs::path own = folder_ / file_name_of(key);
  if (key.empty() || !fs::exists(own)) return std::nullopt;
  PlayedRuns runs{key, "", "", {}};
  for (const auto& file : fs::directory_iterator(own)) runs.methods.push_back(file.path());
  const auto weight = [](const fs::path& file) { return std::pair(fs::file_size(file), file); };
  std::ranges::sort(runs.methods, {}, weight);
  std::uintmax_t sum = 0;
  const auto too_much =
      std::ranges::find_if(runs.methods, [&](const fs::path& f) { return (sum += file_size(f)) > most; });
  if (const auto count = runs.methods.end() - too_much; count > 0)
    notes.push_back(fmt::format("of {} the runs of {} methods are too large for the page to play", key, count));
  runs.methods.erase(too_much, runs.methods.end());
  std::ranges::sort(runs.methods);
  return runs;
}

std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full) {
  for (const Scene& scene : scenes)
    if (const auto small = map_scene(scene, full))
      for (const MapKind& kind : map_kinds())
        if (key == fmt::format("{}-{}-map", small->name, kind.name)) return stage_json(*small);
  return "";
}

}  // namespace crosscheck
