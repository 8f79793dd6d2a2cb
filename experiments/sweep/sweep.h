// Computes the points of a sweep. Finished points are not repeated, and a failed point does not stop the others.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiments/sweep/store.h"
#include "experiments/timing/machine.h"
#include "mysim/base/progress.h"

namespace crosscheck {

/// Points I-1, I-1+N, I-1+2N, ... of a list.
struct Shard {
  int index = 1, count = 1;
  bool holds(size_t point) const { return static_cast<int>(point % static_cast<size_t>(count)) == index - 1; }
};
/// Parses "2/8". Throws InputError, "expected I/N with 1 <= I <= N".
Shard shard_from(const std::string& text);

struct SweepOptions {
  LockPatience patience;
  int jobs = 0;  // number of concurrent processes; 0: one per core that this process may use
  Shard shard = {};
};

struct FailedPoint {
  std::string name, why;
};

/// Computes the shard's points that are missing in the store, and stores their rows. Points run in separate processes
/// (a crash affects only one point, and Bullet keeps state per process). Timed points run after all others, one at a
/// time, pinned to a core, while no other sweep of this user computes on the machine. Returns the points that threw or
/// crashed, whose rows are not stored.
std::vector<FailedPoint> run_points(std::span<const Point> points, const SweepOptions& options, const Store& store,
                                    Progress& progress);

/// The rows of all points in the order of the list, and the conclusions of the list's experiments. The rows of a point
/// are taken from the first store that has the point. Points that are in no store are appended to `missing`, with the
/// reason if a file cannot be read.
TableSet joined(const PointList& list, std::span<const Store> stores, std::vector<std::string>& missing);

/// Computes all points in this process, without a store. Does not catch exceptions.
TableSet computed(std::span<const Point> points);

}  // namespace crosscheck
