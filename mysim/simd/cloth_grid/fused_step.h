// The fused step: kick and drift of a whole cloth in place, in one pass over its rows. With the force f_i on particle i
// and the length h of the kick
//   f_i  = sum over the springs of i:  k (L / |x_i - x_j| - 1) (x_i - x_j)       N, Hooke's law, rest length L
//   v_i' = v_i + inverse_mass_dt f_i + dt a - damping v_i                        a: gravity and uniform wind
//   x_i* = x_i + drift_before v_i'
//   (x_i*, v_i') = on_contact(x_i*, v_i')                                        if x_i* is near a surface
//   x_i' = x_i* + drift_after v_i'
// with dt = h / (1 + h gamma / 2), inverse_mass_dt = dt / m and damping = dt gamma (symplectic Euler: dt = h). Leapfrog
// keeps x half a step ahead: drift_before = h / 2 ends this step, and drift_after = h / 2 begins the next. Results
// differ from steppers/leapfrog.cpp and steppers/symplectic_euler.cpp, which define the rules, by round-off only.
//
// A cloth is a regular grid of rows x columns. Column c of a row is in lane c / tiles of tile c % tiles, so that
// neighbours in a row are whole adjacent tiles and nothing has to be gathered. A tile holds one cache line of each
// coordinate, whatever the instruction set. The halo of a row consists of copies of its first two tiles and of its last
// one, shifted by a lane: every spring then connects tile to tile, even at the ends. Lanes without a particle have
// stiffness 0.
//
// A row is complete when the rows above and the row itself have contributed their forces. It is then kicked and drifted
// in place, since no later row needs its old positions. A step is therefore one pass that evaluates each spring once,
// with three rows of forces as memory.
//
// A slab of a cloth is stepped like a whole cloth. Its halo rows, which belong to its neighbours, do not move; the
// leading ones contribute their forces again, in the order of a pass over the whole cloth.
#pragma once

namespace crosscheck::simd {

inline constexpr int directions = 6;  // spring directions, towards later particles
/// Offset between the ends of a spring: to the next particle of the row or the one after it; to the next row, straight
/// or along a diagonal; or straight to the row after the next.
struct Direction {
  int down, right;
};
static constexpr Direction direction[directions] = {{0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, -1}, {2, 0}};

template <class T>
inline constexpr int lanes = 64 / sizeof(T);

inline constexpr int left_halo = 1, right_halo = 2;  // tiles per row

/// The fused step calls back for particles closer to `centre` than the root of `squared_radius`.
struct BoundingSphere {
  double centre[3], squared_radius;  // m, m^2
};
/// Receives one tile at the end of the step, lane by lane: positions and velocities, which it may modify.
template <class T>
using ContactCallback = void (*)(void* user_data, int row, int tile, T* x, T* v);

template <class T>
struct ClothGrid {
  int rows, tiles;                  // tiles: of a row, without halo
  int leading_halo, trailing_halo;  // number of rows at the start and at the end that belong to a neighbour
  T *x, *v;                         // m, m/s: rows x (left_halo + tiles + right_halo) x 3 x lanes; v without halo
  T* force;                         // N: three rows in the layout of x, working memory
  const T* k[directions];           // N/m: tiles x lanes; null if there is no spring
  T rest[directions];               // m
  const T *damping, *inverse_mass_dt, *dt;  // 1, s/kg, s: per particle (rows x tiles x lanes), or one tile for all
  int stride;                               // between particles' factors: lanes, or 0 for one tile
};

/// A fixed sphere (terms/surface.h).
struct RestingSphere {
  double centre[3], contact_radius;  // m
  double friction, restitution;      // 1
};
/// A half-space: the fused step calls back for particles closer than `near` to its face, which passes through `origin`.
/// It must be fixed if contacts are resolved in lanes.
struct BoundingPlane {
  double origin[3], normal[3], near;  // m, 1, m
  double friction, restitution;       // 1
};

/// Parameters of a fused step besides the springs. ClothGrid stores `damping` and not 1 - damping, because rounding the
/// latter would lose a fraction of the damping in every step.
template <class T>
struct KickDrift {
  T uniform_acceleration[3];    // m/s^2
  T drift_before, drift_after;  // s
  const BoundingSphere* bounding_spheres;
  int bounding_sphere_count;
  ContactCallback<T> on_contact;
  void* user_data;
  const RestingSphere* resting_spheres;  // as many as bounding spheres
  const BoundingPlane* planes = nullptr;
  int plane_count = 0;
  bool in_lanes = false;  // resolve contacts in lanes, not by the callback; double precision only
};

template <class T>
struct Kernel {
  /// Returns the number of springs with nonzero rest length whose ends coincided; they exert no force.
  long (*fused_step)(const ClothGrid<T>&, const KickDrift<T>&);
  /// 1 / sqrt of each element, as used for springs; `count` must be a multiple of the number of lanes.
  void (*rsqrt_array)(const T* s, T* y, long count);
  /// Measures the machine's peak by `rounds` rounds of independent multiplications and additions in registers. `sum`
  /// receives a value that depends on all of them. Returns the operations per round.
  int (*multiply_and_add)(long rounds, T* sum);
};

}  // namespace crosscheck::simd
