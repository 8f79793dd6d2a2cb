// Stiffness of a sheet's springs, and the inverse blocks on the diagonal. Compiled once for each instruction set,
// CROSSCHECK_ISA naming it.
#include "mysim/multigrid/rows.h"

namespace crosscheck::multigrid {
namespace {

using D = L<double>;
using Vd = V<double>;

/// m^2: ends nearer than its root have no direction, and their spring no stiffness.
inline constexpr double smallest = 1e-290;

struct Stiffness {
  Vd n[3], a;    // as in Matrix
  Vd blocks[6];  // N/m: xx yy zz xy xz yz
};

/// Of Hooke's law: along the spring k, across it k (1 - L / length).
ALWAYS Stiffness stiffness_of(const Vd* d, Vd k, Vd rest, bool clamped) {
  Vd squared = D::fma(d[2], d[2], D::fma(d[1], d[1], d[0] * d[0]));
  const Vd inverse = strip::inverse_root<double, false>(D::max(squared, D::all(smallest)));
  // 1 where the ends are apart, 0 where they are in one place
  const Vd there = D::min(squared * D::all(1 / smallest), D::all(1));
  Stiffness s;
  s.a = there * k * D::fnma(rest, inverse, D::all(1));
  if (clamped) s.a = D::max(s.a, D::all(0));
  const Vd left = D::max(D::fnma(there, s.a, there * k), D::all(0)), root = D::root(left);
  for (int c = 0; c < 3; ++c) s.n[c] = root * (d[c] * inverse);
  for (int c = 0; c < 3; ++c) s.blocks[c] = D::fma(s.n[c], s.n[c], s.a);
  s.blocks[3] = s.n[0] * s.n[1], s.blocks[4] = s.n[0] * s.n[2], s.blocks[5] = s.n[1] * s.n[2];
  return s;
}

ALWAYS void add_blocks(double* to, const Vd* blocks) {
  for (int i = 0; i < 6; ++i) D::store(to + i * lanes, D::load(to + i * lanes) + blocks[i]);
}

void linearise(const Shape& s, double* const* springs, double* blocks) {
  const long length = row_length(s.blocks, 3);
  for (int row = 0; row < s.rows; ++row) copy_ends<line<3>>(row_of(s.x, s.blocks, row), s.blocks);
  over_rows<6>(
      s.rows, s.blocks, s.sums,
      [&](int row, double* const* sums) __attribute__((always_inline)) {
        const double* x = row_of(s.x, s.blocks, row);
        for (int d = 0; d < directions; ++d) {
          const Direction to = direction[d];
          if (!s.k[d] || row + to.down >= s.rows) continue;
          for (int b = 0; b < s.blocks; ++b)
            for (int lane = 0; lane < lanes; lane += D::width) {
              const double* near = x + b * line<3> + lane;
              const double* far = near + to.down * length + to.right * line<3>;
              Vd apart[3];
              for (int c = 0; c < 3; ++c) apart[c] = D::load(near + c * lanes) - D::load(far + c * lanes);
              const Stiffness k = stiffness_of(apart, D::load(s.k[d] + b * lanes + lane), D::all(s.rest[d]), s.clamped);
              double* kept = springs[d] + (static_cast<long>(row) * s.blocks + b) * line<4> + lane;
              for (int c = 0; c < 3; ++c) D::store(kept + c * lanes, k.n[c]);
              D::store(kept + 3 * lanes, k.a);
              add_blocks(sums[0] + b * line<6> + lane, k.blocks);
              add_blocks(sums[to.down] + (b + to.right) * line<6> + lane, k.blocks);
            }
        }
      },
      [&](int row, const double* sums) __attribute__((always_inline)) {
        double* to = blocks + static_cast<long>(row) * s.blocks * line<6>;
        for (int i = 0; i < s.blocks * line<6>; i += D::width) D::store(to + i, D::load(sums + i));
      });
}

/// By cofactors: symmetric as the blocks are.
void invert(double* blocks, const double* inertia, const double* free, long count) {
  for (long i = 0; i < count; ++i, blocks += line<6>, inertia += lanes, free += lanes)
    for (int lane = 0; lane < lanes; lane += D::width) {
      double* at = blocks + lane;
      const Vd m = D::load(inertia + lane), open = D::load(free + lane);
      const Vd xx = D::load(at) + m, yy = D::load(at + lanes) + m, zz = D::load(at + 2 * lanes) + m,
               xy = D::load(at + 3 * lanes), xz = D::load(at + 4 * lanes), yz = D::load(at + 5 * lanes);
      const Vd cofactors[6] = {D::fnma(yz, yz, yy * zz), D::fnma(xz, xz, xx * zz), D::fnma(xy, xy, xx * yy),
                               D::fnma(xy, zz, xz * yz), D::fnma(xz, yy, xy * yz), D::fnma(yz, xx, xy * xz)};
      const Vd determinant = D::fma(xz, cofactors[4], D::fma(xy, cofactors[3], xx * cofactors[0]));
      // where nothing is free there may be nothing to divide by
      const Vd over = open / (determinant + (D::all(1) - open));
      for (int c = 0; c < 6; ++c) D::store(at + c * lanes, over * cofactors[c]);
    }
}

void narrow(const double* from, float* to, long count) {
  for (long i = 0; i < count; ++i) to[i] = static_cast<float>(from[i]);
}

}  // namespace

namespace CROSSCHECK_ISA {

void set_shapes(Functions& f) { f.linearise = linearise, f.invert = invert, f.narrow = narrow; }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::multigrid
