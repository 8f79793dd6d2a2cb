// What kind of scene it is, in a word for tables and sentences.
#pragma once

#include <string>

#include "mysim/scene.h"

namespace crosscheck {

/// "ball", "hard lengths", "cloth", "springs", "rotation" or "free flight": by what is hardest in it.
std::string kind_of(const Scene& scene);

}  // namespace crosscheck
