// A cloth as a regular grid: recognised from a scene's springs, laid out in lanes, split into slabs for threads.
#pragma once

#include <array>
#include <cassert>
#include <deque>
#include <optional>

#include "mysim/simd/aligned_buffer.h"
#include "mysim/simd/cloth_grid/fused_step.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/simd/thread_pool.h"
#include "mysim/terms/springs.h"
#include "mysim/types.h"

namespace crosscheck::simd {

/// The fused step (fused_step.h). `fast` uses fused multiply-add and the machine's own estimate of inverse square
/// roots; without it, results have the same bits on every machine.
template <class T>
Kernel<T> kernel(InstructionSet isa, bool fast);

/// All springs of a rows x columns grid whose particle (row, column) has index row * columns + column. Each direction
/// (fused_step.h) has either all springs that fit, with one stiffness and one rest length, or none.
struct GridTopology {
  struct Stiffness {
    double k, rest;  // N/m, m
  };
  int rows, columns;
  std::array<std::optional<Stiffness>, directions> families;
};

/// Returns nothing if the springs follow another law or do not form exactly one such grid.
std::optional<GridTopology> find_grid_topology(const Springs& springs, int particles);

// A cloth's memory: conversion between scene order and lanes.

/// With fewer columns, a row is a single tile of floats, whose skip-one springs would cross two lanes. Double precision
/// has the same limit, so that both precisions support the same cloths.
inline constexpr int fewest_columns = lanes<float> + 1;
inline bool fits(const GridTopology& topology) { return topology.columns >= fewest_columns; }

template <class T>
class ClothGridMemory {
 public:
  explicit ClothGridMemory(const GridTopology& topology);

  ClothGrid<T>& grid() { return grid_; }
  int size() const { return rows_ * columns_; }  // particles
  /// Positions of a row and its halo: row_length() numbers.
  T* row(int which) {
    assert(0 <= which && which < rows_);
    return x_.data() + which * row_length();
  }
  long row_length() const { return static_cast<long>(left_halo + tiles_ + right_halo) * 3 * lanes<T>; }

  /// Copies all particles in, and fills the halos.
  void put(const Eigen::Ref<const Points>& x, const Eigen::Ref<const Points>& v);
  /// Copies some rows out; particle i has column first + i of x and v.
  void get(int row, int rows, int first, Points& x, Points& v) const;
  /// Moves a particle, including its halo copies; its velocity becomes 0.
  void place(int particle, const Vec3& x);
  Vec3 position(int particle) const;
  Vec3 velocity(int particle) const;
  /// One value per particle (or one for all) in the kernel's layout. Lanes without a particle are 0 if each particle
  /// has its own value.
  AlignedBuffer<T> spread(const Eigen::ArrayXd& values) const;

  /// Particle in a lane of a tile; -1 if the lane is empty.
  int particle(int row, int tile, int lane) const {
    assert(0 <= row && row < rows_ && 0 <= tile && tile < tiles_ && 0 <= lane && lane < lanes<T>);
    const int column = lane * tiles_ + tile;
    return column < columns_ ? row * columns_ + column : -1;
  }

 private:
  long x_at(int particle) const;  // position of its first coordinate; the others are one cache line apart
  long v_at(int particle) const;

  int rows_, columns_, tiles_;
  AlignedBuffer<T> x_, v_, force_;
  AlignedBuffer<T> k_[directions];
  ClothGrid<T> grid_{};
};

/// A cloth split into slabs of rows, one per thread. Around its own rows, a slab has two halo rows of each neighbour,
/// because a spring spans at most two rows. Before a fused step it receives the positions that the neighbour sent after
/// the previous fused step, through two alternating buffers, so that threads wait for each other only once per fused
/// step. Forces are summed in the order of a single slab, which gives the same bits for any number of slabs.
template <class T>
class Slabs {
 public:
  /// Factors as in ClothGrid: one per particle, or one tile for all particles.
  struct KickFactors {
    AlignedBuffer<T> damping, inverse_mass_dt, dt;
  };
  struct Slab {
    int which;
    ClothGridMemory<T> body;
    int first;  // the slab's first particle
    int leading_halo, own_rows;
    AlignedBuffer<T> outgoing_halo[2];  // copies of the first two and the last two own rows
    std::vector<KickFactors> factors;   // one per kick
    /// The slab's index of particle i; -1 if it is in none of its rows.
    int here(int i) const { return i >= first && i - first < body.size() ? i - first : -1; }
  };

  /// One slab per thread, or fewer if there are few rows.
  Slabs(const GridTopology& topology, int threads);

  void put(const Points& x, const Points& v);
  void get(Points& x, Points& v) const;
  /// Calls work(slab) for each slab on its thread, with the neighbours' rows up to date.
  template <class Work>
  void for_each(Work work) {
    const std::function<void(int)> exchange_and_work = [&](int which) {
      receive_halo(which);
      work(slabs_[which]);
      send_halo(which, 1 - parity_);
    };
    pool_.all(exchange_and_work);
    parity_ = 1 - parity_;
  }
  std::deque<Slab>& all() { return slabs_; }
  double worker_seconds() const { return pool_.seconds(); }

 private:
  void receive_halo(int which);
  void send_halo(int which, int parity);

  int columns_;
  std::deque<Slab> slabs_;
  ThreadPool pool_;
  int parity_ = 0;
};

}  // namespace crosscheck::simd
