// Trajectories in NumPy's .npy files: their format, written during a run, read and replayed to observers.
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

// NumPy's .npy files: what trajectories are stored in.

/// The header of frames x particles x 3 numbers, float64, little endian, C order (format 1.0): 128 bytes, whatever
/// the numbers.
std::string npy_header(long frames, long particles);
/// The numbers of a frame as they stand behind it.
std::string_view npy_data(const Points& frame);
/// A whole file.
std::string npy_bytes(const std::vector<Points>& frames);

/// Reads frames x particles x 3 numbers: float64 or float32, little endian, C order, format 1.0 or 2.0. Throws
/// InputError that names the file and what was expected when it is something else, or has another number of particles,
/// or fewer than min_frames or more than max_frames frames, or is shorter or longer than its header says.
std::vector<Points> read_npy(const std::filesystem::path& file, int min_frames, int max_frames, int particles);

// Frames of a run on their way to disk: memory holds none of them.

/// Writes positions at samples (m) to trajectory.npy and, where states have them, velocities (m/s) to velocities.npy
/// (trajectory_files.h). The files are seen after finish() and not before. Throws InputError where they cannot be
/// written.
class TrajectoryWriter : public Observer {
 public:
  explicit TrajectoryWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Verdict observe(const State& state, bool sample) override;
  /// Says in both files how many frames there are; a run that failed has fewer than requested.
  void finish();
  /// The times of the frames, s.
  const std::vector<double>& times() const { return times_; }

 private:
  std::filesystem::path folder_;
  std::optional<StreamingFile> x_, v_;
  std::vector<double> times_;
  long particles_ = 0;
};

// Frames that came from outside, played to observers as if an engine stepped through them.

/// Sampled positions (m), and velocities (m/s) where they were delivered.
struct Frames {
  std::vector<Points> x, v;
};

/// Reads positions of the scene's particles at the run's samples, the start included. Throws InputError that names the
/// file and what was expected, also when the first frame is not the scene's start. `may_be_truncated`: fewer frames
/// than samples are allowed, of a run that failed by its own word.
std::vector<Points> read_positions(const std::filesystem::path& file, const Scene& scene, const Run& run,
                                   bool may_be_truncated = false);

/// Shows the frames to the observer, every `per_sample`-th as a sample; fills verdict, reason and end of the outcome
/// when the observer ends the run.
void replay(const Frames& frames, const Scene& scene, const Run& run, Observer& observer, Outcome& out,
            int per_sample = 1);

}  // namespace crosscheck
