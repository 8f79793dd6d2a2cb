// Trajectories in NumPy's .npy files: writing them during a run, reading them, and replaying them to observers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/base/files.h"
#include "mysim/run/run.h"
#include "mysim/types.h"

namespace crosscheck {

/// Header of frames x particles x 3 numbers, float64, little endian, C order (format 1.0): always 128 bytes.
std::string npy_header(long frames, long particles);
/// Raw data of one frame, in the format of the data after the header.
std::string_view npy_data(const Points& frame);
/// Content of a whole file.
std::string npy_bytes(const std::vector<Points>& frames);

/// Reads frames x particles x 3 numbers: float64 or float32, little endian, C order, format 1.0 or 2.0. Throws
/// InputError, with the file's name and the expected content, if the file is something else, has another number of
/// particles, fewer than min_frames or more than max_frames frames, or a length that its header does not state.
std::vector<Points> read_npy(const std::filesystem::path& file, int min_frames, int max_frames, int particles);

/// Writes positions at samples (m) to trajectory.npy and velocities (m/s), if there are any, to velocities.npy during a
/// run; keeps no frame in memory. The files appear in finish(). Throws InputError if they cannot be written.
class TrajectoryWriter : public Observer {
 public:
  explicit TrajectoryWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Verdict observe(const State& state, bool sample) override;
  /// Writes the number of frames; a failed run has fewer than requested.
  void finish();
  /// Times of the frames (s).
  const std::vector<double>& times() const { return times_; }

 private:
  std::filesystem::path folder_;
  std::optional<StreamingFile> x_, v_;
  std::vector<double> times_;
  long particles_ = 0;
};

/// Another program's samples: positions (m), and velocities (m/s) if delivered.
struct Frames {
  std::vector<Points> x, v;
};

/// Reads positions of the scene's particles at the run's samples, including the start. Throws InputError, with the
/// file's name and the expected content, also if the first frame is not the scene's start. `may_be_truncated`: allow
/// fewer frames than samples, because the program reports a failure.
std::vector<Points> read_positions(const std::filesystem::path& file, const Scene& scene, const Run& run,
                                   bool may_be_truncated = false);

/// Shows the frames to the observer as if an engine stepped through them, every `per_sample`-th as a sample. Sets
/// verdict, reason and end of the outcome if the observer ends the run.
void replay(const Frames& frames, const Scene& scene, const Run& run, Observer& observer, Outcome& out,
            int per_sample = 1);

}  // namespace crosscheck
