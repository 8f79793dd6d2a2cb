// Where the particles of a sheet stand in lanes, and numbers of them put there and taken back.
#pragma once

#include "mysim/multigrid/kernel.h"
#include "mysim/strip/sheet_body.h"
#include "mysim/types.h"

namespace crosscheck::multigrid {

using strip::Lines;
using strip::Weave;

struct Layout {
  int rows, columns, blocks;

  /// As many blocks as can be halved often, few of them empty.
  static Layout of(const Weave& weave);
  /// Every second row and column.
  Layout halved() const { return {(rows + 1) / 2, (columns + 1) / 2, blocks / 2}; }
  bool can_be_halved() const { return blocks % 2 == 0 && rows > 2; }

  long all_lanes() const { return static_cast<long>(rows) * blocks * lanes; }
  long row_length() const { return static_cast<long>(before + blocks + after) * 3 * lanes; }
  template <class T>
  Lines<T> field() const {
    return Lines<T>(static_cast<size_t>(rows) * row_length());
  }

  /// take(index of the particle, place among rows x blocks x lanes, place of its first number in a field).
  template <class Take>
  void each(Take take) const {
    for (int row = 0; row < rows; ++row)
      for (int lane = 0, column = 0; column < columns; ++lane)
        for (int block = 0; block < blocks && column < columns; ++block, ++column)
          take(row * columns + column, (static_cast<long>(row) * blocks + block) * lanes + lane,
               row * row_length() + static_cast<long>(before + block) * 3 * lanes + lane);
  }
  /// Every second row and column of a field, without copies.
  void halve(const Lines<double>& fine, Lines<double>& coarse) const;
  /// Points into a field, without its copies.
  void put(const Points& points, double factor, Lines<double>& field) const;
  void get(const Lines<double>& field, double factor, Points& points) const;
};

}  // namespace crosscheck::multigrid
