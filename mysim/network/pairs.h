// Springs of a network one by one, wherever their ends are. pairs.cpp is compiled once for each instruction set.
//
// Positions are records of four numbers, x y z 0, each fetched as a whole: that is cheaper than gathering coordinates.
// Each spring is turned so that its end a is the earlier particle, and springs are in the order of their ends a. A
// spring's force, again a record, is written to a place of its own. A particle is finished when the springs that begin
// at it are done, since those that end at it began earlier: it adds up the former, which lie side by side, and
// subtracts the latter. Nothing is added to in memory, so that no sum waits for another. The places are a ring, no
// longer than the farthest that a particle looks back.
#pragma once

namespace crosscheck::network {

inline constexpr int group = 32;  // springs between two looks at which particles are finished

struct Pairs {
  int particles, springs;  // springs: filled up to whole groups with some of no stiffness
  const int* ends;         // of each spring, a and b: where in x
  const double *k, *rest;  // N/m, m: of each spring
  const int* begin;        // particles + 1: springs begin[i] ... begin[i + 1] - 1 begin at particle i
  const int* end;  // particles + 1: ending[end[i]] ... ending[end[i + 1] - 1] are the places of those that end there
  const int* ending;
  double* x;      // m: records, of each particle and of somewhere far from all
  double* force;  // N: records, of springs on their ends a: spring i stands in place i & mask; behind the last one a 0
  long mask;      // places less 1: a power of two less 1
};

}  // namespace crosscheck::network
