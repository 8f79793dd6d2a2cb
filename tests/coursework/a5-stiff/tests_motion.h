#pragma once

#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/random.h"

namespace coursework::a5 {

std::vector<Case> one_spring(Random& random);
std::vector<Case> gravity_and_drag(Random& random);
std::vector<Case> network(Random& random);
std::vector<Case> small_network(Random& random);
std::vector<Case> stiff_chain(Random& random);
std::vector<Case> small_stiff_chain(Random& random);

}  // namespace coursework::a5
