// Which ingredient, or which rule, the failures have in common.
#pragma once

#include <span>

#include "experiments/regress/verdicts.h"

namespace crosscheck {

/// In words for people; empty where it is not attributed. Settings that the engine tells are named where they changed
/// in every question that moved. An ingredient is named only where
///   every question that moved has it,
///   taking it out makes the difference vanish, wherever that was asked and moved before,
///   every shipped scene that has it moved (under the methods that moved),
/// and no other ingredient fits as well. Rules, three at most, are named where nothing but they moved, and where each
/// scene that moved under them was asked under another rule and did not. Questions whose run was refused or failed
/// before tell nothing. What fits neither way is not attributed.
std::string cause_of(std::span<const Question> questions, std::span<const Compared> rows);

}  // namespace crosscheck
