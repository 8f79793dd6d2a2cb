// How far from the exact angle particles leave a ball, in words that a finding and a figure share.
#pragma once

#include <string>

#include "experiments/table.h"

namespace crosscheck {

/// Of table `sphere-leaving`: mysim's rules together, every other method by itself, at the finest step and beside the
/// longest. Empty where no particle leaves.
std::string leaving_sentence(const Table& leaving);

}  // namespace crosscheck
