// States that come back from a student.
#pragma once

#include <stdexcept>
#include <string>

#include "numbers.h"
#include "pendulum.h"

namespace coursework {

inline const State& expect_size(const char* what, const State& s, std::size_t size) {
  if (s.size() != size)
    throw std::length_error(std::string(what) + " has " + std::to_string(s.size()) + " vectors, the state has " +
                            std::to_string(size));
  return s;
}

}  // namespace coursework
