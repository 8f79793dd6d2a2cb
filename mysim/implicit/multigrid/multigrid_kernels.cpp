// Linearisation, matrix products, grid transfers and vector operations of the V-cycle, compiled once per instruction
// set.
#include "mysim/implicit/multigrid/multigrid_kernels.h"

#include <cassert>

#include "mysim/simd/cloth_grid/rows.h"

namespace crosscheck::multigrid {

namespace {

using simd::clear;
using simd::fill_halo;
using simd::reduce_halo;

template <class T>
using L = simd::Lanes<T>;
template <class T>
using V = typename L<T>::V;

/// `numbers`: values per particle.
template <int numbers>
inline constexpr int tile_size = numbers* lanes;

FORCE_INLINE long row_length(int tiles, int numbers) {
  return static_cast<long>(left_halo + tiles + right_halo) * numbers * lanes;
}

/// First tile of a row of a field.
template <class T>
FORCE_INLINE T* row_of(T* field, int tiles, int row) {
  return field + row * row_length(tiles, 3) + left_halo * tile_size<3>;
}

/// Visits the rows in order. begin(row, sums) adds to sums[0] (the row itself) and to sums[1], sums[2] (the next two).
/// As soon as nothing more will be added to a row, finish(row, sums) is called for it. `memory`: three rows.
template <int numbers, class T, class Begin, class Finish>
FORCE_INLINE void over_rows(int rows, int tiles, T* memory, Begin begin, Finish finish) {
  const long length = row_length(tiles, numbers), first = left_halo * tile_size<numbers>;
  T* sums[3] = {memory + first, memory + length + first, memory + 2 * length + first};
  for (T* row : sums) clear(row - first, length);
  for (int r = 0; r < rows; ++r) {
    begin(r, sums);
    reduce_halo<tile_size<numbers>>(sums[0], tiles);
    finish(r, sums[0]);
    T* done = sums[0];
    clear(done - first, length);
    sums[0] = sums[1], sums[1] = sums[2], sums[2] = done;
  }
}

/// Sums lane by lane, independent of the register width.
struct Sum {
  alignas(64) double each[lanes] = {};
  double total() const {
    double all = 0;
    for (const double one : each) all += one;
    return all;
  }
};

using D = L<double>;
using Vd = V<double>;

/// m^2; springs shorter than the square root of this have no direction and no stiffness.
inline constexpr double min_squared_length = 1e-290;

struct Stiffness {
  Vd n[3], a;   // as in Matrix
  Vd block[6];  // N/m: xx yy zz xy xz yz
};

/// Stiffness by Hooke's law: k along the spring, k (1 - L / length) across it.
FORCE_INLINE Stiffness stiffness_of(const Vd* d, Vd k, Vd rest, bool clamped) {
  Vd squared = D::fma(d[2], d[2], D::fma(d[1], d[1], d[0] * d[0]));
  const Vd inverse = simd::rsqrt<double, false>(D::max(squared, D::all(min_squared_length)));
  // 1 where the ends are distinct, otherwise 0
  const Vd there = D::min(squared * D::all(1 / min_squared_length), D::all(1));
  Stiffness s;
  s.a = there * k * D::fnma(rest, inverse, D::all(1));
  if (clamped) s.a = D::max(s.a, D::all(0));
  const Vd left = D::max(D::fnma(there, s.a, there * k), D::all(0)), root = D::root(left);
  for (int c = 0; c < 3; ++c) s.n[c] = root * (d[c] * inverse);
  for (int c = 0; c < 3; ++c) s.block[c] = D::fma(s.n[c], s.n[c], s.a);
  s.block[3] = s.n[0] * s.n[1], s.block[4] = s.n[0] * s.n[2], s.block[5] = s.n[1] * s.n[2];
  return s;
}

FORCE_INLINE void add_block(double* to, const Vd* block) {
  for (int i = 0; i < 6; ++i) D::store(to + i * lanes, D::load(to + i * lanes) + block[i]);
}

void linearise(const SpringGeometry& s, double* const* springs, double* blocks) {
  const long length = row_length(s.tiles, 3);
  for (int row = 0; row < s.rows; ++row) fill_halo<tile_size<3>>(row_of(s.x, s.tiles, row), s.tiles);
  over_rows<6>(
      s.rows, s.tiles, s.sums,
      [&](int row, double* const* sums) __attribute__((always_inline)) {
        const double* x = row_of(s.x, s.tiles, row);
        for (int d = 0; d < directions; ++d) {
          const Direction to = direction[d];
          if (!s.k[d] || row + to.down >= s.rows) continue;
          for (int b = 0; b < s.tiles; ++b)
            for (int lane = 0; lane < lanes; lane += D::width) {
              const double* near = x + b * tile_size<3> + lane;
              const double* far = near + to.down * length + to.right * tile_size<3>;
              Vd apart[3];
              for (int c = 0; c < 3; ++c) apart[c] = D::load(near + c * lanes) - D::load(far + c * lanes);
              const Stiffness k = stiffness_of(apart, D::load(s.k[d] + b * lanes + lane), D::all(s.rest[d]), s.clamped);
              double* kept = springs[d] + (static_cast<long>(row) * s.tiles + b) * tile_size<4> + lane;
              for (int c = 0; c < 3; ++c) D::store(kept + c * lanes, k.n[c]);
              D::store(kept + 3 * lanes, k.a);
              add_block(sums[0] + b * tile_size<6> + lane, k.block);
              add_block(sums[to.down] + (b + to.right) * tile_size<6> + lane, k.block);
            }
        }
      },
      [&](int row, const double* sums) __attribute__((always_inline)) {
        double* to = blocks + static_cast<long>(row) * s.tiles * tile_size<6>;
        for (int i = 0; i < s.tiles * tile_size<6>; i += D::width) D::store(to + i, D::load(sums + i));
      });
}

/// Inverts by cofactors, which keeps the inverse exactly as symmetric as the block.
void invert(double* blocks, const double* inertia, const double* free, long count) {
  assert(count >= 0);
  for (long i = 0; i < count; ++i, blocks += tile_size<6>, inertia += lanes, free += lanes)
    for (int lane = 0; lane < lanes; lane += D::width) {
      double* at = blocks + lane;
      const Vd m = D::load(inertia + lane), open = D::load(free + lane);
      const Vd xx = D::load(at) + m, yy = D::load(at + lanes) + m, zz = D::load(at + 2 * lanes) + m,
               xy = D::load(at + 3 * lanes), xz = D::load(at + 4 * lanes), yz = D::load(at + 5 * lanes);
      const Vd cofactors[6] = {D::fnma(yz, yz, yy * zz), D::fnma(xz, xz, xx * zz), D::fnma(xy, xy, xx * yy),
                               D::fnma(xy, zz, xz * yz), D::fnma(xz, yy, xy * yz), D::fnma(yz, xx, xy * xz)};
      const Vd determinant = D::fma(xz, cofactors[4], D::fma(xy, cofactors[3], xx * cofactors[0]));
      // the determinant of a fixed particle's block may be zero
      const Vd over = open / (determinant + (D::all(1) - open));
      for (int c = 0; c < 6; ++c) D::store(at + c * lanes, over * cofactors[c]);
    }
}

void to_float(const double* from, float* to, long count) {
  for (long i = 0; i < count; ++i) to[i] = static_cast<float>(from[i]);
}

template <int value>
struct Number {};

/// Adds the force a d + (n . d) n of a spring to `own` and subtracts it from `other`.
template <class T>
FORCE_INLINE void spring(const V<T>* near, V<T>* own, const T* far, T* other, const T* s) {
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

/// Adds the forces K x of the springs that start in a row to the sums of the rows of both ends.
template <class T>
FORCE_INLINE void springs_of_row(const Matrix<T>& m, const T* x, int row, T* const* sums) {
  const long length = row_length(m.tiles, 3);
  for (int b = 0; b < m.tiles; ++b)
    for (int lane = 0; lane < lanes; lane += L<T>::width) {
      const long at = static_cast<long>(b) * tile_size<3> + lane;
      V<T> near[3], own[3];
      for (int c = 0; c < 3; ++c)
        near[c] = L<T>::load(x + at + c * lanes), own[c] = L<T>::load(sums[0] + at + c * lanes);
      const auto take = [&]<int d>(Number<d>) __attribute__((always_inline)) {
        constexpr Direction to = direction[d];
        if (!m.springs[d] || row + to.down >= m.rows) return;
        const long there = at + to.right * tile_size<3>;
        spring<T>(near, own, x + to.down * length + there, sums[to.down] + there,
                  m.springs[d] + (static_cast<long>(row) * m.tiles + b) * tile_size<4> + lane);
      };
      take(Number<0>{}), take(Number<1>{}), take(Number<2>{}), take(Number<3>{}), take(Number<4>{}), take(Number<5>{});
      for (int c = 0; c < 3; ++c) L<T>::store(sums[0] + at + c * lanes, own[c]);
    }
}

/// Calls take(position in the field, tile, lane, A x there) for each register of each row, then done(position of the
/// row).
template <class T, class Take, class Done>
FORCE_INLINE void each_product(const Matrix<T>& m, const T* x, Take take, Done done) {
  over_rows<3>(
      m.rows, m.tiles, m.force,
      [&](int row, T* const* sums)
          __attribute__((always_inline)) { springs_of_row(m, row_of(x, m.tiles, row), row, sums); },
      [&](int row, const T* sums) __attribute__((always_inline)) {
        const long begin = row_of(x, m.tiles, row) - x;
        for (int b = 0; b < m.tiles; ++b)
          for (int lane = 0; lane < lanes; lane += L<T>::width) {
            const long in_row = static_cast<long>(b) * tile_size<3> + lane, at = begin + in_row;
            const long tile = static_cast<long>(row) * m.tiles + b;
            const V<T> inertia = L<T>::load(m.inertia + tile * lanes + lane);
            V<T> product[3];
            for (int c = 0; c < 3; ++c)
              product[c] = L<T>::fma(inertia, L<T>::load(x + at + c * lanes), L<T>::load(sums + in_row + c * lanes));
            take(at, tile, lane, product);
          }
        done(begin);
      });
}

double product(const Matrix<double>& m, const double* p, double* q) {
  using D = L<double>;
  Sum sum;
  each_product(
      m, p,
      [&](long at, long tile, int lane, const V<double>* product) __attribute__((always_inline)) {
        const V<double> free = D::load(m.free + tile * lanes + lane);
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

FORCE_INLINE void scale(const Matrix<float>& m, long tile, int lane, const V<float>* r, V<float>* z) {
  using F = L<float>;
  const float* i = m.inverse + tile * tile_size<6> + lane;
  const V<float> xx = F::load(i), yy = F::load(i + lanes), zz = F::load(i + 2 * lanes), xy = F::load(i + 3 * lanes),
                 xz = F::load(i + 4 * lanes), yz = F::load(i + 5 * lanes);
  z[0] = F::fma(xz, r[2], F::fma(xy, r[1], xx * r[0]));
  z[1] = F::fma(yz, r[2], F::fma(yy, r[1], xy * r[0]));
  z[2] = F::fma(zz, r[2], F::fma(yz, r[1], xz * r[0]));
}

void smooth_first(const Matrix<float>& m, float take, const float* b, float* x, float* change) {
  using F = L<float>;
  for (int row = 0; row < m.rows; ++row) {
    const long begin = row_of(x, m.tiles, row) - x;
    for (int i = 0; i < m.tiles; ++i)
      for (int lane = 0; lane < lanes; lane += F::width) {
        const long at = begin + static_cast<long>(i) * tile_size<3> + lane;
        V<float> r[3], z[3];
        for (int c = 0; c < 3; ++c) r[c] = F::load(b + at + c * lanes);
        scale(m, static_cast<long>(row) * m.tiles + i, lane, r, z);
        for (int c = 0; c < 3; ++c) {
          const V<float> all = F::all(take) * z[c];
          F::store(x + at + c * lanes, all), F::store(change + at + c * lanes, all);
        }
      }
    fill_halo<tile_size<3>>(x + begin, m.tiles);
  }
}

void smooth(const Matrix<float>& m, bool first, float keep, float take, const float* b, float* x, float* change) {
  using F = L<float>;
  if (first) return smooth_first(m, take, b, x, change);
  each_product(
      m, static_cast<const float*>(x),
      [&](long at, long tile, int lane, const V<float>* product) __attribute__((always_inline)) {
        V<float> r[3], z[3];
        for (int c = 0; c < 3; ++c) r[c] = F::load(b + at + c * lanes) - product[c];
        scale(m, tile, lane, r, z);
        for (int c = 0; c < 3; ++c) {
          const long i = at + c * lanes;
          const V<float> step = F::fma(F::all(keep), F::load(change + i), F::all(take) * z[c]);
          F::store(change + i, step), F::store(x + i, F::load(x + i) + step);
        }
      },
      [&](long begin) __attribute__((always_inline)) { fill_halo<tile_size<3>>(x + begin, m.tiles); });
}

void residual(const Matrix<float>& m, const float* b, const float* x, float* r) {
  using F = L<float>;
  each_product(
      m, x,
      [&](long at, long tile, int lane, const V<float>* product) __attribute__((always_inline)) {
        const V<float> free = F::load(m.free + tile * lanes + lane);
        for (int c = 0; c < 3; ++c) F::store(r + at + c * lanes, free * (F::load(b + at + c * lanes) - product[c]));
      },
      [&](long begin) __attribute__((always_inline)) { fill_halo<tile_size<3>>(r + begin, m.tiles); });
}

using F = L<float>;
using Vf = V<float>;

/// Restriction weight of the fine row after an even one: 1/2, or 1 if there is no next coarse row.
FORCE_INLINE float down(const Transfer& t, int coarse_row) { return coarse_row + 1 < t.coarse_rows ? 0.5f : 1; }

FORCE_INLINE Vf gathered(const Transfer& t, const float* fine, int tile, int lane, int c) {
  const float* at = fine + 2L * tile * tile_size<3> + c * lanes + lane;
  const Vf right = F::load(t.right + tile * lanes + lane), left = F::load(t.left + tile * lanes + lane);
  return F::fma(right, F::load(at + tile_size<3>), F::fma(left, F::load(at - tile_size<3>), F::load(at)));
}

void restrict_residual(const Transfer& t, const float* r, float* b) {
  const int fine_tiles = 2 * t.coarse_tiles;
  for (int row = 0; row < t.coarse_rows; ++row) {
    float* to = row_of(b, t.coarse_tiles, row);
    const float* here = row_of(r, fine_tiles, 2 * row);
    const long length = row_length(fine_tiles, 3);
    const bool above = row > 0, below = 2 * row + 1 < t.fine_rows;
    for (int i = 0; i < t.coarse_tiles; ++i)
      for (int c = 0; c < 3; ++c)
        for (int lane = 0; lane < lanes; lane += F::width) {
          Vf sum = gathered(t, here, i, lane, c);
          if (above) sum = F::fma(F::all(0.5f), gathered(t, here - length, i, lane, c), sum);
          if (below) sum = F::fma(F::all(down(t, row)), gathered(t, here + length, i, lane, c), sum);
          F::store(to + i * tile_size<3> + c * lanes + lane, sum);
        }
  }
}

/// Adds `one` times a coarse row and `two` times the next coarse row to a fine row.
FORCE_INLINE void spread(const Transfer& t, const float* coarse, float one, float two, const float* free, float* fine) {
  const long next_row = two == 0 ? 0 : row_length(t.coarse_tiles, 3);
  const auto between = [&](const float* at) __attribute__((always_inline)) {
    return F::fma(F::all(two), F::load(at + next_row), F::all(one) * F::load(at));
  };
  const auto add = [](float* to, Vf open, Vf more) __attribute__((always_inline)) {
    F::store(to, F::fma(open, more, F::load(to)));
  };
  for (int i = 0; i < t.coarse_tiles; ++i)
    for (int lane = 0; lane < lanes; lane += F::width) {
      const Vf own = F::load(t.right + i * lanes + lane), other = F::all(1) - own;
      const Vf open = F::load(free + 2L * i * lanes + lane), open_next = F::load(free + (2L * i + 1) * lanes + lane);
      for (int c = 0; c < 3; ++c) {
        const float* at = coarse + i * tile_size<3> + c * lanes + lane;
        const Vf here = between(at), there = between(at + tile_size<3>);
        float* to = fine + 2L * i * tile_size<3> + c * lanes + lane;
        add(to, open, here);
        add(to + tile_size<3>, open_next, F::fma(own, here, other * there));
      }
    }
  fill_halo<tile_size<3>>(fine, 2 * t.coarse_tiles);
}

void prolong_and_add(const Transfer& t, const float* coarse, const float* free, float* x) {
  assert(t.coarse_rows == (t.fine_rows + 1) / 2);
  const int fine_tiles = 2 * t.coarse_tiles;
  for (int row = 0; row < t.fine_rows; ++row) {
    const float* from = row_of(coarse, t.coarse_tiles, row / 2);
    const float one = row % 2 == 0 ? 1 : down(t, row / 2), two = 1 - one;
    spread(t, from, one, two, free + static_cast<long>(row) * fine_tiles * lanes, row_of(x, fine_tiles, row));
  }
}

/// Visits registers and rows like each_product().
template <class Take, class Done>
FORCE_INLINE void each_place(int rows, int tiles, Take take, Done done) {
  for (int row = 0; row < rows; ++row) {
    const long begin = row * row_length(tiles, 3) + left_halo * tile_size<3>;
    for (long i = 0; i < static_cast<long>(tiles) * tile_size<3>; i += lanes)
      for (int lane = 0; lane < lanes; lane += D::width) take(begin + i + lane, lane);
    done(begin);
  }
}

double update_solution(const Matrix<double>& m, double length, const double* p, const double* q, double* u, double* r,
                       float* single) {
  const Vd by = D::all(length);
  Sum sum;
  each_place(
      m.rows, m.tiles,
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

FORCE_INLINE Vd widened(const float* z) {
  alignas(64) double wide[D::width];
  for (int j = 0; j < D::width; ++j) wide[j] = z[j];
  return D::load(wide);
}

void dot_products(const Matrix<double>& m, const double* r, const double* q, const float* z, double* sums) {
  Sum with_r, with_q;
  each_place(
      m.rows, m.tiles,
      [&](long i, int lane) __attribute__((always_inline)) {
        const Vd wide = widened(z + i);
        D::store(with_r.each + lane, D::fma(wide, D::load(r + i), D::load(with_r.each + lane)));
        D::store(with_q.each + lane, D::fma(wide, D::load(q + i), D::load(with_q.each + lane)));
      },
      [](long) {});
  sums[0] = with_r.total(), sums[1] = with_q.total();
}

void update_direction(const Matrix<double>& m, const float* z, double keep, double* p) {
  each_place(
      m.rows, m.tiles,
      [&](long i, int)
          __attribute__((always_inline)) { D::store(p + i, D::fma(D::all(keep), D::load(p + i), widened(z + i))); },
      [&](long begin) __attribute__((always_inline)) { fill_halo<tile_size<3>>(p + begin, m.tiles); });
}

}  // namespace

namespace CROSSCHECK_ISA {

Kernels kernels_of() {
  return {.linearise = linearise,
          .invert = invert,
          .to_float = to_float,
          .product = product,
          .update_solution = update_solution,
          .dot_products = dot_products,
          .update_direction = update_direction,
          .smooth = smooth,
          .residual = residual,
          .restrict_residual = restrict_residual,
          .prolong_and_add = prolong_and_add};
}

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::multigrid
