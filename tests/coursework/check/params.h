// The named numbers of a call: all numbers under one name, in all repetitions of a group, form one parameter.
#pragma once

#include <string>
#include <vector>

#include "layout.h"

namespace coursework {

/// Numbers that share a name: a single row, or a row for each particle, spring or place.
struct Param {
  std::string name;
  std::vector<std::size_t> at;  // positions of its numbers, row by row
  std::size_t rows = 1, columns = 1;
  int group = -1;
  bool whole = false, angle = false;
  bool scalar() const { return at.size() == 1; }
};

/// Returns the parameters of a call. Each number of a list, such as m[particles], is a row.
std::vector<Param> params_of(const CallLayout& layout);

/// The number in terms of the call's parameters, such as "2", "-1/2", "h", "1/m", "h^2/2"; its digits if no name fits,
/// or if several names fit.
std::string named_number(double value, double relative, const std::vector<Param>& params, const Numbers& in);

/// As named_number(), but empty if no name fits, or if several names fit.
std::string name_of_number(double value, double relative, const std::vector<Param>& params, const Numbers& in);

/// All names that fit, such as 1/2 and 1/m if m = 2; empty if none fits.
std::vector<std::string> names_of_number(double value, double relative, const std::vector<Param>& params,
                                         const Numbers& in);

}  // namespace coursework
