// Forces of any spring graph: by offset (DIA) where the springs are ordered, otherwise edge by edge (COO).
#pragma once

namespace crosscheck::spring_graph {

// DIA: springs by diagonals of the adjacency matrix.
//
// The cost of a spring is the access to its ends: scattered numbers are gathered one by one, and adding to both ends is
// a scatter in which no two lanes may collide. But when particles are numbered row by row, as in cloths, tiles and
// chains, most springs join particle i to i + offset, with a handful of offsets: they lie on a few diagonals of the
// adjacency matrix. Eight springs of a diagonal that begin next to each other also end next to each other: six loads
// read their ends, and nothing is gathered. Lanes without a spring have stiffness 0.
//
// The kernel visits tiles of eight particles. It first computes the springs that begin in a tile: it sums their forces
// on the tile in registers, and stores each force in its diagonal's ring. Then it finishes the previous tile: the
// forces of the springs that end at a particle are `offset` places back in the ring of each diagonal, contiguous again.
// So each spring is computed once, and each force is written and read once while it is in the cache, for graphs of any
// size: a ring is about as long as its offset.
//
// Stiffness and rest length of eight springs form a coefficient row. Equal rows share their memory: in a large grid,
// where nearly all are equal, this saves most of the traffic to main memory.

inline constexpr int tile = 8;  // particles, and springs, per tile

/// Springs from particle i to i + offset, for i in tiles [first, last).
struct Diagonal {
  int offset;
  int first, last;
  long mask;  // length of the ring, a power of two, minus 1
  // N: three rings, for x, y and z; the force at i is in place i & mask; each ring is followed by a copy of its first
  // tile
  double* ring;
};

struct DiaSprings {
  int particles, tiles, count;
  const Diagonal* diagonals;
  const int* coefficient_row;  // per tile and diagonal, tile by tile: index of the coefficient row
  const double* coefficients;  // N/m and m: per row, the springs' stiffness, then their rest lengths
  double* x[3];   // m: coordinates, with a spare tile before and after them, whose particles do not coincide
  double* pulls;  // N: two tiles of 3 x tile, working memory
};

// COO: a list of springs with arbitrary ends.
//
// Positions and forces are records of four numbers, x y z 0, which are fetched whole; this is cheaper than gathering
// coordinates. As many springs as a register has lanes are processed together. The records of their ends are
// subtracted, and the sums of squares and the laws are computed lane by lane. Then, spring after spring, the difference
// times the number in its lane is added to one end and subtracted from the other, so that no two collide. Springs are
// sorted by their first ends, which keeps memory accesses close together.

struct CooSprings {
  int particles, springs;  // springs: whole tiles, padded with springs between two extra particles
  const int* ends;         // two per spring: positions in x
  const double *k, *rest;  // N/m, m
  double *x, *force;       // m, N: particles + 2 records
};

/// Both functions add the springs' forces at positions x (m) to f (N), both 3 x particles, and return true if the two
/// ends in any lane coincided. The caller must check whether that lane has a spring.
struct Kernels {
  bool (*dia)(const DiaSprings&, const double* x, double* f);
  bool (*coo)(const CooSprings&, const double* x, double* f);
};

}  // namespace crosscheck::spring_graph
