// The active defect: the one named in the environment, or none. Read once.
#pragma once

#include <cstdlib>
#include <cstring>

namespace crosscheck {

inline bool mutant(const char* name) {
  static const char* chosen = std::getenv("CROSSCHECK_MUTANT");
  return chosen && std::strcmp(chosen, name) == 0;
}

}  // namespace crosscheck
