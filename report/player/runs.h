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

/// The number of samples from one frame to the next: at most 150 frames after the first; the last sample is a frame if
/// the samples allow it. 0 if the scene is too large to be played.
int frame_stride(const Scene& scene);

/// The runs of one method in one set: an entry of the index.
struct RunFile {
  std::string set, scene, method;
  std::filesystem::path file;  // in the report's folder
  int particles;
  Json entry;  // as in report.json
};

/// Writes runs while experiments make them, from several processes at a time.
class RunsWriter {
 public:
  /// The folder of the report.
  explicit RunsWriter(std::filesystem::path report) : report_(std::move(report)) {}
  /// Set SCENE-OF; of a map's cells the last picture of each. `run`: the scene's at the request's step.
  void keep(const RecordedRuns& recorded, const Run& run);
  /// Set SCENE-truth, as far as the truth is known.
  void keep_truth(const Scene& scene, const Run& run);

 private:
  const std::optional<Truth>& truth_on(const Scene& scene, const Run& run);
  std::filesystem::path report_;
  std::map<std::string, std::optional<Truth>> truths_;  // by the names of scenes
};

/// The index of all runs that were written, in the order of sets and methods. The files in which their writers left
/// the entries are removed.
Json take_index(const std::filesystem::path& report);

/// The entries of an index. Throws InputError that names the file if an entry is malformed, and, with `unpacked`, also
/// if the bytes of a run are not what its entry states.
std::vector<RunFile> run_files(const JsonField& index, const std::filesystem::path& report, bool unpacked);

/// The positions of a run of the file (m), frame by frame; empty if that run has none.
std::vector<Points> positions_of(const RunFile& file, size_t place);

}  // namespace crosscheck
