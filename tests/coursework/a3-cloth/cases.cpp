#include "tests/coursework/a3-cloth/cases.h"

#include <cmath>
#include <numbers>

namespace coursework::a3 {

Points Mesh::points() const {
  Points x(3, size());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      x.col(column + columns * row) = corner + Vec3(across * column, 0, down * row);
  return x;
}

Mesh random_mesh(Random& random, int smallest, int largest) {
  const int few = random.integer(smallest, largest), many = few + random.integer(1, 3);
  const bool wide = random.integer(0, 1) == 1;
  const double across = random.uniform(0.1, 0.2), down = across * random.uniform(1.2, 1.5);
  const Vec3 corner = Vec3(1, 2, -1) + random_vector(random, 0.5);
  return wide ? Mesh{few, many, across, down, corner} : Mesh{many, few, down, across, corner};
}

Sheet random_sheet(Random& random, int smallest, int largest, double bent) {
  Sheet sheet{random_mesh(random, smallest, largest), {}, {}};
  sheet.x = sheet.mesh.points();
  const double structural = random.uniform(80, 120), shear = random.uniform(40, 60), flexion = random.uniform(20, 30);
  sheet.springs = grid_springs(grid_of(sheet.mesh, structural, shear, flexion));
  for (int i = 0; i < sheet.mesh.size(); ++i) sheet.x.col(i) += random_vector(random, bent);
  return sheet;
}

Sheet small_sheet(Random& random, int size, double bent) {
  // mysim's grid does not support a single row
  const double across = 0.1, down = 0.2, k = 100;
  Sheet sheet{size < 4 ? Mesh{1, size, across, down, {1, 2, -1}} : Mesh{2, 2, across, down, {1, 2, -1}}, {}, {}};
  sheet.x = sheet.mesh.points();
  for (int i = 1; i < size && size < 4; ++i)
    sheet.springs.push_back({i - 1, i, k, across, crosscheck::Family::structural});
  if (size >= 4) sheet.springs = grid_springs(grid_of(sheet.mesh, k, k / 2, k / 4));
  for (int i = 0; i < sheet.mesh.size(); ++i) sheet.x.col(i) += random_vector(random, bent);
  return sheet;
}

crosscheck::Grid grid_of(const Mesh& mesh, double structural, double shear, double flexion) {
  crosscheck::Grid grid{};
  grid.nu = mesh.columns;
  grid.nv = mesh.rows;
  grid.nw = 1;
  grid.u = Vec3(mesh.across * (mesh.columns - 1), 0, 0);
  grid.v = Vec3(0, 0, mesh.down * (mesh.rows - 1));
  grid.stiffness = {structural, shear, flexion};
  return grid;
}

void put(Numbers& out, const Mesh& m) {
  out.insert(out.end(), {double(m.rows), double(m.columns), m.across, m.down});
  put(out, m.corner);
}
void put(Numbers& out, const std::vector<crosscheck::Spring>& springs) {
  out.push_back(static_cast<double>(springs.size()));
  for (const auto& s : springs) out.insert(out.end(), {double(s.a), double(s.b), s.k, s.rest});
}
void put(Numbers& out, const std::vector<std::array<int, 3>>& triangles) {
  out.push_back(static_cast<double>(triangles.size()));
  for (const auto& corners : triangles) out.insert(out.end(), corners.begin(), corners.end());
}
void put(Numbers& out, const Breeze& b) {
  out.push_back(b.on);
  put(out, b.direction);
  out.insert(out.end(), {b.speed, b.gust, b.frequency, b.offset, b.density, b.coefficient});
}

Numbers numbers_of(const Points& points) { return Numbers(points.data(), points.data() + points.size()); }

Points force_of(const crosscheck::Term& term, const crosscheck::Particles& particles, const crosscheck::State& state) {
  crosscheck::Forces forces{Points::Zero(3, state.x.cols())};
  std::visit(
      [&]<class T>(const T& t) {
        if constexpr (crosscheck::HasForce<T>) add_force(t, particles, state, forces);
      },
      term);
  return forces.f;
}

Vec3 Breeze::at(double t) const {
  return speed * (1 + gust * std::sin(2 * std::numbers::pi * frequency * t + offset)) * direction;
}

Breeze random_breeze(Random& random) {
  const Vec3 direction = random_direction(random);
  const double speed = random.uniform(2, 4), gust = random.uniform(0.3, 0.6), frequency = random.uniform(0.4, 0.9);
  // below 45 degrees, because sine and cosine are equal there
  const double offset = random.uniform(0.1, 0.6);
  return {true, direction, speed, gust, frequency, offset, random.uniform(1, 1.4), random.uniform(1, 2)};
}

crosscheck::Aerodynamics aerodynamics(const Breeze& breeze, double t,
                                      const std::vector<std::array<int, 3>>& triangles) {
  return {breeze.density, breeze.coefficient, {breeze.at(t), std::nullopt}, triangles};
}

}  // namespace coursework::a3
