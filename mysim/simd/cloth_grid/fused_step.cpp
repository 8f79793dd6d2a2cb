// Compiled once per instruction set, which CROSSCHECK_ISA names.
#include "mysim/simd/cloth_grid/fused_step.h"

#include <cassert>

#include "mysim/simd/cloth_grid/rows.h"

namespace crosscheck::simd {
namespace {

template <class T>
using V = typename Lanes<T>::V;

/// Coordinates of one register of particles; in memory they are a cache line apart.
template <class T>
struct Three {
  V<T> x, y, z;
};
template <class T>
FORCE_INLINE Three<T> load(const T* p) {
  using L = Lanes<T>;
  return {L::load(p), L::load(p + lanes<T>), L::load(p + 2 * lanes<T>)};
}
template <class T>
FORCE_INLINE void store(T* p, const Three<T>& a) {
  using L = Lanes<T>;
  L::store(p, a.x), L::store(p + lanes<T>, a.y), L::store(p + 2 * lanes<T>, a.z);
}

template <class T>
inline constexpr bool is_double = sizeof(T) == 8;
template <class T>
inline constexpr int tile_size = 3 * lanes<T>;  // numbers per tile

/// m^2; below any nonzero squared length.
template <class T>
inline constexpr T min_squared_length = T(1e-30);

template <class T>
FORCE_INLINE long row_length(const ClothGrid<T>& s) {
  return static_cast<long>(left_halo + s.tiles + right_halo) * tile_size<T>;
}

/// One spring per lane: adds the force to `force` at the near end and subtracts it from `far_force` at the far end.
template <class T, bool fast>
FORCE_INLINE void spring(const Three<T>& near, Three<T>& force, const T* far, T* far_force, const T* k, V<T> rest,
                         V<T>& least) {
  using L = Arithmetic<T, fast>;
  const Three<T> q = load(far);
  const V<T> dx = near.x - q.x, dy = near.y - q.y, dz = near.z - q.z;
  V<T> s = L::fma(dz, dz, L::fma(dy, dy, dx * dx));
  least = L::min(least, s);
  // the force of coincident ends is 0: a large number times 0
  s = L::max(s, L::all(min_squared_length<T>));
  const V<T> scale = L::load(k) * L::fma(rest, rsqrt<T, fast>(s), L::all(-1));
  force.x = L::fma(scale, dx, force.x), force.y = L::fma(scale, dy, force.y), force.z = L::fma(scale, dz, force.z);
  const Three<T> f = load(far_force);
  store(far_force, Three<T>{L::fnma(scale, dx, f.x), L::fnma(scale, dy, f.y), L::fnma(scale, dz, f.z)});
}

template <int n>
struct Number {
  static constexpr int value = n;
};

template <class T>
struct RowWindow {
  const T* x[3];  // this row and the next two, at tile 0; not used beyond the last row
  T* f[3];
};

/// All springs that begin in a row; directions are compile-time constants.
template <class T, bool fast>
FORCE_INLINE void springs_of_row(const ClothGrid<T>& s, const RowWindow<T>& rows, int rows_below, V<T>& least) {
  using L = Lanes<T>;
  for (int b = 0; b < s.tiles; ++b)
    for (int lane = 0; lane < lanes<T>; lane += L::width) {
      const long at = static_cast<long>(b) * tile_size<T> + lane;
      const Three<T> near = load(rows.x[0] + at);
      Three<T> force = load(rows.f[0] + at);
      const auto take = [&](auto d) __attribute__((always_inline)) {
        constexpr Direction to = direction[decltype(d)::value];
        if (!s.k[decltype(d)::value] || to.down > rows_below) return;
        const long there = at + static_cast<long>(to.right) * tile_size<T>;
        spring<T, fast>(near, force, rows.x[to.down] + there, rows.f[to.down] + there,
                        s.k[decltype(d)::value] + static_cast<long>(b) * lanes<T> + lane,
                        L::all(s.rest[decltype(d)::value]), least);
      };
      take(Number<0>{}), take(Number<1>{}), take(Number<2>{}), take(Number<3>{}), take(Number<4>{}), take(Number<5>{});
      store(rows.f[0] + at, force);
    }
}

template <class T>
FORCE_INLINE Three<T> all(const double (&a)[3]) {
  using L = Lanes<T>;
  return {L::all(T(a[0])), L::all(T(a[1])), L::all(T(a[2]))};
}
template <class T>
FORCE_INLINE Three<T> operator+(const Three<T>& a, const Three<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
FORCE_INLINE Three<T> operator-(const Three<T>& a, const Three<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
FORCE_INLINE Three<T> scaled(V<T> by, const Three<T>& a) {
  return {by * a.x, by * a.y, by * a.z};
}
template <class T>
FORCE_INLINE V<T> dot(const Three<T>& a, const Three<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T, class Mask>
FORCE_INLINE Three<T> choose(Mask mask, const Three<T>& a, const Three<T>& b) {
  return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
}

template <class T, bool fast>
FORCE_INLINE bool touches(const Three<T>& x, const BoundingSphere& sphere) {
  using L = Arithmetic<T, fast>;
  const V<T> dx = x.x - L::all(T(sphere.centre[0])), dy = x.y - L::all(T(sphere.centre[1])),
             dz = x.z - L::all(T(sphere.centre[2]));
  return L::any_less(L::fma(dz, dz, L::fma(dy, dy, dx * dx)), L::all(T(sphere.squared_radius)));
}
template <class T, bool fast>
FORCE_INLINE bool touches(const Three<T>& x, const BoundingPlane& plane) {
  return Lanes<T>::any_less(dot<T>(x - all<T>(plane.origin), all<T>(plane.normal)), Lanes<T>::all(T(plane.near)));
}

// resolve_contact() of terms/surface.h, vectorised operation by operation: a test verifies that the bits agree.
// Particles processed one by one take five times as long, because each square root waits for the previous one.

template <class T>
FORCE_INLINE Three<T> shortened(const Three<T>& a, V<T> by) {
  using L = Lanes<T>;
  const V<T> length = L::root(dot<T>(a, a)), none = L::all(0);
  return choose<T>(length <= by, Three<T>{none, none, none}, scaled<T>(L::all(1) - by / length, a));
}
template <class T>
FORCE_INLINE Three<T> normal_of(const Three<T>& d, V<T> length) {
  using L = Lanes<T>;
  const V<T> none = L::all(0);
  return choose<T>(length > none, Three<T>{d.x / length, d.y / length, d.z / length}, Three<T>{none, L::all(1), none});
}
/// Velocity after contact with a fixed surface of normal n; v if the particle recedes.
template <class T, class Solid>
FORCE_INLINE Three<T> velocity_after_contact(const Solid& s, const Three<T>& n, const Three<T>& v) {
  using L = Lanes<T>;
  const V<T> none = L::all(0), friction = L::all(s.friction);
  const V<T> inward = dot<T>(v, n), change = L::all(-(1 + s.restitution)) * inward;
  const Three<T> held = shortened<T>(v - scaled<T>(inward, n), friction * change) + scaled<T>(inward + change, n);
  const Three<T> zero{none, none, none};  // the surface's velocity: adding it turns -0 into 0
  return choose<T>(inward < none, held, v) + zero;
}
template <class T>
FORCE_INLINE void resolve_contact(const RestingSphere& s, const Three<T>& x_n, Three<T>& x, Three<T>& v) {
  using L = Lanes<T>;
  const V<T> radius = L::all(s.contact_radius), friction = L::all(s.friction);
  const Three<T> centre = all<T>(s.centre);
  Three<T> d = x - centre;
  V<T> distance = L::root(dot<T>(d, d));
  const auto touching = distance < radius;
  const V<T> push = radius - distance;
  Three<T> n = normal_of<T>(d, distance), at = centre + scaled<T>(radius, n);
  if (s.friction > 0) {
    const Three<T> moved = at - x_n, along_normal = scaled<T>(dot<T>(moved, n), n);
    d = x_n + along_normal + shortened<T>(moved - along_normal, friction * push) - centre;
    distance = L::root(dot<T>(d, d));
    n = normal_of<T>(d, distance), at = centre + scaled<T>(radius, n);
  }
  x = choose<T>(touching, at, x);
  v = choose<T>(touching, velocity_after_contact<T>(s, n, v), v);
}
template <class T>
FORCE_INLINE void resolve_contact(const BoundingPlane& s, const Three<T>& x_n, Three<T>& x, Three<T>& v) {
  using L = Lanes<T>;
  const Three<T> origin = all<T>(s.origin), n = all<T>(s.normal);
  const V<T> gap = dot<T>(x - origin, n);
  const auto touching = gap < L::all(0);
  Three<T> at = x - scaled<T>(gap, n);
  if (s.friction > 0) {
    const Three<T> moved = at - x_n, along_normal = scaled<T>(dot<T>(moved, n), n);
    at = x_n + along_normal + shortened<T>(moved - along_normal, L::all(-s.friction) * gap);
    at = at - scaled<T>(dot<T>(at - origin, n), n);
  }
  x = choose<T>(touching, at, x);
  v = choose<T>(touching, velocity_after_contact<T>(s, n, v), v);
}

/// Kick, contacts and drift of a row. Scenes without planes do not pay for the code of planes.
template <class T, bool fast, bool planes>
FORCE_INLINE void move_row(const ClothGrid<T>& s, const KickDrift<T>& step, int row, T* x, const T* f) {
  using L = Arithmetic<T, fast>;
  const V<T> drift_before = L::all(step.drift_before), drift_after = L::all(step.drift_after);
  const V<T> fall_x = L::all(step.uniform_acceleration[0]), fall_y = L::all(step.uniform_acceleration[1]),
             fall_z = L::all(step.uniform_acceleration[2]);
  for (int b = 0; b < s.tiles; ++b) {
    T *x_b = x + static_cast<long>(b) * tile_size<T>,
      *v_b = s.v + (static_cast<long>(row) * s.tiles + b) * tile_size<T>;
    alignas(64) T end[tile_size<T>], speed[tile_size<T>];
    bool touched = false;
    const bool in_lanes = is_double<T> && step.in_lanes,
               by_callback = (step.bounding_sphere_count > 0 || (planes && step.plane_count > 0)) && !in_lanes;
    for (int lane = 0; lane < lanes<T>; lane += L::width) {
      const long own = (static_cast<long>(row) * s.tiles + b) * s.stride + lane;
      const V<T> damping = L::load(s.damping + own), inverse_mass_dt = L::load(s.inverse_mass_dt + own),
                 dt = L::load(s.dt + own);
      const Three<T> p = load(x_b + lane), u = load(v_b + lane),
                     pull = load(f + static_cast<long>(b) * tile_size<T> + lane);
      Three<T> v{u.x + L::fnma(damping, u.x, L::fma(inverse_mass_dt, pull.x, dt * fall_x)),
                 u.y + L::fnma(damping, u.y, L::fma(inverse_mass_dt, pull.y, dt * fall_y)),
                 u.z + L::fnma(damping, u.z, L::fma(inverse_mass_dt, pull.z, dt * fall_z))};
      Three<T> e{L::fma(drift_before, v.x, p.x), L::fma(drift_before, v.y, p.y), L::fma(drift_before, v.z, p.z)};
      if constexpr (is_double<T>)
        if (in_lanes) {
          for (int i = 0; i < step.bounding_sphere_count; ++i)
            if (touches<T, fast>(e, step.bounding_spheres[i]))
              resolve_contact<T>(step.resting_spheres[i], p - scaled<T>(drift_after, u), e, v);
          for (int i = 0; planes && i < step.plane_count; ++i)
            if (touches<T, fast>(e, step.planes[i]))
              resolve_contact<T>(step.planes[i], p - scaled<T>(drift_after, u), e, v);
        }
      if (by_callback) {
        store(end + lane, e), store(speed + lane, v);
        for (int i = 0; i < step.bounding_sphere_count; ++i) touched |= touches<T, fast>(e, step.bounding_spheres[i]);
        for (int i = 0; planes && i < step.plane_count; ++i) touched |= touches<T, fast>(e, step.planes[i]);
      } else {
        store(v_b + lane, v);
        store(x_b + lane,
              Three<T>{L::fma(drift_after, v.x, e.x), L::fma(drift_after, v.y, e.y), L::fma(drift_after, v.z, e.z)});
      }
    }
    if (!by_callback) continue;
    if (touched) step.on_contact(step.user_data, row, b, end, speed);
    for (int lane = 0; lane < lanes<T>; lane += L::width) {
      const Three<T> e = load(end + lane), v = load(speed + lane);
      store(v_b + lane, v);
      store(x_b + lane,
            Three<T>{L::fma(drift_after, v.x, e.x), L::fma(drift_after, v.y, e.y), L::fma(drift_after, v.z, e.z)});
    }
  }
  fill_halo<tile_size<T>>(x, s.tiles);
}

/// Degenerate springs that begin in a row, counted one by one; called only if a length was 0.
template <class T>
[[gnu::noinline]] long count_degenerate_springs(const ClothGrid<T>& s, const RowWindow<T>& rows, int rows_below) {
  long degenerate_springs = 0;
  for (int d = 0; d < directions; ++d) {
    if (!s.k[d] || direction[d].down > rows_below || !(s.rest[d] > 0)) continue;
    for (int b = 0; b < s.tiles; ++b)
      for (int lane = 0; lane < lanes<T>; ++lane) {
        const long at = static_cast<long>(b) * tile_size<T> + lane;
        const T *near = rows.x[0] + at, *far = rows.x[direction[d].down] + at + direction[d].right * tile_size<T>;
        degenerate_springs += s.k[d][b * lanes<T> + lane] > 0 && near[0] == far[0] && near[lanes<T>] == far[lanes<T>] &&
                              near[2 * lanes<T>] == far[2 * lanes<T>];
      }
  }
  return degenerate_springs;
}

/// Returns the number of degenerate springs that begin in the slab's own rows.
template <class T, bool fast>
long fused_step(const ClothGrid<T>& s, const KickDrift<T>& step) {
  assert(s.tiles >= 2);  // fits(): a spring crosses at most one lane
  assert(s.leading_halo >= 0 && s.trailing_halo >= 0 && s.rows > s.leading_halo + s.trailing_halo);
  assert(s.damping && s.inverse_mass_dt && s.dt && (s.stride == 0 || s.stride == lanes<T>));
  assert(step.bounding_sphere_count == 0 || (step.bounding_spheres && step.on_contact));
  assert(step.plane_count == 0 || (step.planes && step.on_contact));
  using L = Lanes<T>;
  const long length = row_length(s), first = left_halo * tile_size<T>;
  T* f[3] = {s.force + first, s.force + length + first, s.force + 2 * length + first};
  for (T* row : f) clear(row - first, length);
  long degenerate_springs = 0;
  for (int r = 0; r < s.rows - s.trailing_halo; ++r) {
    T* x = s.x + r * length + first;
    const RowWindow<T> rows{{x, x + length, x + 2 * length}, {f[0], f[1], f[2]}};
    V<T> least = L::all(T(1));
    springs_of_row<T, fast>(s, rows, s.rows - 1 - r, least);
    if (r >= s.leading_halo) {
      if (L::any_less(least, L::all(min_squared_length<T>)))
        degenerate_springs += count_degenerate_springs(s, rows, s.rows - 1 - r);
      reduce_halo<tile_size<T>>(f[0], s.tiles);
      if (step.plane_count > 0)
        move_row<T, fast, true>(s, step, r, x, f[0]);
      else
        move_row<T, fast, false>(s, step, r, x, f[0]);
    }
    T* done = f[0];
    clear(done - first, length);
    f[0] = f[1], f[1] = f[2], f[2] = done;
  }
  return degenerate_springs;
}

template <class T, bool fast>
void rsqrt_array(const T* s, T* y, long count) {
  assert(count % Lanes<T>::width == 0);
  using L = Lanes<T>;
  for (long i = 0; i < count; i += L::width) L::store(y + i, rsqrt<T, fast>(L::load(s + i)));
}

template <class T>
int multiply_and_add(long rounds, T* sum) {
  using L = Lanes<T>;
  constexpr int chains = 12;  // two pipes, each with four or five operations in flight
  V<T> y[chains];
  for (int i = 0; i < chains; ++i) y[i] = L::all(T(1) / T(i + 1));
  const V<T> half = L::all(T(0.5));  // iterates converge to 1, without overflow and slow denormal numbers
  for (long round = 0; round < rounds; ++round)
    for (int i = 0; i < chains; ++i) y[i] = L::fma(y[i], half, half);
  V<T> all = L::all(0);
  for (int i = 0; i < chains; ++i) all = all + y[i];
  alignas(64) T each[L::width];
  L::store(each, all);
  for (const T one : each) *sum += one;
  return 2 * chains * L::width;
}

}  // namespace

namespace CROSSCHECK_ISA {

Kernel<double> double_kernel(bool fast) {
  if (fast) return {fused_step<double, true>, rsqrt_array<double, true>, multiply_and_add<double>};
  return {fused_step<double, false>, rsqrt_array<double, false>, multiply_and_add<double>};
}
Kernel<float> float_kernel(bool fast) {
  if (fast) return {fused_step<float, true>, rsqrt_array<float, true>, multiply_and_add<float>};
  return {fused_step<float, false>, rsqrt_array<float, false>, multiply_and_add<float>};
}

}  // namespace CROSSCHECK_ISA
}  // namespace crosscheck::simd
