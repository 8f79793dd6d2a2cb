// Which instruction set runs the sweep, chosen when it is asked for.
#pragma once

#include <string>
#include <vector>

#include "mysim/strip/kernel.h"

namespace crosscheck::strip {

enum class Isa { sse2, avx2, avx512 };
std::string_view name_of(Isa isa);

/// What this machine has, the best last.
std::vector<Isa> available();

/// The best there is, or the one that CROSSCHECK_INSTRUCTIONS names (sse2, avx2, avx512). Throws InputError where it
/// names none of them or one that this machine lacks.
Isa chosen();

/// `fast`: inverse roots from the machine's own estimate; else the same bits on AVX2 and AVX-512.
template <class T>
Kernel<T> kernel(Isa isa, bool fast);

}  // namespace crosscheck::strip
