// Detection of self-intersections of a surface at samples. Reported as a remark, never as a verdict.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "mysim/run/run.h"

namespace crosscheck {

/// Finds the edges of a surface that pierce its triangles.
class CrossingDetector {
 public:
  explicit CrossingDetector(std::vector<std::array<int, 3>> triangles);
  /// Number of edges that pierce a triangle with which they share no particle; 0 if a position is not finite. Linear in
  /// the number of triangles if they are of similar size.
  int piercing_edges(const Points& x);

 private:
  struct Cell {
    int at[3];
  };
  std::size_t bucket_of(const Cell& cell) const;
  template <class Visit>
  void for_each_cell(const Vec3& low, const Vec3& high, const Visit& visit) const;

  std::vector<std::array<int, 3>> triangles_;
  std::vector<std::pair<int, int>> edges_;  // each edge once
  double cell_ = 1;                         // m, side of a cell
  // spatial hash: triangles by bucket; bucket b holds entries_[begin_[b]] up to entries_[begin_[b + 1]]
  std::vector<int> begin_, entries_;
  std::vector<std::pair<std::size_t, int>> unsorted_;  // bucket, triangle
  std::vector<int> last_edge_;                         // last edge that was compared with each triangle
};

/// Checks at most 32 samples of a run, at its end and evenly before: checking one sample costs about as much as forty
/// steps of a cloth.
class CrossingObserver : public Observer {
 public:
  CrossingObserver(const Scene& scene, int samples);
  Verdict observe(const State& state, bool sample) override;
  int most() const { return most_; }       // largest number of edges at one sample
  double first() const { return first_; }  // s, of the first sample with an intersection; meaningless if there is none
  /// Appends a sentence to the outcome's remark if the surface intersected itself.
  void note(Outcome& outcome) const;

 private:
  CrossingDetector detector_;
  bool has_surface_;
  int left_, stride_, most_ = 0;
  double first_ = 0;
};

}  // namespace crosscheck
