// Inputs and expected answers of the cloth assignment, from mysim's grid and terms and from closed forms. Includes none
// of the student's headers.
#pragma once

#include <vector>

#include "mysim/scene/grid.h"
#include "tests/coursework/grader/vectors.h"

namespace coursework::a3 {

using crosscheck::Points;
using crosscheck::Vec3;
using Cases = std::vector<Case>;

struct Mesh {
  int rows, columns;
  double across, down;  // m
  Vec3 corner;          // m
  int size() const { return rows * columns; }
  Points points() const;
};

/// A random mesh: rows and columns differ in number, and cells are not square.
Mesh random_mesh(Random& random, int smallest, int largest);
/// A sheet with all three families, displaced from its flat shape by up to `bent` in each direction.
struct Sheet {
  Mesh mesh;
  std::vector<crosscheck::Spring> springs;
  Points x;
};
Sheet random_sheet(Random& random, int smallest, int largest, double bent);
/// A sheet of one to three particles in a row with springs between neighbours, or of four particles in a cell.
Sheet small_sheet(Random& random, int size, double bent);

using coursework::put;
void put(Numbers& out, const Mesh& mesh);
void put(Numbers& out, const std::vector<crosscheck::Spring>& springs);
void put(Numbers& out, const std::vector<std::array<int, 3>>& triangles);
Numbers numbers_of(const Points& points);
Points force_of(const crosscheck::Term& term, const crosscheck::Particles& particles, const crosscheck::State& state);

crosscheck::Grid grid_of(const Mesh& mesh, double structural, double shear, double flexion);

struct Breeze {
  bool on;
  Vec3 direction;
  double speed, gust, frequency, offset, density, coefficient;
  Vec3 at(double t) const;
};
Breeze random_breeze(Random& random);
void put(Numbers& out, const Breeze& breeze);
crosscheck::Aerodynamics aerodynamics(const Breeze& breeze, double t, const std::vector<std::array<int, 3>>& triangles);

// part 1
Cases index(Random& random);
Cases neighbours(Random& random);
Cases positions(Random& random);
// part 2
Cases structural(Random& random);
Cases shear(Random& random);
Cases flexion(Random& random);
Cases spring_steps(Random& random);
Cases spring_counts(Random& random);
// part 3
Cases one_spring(Random& random);
Cases small_one_spring(Random& random);
Cases sheet_springs(Random& random);
Cases small_sheet_springs(Random& random);
Cases spring_laws(Random& random);
Cases small_spring_laws(Random& random);
Cases ends_that_meet(Random& random);
Cases gravity(Random& random);
Cases drag(Random& random);
// part 4
Cases triangles(Random& random);
Cases air(Random& random);
Cases one_triangle(Random& random);
Cases small_triangle(Random& random);
Cases wind_on_cloth(Random& random);
Cases small_wind_on_cloth(Random& random);
// part 5
Cases rates(Random& random);
Cases small_rates(Random& random);
Cases pinned_rates(Random& random);
Cases small_pinned_rates(Random& random);
Cases rates_again(Random& random);
Cases small_rates_again(Random& random);
Cases hanging_strip(Random& random);
Cases swinging_cloth(Random& random);

}  // namespace coursework::a3
