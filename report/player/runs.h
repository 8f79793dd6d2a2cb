// Recorded runs of a report: files runs/SET/METHOD.u16.gz and their index, the list "runs" of report.json
// (report/CONTRACT.md).
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/base/json.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Number of samples between frames, so that at most 150 frames follow the first one; if possible, the last sample is a
/// frame. 0 if the scene is too large for the player.
int frame_stride(const Scene& scene);

/// The runs of a method in a set, which have one entry in the index.
struct RunFile {
  std::string set, scene, method;
  std::filesystem::path file;  // relative to the report's folder
  int particles;
  Json entry;  // in the format of report.json
};

/// Writes runs. Several processes may write at the same time.
class RunsWriter {
 public:
  explicit RunsWriter(std::filesystem::path report) : report_(std::move(report)) {}
  /// Writes the set SCENE-OF; for a map, it consists of the cells' last pictures. `run`: the scene's run at the
  /// requested step.
  void keep(const RecordedRuns& recorded, const Run& run);
  /// Writes the set SCENE-truth, which ends where the truth ends.
  void keep_truth(const Scene& scene, const Run& run);

 private:
  const std::optional<Truth>& truth_on(const Scene& scene, const Run& run);
  std::filesystem::path report_;
  std::map<std::string, std::optional<Truth>> truths_;  // by scene
};

/// The index of all runs written so far, ordered by set and method. Removes the files into which the writers put their
/// entries.
Json take_index(const std::filesystem::path& report);

/// Reads an index. Throws InputError with the file's name if an entry is malformed. If `unpacked`, also throws if a
/// run's bytes differ from its entry.
std::vector<RunFile> run_files(const JsonField& index, const std::filesystem::path& report, bool unpacked);

/// Positions in m of the run with index `place`, by frame; empty if there is no such run.
std::vector<Points> positions_of(const RunFile& file, size_t place);

}  // namespace crosscheck
