// Recorded runs as files of a report: runs/SET/METHOD.u16.gz, and their index, the list "runs" of report.json.
// report/CONTRACT.md describes both.
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

/// Number of samples from one frame to the next. There are at most 150 frames after the first, and the last sample is a
/// frame if the samples allow it. 0 if the scene is too large for the player.
int frame_stride(const Scene& scene);

/// The runs of one method in one set: an entry of the index.
struct RunFile {
  std::string set, scene, method;
  std::filesystem::path file;  // relative to the report's folder
  int particles;
  Json entry;  // format of report.json
};

/// Writes runs while experiments compute them, from several processes in parallel.
class RunsWriter {
 public:
  /// The folder of the report.
  explicit RunsWriter(std::filesystem::path report) : report_(std::move(report)) {}
  /// Writes the set SCENE-OF; for a map, the last picture of each cell. `run`: the scene's run at the request's step.
  void keep(const RecordedRuns& recorded, const Run& run);
  /// Writes the set SCENE-truth, as long as the truth is known.
  void keep_truth(const Scene& scene, const Run& run);

 private:
  const std::optional<Truth>& truth_on(const Scene& scene, const Run& run);
  std::filesystem::path report_;
  std::map<std::string, std::optional<Truth>> truths_;  // by scene name
};

/// The index of all runs written so far, ordered by set and method. Removes the files in which the writers left the
/// entries.
Json take_index(const std::filesystem::path& report);

/// The entries of an index. Throws InputError with the file's name if an entry is malformed; with `unpacked`, also if
/// the bytes of a run differ from the description in its entry.
std::vector<RunFile> run_files(const JsonField& index, const std::filesystem::path& report, bool unpacked);

/// The positions of a run in the file (m), by frame; empty if there is no such run.
std::vector<Points> positions_of(const RunFile& file, size_t place);

}  // namespace crosscheck
