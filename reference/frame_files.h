// Frames of a run on their way to disk: memory holds none of them.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "mysim/growing_file.h"
#include "mysim/run.h"

namespace crosscheck {

/// Writes positions at samples (m) to trajectory.npy and, where states have them, velocities (m/s) to velocities.npy
/// (npy.h). The files are seen after finish() and not before. Throws InputError where they cannot be written.
class FrameFiles : public Observer {
 public:
  explicit FrameFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Verdict observe(const State& state, bool sample) override;
  /// Says in both files how many frames there are; a run that failed has fewer than were asked for.
  void finish();
  /// When the frames were taken, s.
  const std::vector<double>& times() const { return times_; }

 private:
  std::filesystem::path folder_;
  std::optional<GrowingFile> x_, v_;
  std::vector<double> times_;
  long particles_ = 0;
};

}  // namespace crosscheck
