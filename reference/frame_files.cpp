// A header that counts no frames, the frames, and the header again.
#include "reference/frame_files.h"

#include "reference/npy.h"

namespace crosscheck {

Verdict FrameFiles::observe(const State& state, bool sample) {
  if (!sample) return Verdict::ok;
  if (times_.empty()) {
    particles_ = state.x.cols();
    x_.emplace(folder_ / "trajectory.npy");
    if (state.v.cols() == particles_) v_.emplace(folder_ / "velocities.npy");
    for (auto* file : {&x_, &v_})
      if (*file) (*file)->append(npy_header(0, particles_));
  }
  times_.push_back(state.t);
  x_->append(npy_data(state.x));
  if (v_) v_->append(npy_data(state.v));
  return Verdict::ok;
}

void FrameFiles::finish() {
  for (auto* file : {&x_, &v_})
    if (*file) {
      (*file)->rewrite_beginning(npy_header(static_cast<long>(times_.size()), particles_));
      (*file)->finish();
    }
}

}  // namespace crosscheck
