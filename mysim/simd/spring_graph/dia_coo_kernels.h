// Forces of any spring graph: by offset (DIA) where springs lie in order, else edge by edge (COO).
#pragma once

namespace crosscheck::spring_graph {

// DIA: springs by diagonals. dia_coo_kernels.cpp is compiled once for each instruction set.
//
// The cost of a spring is the access to its ends: numbers that lie apart are gathered one by one, and adding to both
// ends is a scatter, where no two lanes may meet. But particles are seldom numbered at random. Row by row, as in
// cloths, tiles and chains, most springs join particle i to i + offset, with a handful of offsets: in the adjacency
// matrix they stand on a few diagonals. Eight springs of a diagonal that begin side by side also end side by side:
// their ends are six loads, and nothing is gathered. Lanes without a spring have stiffness 0.
//
// The kernel goes over tiles of eight particles. First come the springs that begin in a tile: their forces on it are
// summed in registers, and each is also left in its diagonal's ring. Then the tile before is finished: what ends at a
// particle is `offset` places back in the ring of each diagonal, side by side again. So each spring is computed once,
// and each force is written once and read once while it is still in the cache, however large the graph is: a ring is
// about as long as its offset.
//
// Stiffness and rest length of eight springs are a coefficient row; equal rows share their memory. In a grid nearly all
// are equal, and in a large one that is most of what would have to come from main memory.

inline constexpr int tile = 8;  // particles, and springs, side by side

/// Springs from particle i to i + offset, for i in the tiles [first, last).
struct Diagonal {
  int offset;
  int first, last;
  long mask;     // length of the ring less 1: a power of two less 1
  double* ring;  // N: forces at i stand in place i & mask; x, y and z, each with its first tile again at its end
};

struct DiaSprings {
  int particles, tiles, count;
  const Diagonal* diagonals;
  const int* coefficient_row;  // of each tile and diagonal, tile by tile: which coefficients
  const double* coefficients;  // N/m and m: of each row the stiffness of the springs, then their rest lengths
  double* x[3];   // m: coordinates, with a tile to spare on either side, where no two particles are in one place
  double* pulls;  // N: of two tiles, 3 x tile each; working memory
};

// COO: a list of springs, wherever their ends are.
//
// Positions and forces are records of four numbers, x y z 0, each fetched as a whole: that is cheaper than gathering
// coordinates. As many springs as a register has lanes are taken together: records of their ends are subtracted, the
// sums of squares and the laws go lane by lane, and each record times its lane is added to one end and subtracted from
// the other, spring after spring, so that no two meet. Springs come in the order of their first ends, which keeps what
// they fetch close together.

struct CooSprings {
  int particles, springs;  // springs: whole tiles, filled up with some between two particles that there are none of
  const int* ends;         // of each spring, two: where in x
  const double *k, *rest;  // N/m, m: of each spring
  double *x, *force;       // m, N: records of particles + 2
};

/// The functions of one instruction set. Both add the springs' forces at positions x (m) to f (N), both 3 x particles,
/// and return whether some two ends met. They may look at lanes without a spring, too: whether springs were among them
/// is to be found out.
struct Kernels {
  bool (*dia)(const DiaSprings&, const double* x, double* f);
  bool (*coo)(const CooSprings&, const double* x, double* f);
};

}  // namespace crosscheck::spring_graph
