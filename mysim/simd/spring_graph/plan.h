// The partition of springs among kernels, and the memory in which the kernels read them.
#pragma once

#include "mysim/simd/aligned_buffer.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/simd/spring_graph/kernels.h"
#include "mysim/terms/springs.h"

namespace crosscheck::spring_graph {

Kernels kernels(simd::InstructionSet isa, SpringLaw law);

/// Costs on this kind of instructions, ns, as measured on one machine; only their ratios matter. Both kinds
/// of AVX share one set: they sort springs alike, add them up in the same order, and so give the same bits.
struct Costs {
  double coefficient_row,
      tile;  // eight springs of a diagonal side by side; putting eight particles in and getting them out
  double pair, particle;
  double plain;  // a spring of the plain loop
  double call;
};
Costs costs(simd::InstructionSet isa);

// The memory of diagonals and of pairs: springs laid out as their functions read them.

using simd::AlignedBuffer;
/// Springs turned so that a < b, in the order of a.
using OrientedSprings = std::vector<Spring>;

class DiaStorage {
 public:
  /// Each of them springs of one offset, no two alike.
  DiaStorage(const std::vector<OrientedSprings>& diagonals, int particles);
  const DiaSprings& view() const { return view_; }
  /// Springs of some rest length whose ends are in one place, in the positions last loaded.
  long degenerate_springs() const;

 private:
  void fill_coefficients(const std::vector<OrientedSprings>& diagonals);

  DiaSprings view_{};
  std::vector<Diagonal> diagonals_;
  std::vector<int> coefficient_row_;
  std::vector<AlignedBuffer<double>> rings_;
  AlignedBuffer<double> coefficients_, x_, pulls_;
};

class CooStorage {
 public:
  CooStorage(const OrientedSprings& springs, int particles);
  const CooSprings& view() const { return view_; }
  long degenerate_springs() const;

 private:
  CooSprings view_{};
  std::vector<int> ends_;
  AlignedBuffer<double> k_, rest_, x_, force_;
};

// Sorts the springs of a graph into diagonals, pairs and plain ones.

/// The partition of the least cost.
struct SpringPartition {
  std::vector<OrientedSprings> diagonals;
  OrientedSprings pairs;
  std::vector<Spring> plain;  // as they were
};
SpringPartition partition_springs(const std::vector<Spring>& springs, int particles, const Costs& costs);

}  // namespace crosscheck::spring_graph
