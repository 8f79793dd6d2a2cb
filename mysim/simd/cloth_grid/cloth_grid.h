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

/// The functions of the fused step (fused_step.h). `fast`: fused multiply-add, and inverse square roots from the
/// machine's own estimate; otherwise the same bits on every machine.
template <class T>
Kernel<T> kernel(InstructionSet isa, bool fast);

// Recognition of the regular grid in a scene's springs, if there is one.

/// All springs of a rows x columns grid whose particle (row, column) has the index row * columns + column. For each
/// direction (fused_step.h), either all springs that fit or none are present, with one stiffness and one rest length.
struct GridTopology {
  struct Stiffness {
    double k, rest;  // N/m, m
  };
  int rows, columns;
  std::array<std::optional<Stiffness>, directions> families;
};

/// Nothing if the springs follow another law or do not form exactly one such grid; such scenes use the kernels for
/// general spring graphs.
std::optional<GridTopology> find_grid_topology(const Springs& springs, int particles);

// The memory of a cloth: conversion between scene order and lanes.

/// With fewer columns, a row is a single tile of floats, whose skip-one springs would cross two lanes. Both precisions
/// support the same cloths.
inline constexpr int fewest_columns = lanes<float> + 1;
inline bool fits(const GridTopology& topology) { return topology.columns >= fewest_columns; }

template <class T>
class ClothGridMemory {
 public:
  explicit ClothGridMemory(const GridTopology& topology);

  ClothGrid<T>& grid() { return grid_; }
  int size() const { return rows_ * columns_; }  // particles
  /// One row of positions including its halo: row_length() numbers.
  T* row(int which) {
    assert(0 <= which && which < rows_);
    return x_.data() + which * row_length();
  }
  long row_length() const { return static_cast<long>(left_halo + tiles_ + right_halo) * 3 * lanes<T>; }

  /// Copies all particles in, and fills the halos of the rows.
  void put(const Eigen::Ref<const Points>& x, const Eigen::Ref<const Points>& v);
  /// Copies some rows out; the column of x and v of particle i is first + i.
  void get(int row, int rows, int first, Points& x, Points& v) const;
  /// Sets the position of one particle, including halo copies; its velocity is set to 0.
  void place(int particle, const Vec3& x);
  Vec3 position(int particle) const;
  Vec3 velocity(int particle) const;
  /// One value per particle (or one for all) in the layout that the kernel reads; lanes without a particle hold 0 if
  /// each particle has its own value.
  AlignedBuffer<T> spread(const Eigen::ArrayXd& values) const;

  /// Index of the particle in a lane of a tile; -1 if the lane is empty.
  int particle(int row, int tile, int lane) const {
    assert(0 <= row && row < rows_ && 0 <= tile && tile < tiles_ && 0 <= lane && lane < lanes<T>);
    const int column = lane * tiles_ + tile;
    return column < columns_ ? row * columns_ + column : -1;
  }

 private:
  long x_at(int particle) const;  // position of its first coordinate; each further coordinate is a cache line apart
  long v_at(int particle) const;

  int rows_, columns_, tiles_;
  AlignedBuffer<T> x_, v_, force_;
  AlignedBuffer<T> k_[directions];
  ClothGrid<T> grid_{};
};

// A cloth split into slabs of rows, one slab per thread.

/// Around its own rows a slab has two halo rows of each neighbour, because a spring spans at most two rows. Before a
/// fused step it receives the positions that the neighbour sent after the last one. Two such buffers are used
/// alternately, so that all slabs send and receive at the same time and threads wait for each other only once per fused
/// step. Forces are summed in the order of a single slab: the same bits for any number of slabs.
template <class T>
class Slabs {
 public:
  /// As in ClothGrid: per particle, or one tile for all.
  struct KickFactors {
    AlignedBuffer<T> damping, inverse_mass_dt, dt;
  };
  struct Slab {
    int which;
    ClothGridMemory<T> body;
    int first;                          // index of the slab's first particle in the scene
    int leading_halo, own_rows;         // rows
    AlignedBuffer<T> outgoing_halo[2];  // for the neighbours: the first two and the last two own rows
    std::vector<KickFactors> factors;   // one per kick
    /// The slab's index of the scene's particle i; -1 if it is in none of the slab's rows.
    int here(int i) const { return i >= first && i - first < body.size() ? i - first : -1; }
  };

  /// Creates as many slabs as threads, or fewer if there are few rows.
  Slabs(const GridTopology& topology, int threads);

  void put(const Points& x, const Points& v);
  void get(Points& x, Points& v) const;
  /// Calls work(slab) for each slab on its own thread, with the neighbours' rows up to date.
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
