// Implicit Euler by passes, and position-based averaging: types and functions of the five parts. Do not change this
// file: the grader uses its own copy. Units: m, kg, s, N.
#pragma once

#include <functional>
#include <vector>

#include "vec3.h"

/// A spring between particles `a` and `b`. With d = x_a - x_b and L = |d|, the force on `a` is -k (L - rest) d / L, and
/// the force on `b` is the opposite. If L is 0 there is no direction and no force.
struct Spring {
  int a, b;
  double rest;  // m
};

/// All particles have the same mass and all springs the same stiffness.
struct Net {
  double mass, stiffness;  // kg, N/m
  Vec3 gravity;            // m/s^2
  std::vector<Spring> springs;
  std::vector<bool> held;  // these particles never move; their velocity is 0
};

struct State {
  std::vector<Vec3> x, v;  // m, m/s
};

/// Damping multiplies velocities by this factor at the start of each step.
constexpr double velocity_kept = 0.99;
/// Weight of a particle's own position in the averaging; each of its springs has the weight 1.
constexpr double own_weight = 0.2;

/// side x side particles at rest, `width` metres on each side, in the plane of x and z.
inline State square_state(int side, double width) {
  State state;
  const double spacing = width / (side - 1);
  for (int i = 0; i < side * side; ++i) state.x.push_back({spacing * (i % side), 0, spacing * (i / side)});
  state.v.resize(state.x.size());
  return state;
}

/// The net whose springs are at their rest lengths in this state. It has springs along the sides of all cells and along
/// one diagonal of each cell; the first and the last particle of the first row are held.
inline Net square_net(int side, double mass, double stiffness, const Vec3& gravity, const State& state) {
  Net net{mass, stiffness, gravity, {}, std::vector<bool>(state.x.size(), false)};
  const auto add = [&](int a, int b) {
    net.springs.push_back({a, b, length(state.x[static_cast<std::size_t>(a)] - state.x[static_cast<std::size_t>(b)])});
  };
  for (int i = 0; i < side * side; ++i) {
    const bool right = i % side + 1 < side, down = i / side + 1 < side;
    if (right) add(i, i + 1);
    if (down) add(i, i + side);
    if (right && down) add(i, i + side + 1);
  }
  net.held[0] = net.held[static_cast<std::size_t>(side) - 1] = true;
  return net;
}

/// A chain of n particles that hang below a held particle.
inline Net hanging_chain(int n, double mass, double stiffness, double rest, const Vec3& gravity) {
  Net net{mass, stiffness, gravity, {}, std::vector<bool>(static_cast<std::size_t>(n) + 1, false)};
  for (int i = 1; i <= n; ++i) net.springs.push_back({i - 1, i, rest});
  net.held[0] = true;
  return net;
}

/// The state of a chain straight down from the origin, with all springs at their rest lengths.
inline State straight_state(const Net& chain) {
  State state;
  state.x.resize(1);
  for (const Spring& spring : chain.springs) state.x.push_back(state.x.back() - Vec3(0, spring.rest, 0));
  state.v.resize(state.x.size());
  return state;
}

// ---- pass.cpp

/// g = m/h^2 (x - ahead) - F(x) of each particle, N; 0 for held particles. All are 0 if x is the implicit step.
std::vector<Vec3> gradient(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h);

/// The positions after moving each particle by -g / (m/h^2 + 4 k), all at once.
std::vector<Vec3> jacobi_pass(const Net& net, const std::vector<Vec3>& ahead, const std::vector<Vec3>& x, double h);

// ---- step.cpp

/// Chebyshev's weights of the passes 1, 2, ... `passes`.
std::vector<double> weights(int passes, double rho);

/// One step of implicit Euler by the given number of accelerated passes.
State implicit_step(const Net& net, const State& state, double h, int passes, double rho);

// ---- rate.cpp

/// A plain pass as a function of the errors: pass(e) = B e, with B symmetric.
using Pass = std::function<std::vector<double>(const std::vector<double>&)>;

/// The largest |mu| of the eigenvalues mu of B, to eight digits; `error` is any error to start from.
double spectral_radius(const Pass& pass, std::vector<double> error);

/// Factor by which one accelerated pass, in the long run, multiplies the size of an error with the eigenvalue mu;
/// 0 <= rho < 1.
double factor(double mu, double rho);

/// The rho above which accelerated passes are, in the long run, slower than plain ones; 0 if plain ones diverge. The
/// arguments are the lowest and the highest eigenvalue of B.
double slower_from(double lowest, double highest);

// ---- leftover.cpp

/// Fraction of an error with the eigenvalue mu that remains after the given number of accelerated passes.
double left_over(double mu, double rho, int passes);

/// The acceleration, m/s^2, with which a free net with unstretched springs begins to fall.
double falling(double mass, double stiffness, double h, double rho, int passes, double gravity);

/// Factor by which one step of the given number of passes, in the long run, multiplies the size of a deviation from
/// rest with the eigenvalue mu. `inertia` is m/h^2 divided by m/h^2 + 4 k.
double step_growth(double mu, double inertia, double rho, int passes);

/// The smallest rho, to six digits, at which step_growth is above 1 + 1e-9 for at least one of the eigenvalues; 1 if no
/// rho below 1 has this property.
double diverges_from(const std::vector<double>& eigenvalues, double inertia, int passes);

// ---- averaging.cpp

/// One pass of position-based averaging.
std::vector<Vec3> averaging_pass(const Net& net, const std::vector<Vec3>& x);

/// One step by the given number of averaging passes.
State averaging_step(const Net& net, const State& state, double h, int passes);

/// The stiffness (N/m) that the given number of passes gives to a spring between a hanging particle and a held one.
double stiffness_of(double mass, double h, int passes);
