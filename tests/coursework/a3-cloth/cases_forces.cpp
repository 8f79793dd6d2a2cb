// Part 3: forces of springs, gravity and drag.
#include <Eigen/Geometry>

#include "tests/coursework/a3-cloth/cases.h"

namespace coursework::a3 {
namespace {

using crosscheck::Spring;
using crosscheck::Springs;
using crosscheck::State;

// at most a dozen springs of at most 100 N meet at a particle: their sum has a round-off of 1e-12 N in any order
constexpr double round_off = 1e-9;

Case force_case(const char* call) {
  return {.call = call, .columns = 3, .tolerance = round_off, .row = "particle", .column = "force"};
}

Numbers spring_input(const std::vector<Spring>& springs, const Points& x) {
  Numbers in;
  put(in, springs);
  in.push_back(static_cast<double>(x.cols()));
  put(in, x);
  return in;
}

Points spring_force(const std::vector<Spring>& springs, const Points& x) {
  return force_of(Springs{springs}, {}, State{0, x, {}});
}

double energy(const std::vector<Spring>& springs, const Points& x) {
  return potential_energy(Springs{springs}, {}, State{0, x, {}});
}

/// -dE/ds of E(x + s u) at s = 0, from two central differences whose leading errors cancel.
double power(const std::vector<Spring>& springs, const Points& x, const Points& u) {
  auto difference = [&](double s) { return (energy(springs, x + s * u) - energy(springs, x - s * u)) / (2 * s); };
  const double s = 1e-3;
  return -(4 * difference(s / 2) - difference(s)) / 3;
}

}  // namespace

Cases one_spring(Random& random) {
  Cases cases;
  for (const double stretch : {random.uniform(1.2, 1.6), random.uniform(0.4, 0.8)}) {
    const double k = random.uniform(50, 150), rest = random.uniform(0.3, 0.6);
    const Vec3 direction = random_direction(random), b = random_vector(random, 1);
    Points x(3, 2);
    x << b + stretch * rest * direction, b;
    Case c = force_case("spring_forces");
    c.in = spring_input({Spring{0, 1, k, rest}}, x);
    const Vec3 on_a = -k * (stretch - 1) * rest * direction;  // the closed form
    put(c.expected, on_a);
    put(c.expected, Vec3(-on_a));
    cases.push_back(c);
  }
  return cases;
}

Cases small_one_spring(Random&) {
  // a spring along an axis, first stretched, then shortened
  Cases cases;
  for (const double length : {3.0, 1.0}) {
    Points x = Points::Zero(3, 2);
    x(0, 0) = length;
    Case c = force_case("spring_forces");
    c.in = spring_input({Spring{0, 1, 10, 2}}, x);
    put(c.expected, Vec3(-10 * (length - 2), 0, 0));
    put(c.expected, Vec3(10 * (length - 2), 0, 0));
    cases.push_back(c);
  }
  return cases;
}

namespace {

Case springs_of(const Sheet& sheet) {
  Case c = force_case("spring_forces");
  c.in = spring_input(sheet.springs, sheet.x);
  c.expected = numbers_of(spring_force(sheet.springs, sheet.x));
  return c;
}

}  // namespace

Cases sheet_springs(Random& random) { return {springs_of(random_sheet(random, 3, 5, 0.04))}; }
Cases small_sheet_springs(Random& random) {
  Cases cases = small_one_spring(random);
  for (const int size : {2, 3, 4}) cases.push_back(springs_of(small_sheet(random, size, 0.04)));
  return cases;
}

namespace {

Case laws_of(Random& random, const Sheet& sheet) {
  Case c = force_case("spring_laws");
  c.columns = 9;
  c.row = "whole";
  c.column = "laws";
  c.in = spring_input(sheet.springs, sheet.x);
  put(c.in, random_vector(random, 2));
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(random.uniform(0.5, 2.5), random_direction(random)).toRotationMatrix();
  put(c.in, Points(rotation.transpose()));  // put() writes columns, which are the rows of the rotation
  Points u(3, sheet.mesh.size());
  for (int i = 0; i < u.cols(); ++i) u.col(i) = random_vector(random, 1);
  put(c.in, u);
  c.expected.assign(8, 0.0);
  c.expected.push_back(power(sheet.springs, sheet.x, u));
  // energies of some 5 J, whose difference is divided by 1e-3 m, give a round-off of 1e-12 N. The truncation error,
  // relative to some 10 N, is about (step / length)^4 = (0.001 / 0.05)^4 = 2e-7 (measured on 20 seeds: 6e-7 N)
  c.tolerance = 1e-5;
  return c;
}

}  // namespace

Cases spring_laws(Random& random) { return {laws_of(random, random_sheet(random, 3, 4, 0.04))}; }
Cases small_spring_laws(Random& random) {
  Cases cases;
  for (const int size : {2, 3}) cases.push_back(laws_of(random, small_sheet(random, size, 0.04)));
  return cases;
}

Cases ends_that_meet(Random& random) {
  Points x(3, 3);
  const Vec3 here = random_vector(random, 1), step = random.uniform(0.3, 0.5) * random_direction(random);
  x << here, here, here + step;
  const std::vector<Spring> springs{{0, 1, random.uniform(50, 150), 0.2}, {1, 2, random.uniform(50, 150), 0.2}};
  Case c = force_case("spring_forces");
  c.in = spring_input(springs, x);
  c.expected = numbers_of(spring_force(springs, x));
  return {c};
}

Cases gravity(Random& random) {
  Case c = force_case("gravity_forces");
  const int count = random.integer(3, 6);
  const Vec3 g = Vec3(0, -9.81, 0) + random_vector(random, 2);
  c.in.push_back(count);
  for (int i = 0; i < count; ++i) {
    const double mass = random.uniform(0.1, 0.6);
    c.in.push_back(mass);
    put(c.expected, Vec3(mass * g));
  }
  put(c.in, g);
  return {c};
}

Cases drag(Random& random) {
  Case c = force_case("drag_forces");
  const double coefficient = random.uniform(0.2, 0.7);
  const int count = random.integer(3, 6);
  c.in = {coefficient, double(count)};
  for (int i = 0; i < count; ++i) {
    const Vec3 v = random_vector(random, 3);
    put(c.in, v);
    put(c.expected, Vec3(-coefficient * v));
  }
  return {c};
}

}  // namespace coursework::a3
