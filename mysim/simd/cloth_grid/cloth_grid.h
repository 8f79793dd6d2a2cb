// A cloth as a regular grid: found in a scene's springs, laid out in lanes, cut into slabs for threads.
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

/// The functions of the fused step (fused_step.h). `fast`: fused multiply-add, and inverse roots from the machine's own
/// estimate; else the same bits on every machine.
template <class T>
Kernel<T> kernel(InstructionSet isa, bool fast);

// Finds the regular grid in a scene's springs, if there is one.

/// All springs of a rows x columns grid whose particle (row, column) has the index row * columns + column: of each
/// direction (fused_step.h) all that fit in or none, with one stiffness and one rest length.
struct GridTopology {
  struct Stiffness {
    double k, rest;  // N/m, m
  };
  int rows, columns;
  std::array<std::optional<Stiffness>, directions> families;
};

/// Empty where the springs are of another law, no such grid, or not all of one: such scenes are left to kernels for any
/// spring graph.
std::optional<GridTopology> find_grid_topology(const Springs& springs, int particles);

// The memory of a cloth: particles of a scene laid out in lanes, and back.

/// Of fewer columns a row is one tile of floats, whose springs to the next column but one would cross two lanes. Both
/// precisions take the same cloths.
inline constexpr int fewest_columns = lanes<float> + 1;
inline bool fits(const GridTopology& topology) { return topology.columns >= fewest_columns; }

template <class T>
class ClothGridMemory {
 public:
  explicit ClothGridMemory(const GridTopology& topology);

  ClothGrid<T>& grid() { return grid_; }
  int size() const { return rows_ * columns_; }  // particles
  /// A row of positions with its halo: row_length() numbers.
  T* row(int which) {
    assert(0 <= which && which < rows_);
    return x_.data() + which * row_length();
  }
  long row_length() const { return static_cast<long>(left_halo + tiles_ + right_halo) * 3 * lanes<T>; }

  /// All particles, and the halos of the rows.
  void put(const Eigen::Ref<const Points>& x, const Eigen::Ref<const Points>& v);
  /// Some rows; the column of x and v of particle i is first + i.
  void get(int row, int rows, int first, Points& x, Points& v) const;
  /// One particle, in the halo too: v is set to 0.
  void place(int particle, const Vec3& x);
  Vec3 position(int particle) const;
  Vec3 velocity(int particle) const;
  /// A number of each particle (or one for all), laid out as the kernel reads it; lanes without a particle hold 0 where
  /// each has its own.
  AlignedBuffer<T> spread(const Eigen::ArrayXd& values) const;

  /// The particle in a lane of a tile; -1 where there is none.
  int particle(int row, int tile, int lane) const {
    assert(0 <= row && row < rows_ && 0 <= tile && tile < tiles_ && 0 <= lane && lane < lanes<T>);
    const int column = lane * tiles_ + tile;
    return column < columns_ ? row * columns_ + column : -1;
  }

 private:
  long x_at(int particle) const;  // of its first coordinate; the others are a cache line further
  long v_at(int particle) const;

  int rows_, columns_, tiles_;
  AlignedBuffer<T> x_, v_, force_;
  AlignedBuffer<T> k_[directions];
  ClothGrid<T> grid_{};
};

// A cloth cut into slabs of rows, one for each thread.

/// Around its own rows a slab has two halo rows of each neighbour: a spring spans two rows at most. Before a fused
/// step it receives their positions from where the neighbour put them after the last one; two such buffers, used in
/// turns, let all slabs send and receive at the same time, so that threads wait for each other once a fused step.
/// Forces are summed in the order of a single slab: the same bits, however many there are.
template <class T>
class Slabs {
 public:
  /// As in ClothGrid: of each particle, or one tile for all.
  struct KickFactors {
    AlignedBuffer<T> damping, inverse_mass_dt, dt;
  };
  struct Slab {
    int which;
    ClothGridMemory<T> body;
    int first;                          // particle that is 0 here
    int leading_halo, own_rows;         // rows
    AlignedBuffer<T> outgoing_halo[2];  // for the neighbours: the first two of its own rows, and the last two
    std::vector<KickFactors> factors;   // of each kick
    /// The particle here that is i in the scene; -1 where it is in none of this slab's rows.
    int here(int i) const { return i >= first && i - first < body.size() ? i - first : -1; }
  };

  /// As many slabs as threads, or fewer where rows are few.
  Slabs(const GridTopology& topology, int threads);

  void put(const Points& x, const Points& v);
  void get(Points& x, Points& v) const;
  /// work(slab) for each, on its own thread, with its neighbours' rows where they are now.
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
