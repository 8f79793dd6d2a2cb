// Springs of a network one by one, wherever their ends are. pairs.cpp is compiled once for each instruction set.
//
// Positions and forces are records of four numbers, x y z 0, each fetched as a whole: that is cheaper than gathering
// coordinates. As many springs as a register has lanes are taken together: records of their ends are subtracted, the
// sums of squares and the laws go lane by lane, and each record times its lane is added to one end and subtracted from
// the other, spring after spring, so that no two meet. Springs come in the order of their first ends, which keeps what
// they fetch close together.
#pragma once

namespace crosscheck::network {

struct Pairs {
  int particles, springs;  // springs: whole blocks, filled up with some between two particles that there are none of
  const int* ends;         // of each spring, two: where in x
  const double *k, *rest;  // N/m, m: of each spring
  double *x, *force;       // m, N: records of particles + 2
};

}  // namespace crosscheck::network
