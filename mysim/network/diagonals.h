// Springs of a network by diagonals: what their force costs is decided here. diagonals.cpp is compiled once for each
// instruction set.
//
// What a spring costs is getting at its ends: numbers that lie apart are gathered one by one, and adding to both ends
// is a scatter, where no two lanes may meet. But particles are seldom numbered at random. Row by row, as in cloths,
// blocks and chains, most springs join particle i to i + offset, with a handful of offsets: in the matrix of who is
// joined to whom they stand on a few diagonals. Eight springs of a diagonal that begin side by side also end side by
// side: their ends are six loads, and nothing is gathered. Lanes without a spring have stiffness 0.
//
// The sweep goes over blocks of eight particles. First come the springs that begin in a block: their forces on it are
// summed in registers, and each is also left in its diagonal's ring. Then the block before is finished: what ends at a
// particle is `offset` places back in the ring of each diagonal, side by side again. So each spring is computed once,
// and each force is written once and read once while it is still in the cache, however large the network is: a ring is
// about as long as its offset.
//
// Stiffness and rest length of eight springs are a line; lines that say the same share their memory. In a grid nearly
// all do, and in a large one that is most of what would have to come from main memory.
#pragma once

namespace crosscheck::network {

inline constexpr int block = 8;  // particles, and springs, side by side

/// Springs from particle i to i + offset, for i in the blocks [first, last).
struct Diagonal {
  int offset;
  int first, last;
  long mask;     // length of the ring less 1: a power of two less 1
  double* ring;  // N: forces at i stand in place i & mask; x, y and z, each with its first block again at its end
};

struct Diagonals {
  int particles, blocks, count;
  const Diagonal* diagonals;
  const int* line;      // of each block and diagonal in the order of the sweep: which eight springs these are
  const double* lines;  // N/m and m: for each line the stiffness of the springs, then their rest lengths
  double* x[3];         // m: coordinates, with a block to spare on either side, where no two particles are in one place
  double* pulls;        // N: of two blocks, 3 x block each; working memory
};

}  // namespace crosscheck::network
