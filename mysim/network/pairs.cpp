// See pairs.h. Compiled once for each instruction set, CROSSCHECK_ISA naming it.
#include "mysim/network/pairs.h"

#include "mysim/network/law.h"

namespace crosscheck::network {
namespace {

ALWAYS void put(const Pairs& s, const double* x) {
  for (int i = 0; i < s.particles; ++i)
    for (int c = 0; c < 3; ++c) s.x[4L * i + c] = x[3L * i + c];
}

/// What all its springs do to a particle, onto f.
ALWAYS void finish(const Pairs& s, int i, double* f) {
  L::Record pulls = L::record(s.force + 4 * (s.mask + 1)), pushes = pulls;  // 0
  for (long e = s.begin[i]; e < s.begin[i + 1]; ++e) pulls = pulls + L::record(s.force + 4 * (e & s.mask));
  for (long e = s.end[i]; e < s.end[i + 1]; ++e) pushes = pushes + L::record(s.force + 4L * s.ending[e]);
  L::add_point(f + 3L * i, pulls - pushes);
}

template <bool hooke>
bool pairs(const Pairs& s, const double* x, double* f) {
  put(s, x);
  V least = L::all(1);
  int finished = 0;
  for (int first = 0; first < s.springs; first += group) {
    for (int i = first; i < first + group; i += L::width) {
      const L::Records d = L::apart(s.x, s.ends + 2L * i);
      const V squared = L::squares(d);
      least = L::min(least, squared);
      L::store_scaled(s.force + 4 * (i & s.mask), d, scale_of<hooke>(squared, L::load(s.k + i), L::load(s.rest + i)));
    }
    for (; finished < s.particles && s.begin[finished + 1] <= first + group; ++finished) finish(s, finished, f);
  }
  return L::any_below(least, L::all(smallest));
}

}  // namespace

namespace CROSSCHECK_ISA {

bool hooke_pairs(const Pairs& s, const double* x, double* f) { return pairs<true>(s, x, f); }
bool link_pairs(const Pairs& s, const double* x, double* f) { return pairs<false>(s, x, f); }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::network
