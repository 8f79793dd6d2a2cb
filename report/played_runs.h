// The runs that a click in a figure plays: kept as files while the experiments make them, gathered for the page.
#pragma once

#include <filesystem>
#include <optional>

#include "experiments/experiment.h"
#include "report/page/page.h"

namespace crosscheck {

/// A folder for each set of runs ("SCENE-speed-accuracy", "SCENE-stiffness-map"), in it a file of JSON for each method.
class RunsFolder {
 public:
  explicit RunsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes what passes; from several processes at a time. The run is the scene's at the request's step.
  void keep(const WatchedRuns& watched, const Run& run) const;

  /// The set of this key, without a scene or stage yet: nothing where no run was kept. Methods whose runs weigh most
  /// are left out until the page can bear the others; a note says so.
  std::optional<PlayedRuns> of(const std::string& key, std::vector<std::string>& notes) const;

 private:
  std::filesystem::path folder_;
};

/// The small scene of a map with this key, as a stage (player_data.h); empty where no scene has such a map.
std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full);

}  // namespace crosscheck
