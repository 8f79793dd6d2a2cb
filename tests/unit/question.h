// A shipped scene under a method, as regress asks it.
#pragma once

#include "experiments/regress/answer.h"
#include "experiments/scenes.h"

namespace crosscheck::testing_tools {

inline Question question(const std::string& scene = "spring", const std::string& method = "leapfrog") {
  return {load_scene(scene), find_method(method)};
}

}  // namespace crosscheck::testing_tools
