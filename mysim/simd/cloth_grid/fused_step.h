// The fused step: kick and drift of a whole cloth in place, in one pass over its rows. With f_i the force on particle i
// and h the length of the kick:
//   f_i  = sum over the springs of i:  k (L / |x_i - x_j| - 1) (x_i - x_j)       N, Hooke's law, rest length L
//   v_i' = v_i + inverse_mass_dt f_i + dt a - damping v_i                        a: gravity and uniform wind
//   x_i* = x_i + drift_before v_i'
//   (x_i*, v_i') = on_contact(x_i*, v_i')                                        where x_i* is near a surface
//   x_i' = x_i* + drift_after v_i'
// with dt = h / (1 + h gamma / 2), inverse_mass_dt = dt / m and damping = dt gamma (symplectic Euler: dt = h). Leapfrog
// keeps x half a step ahead: drift_before = h / 2 ends this step and drift_after = h / 2 begins the next. The
// definition is steppers/leapfrog.cpp and steppers/symplectic_euler.cpp, from which this differs by round-off alone.
//
// A cloth is a regular grid of rows x columns. Column c of a row stands in lane c / tiles of tile c % tiles, so that
// neighbours in a row are whole tiles side by side and nothing is gathered; a tile is one cache line of each
// coordinate on every machine, so that data do not depend on the instruction set. The halo of a row are copies of its
// first two tiles and of its last one, shifted by a lane: with them every spring is tile against tile, without an
// exception at the ends. Lanes without a particle have stiffness 0.
//
// A row is finished when the rows above and itself have given it their forces; then it is kicked and drifted in place,
// since no later row needs its old positions. So a whole step is one pass, each spring is taken once, and three
// rows of forces are all the memory it needs. fused_step.cpp is compiled once for each instruction set.
//
// A slab of a cloth is stepped like a whole one. Its halo rows are rows of its neighbours: those before its own give
// them their forces anew, in the order in which a pass over the whole cloth would, and no halo row moves.
#pragma once

namespace crosscheck::simd {

inline constexpr int directions = 6;  // of springs, towards later particles
/// Rows and columns from one end of a spring to the other: along the row, next and skip-one; to the next row, straight
/// and along both diagonals; two rows on.
struct Direction {
  int down, right;
};
static constexpr Direction direction[directions] = {{0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, -1}, {2, 0}};

template <class T>
inline constexpr int lanes = 64 / sizeof(T);

inline constexpr int left_halo = 1, right_halo = 2;  // of a row, in tiles

/// The fused step calls back where a particle comes closer to `centre` than the root of `squared_radius`.
struct BoundingSphere {
  double centre[3], squared_radius;  // m, m^2
};
/// Given one tile as it would be at the end of the step, lane by lane: positions and velocities, which it may change.
template <class T>
using ContactCallback = void (*)(void* user_data, int row, int tile, T* x, T* v);

template <class T>
struct ClothGrid {
  int rows, tiles;                  // tiles of a row, without its halo
  int leading_halo, trailing_halo;  // of the rows, how many at the beginning and at the end are a neighbour's
  T *x, *v;                         // m, m/s: rows x (left_halo + tiles + right_halo) x 3 x lanes; v without halo
  T* force;                         // N: three rows as those of x, working memory
  const T* k[directions];           // N/m: tiles x lanes; null where there are no springs of that direction
  T rest[directions];               // m
  const T *damping, *inverse_mass_dt, *dt;  // 1, s/kg, s: of each particle (rows x tiles x lanes), or one tile for all
  int stride;                               // of these: lanes, or 0 where one tile is for all
};

/// A sphere that does not move (terms/surface.h).
struct RestingSphere {
  double centre[3], contact_radius;  // m
  double friction, restitution;      // 1
};
/// A half-space: the fused step calls back where a particle comes closer than `near` to its face, through `origin`. If
/// contacts are resolved in lanes it does not move.
struct BoundingPlane {
  double origin[3], normal[3], near;  // m, 1, m
  double friction, restitution;       // 1
};

/// Parameters of a fused step besides the springs. `damping` is a number of its own: in 1 - damping, rounded, a
/// fraction of it would be gone in every step.
template <class T>
struct KickDrift {
  T uniform_acceleration[3];    // m/s^2: of all particles alike
  T drift_before, drift_after;  // s
  const BoundingSphere* bounding_spheres;
  int bounding_sphere_count;
  ContactCallback<T> on_contact;
  void* user_data;
  const RestingSphere* resting_spheres;  // as many as bounding ones
  const BoundingPlane* planes = nullptr;
  int plane_count = 0;
  bool in_lanes = false;  // contacts are resolved in lanes and not by the callback; in double precision alone
};

/// The functions of one instruction set.
template <class T>
struct Kernel {
  /// Returns how many springs of some rest length had ends that met, which pull at nothing.
  long (*fused_step)(const ClothGrid<T>&, const KickDrift<T>&);
  /// 1 / sqrt of each, as the springs take it: `count` is a multiple of the lanes.
  void (*rsqrt_array)(const T* s, T* y, long count);
  /// The machine's peak: so many rounds of multiplications and additions in registers, independent of
  /// each other. `sum` takes something that depends on all of them. Returns how many operations a round has.
  int (*multiply_and_add)(long rounds, T* sum);
};

}  // namespace crosscheck::simd
