// Reference physics of the expected answers: accelerations from one energy, differentiated by complex steps. Contains
// no force formula and evaluates no spring force.
//
// For an analytic E, Im E(x + i s) / s equals dE/dx up to s^2 (Squire and Trapp 1998): with s = 1e-40 there is neither
// cancellation nor truncation error, so the gradient is exact to round-off.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/random.h"

namespace coursework::a2 {

using Vector = Eigen::Vector3d;

inline void put(const Vector& v, Numbers& out) { out.insert(out.end(), v.begin(), v.end()); }

/// Each component in [-size, size).
inline Vector random_vector(Random& random, double size) {
  Vector v;
  for (double& component : v) component = random.uniform(-size, size);
  return v;
}
/// Unit vector, never along an axis.
inline Vector random_direction(Random& random) {
  Vector v(0.36, 0.48, 0.8);
  if (random.rounds()) {
    std::swap(v[random.integer(0, 2)], v[random.integer(0, 2)]);
    for (double& component : v) component *= random.integer(0, 1) ? 1 : -1;
    return v;
  }
  for (double& component : v) component = random.uniform(0.3, 1) * (random.integer(0, 1) ? 1 : -1);
  return v.normalized();
}

struct Motion {
  Vector x, v;  // m, m/s
};

/// Particles in a row, the first one fixed; the pendulum is a row of two.
struct Row {
  Vector gravity = Vector::Zero();  // m/s^2
  double drag = 0;                  // N s/m
  std::vector<double> mass;         // n, kg
  std::vector<double> stiffness;    // n - 1, N/m
  std::vector<double> rest;         // n - 1, m

  std::size_t size() const { return mass.size(); }

  /// Potential energy of springs and gravity (J), without the gravitational energy of the fixed particle.
  template <class Number>
  Number potential(const std::vector<Eigen::Matrix<Number, 3, 1>>& x) const {
    Number energy = 0;
    for (std::size_t i = 1; i < size(); ++i) {
      Number heights = 0, square = 0;
      for (int c = 0; c < 3; ++c) {
        const Number d = x[i][c] - x[i - 1][c];
        heights += gravity[c] * x[i][c], square += d * d;
      }
      using std::sqrt;
      const Number stretch = sqrt(square) - rest[i - 1];
      energy += 0.5 * stiffness[i - 1] * stretch * stretch - mass[i] * heights;
    }
    return energy;
  }

  /// dE/dx of each particle, N.
  std::vector<Vector> gradient(const std::vector<Motion>& state) const {
    using Complex = std::complex<double>;
    const double s = 1e-40;
    std::vector<Eigen::Matrix<Complex, 3, 1>> x;
    for (const Motion& one : state) x.push_back(one.x.cast<Complex>());
    std::vector<Vector> slope(size());
    for (std::size_t i = 0; i < size(); ++i)
      for (int c = 0; c < 3; ++c) {
        x[i][c] += Complex(0, s);
        slope[i][c] = potential(x).imag() / s;
        x[i][c] -= Complex(0, s);
      }
    return slope;
  }

  /// x' and v' of each particle; zero for the fixed one.
  std::vector<Motion> derivative(const std::vector<Motion>& state) const {
    std::vector<Motion> rate(size(), {Vector::Zero(), Vector::Zero()});
    const std::vector<Vector> slope = gradient(state);
    for (std::size_t i = 1; i < size(); ++i) rate[i] = {state[i].v, (-slope[i] - drag * state[i].v) / mass[i]};
    return rate;
  }

  /// Total energy (J), kinetic energy included.
  double energy(const std::vector<Motion>& state) const {
    std::vector<Vector> x;
    double kinetic = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      x.push_back(state[i].x);
      if (i > 0) kinetic += 0.5 * mass[i] * state[i].v.squaredNorm();
    }
    return kinetic + potential(x);
  }
};

inline void put(const std::vector<Motion>& state, Numbers& out) {
  for (const Motion& one : state) put(one.x, out), put(one.v, out);
}

/// Round-off bound: a force law takes fewer than 60 sums, products and roots. Each has an error of half an epsilon
/// times `size`, where `size` bounds the numbers.
inline double round_off(double size) { return 60 * 1.2e-16 * size; }

}  // namespace coursework::a2
