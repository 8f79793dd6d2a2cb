// Chooses the format in which each spring's force is cheapest, and stores springs in the DIA and COO formats.
#pragma once

#include "mysim/simd/aligned_buffer.h"
#include "mysim/simd/instruction_sets.h"
#include "mysim/simd/spring_graph/dia_coo_kernels.h"
#include "mysim/terms/springs.h"

namespace crosscheck::spring_graph {

Kernels kernels(simd::InstructionSet isa, SpringLaw law);

/// Costs in ns, measured on one machine with AVX2; only their ratios matter. All instruction sets share them, to
/// partition springs identically, add forces in the same order, and give the same bits.
struct Costs {
  double coefficient_row = 9;  // DIA: eight adjacent springs of a diagonal
  double tile = 10;            // DIA: load and store eight particles
  double coo_spring = 1.8, coo_particle = 2;
  double plain = 3.1;  // one spring in the plain loop
  double call = 30;    // calling a kernel
};

using simd::AlignedBuffer;
/// Springs with `a` < `b`, sorted by `a`.
using OrientedSprings = std::vector<Spring>;

class DiaStorage {
 public:
  /// `diagonals` has one list of springs per offset.
  DiaStorage(const std::vector<OrientedSprings>& diagonals, int particles);
  const DiaSprings& view() const { return view_; }
  /// Springs with nonzero rest length whose ends coincide in the positions last loaded.
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

/// Each spring is in exactly one list.
struct SpringPartition {
  std::vector<OrientedSprings> dia;  // one list per offset
  OrientedSprings coo;
  std::vector<Spring> plain;  // unchanged, for the plain loop
};
SpringPartition partition_springs(const std::vector<Spring>& springs, int particles, const Costs& costs);

}  // namespace crosscheck::spring_graph
