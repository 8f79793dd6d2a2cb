// The functions of the room for each instruction set.
#pragma once

#include "mysim/multigrid/kernel.h"
#include "mysim/strip/kernels.h"

namespace crosscheck::multigrid {

Functions functions(strip::Isa isa);

}  // namespace crosscheck::multigrid
