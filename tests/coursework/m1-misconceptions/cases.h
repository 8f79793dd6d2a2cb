// Inputs and expected answers of sag.cpp and iterations.cpp.
#pragma once

#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/random.h"

namespace coursework::m1 {

std::vector<Case> catenaries(Random& random);
std::vector<Case> parabolas(Random& random);
std::vector<Case> elastic_chains(Random& random);

std::vector<Case> frames(Random& random);
std::vector<Case> many(Random& random);
std::vector<Case> tables(Random& random);
std::vector<Case> measured(Random& random);

}  // namespace coursework::m1
