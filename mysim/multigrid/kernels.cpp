#include "mysim/multigrid/kernels.h"

namespace crosscheck::multigrid {

#define FUNCTIONS_OF(isa)         \
  namespace isa {                 \
  void set_products(Functions&);  \
  void set_shapes(Functions&);    \
  void set_transfers(Functions&); \
  void set_vectors(Functions&);   \
  inline Functions functions() {  \
    Functions f{};                \
    set_products(f);              \
    set_shapes(f);                \
    set_transfers(f);             \
    set_vectors(f);               \
    return f;                     \
  }                               \
  }
FUNCTIONS_OF(sse2)
FUNCTIONS_OF(avx2)
FUNCTIONS_OF(avx512)
#undef FUNCTIONS_OF

Functions functions(strip::Isa isa) {
  return isa == strip::Isa::avx512 ? avx512::functions()
         : isa == strip::Isa::avx2 ? avx2::functions()
                                   : sse2::functions();
}

}  // namespace crosscheck::multigrid
