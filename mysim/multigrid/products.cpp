// Products with the matrix of a sheet, and what is done with them row by row. Compiled once for each instruction set,
// CROSSCHECK_ISA naming it.
#include "mysim/multigrid/rows.h"

namespace crosscheck::multigrid {
namespace {

template <int value>
struct Number {};

/// a d + (n . d) n onto one end, and taken from the other.
template <class T>
ALWAYS void spring(const V<T>* near, V<T>* own, const T* far, T* other, const T* s) {
  const V<T> n[3] = {L<T>::load(s), L<T>::load(s + lanes), L<T>::load(s + 2 * lanes)}, a = L<T>::load(s + 3 * lanes);
  V<T> d[3];
  for (int c = 0; c < 3; ++c) d[c] = near[c] - L<T>::load(far + c * lanes);
  const V<T> along = L<T>::fma(n[2], d[2], L<T>::fma(n[1], d[1], n[0] * d[0]));
  for (int c = 0; c < 3; ++c) {
    const V<T> f = L<T>::fma(along, n[c], a * d[c]);
    own[c] = own[c] + f;
    L<T>::store(other + c * lanes, L<T>::load(other + c * lanes) - f);
  }
}

/// K x of the springs that begin in a row.
template <class T>
ALWAYS void springs_of_row(const Matrix<T>& m, const T* x, int row, T* const* sums) {
  const long length = row_length(m.blocks, 3);
  for (int b = 0; b < m.blocks; ++b)
    for (int lane = 0; lane < lanes; lane += L<T>::width) {
      const long at = static_cast<long>(b) * line<3> + lane;
      V<T> near[3], own[3];
      for (int c = 0; c < 3; ++c)
        near[c] = L<T>::load(x + at + c * lanes), own[c] = L<T>::load(sums[0] + at + c * lanes);
      const auto take = [&]<int d>(Number<d>) __attribute__((always_inline)) {
        constexpr Direction to = direction[d];
        if (!m.springs[d] || row + to.down >= m.rows) return;
        const long there = at + to.right * line<3>;
        spring<T>(near, own, x + to.down * length + there, sums[to.down] + there,
                  m.springs[d] + (static_cast<long>(row) * m.blocks + b) * line<4> + lane);
      };
      take(Number<0>{}), take(Number<1>{}), take(Number<2>{}), take(Number<3>{}), take(Number<4>{}), take(Number<5>{});
      for (int c = 0; c < 3; ++c) L<T>::store(sums[0] + at + c * lanes, own[c]);
    }
}

/// take(place in the row of a field, number of the block and lane, A x there), for each register of each row; then
/// done(row).
template <class T, class Take, class Done>
ALWAYS void each_product(const Matrix<T>& m, const T* x, Take take, Done done) {
  over_rows<3>(
      m.rows, m.blocks, m.force,
      [&](int row, T* const* sums)
          __attribute__((always_inline)) { springs_of_row(m, row_of(x, m.blocks, row), row, sums); },
      [&](int row, const T* sums) __attribute__((always_inline)) {
        const long begin = row_of(x, m.blocks, row) - x;
        for (int b = 0; b < m.blocks; ++b)
          for (int lane = 0; lane < lanes; lane += L<T>::width) {
            const long in_row = static_cast<long>(b) * line<3> + lane, at = begin + in_row;
            const long block = static_cast<long>(row) * m.blocks + b;
            const V<T> inertia = L<T>::load(m.inertia + block * lanes + lane);
            V<T> product[3];
            for (int c = 0; c < 3; ++c)
              product[c] = L<T>::fma(inertia, L<T>::load(x + at + c * lanes), L<T>::load(sums + in_row + c * lanes));
            take(at, block, lane, product);
          }
        done(begin);
      });
}

double product(const Matrix<double>& m, const double* p, double* q) {
  using D = L<double>;
  Sum sum;
  each_product(
      m, p,
      [&](long at, long block, int lane, const V<double>* product) __attribute__((always_inline)) {
        const V<double> free = D::load(m.free + block * lanes + lane);
        V<double> s = D::load(sum.each + lane);
        for (int c = 0; c < 3; ++c) {
          const V<double> kept = free * product[c];
          D::store(q + at + c * lanes, kept);
          s = D::fma(kept, D::load(p + at + c * lanes), s);
        }
        D::store(sum.each + lane, s);
      },
      [](long) {});
  return sum.total();
}

/// D^-1 r.
ALWAYS void scale(const Matrix<float>& m, long block, int lane, const V<float>* r, V<float>* z) {
  using F = L<float>;
  const float* i = m.inverse + block * line<6> + lane;
  const V<float> xx = F::load(i), yy = F::load(i + lanes), zz = F::load(i + 2 * lanes), xy = F::load(i + 3 * lanes),
                 xz = F::load(i + 4 * lanes), yz = F::load(i + 5 * lanes);
  z[0] = F::fma(xz, r[2], F::fma(xy, r[1], xx * r[0]));
  z[1] = F::fma(yz, r[2], F::fma(yy, r[1], xy * r[0]));
  z[2] = F::fma(zz, r[2], F::fma(yz, r[1], xz * r[0]));
}

void relax_first(const Matrix<float>& m, float take, const float* b, float* x, float* change) {
  using F = L<float>;
  for (int row = 0; row < m.rows; ++row) {
    const long begin = row_of(x, m.blocks, row) - x;
    for (int i = 0; i < m.blocks; ++i)
      for (int lane = 0; lane < lanes; lane += F::width) {
        const long at = begin + static_cast<long>(i) * line<3> + lane;
        V<float> r[3], z[3];
        for (int c = 0; c < 3; ++c) r[c] = F::load(b + at + c * lanes);
        scale(m, static_cast<long>(row) * m.blocks + i, lane, r, z);
        for (int c = 0; c < 3; ++c) {
          const V<float> all = F::all(take) * z[c];
          F::store(x + at + c * lanes, all), F::store(change + at + c * lanes, all);
        }
      }
    copy_ends<line<3>>(x + begin, m.blocks);
  }
}

void relax(const Matrix<float>& m, bool first, float keep, float take, const float* b, float* x, float* change) {
  using F = L<float>;
  if (first) return relax_first(m, take, b, x, change);
  each_product(
      m, static_cast<const float*>(x),
      [&](long at, long block, int lane, const V<float>* product) __attribute__((always_inline)) {
        V<float> r[3], z[3];
        for (int c = 0; c < 3; ++c) r[c] = F::load(b + at + c * lanes) - product[c];
        scale(m, block, lane, r, z);
        for (int c = 0; c < 3; ++c) {
          const long i = at + c * lanes;
          const V<float> step = F::fma(F::all(keep), F::load(change + i), F::all(take) * z[c]);
          F::store(change + i, step), F::store(x + i, F::load(x + i) + step);
        }
      },
      [&](long begin) __attribute__((always_inline)) { copy_ends<line<3>>(x + begin, m.blocks); });
}

void residual(const Matrix<float>& m, const float* b, const float* x, float* r) {
  using F = L<float>;
  each_product(
      m, x,
      [&](long at, long block, int lane, const V<float>* product) __attribute__((always_inline)) {
        const V<float> free = F::load(m.free + block * lanes + lane);
        for (int c = 0; c < 3; ++c) F::store(r + at + c * lanes, free * (F::load(b + at + c * lanes) - product[c]));
      },
      [&](long begin) __attribute__((always_inline)) { copy_ends<line<3>>(r + begin, m.blocks); });
}

}  // namespace

namespace CROSSCHECK_ISA {

void set_products(Functions& f) { f.product = product, f.relax = relax, f.residual = residual; }

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::multigrid
