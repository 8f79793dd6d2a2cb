// The functions that you write, and their data types. Do not change this file: the grader uses its own copy.
// Units: m, kg, s, N. The y axis points up.
#pragma once

#include <vector>

#include "vec3.h"

// ---- grid.cpp

/// Rows of particles. Along a row, x increases; from row to row, z increases.
struct Grid {
  int rows = 0, columns = 0;
  double across = 0;  // m, between neighbours in a row
  double down = 0;    // m, between neighbours in a column
  Vec3 corner;        // m, position of the particle in row 0, column 0
};

/// Index of the particle in a row and column: all particles of row 0 come first, then all of row 1, ...
int index_of(const Grid& grid, int row, int column);
/// Indices of the adjacent particles in the same row and in the same column: one to four, in any order.
std::vector<int> neighbours(const Grid& grid, int row, int column);
/// Initial position of each particle, in the order of the indices.
std::vector<Vec3> positions(const Grid& grid);

// ---- springs.cpp

struct Spring {
  int a = 0, b = 0;  // its ends
  double k = 0;      // N/m
  double rest = 0;   // m, rest length
};

/// The springs of one family, each once, in any order. They have stiffness k and are at rest length in the flat grid.
std::vector<Spring> structural(const Grid& grid, double k);  // from each particle to the next in its row and column
std::vector<Spring> shear(const Grid& grid, double k);       // both diagonals of every cell
std::vector<Spring> flexion(const Grid& grid, double k);     // from each to the next but one in its row and column

// ---- forces.cpp: the force on each particle, N

/// The sum of all spring forces on each particle. A spring whose ends coincide has no direction and exerts no force.
std::vector<Vec3> spring_forces(const std::vector<Spring>& springs, const std::vector<Vec3>& x);
/// Gravity: mass times g (m/s^2).
std::vector<Vec3> gravity_forces(const std::vector<double>& mass, const Vec3& g);
/// Viscous drag with coefficient c (N s/m).
std::vector<Vec3> drag_forces(double c, const std::vector<Vec3>& v);

// ---- wind.cpp

struct State {
  std::vector<Vec3> x;  // m
  std::vector<Vec3> v;  // m/s
};

struct Triangle {
  int a = 0, b = 0, c = 0;
};

struct Wind {
  bool on = false;
  Vec3 direction;                              // unit vector, the direction in which the air moves
  double speed = 0;                            // m/s, on average
  double gust = 0, frequency = 0, offset = 0;  // relative amplitude, frequency (Hz), phase (rad) of the speed
  double density = 0;                          // of the air, kg/m^3
  double coefficient = 0;                      // of the pressure, dimensionless
};

/// Two triangles for each cell of the grid; they share the diagonal from (row, column + 1) to (row + 1, column).
std::vector<Triangle> triangles(const Grid& grid);
/// Velocity of the air at time t, m/s.
Vec3 wind_at(const Wind& wind, double t);
/// Force of the wind on each particle, N.
std::vector<Vec3> wind_forces(const Wind& wind, const std::vector<Triangle>& triangles, const State& state, double t);

// ---- derivative.cpp

struct Cloth {
  std::vector<double> mass;  // kg, of each particle
  std::vector<int> pins;     // these particles are fixed
  std::vector<Spring> springs;
  std::vector<Triangle> triangles;
  Vec3 gravity;     // m/s^2
  double drag = 0;  // N s/m
  Wind wind;
};

/// The rate of change of the whole state: .x for the positions, .v for the velocities.
State derivative(const Cloth& cloth, const State& state, double t);
