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

  /// The set with this key, for one method or all, without scene and stage; nothing if it has no runs. Methods for
  /// which the page has no room are omitted, with a note.
  std::optional<PlayableRuns> take(const std::string& key, const std::string& only, std::vector<std::string>& notes);
  /// Positions that a scene's camera must show: those of the truth and of a completed run.
  std::vector<Points> seen_in(const Scene& scene) const;

 private:
  std::vector<RunFile> files_;
  size_t room_ = 5'500'000;  // bytes
};

/// The stage of a scene, or of the small scene of a map with this key; empty if nothing can be played.
std::string stage_of(const Scene& scene, const SceneData& facts, const PageRuns& runs);
std::string stage_of_map(const std::string& key, const std::vector<Scene>& scenes, bool full);

}  // namespace crosscheck
