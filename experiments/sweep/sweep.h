// Computes the points of a sweep: finished points are not repeated, a failed one is named, and other points go on.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/sweep/store.h"
#include "experiments/timing/machine.h"
#include "mysim/base/progress.h"

namespace crosscheck {

/// Part I of N of a list: its points I-1, I-1+N, I-1+2N, ...
struct Shard {
  int index = 1, count = 1;
  bool holds(size_t point) const { return static_cast<int>(point % static_cast<size_t>(count)) == index - 1; }
};
/// "2/8". Throws InputError, "expected I/N with 1 <= I <= N".
Shard shard_from(const std::string& text);

struct SweepOptions {
  LockPatience patience;  // the command's
  int jobs = 0;           // processes at a time; 0: as many as cores that this process may use
  Shard shard = {};
};

struct FailedPoint {
  std::string name, why;
};

/// Computes the shard's points that the store has not, and keeps what they give. Points run in processes of their own
/// (an engine that crashes takes one point with it, and Bullet keeps state per process); timed points after all others,
/// one at a time, pinned to a core, and while no other sweep of this user computes on the machine. Returns the points
/// that threw or crashed; no rows are kept of these.
std::vector<FailedPoint> run_points(std::span<const Point> points, const SweepOptions& options, const Store& store,
                                    Progress& progress);

/// The rows of all points of the list in their order, each from the first store that has it, and what the list's
/// experiments conclude from them; the names of points that no store has are added to `missing`, with the fault of
/// a file that cannot be read.
TableSet joined(const PointList& list, std::span<const Store> stores, std::vector<std::string>& missing);

/// Computes all points here and now, without a store: for a few, and for tests. Lets exceptions through.
TableSet computed(std::span<const Point> points);

}  // namespace crosscheck
