// The memory of diagonals and of pairs: springs laid out as their functions read them.
#pragma once

#include "mysim/network/kernels.h"
#include "mysim/strip/sheet_body.h"

namespace crosscheck::network {

using strip::Lines;
/// Springs turned so that a < b, in the order of a.
using Turned = std::vector<Spring>;

class DiagonalMemory {
 public:
  /// Each of them springs of one offset, no two alike.
  DiagonalMemory(const std::vector<Turned>& diagonals, int particles);
  const Diagonals& view() const { return view_; }
  /// Springs of some rest length whose ends are in one place, as last put there.
  long met() const;

 private:
  void fill_lines(const std::vector<Turned>& diagonals);

  Diagonals view_{};
  std::vector<Diagonal> diagonals_;
  std::vector<int> line_;
  std::vector<Lines<double>> rings_;
  Lines<double> lines_, x_, pulls_;
};

class PairMemory {
 public:
  PairMemory(const Turned& springs, int particles);
  const Pairs& view() const { return view_; }
  long met() const;

 private:
  Pairs view_{};
  std::vector<int> ends_;
  Lines<double> k_, rest_, x_, force_;
};

}  // namespace crosscheck::network
