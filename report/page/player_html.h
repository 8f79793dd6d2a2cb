// The player's part of the page: posters, data, and the runs that a click in a figure plays.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "experiments/experiment.h"
#include "report/page/page.h"
#include "report/player/motions.h"

namespace crosscheck {

/// A script element with JSON: the one sign that could end it is written otherwise.
std::string script_json(const std::string& attributes, const std::string& json);

/// The runs that a figure plays under a click, for the page's end. Throws std::runtime_error where a file cannot be
/// read.
std::string runs_html(const PlayableRuns& runs);
/// The runs of all scenes and maps of a page. Where it has the lab, mysim's runs of a scene that the lab computes stand
/// there without their motions, but for those of `shown` (keys, by scene), which move before the engine is there.
std::string all_runs_html(const std::vector<PlayableRuns>& runs, bool lab,
                          const std::map<std::string, std::set<std::string>>& shown);

// The runs that a click in a figure plays: kept as files while the experiments make them, gathered for the page.

/// A folder for each set of runs ("SCENE-engines", "SCENE-speed-accuracy", "SCENE-stiffness-map"), in it a file of JSON
/// for each method.
class RunsFolder {
 public:
  explicit RunsFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes the runs; from several processes at a time. The run is the scene's at the request's step.
  void keep(const RecordedRuns& recorded, const Run& run);

  /// The set of this key, of one method or of all, without a scene or stage yet: nothing where no run was kept. Methods
  /// whose runs weigh most are left out until the page can bear the others; a note says so.
  std::optional<PlayableRuns> of(const std::string& key, const std::string& only,
                                 std::vector<std::string>& notes) const;

 private:
  std::filesystem::path folder_;
  std::map<std::string, MotionBase> bases_;  // by the names of scenes
};

/// The small scene of a map with this key, as a stage (report/player/motions.h); empty where no scene has such a
/// map.
std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full);

}  // namespace crosscheck
