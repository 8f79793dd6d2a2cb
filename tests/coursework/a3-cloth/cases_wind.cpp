// Part 4: triangles, the air, and its pressure.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tests/coursework/a3-cloth/cases.h"

namespace coursework::a3 {
namespace {

// forces of at most 10 N, summed over six triangles, have a round-off of 1e-14 N
constexpr double wind_round_off = 1e-9;

Case wind_case(const Breeze& breeze, const std::vector<std::array<int, 3>>& faces, const Points& x, const Points& v,
               double t) {
  Case c{.call = "wind_forces", .columns = 3, .tolerance = wind_round_off, .row = "particle", .column = "force"};
  put(c.in, breeze);
  put(c.in, faces);
  c.in.push_back(static_cast<double>(x.cols()));
  put(c.in, x);
  put(c.in, v);
  c.in.push_back(t);
  return c;
}

}  // namespace

Cases triangles(Random& random) {
  Cases cases;
  for (int i = 0; i < 2; ++i) {
    const Mesh mesh = random_mesh(random, 2, 4);
    Case c{.call = "triangles", .columns = 3, .tolerance = wind_round_off, .row = "triangle", .column = "corners"};
    put(c.in, mesh);
    auto all = grid_triangles(grid_of(mesh, 1, 0, 0));
    for (auto& corners : all) std::sort(corners.begin(), corners.end());
    std::sort(all.begin(), all.end());
    for (const auto& corners : all) c.expected.insert(c.expected.end(), corners.begin(), corners.end());
    cases.push_back(c);
  }
  return cases;
}

Cases air(Random& random) {
  const Breeze breeze = random_breeze(random);
  Case c{.call = "wind_at", .columns = 3, .tolerance = wind_round_off, .row = "time", .column = "air"};
  put(c.in, breeze);
  const int count = 24;
  c.row_size = random.uniform(0.1, 0.2);
  c.in.push_back(count);
  for (int i = 0; i < count; ++i) {
    c.in.push_back(i * c.row_size);
    put(c.expected, breeze.at(i * c.row_size));
  }
  c.plot_y = 0;
  return {c};
}

Cases one_triangle(Random& random) {
  Cases cases;
  for (const double side : {1.0, -1.0}) {
    Breeze breeze = random_breeze(random);
    const Vec3 edge = random.uniform(0.3, 0.6) * random_direction(random);
    const Vec3 other = random.uniform(0.3, 0.6) * edge.unitOrthogonal() + random.uniform(0.2, 0.5) * edge;
    const Vec3 area = 0.5 * edge.cross(other), n = area.normalized();
    // the air meets the triangle at 30 to 60 degrees, once from each side
    const double angle = random.uniform(0.5, 1.0);
    breeze.direction = std::cos(angle) * edge.normalized() + side * std::sin(angle) * n;
    Points x(3, 3);
    const Vec3 here = random_vector(random, 1);
    x << here, here + edge, here + other;
    const double t = random.uniform(0.2, 2);
    Case c = wind_case(breeze, {{0, 1, 2}}, x, Points::Zero(3, 3), t);
    // the closed form: 1/2 rho C A |w|^2 sin(angle) along the normal, in the direction of the wind
    const Vec3 whole = 0.5 * breeze.density * breeze.coefficient * area.norm() * breeze.at(t).squaredNorm() *
                       std::sin(angle) * side * n;
    for (int corner = 0; corner < 3; ++corner) put(c.expected, Vec3(whole / 3));
    cases.push_back(c);
  }
  return cases;
}

Cases small_triangle(Random&) {
  // a triangle of 6 m^2 in five cases: the air meets it from the front, from behind, and at an angle; the triangle
  // moves with half the speed of the wind; only one corner moves
  Points x(3, 3);
  x << 0, 0, 4, 0, 0, 0, 0, 3, 0;
  Cases cases;
  const auto add = [&](const Vec3& direction, const Vec3& corner, const Vec3& others) {
    const Breeze breeze{true, direction, 5, 0, 1, 0, 1, 2};
    Points v(3, 3);
    v << corner, others, others;
    Case c = wind_case(breeze, {{0, 1, 2}}, x, v, 0);
    const Vec3 u = 5 * direction - (corner + 2 * others) / 3;
    const Vec3 whole = 0.5 * 1 * 2 * 6 * u.norm() * Vec3(0, u.y(), 0);
    for (int i = 0; i < 3; ++i) put(c.expected, Vec3(whole / 3));
    cases.push_back(c);
  };
  const Vec3 still = Vec3::Zero();
  add({0, 1, 0}, still, still), add({0, -1, 0}, still, still), add({0.6, 0.8, 0}, still, still);
  add({0, 1, 0}, {0, 2.5, 0}, {0, 2.5, 0}), add({0, 1, 0}, {0, 3, 0}, still);
  return cases;
}

namespace {

/// Three cases: wind from one side, wind from the other side, and no wind.
Cases wind_on(Random& random, const Sheet& sheet, const std::vector<std::array<int, 3>>& faces) {
  Breeze breeze = random_breeze(random);
  Points v(3, sheet.mesh.size());
  for (int i = 0; i < v.cols(); ++i) v.col(i) = random_vector(random, 1.5);
  const double t = random.uniform(0.2, 2);
  Cases cases;
  auto add = [&] {
    Case c = wind_case(breeze, faces, sheet.x, v, t);
    c.expected = breeze.on ? numbers_of(force_of(aerodynamics(breeze, t, faces), {}, {t, sheet.x, v}))
                           : Numbers(static_cast<std::size_t>(v.size()), 0.0);
    cases.push_back(c);
  };
  add();
  breeze.direction = -breeze.direction;
  add();
  breeze.on = false;
  add();
  return cases;
}

}  // namespace

Cases wind_on_cloth(Random& random) {
  const Sheet sheet = random_sheet(random, 3, 4, 0.04);
  return wind_on(random, sheet, grid_triangles(grid_of(sheet.mesh, 1, 0, 0)));
}

Cases small_wind_on_cloth(Random& random) {
  // a single triangle, then a cell of two triangles
  Sheet one{Mesh{1, 3, 0.4, 0.3, Vec3::Zero()}, {}, Points(3, 3)};
  one.x << 0, 0.4, 0, 0, 0, 0, 0, 0, 0.3;
  Cases cases = small_triangle(random), tilted = wind_on(random, one, {{0, 1, 2}});
  cases.insert(cases.end(), tilted.begin(), tilted.end());
  const Sheet cell = small_sheet(random, 4, 0.04);
  const Cases two = wind_on(random, cell, grid_triangles(grid_of(cell.mesh, 1, 0, 0)));
  cases.insert(cases.end(), two.begin(), two.end());
  return cases;
}

}  // namespace coursework::a3
