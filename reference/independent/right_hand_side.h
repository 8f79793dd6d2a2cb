// The physics of a scene written a second time, apart from mysim's terms and steppers: what the integrators of others
// (odeint, SUNDIALS) solve. Where both codes agree, neither has a slip of the pen.
#pragma once

#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// The unknowns of the free particles, one after the other: 3 n positions (m), then 3 n velocities (m/s); of a
/// first-order scene positions only. Pins are no unknowns: their place is a function of time.
using Flat = std::vector<double>;

class RightHandSide {
 public:
  /// Takes what it needs of the scene's numbers; none of mysim's forces, motions or gusts is called. Throws Unsupported
  /// where there is contact, which no right-hand side knows.
  explicit RightHandSide(const Scene& scene);

  Flat start() const;
  /// rate = dy/dt at time t (s). Under hard distances the forces that keep them are solved for, densely; throws
  /// Unsupported when they are not unique.
  void operator()(const Flat& y, Flat& rate, double t);
  /// The state of all particles, pins included, in the scene's numbering.
  void write(const Flat& y, double t, State& state);

  long evaluations() const { return evaluations_; }
  long coincident() const { return coincident_; }  // springs met at zero length, over all evaluations

 private:
  struct Pair {
    int a, b;
    double k, rest, damping;  // N/m, m, N s/m; a spring without dashpot has damping 0, and the other way round
  };
  struct Signal {  // w(t) = mean (1 + variation g1(t)) + side g2(t), each g a sum of sines
    struct Sine {
      double weight, omega, phase;
    };
    double mean[3], side[3] = {0, 0, 0}, variation = 0;
    std::vector<Sine> along, across;
    void at(double t, double out[3]) const;
  };
  struct Rod {
    int a, b;
  };

  static Signal signal_of(const Blowing& blowing);
  void take(const Term& term);
  void place(const Flat& y, double t);
  void pull(const Pair& pair);
  void blow(double t);
  void keep_lengths();

  int n_;                    // particles
  std::vector<int> moving_;  // indices of the free particles
  Flat start_;
  std::vector<double> mass_, drag_;  // n, kg and N s/m; drag_ is empty without drag
  std::vector<double> home_;         // 3 n, m, positions at the start, of which the pins' count
  std::vector<char> fixed_;          // n
  bool carried_ = false;             // pins move
  double sway_[3] = {0, 0, 0}, sway_omega_ = 0, sway_ramp_ = 1;
  bool first_order_ = false, link_law_ = false;
  double turning_ = 0;             // rad/s, of the first-order field
  double falling_[3] = {0, 0, 0};  // m/s^2
  std::vector<Pair> pairs_;
  std::vector<Rod> rods_;
  std::vector<Signal> winds_, airs_;  // m/s^2; m/s
  std::vector<int> corners_;          // 3 per triangle
  double air_ = 0;                    // density times coefficient, kg/m^3
  std::vector<double> x_, v_, f_;     // 3 n, scratch: positions, velocities, forces
  long evaluations_ = 0, coincident_ = 0;
};

}  // namespace crosscheck
