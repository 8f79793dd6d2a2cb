// The named numbers of a call: what stands under one name in all repetitions of a group is one parameter. C++17,
// standard library only.
#pragma once

#include <string>
#include <vector>

#include "layout.h"

namespace coursework {

/// Rows of numbers with one name: one row, or one for each particle, spring, place.
struct Param {
  std::string name;
  std::vector<std::size_t> at;  // where its numbers stand, row after row
  std::size_t rows = 1, columns = 1;
  int group = -1;
  bool whole = false, angle = false;
  bool scalar() const { return at.size() == 1; }
};

/// Of a list, as m[particles], each number is a row.
std::vector<Param> params_of(const CallLayout& layout);

/// What number this is in terms of the call's: "2", "-1/2", "h", "1/m", "h^2/2"; its digits where it is none of them or
/// several.
std::string named_number(double value, double relative, const std::vector<Param>& params, const Numbers& in);

/// The same, and empty where no name fits, or several do.
std::string name_of_number(double value, double relative, const std::vector<Param>& params, const Numbers& in);

/// All that it may be called, as 1/2 and 1/m where m = 2; none where no name fits.
std::vector<std::string> names_of_number(double value, double relative, const std::vector<Param>& params,
                                         const Numbers& in);

}  // namespace coursework
