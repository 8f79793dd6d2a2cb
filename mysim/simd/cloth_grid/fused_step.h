// The sweep over a sheet: what a step costs is decided here. fused_step.cpp is compiled once for each instruction set.
//
// A sheet is a regular grid of rows x columns. Column c of a row stands in lane c / tiles of tile c % tiles, so that
// neighbours in a row are whole tiles side by side and nothing is gathered; a tile is one cache line of each
// coordinate on every machine, so that data do not depend on the instruction set. Beside each row stand copies of its
// first two tiles and of its last one, shifted by a lane: with them every spring is tile against tile, without an
// exception at the ends. Lanes without a particle have stiffness 0.
//
// A row is finished when the rows above and itself have given it their forces; then it is kicked and drifted in place,
// since no later row asks for its old positions. So a whole step is one sweep, each spring is taken once, and three
// rows of forces are all the memory it needs.
//
// A band of a sheet is swept like a whole one. Rows of its neighbours stand around it: those before it give it their
// forces anew, in the order in which a sweep over the whole sheet would, and neither these nor those after it move.
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

inline constexpr int left_halo = 1, right_halo = 2;  // copies beside a row, in tiles

/// A contact is not the sweep's business: it asks for it where a particle comes closer to `centre` than the root of
/// `squared_radius`.
struct BoundingSphere {
  double centre[3], squared_radius;  // m, m^2
};
/// Of one tile: where it would be at the end of the step, how fast, lane by lane; what it says there is taken over.
template <class T>
using ContactCallback = void (*)(void* user_data, int row, int tile, T* x, T* v);

template <class T>
struct ClothGrid {
  int rows, tiles;                  // of a row, without its copies
  int leading_halo, trailing_halo;  // of the rows, how many at the beginning and at the end are a neighbour's
  T *x, *v;                // m, m/s: rows x (before + tiles + after) x 3 x lanes; v without copies: rows x tiles
  T* force;                // N: three rows as those of x, working memory
  const T* k[directions];  // N/m: tiles x lanes; null where there are no springs of that direction
  T rest[directions];      // m
  const T *damping, *inverse_mass_dt,
      *dt;     // of each particle (rows x tiles x lanes), or of all (one line): see KickDrift
  int stride;  // of these: lanes, or 0 where one line is for all
};

/// What a sweep does: v' = v + (push f + span fall - lose v); x_end = x + out v'; contacts; x' = x_end + on v'. What
/// drag takes is kept as a number of its own: in 1 - lose, rounded, a fraction of it would be gone in every step.
template <class T>
struct KickDrift {
  T uniform_acceleration[3];    // m/s^2: of all particles alike
  T drift_before, drift_after;  // s
  const BoundingSphere* bounding_spheres;
  int bounding_sphere_count;
  ContactCallback<T> on_contact;
  void* user_data;
};

/// The functions of one instruction set.
template <class T>
struct Kernel {
  /// Both return how many springs of some rest length had ends that met, which pull at nothing.
  long (*fused_step)(const ClothGrid<T>&, const KickDrift<T>&);
  /// Forces of the springs alone, into `force` (N, laid out as v).
  long (*forces)(const ClothGrid<T>&, T* force);
  /// 1 / sqrt of each, as the springs take it: `count` is a multiple of the lanes.
  void (*rsqrt_array)(const T* s, T* y, long count);
  /// What the machine can do at most: so many rounds of multiplications and additions in registers that wait for
  /// nobody. `sum` takes something that hangs on all of them. Returns how many operations a round has.
  int (*multiply_and_add)(long rounds, T* sum);
};

}  // namespace crosscheck::simd
