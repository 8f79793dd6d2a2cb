// Each spring in the format in which its force is cheapest, and the memory of both formats: for DIA the offsets and
// coefficient rows, for COO the list of edges.
#pragma once

#include "mysim/simd/aligned_buffer.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/simd/spring_graph/dia_coo_kernels.h"
#include "mysim/terms/springs.h"

namespace crosscheck::spring_graph {

Kernels kernels(simd::InstructionSet isa, SpringLaw law);

/// Costs in ns, measured on one machine with AVX2; only their ratios matter. All instruction sets share them, so that
/// they partition springs alike, add forces up in the same order, and give the same bits.
struct Costs {
  double coefficient_row = 9;  // DIA: eight springs of a diagonal side by side
  double tile = 10;            // DIA: eight particles put in and taken out
  double coo_spring = 1.8, coo_particle = 2;
  double plain = 3.1;  // a spring of the plain loop
  double call = 30;    // calling a kernel
};

using simd::AlignedBuffer;
/// Springs with a < b, in the order of a.
using OrientedSprings = std::vector<Spring>;

/// The memory of DIA.
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

/// The memory of COO.
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

/// Each spring in one of three lists.
struct SpringPartition {
  std::vector<OrientedSprings> dia;  // a list for each offset
  OrientedSprings coo;
  std::vector<Spring> plain;  // for the plain loop, as they were
};
/// The partition of the least cost.
SpringPartition partition_springs(const std::vector<Spring>& springs, int particles, const Costs& costs);

}  // namespace crosscheck::spring_graph
