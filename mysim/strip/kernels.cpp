#include "mysim/strip/kernels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "mysim/errors.h"

namespace crosscheck::strip {

// the tables of kernel.cpp, compiled for each
#define TABLES_OF(isa)                \
  namespace isa {                     \
  Kernel<double> double_kernel(bool); \
  Kernel<float> float_kernel(bool);   \
  }
TABLES_OF(sse2)
TABLES_OF(avx2)
TABLES_OF(avx512)
#undef TABLES_OF

std::string_view name_of(Isa isa) {
  constexpr std::string_view names[] = {"sse2", "avx2", "avx512"};
  return names[static_cast<int>(isa)];
}

std::vector<Isa> available() {
  std::vector<Isa> all{Isa::sse2};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) all.push_back(Isa::avx2);
  if (all.size() > 1 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    all.push_back(Isa::avx512);
  return all;
}

Isa chosen() {
  const std::vector<Isa> all = available();
  const char* named = std::getenv("CROSSCHECK_INSTRUCTIONS");
  if (!named || !*named) return all.back();
  for (const Isa isa : all)
    if (name_of(isa) == named) return isa;
  throw InputError(
      fmt::format("CROSSCHECK_INSTRUCTIONS={}: expected sse2, avx2 or avx512, and one that this machine has", named));
}

template <>
Kernel<double> kernel(Isa isa, bool fast) {
  return isa == Isa::avx512 ? avx512::double_kernel(fast)
         : isa == Isa::avx2 ? avx2::double_kernel(fast)
                            : sse2::double_kernel(fast);
}

template <>
Kernel<float> kernel(Isa isa, bool fast) {
  return isa == Isa::avx512 ? avx512::float_kernel(fast)
         : isa == Isa::avx2 ? avx2::float_kernel(fast)
                            : sse2::float_kernel(fast);
}

}  // namespace crosscheck::strip
