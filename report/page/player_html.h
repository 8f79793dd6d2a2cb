// The player's part of the page: posters, data, and the runs that a click in a figure plays.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "experiments/experiment.h"
#include "report/page/page.h"

namespace crosscheck {

/// Styles and script of all players of a page, for its head.
std::string player_head();

/// The poster, which stays where nothing can be played and on paper, and the motions over it (JSON of
/// report/player/player_data.h).
std::string player_html(const PageImage& poster, const std::filesystem::path& motions);

/// The runs that a figure plays under a click, for the page's end. Throws std::runtime_error where a file cannot be
/// read.
std::string runs_html(const PlayableRuns& runs);

// The runs that a click in a figure plays: kept as files while the experiments make them, gathered for the page.

/// A folder for each set of runs ("SCENE-speed-accuracy", "SCENE-stiffness-map"), in it a file of JSON for each method.
class RunsFolder {
 public:
  explicit RunsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes the runs; from several processes at a time. The run is the scene's at the request's step.
  void keep(const WatchedRuns& watched, const Run& run) const;

  /// The set of this key, without a scene or stage yet: nothing where no run was kept. Methods whose runs weigh most
  /// are left out until the page can bear the others; a note says so.
  std::optional<PlayableRuns> of(const std::string& key, std::vector<std::string>& notes) const;

 private:
  std::filesystem::path folder_;
};

/// The small scene of a map with this key, as a stage (report/player/player_data.h); empty where no scene has such a
/// map.
std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full);

}  // namespace crosscheck
