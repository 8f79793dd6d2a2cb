// See pairs.h. Compiled once for each instruction set, CROSSCHECK_ISA naming it.
#include "mysim/network/pairs.h"

#include "mysim/network/law.h"

namespace crosscheck::network {
namespace {

ALWAYS void put(const Pairs& s, const double* x) {
  for (int i = 0; i < s.particles; ++i)
    for (int c = 0; c < 3; ++c) s.x[4L * i + c] = x[3L * i + c];
  for (long i = 0; i < 4L * s.particles; i += 4) L::store_record(s.force + i, L::Record{});
}

template <bool hooke>
bool pairs(const Pairs& s, const double* x, double* f) {
  put(s, x);
  V least = L::all(1);
  for (int i = 0; i < s.springs; i += L::width) {
    const int* ends = s.ends + 2L * i;
    const L::Records d = L::apart(s.x, ends);
    const V squared = L::squares(d);
    least = L::min(least, squared);
    const V scale = scale_of<hooke>(squared, L::load(s.k + i), L::load(s.rest + i));
    L::each_scaled(
        d, scale, [&](int spring, L::Record pull) __attribute__((always_inline)) {
          double *a = s.force + ends[2 * spring], *b = s.force + ends[2 * spring + 1];
          L::store_record(a, L::record(a) + pull);
          L::store_record(b, L::record(b) - pull);
        });
  }
  for (int i = 0; i < s.particles; ++i) L::add_point(f + 3L * i, L::record(s.force + 4L * i));
  return L::any_below(least, L::all(smallest));
}

}  // namespace

namespace CROSSCHECK_ISA {

bool hooke_pairs(const Pairs& s, const double* x, double* f) { return pairs<true>(s, x, f); }
bool link_pairs(const Pairs& s, const double* x, double* f) { return pairs<false>(s, x, f); }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::network
