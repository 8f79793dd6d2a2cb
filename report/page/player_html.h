#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/page/page.h"
#include "report/player/runs.h"

namespace crosscheck {

/// Data of data.html for the player: scenes and runs. Throws InputError if a file cannot be read.
Json motions_data(const PageContent& content);

class PageRuns {
 public:
  explicit PageRuns(std::vector<RunFile> files) : files_(std::move(files)) {}

  /// The set of runs with this key, without scene and stage: the runs of the method `only` or, if `only` is empty, of
  /// all methods. Runs too large for the page are omitted, with a note. Returns nullopt if no runs remain.
  std::optional<PlayableRuns> take(const std::string& key, const std::string& only, std::vector<std::string>& notes);
  /// Positions that a scene's camera must show: those of the truth and of a completed run.
  std::vector<Points> seen_in(const Scene& scene) const;

 private:
  std::vector<RunFile> files_;
  size_t room_ = 5'500'000;  // bytes
};

/// The stage of a scene, or of the small scene of the map with this key; empty if no run can be played.
std::string stage_of(const Scene& scene, const SceneData& facts, const PageRuns& runs);
std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full);

}  // namespace crosscheck
