// Detects self-intersections of a surface at samples. They cause remarks, never verdicts.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

class CrossingDetector {
 public:
  explicit CrossingDetector(std::vector<std::array<int, 3>> triangles);
  /// Number of edges that pierce a triangle without sharing a particle with it; 0 if a position is not finite. Takes
  /// time linear in the number of triangles if their sizes are similar.
  int piercing_edges(const Points& x);

 private:
  struct Cell {
    int at[3];
  };
  std::size_t bucket_of(const Cell& cell) const;
  template <class Visit>
  void for_each_cell(const Vec3& low, const Vec3& high, const Visit& visit) const;

  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::pair<int, int>> edges_;
  double cell_ = 1;  // m, side of a cell
  // spatial hash: the triangles of bucket b are entries_[begin_[b]] up to entries_[begin_[b + 1]]
  std::vector<int> begin_, entries_;
  std::vector<std::pair<std::size_t, int>> unsorted_;  // bucket, triangle
  std::vector<int> last_edge_;                         // last edge compared with each triangle
};

/// Checks at most 32 samples of a run, evenly spaced and including the last, because a check costs as much as about
/// forty steps of a cloth.
class CrossingObserver : public Observer {
 public:
  CrossingObserver(const Scene& scene, int samples);
  Verdict observe(const State& state, bool sample) override;
  int most() const { return most_; }       // largest number of piercing edges at one sample
  double first() const { return first_; }  // s, first sample with a piercing edge; meaningless if there is none
  /// Appends a sentence to the remark if the surface intersected itself.
  void note(Outcome& outcome) const;

 private:
  CrossingDetector detector_;
  bool has_surface_;
  int left_, stride_, most_ = 0;
  double first_ = 0;
};

}  // namespace crosscheck
