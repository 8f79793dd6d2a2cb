// Vectors of conjugate gradients on fields. Compiled once for each instruction set, CROSSCHECK_ISA naming it.
#include "mysim/multigrid/rows.h"

namespace crosscheck::multigrid {
namespace {

using D = L<double>;
using Vd = V<double>;

/// take(place, lane) for each register of a row's blocks; then done(place of the row).
template <class Take, class Done>
ALWAYS void each_place(int rows, int blocks, Take take, Done done) {
  for (int row = 0; row < rows; ++row) {
    const long begin = row * row_length(blocks, 3) + before * line<3>;
    for (long i = 0; i < static_cast<long>(blocks) * line<3>; i += lanes)
      for (int lane = 0; lane < lanes; lane += D::width) take(begin + i + lane, lane);
    done(begin);
  }
}

double advance(const Matrix<double>& m, double length, const double* p, const double* q, double* u, double* r,
               float* single) {
  const Vd by = D::all(length);
  Sum sum;
  each_place(
      m.rows, m.blocks,
      [&](long i, int lane) __attribute__((always_inline)) {
        D::store(u + i, D::fma(by, D::load(p + i), D::load(u + i)));
        const Vd left = D::fnma(by, D::load(q + i), D::load(r + i));
        D::store(r + i, left);
        for (int j = 0; j < D::width; ++j) single[i + j] = static_cast<float>(r[i + j]);
        D::store(sum.each + lane, D::fma(left, left, D::load(sum.each + lane)));
      },
      [](long) {});
  return sum.total();
}

/// Numbers of single precision as doubles.
ALWAYS Vd widened(const float* z) {
  alignas(64) double wide[D::width];
  for (int j = 0; j < D::width; ++j) wide[j] = z[j];
  return D::load(wide);
}

void overlaps(const Matrix<double>& m, const double* r, const double* q, const float* z, double* sums) {
  Sum with_r, with_q;
  each_place(
      m.rows, m.blocks,
      [&](long i, int lane) __attribute__((always_inline)) {
        const Vd wide = widened(z + i);
        D::store(with_r.each + lane, D::fma(wide, D::load(r + i), D::load(with_r.each + lane)));
        D::store(with_q.each + lane, D::fma(wide, D::load(q + i), D::load(with_q.each + lane)));
      },
      [](long) {});
  sums[0] = with_r.total(), sums[1] = with_q.total();
}

void turn(const Matrix<double>& m, const float* z, double keep, double* p) {
  each_place(
      m.rows, m.blocks,
      [&](long i, int)
          __attribute__((always_inline)) { D::store(p + i, D::fma(D::all(keep), D::load(p + i), widened(z + i))); },
      [&](long begin) __attribute__((always_inline)) { copy_ends<line<3>>(p + begin, m.blocks); });
}

}  // namespace

namespace CROSSCHECK_ISA {

void set_vectors(Functions& f) { f.advance = advance, f.overlaps = overlaps, f.turn = turn; }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::multigrid
