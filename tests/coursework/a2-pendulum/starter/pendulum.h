// Forces, the pendulum and the chain. Do not change this file: the grader uses its own copy. Units: m, kg, s, N.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

struct Vec3 {
  double x = 0, y = 0, z = 0;
};
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Vec3 operator*(const Vec3& a, double s) { return s * a; }
inline Vec3 operator/(const Vec3& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
inline Vec3& operator+=(Vec3& a, const Vec3& b) { return a = a + b; }
inline Vec3& operator-=(Vec3& a, const Vec3& b) { return a = a - b; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

/// Positions at even indices, velocities at odd ones: particle i is at state[2 i] and moves with state[2 i + 1].
/// A derivative has the same layout: the rate of the position (a velocity) and the rate of the velocity (an
/// acceleration) of particle i are at 2 i and 2 i + 1.
using State = std::vector<Vec3>;

/// Force of gravity (N) on a particle of `mass`; g is the acceleration of free fall, a vector (m/s^2).
Vec3 gravity_force(double mass, const Vec3& g);

/// Force of viscous drag (N) on a particle of velocity v: -drag v. `drag` is in N s/m.
Vec3 drag_force(double drag, const Vec3& v);

/// Force (N) of a spring on the particle at `a`: -stiffness (L - rest) d / L. The spring's other end is at `b`, and
/// d = a - b, L = |d|. If the ends coincide, the direction is undefined and the force is zero.
Vec3 spring_force(const Vec3& a, const Vec3& b, double stiffness, double rest);

struct Pendulum {
  Vec3 gravity;      // g, m/s^2
  double drag;       // N s/m
  double mass;       // of particle 1, kg
  double stiffness;  // N/m
  double rest;       // rest length, m
};

/// Derivative of a state of two particles: particle 0 is fixed (both its rates are zero, whatever the state says),
/// particle 1 hangs on it by a spring, with gravity and drag.
State pendulum_derivative(const Pendulum& pendulum, const State& state);

struct Chain {
  Vec3 gravity;                   // g, m/s^2
  double drag;                    // of each particle, N s/m
  std::vector<double> mass;       // n, kg; the fixed particle's mass does not matter
  std::vector<double> stiffness;  // n - 1, N/m: spring i joins particles i and i + 1
  std::vector<double> rest;       // n - 1, m
};

/// Derivative of a state of n particles in a row: particle 0 is fixed, the others have gravity, drag and their springs.
State chain_derivative(const Chain& chain, const State& state);

/// The right-hand side of X' = f(X).
using Derivative = std::function<State(const State& state)>;

/// One step of symplectic Euler, for every particle: first v(t + h) = v + h a, with the acceleration a that f
/// returns for the given state; then x(t + h) = x + h v(t + h), with the new velocity. Calls f once.
State symplectic_step(const Derivative& f, const State& state, double h);
