// Diagnosis of a wrong answer: which parts are right, and what explains the wrong numbers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "judge.h"
#include "params.h"
#include "texts.h"

namespace coursework {

/// Columns that are components of one vector, such as x, y, z of a velocity.
struct Block {
  std::string name;  // without components; empty if the row is just "x, y, z"
  std::size_t begin = 0, width = 1;
};
std::vector<Block> blocks_of(const Texts& own, const Case& what);

/// Other cases, and the same student's answers to them.
using Answered = std::vector<std::pair<Case, Answer>>;

/// All other cases with the same call.
Answered others_of(const Case& what, const std::vector<Case>& cases, const std::vector<Answer>& answers);

/// Diagnosis as text, for example "Right: x'. Wrong: v' of particle 1, 2. Where v' is wrong, it is 1/m times the right
/// one." Reports only explanations that hold to round-off for all wrong numbers of a vector, and only if at most two
/// explanations do. A single case may match by chance: if other cases are wrong in the same vector, at least one of
/// them must confirm the explanation, and a factor always needs such a second case. Empty if the answer is right or
/// missing, or if its rows may have any order. Without explanations if the tolerance is much larger than round-off.
std::string seen_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer,
                      const Answered& others = {});

/// As seen_text(), but for numbers that are not an answer by themselves, such as the contribution of a term. Does not
/// say which numbers are right. Empty if no simple explanation fits.
std::string instead_text(const Texts& common, const Texts& own, const Case& what, const Answer& answer,
                         const Answered& others = {});

}  // namespace coursework
