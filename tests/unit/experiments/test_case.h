#pragma once

#include "experiments/regress/cases.h"
#include "experiments/scenes/scenes.h"

namespace crosscheck::testing_tools {

inline Case test_case(const std::string& scene = "spring", const std::string& method = "leapfrog") {
  return {load_scene(scene), find_method(method)};
}

}  // namespace crosscheck::testing_tools
