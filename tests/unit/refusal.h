// What bad input is told.
#pragma once

#include <string>

#include "mysim/errors.h"

namespace crosscheck::testing_tools {

/// The message of the InputError that f throws; empty when it throws none.
template <class F>
std::string refusal_of(F f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace crosscheck::testing_tools
