#include "mysim/network/kernels.h"

namespace crosscheck::network {

#define FUNCTIONS_OF(isa)                                             \
  namespace isa {                                                     \
  bool hooke_diagonals(const Diagonals&, const double* x, double* f); \
  bool link_diagonals(const Diagonals&, const double* x, double* f);  \
  bool hooke_pairs(const Pairs&, const double* x, double* f);         \
  bool link_pairs(const Pairs&, const double* x, double* f);          \
  inline Functions functions(bool hooke) {                            \
    if (hooke) return {hooke_diagonals, hooke_pairs};                 \
    return {link_diagonals, link_pairs};                              \
  }                                                                   \
  }
FUNCTIONS_OF(sse2)
FUNCTIONS_OF(avx2)
FUNCTIONS_OF(avx512)
#undef FUNCTIONS_OF

Functions functions(strip::Isa isa, SpringLaw law) {
  const bool hooke = law == SpringLaw::hooke;
  return isa == strip::Isa::avx512 ? avx512::functions(hooke)
         : isa == strip::Isa::avx2 ? avx2::functions(hooke)
                                   : sse2::functions(hooke);
}

Costs costs(strip::Isa isa) {
  if (isa == strip::Isa::sse2) return {.line = 17, .block = 16, .pair = 2.6, .particle = 2, .plain = 3.1, .call = 30};
  return {.line = 9, .block = 10, .pair = 1.8, .particle = 2, .plain = 3.1, .call = 30};
}

}  // namespace crosscheck::network
