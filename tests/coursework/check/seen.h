// What is right in a wrong answer, and what the wrong numbers are instead. C++17, standard library only.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "judge.h"
#include "params.h"
#include "texts.h"

namespace coursework {

/// Columns that are parts of one vector: x, y, z of a velocity.
struct Block {
  std::string name;  // without its parts; empty where the row has no other name
  std::size_t begin = 0, width = 1;
};
std::vector<Block> blocks_of(const Texts& own, const Case& what);

/// Other cases with the same student's answers.
using Answered = std::vector<std::pair<Case, Answer>>;

/// Those of the case's call, but not the case itself.
Answered others_of(const Case& what, const std::vector<Case>& cases, const std::vector<Answer>& answers);

/// "Right: x'. Wrong: v' of particle 1, 2. Where v' is wrong, it is 1/m times the right one." Only what holds for all
/// wrong numbers of a vector to round-off, and only where no more than two such sentences do. One case may hold by
/// chance: where other ones are wrong in that vector too, one of them at least has to say the same, and a factor has to
/// have such another one. Empty where the answer is right, is no answer, has rows in any order, or is compared with a
/// tolerance that round-off does not explain.
std::string seen_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer,
                      const Answered& others = {});

/// The same of numbers that are no answer by themselves, as what a term adds: what they are instead of the right ones;
/// no word on which are right. Empty: nothing simple.
std::string instead_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer,
                         const Answered& others = {});

}  // namespace coursework
