// The physics of a scene written a second time, apart from mysim's terms and steppers: what the integrators of others
// (odeint, SUNDIALS) solve. Where both codes agree, neither has a slip of the pen.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The unknowns of the free particles, one after the other: 3 n positions (m), then 3 n velocities times a time unit
/// (m); of a first-order scene positions only. Pins are no unknowns: their place is a function of time.
using StateVector = std::vector<double>;

/// A prescribed motion, of pins or of a solid.
class PrescribedMotion {
 public:
  explicit PrescribedMotion(const Motion& motion);
  /// m and m/s, from where it starts.
  void at(double t, double displacement[3], double velocity[3]) const;
  /// m/s^2.
  void acceleration_at(double t, double acceleration[3]) const;

 private:
  double amplitude_[3];  // m
  double omega_, ramp_;  // rad/s, s
};

/// The time by which an integrator under error control multiplies velocities to compare them with lengths, s: the
/// geometric mean of the duration and the time in which the fastest vibration turns by a radian, rounded down to a
/// power of two, so that the multiplication is exact. Scales with the scene's unit of time.
double velocity_time_unit(const Scene& scene);

/// Returns the scene without its spheres and planes.
Scene without_contact(Scene scene);

/// A ball or a half-space at the time that it was moved to last. Its surface is where particles touch.
struct Solid {
  Vec3 start;                    // m: the centre of a ball, a point of a plane
  double radius;                 // m, infinite for a half-space
  Vec3 up = Vec3::Zero();        // the outward unit normal of a half-space
  double friction, restitution;  // mu, e
  double size;                   // m, by which a height over it is judged: the radius, or the scene's size
  std::optional<PrescribedMotion> motion = {};
  Vec3 drift = Vec3::Zero();  // m/s, the constant velocity of a half-space
  Vec3 centre = start, velocity = drift, acceleration = Vec3::Zero();

  bool flat() const { return std::isinf(radius); }
  bool moves() const { return motion || !drift.isZero(0); }
  void move_to(double t);
  double height(const Vec3& x) const { return flat() ? up.dot(x - centre) : (x - centre).norm() - radius; }  // m
  Vec3 normal(const Vec3& x) const { return flat() ? up : Vec3((x - centre).normalized()); }
  /// The place of the surface straight below x.
  Vec3 foot(const Vec3& x) const { return flat() ? Vec3(x - height(x) * up) : Vec3(centre + radius * normal(x)); }
};
/// The scene's solids. Throws Unsupported where there is no contact, and where there are hard distances.
std::vector<Solid> solids_of(const Scene& scene);

class RightHandSide {
 public:
  /// Takes what it needs of the scene's numbers; none of mysim's forces, motions or gusts is called. Throws Unsupported
  /// where there is contact, which no right-hand side knows. `time_unit` (s) is that of the velocities among the
  /// unknowns.
  explicit RightHandSide(const Scene& scene, double time_unit = 1);

  StateVector start() const;
  /// rate = dy/dt at time t (s). Under hard distances the forces that keep them are solved for, densely; throws
  /// Unsupported when they are not unique.
  void operator()(const StateVector& y, StateVector& rate, double t);
  /// The state of all particles, pins included, in the scene's numbering.
  void write_state(const StateVector& y, double t, State& state);

  long evaluations() const { return evaluations_; }
  long degenerate_springs() const { return degenerate_springs_; }  // springs met at zero length, over all evaluations

 private:
  struct LinearSpring {
    int a, b;
    double k, rest;  // N/m, m
  };
  struct Dashpot {
    int a, b;
    double c;  // N s/m
  };
  struct Bar {  // a spring without rest length, of either sign
    int a, b;
    double k;  // N/m
  };
  struct Signal {  // w(t) = mean (1 + variation g1(t)) + side g2(t), each g a sum of sines
    struct Sine {
      double weight, omega, phase;
    };
    double mean[3], side[3] = {0, 0, 0}, variation = 0;
    std::vector<Sine> along, across;
    void at(double t, double out[3]) const;
  };
  struct HardDistance {
    int a, b;
  };

  static Signal signal_of(const WindSignal& wind_signal);
  void add_term(const Term& term);
  void set_state(const StateVector& y, double t);
  void add_spring_forces();
  void add_dashpot_forces();
  void add_aerodynamic_forces(double t);
  void add_constraint_forces();

  double time_unit_;       // s
  int n_;                  // particles
  std::vector<int> free_;  // indices of the free particles
  StateVector start_;
  std::vector<double> mass_, drag_;     // n, kg and N s/m; drag_ is empty without drag
  std::vector<double> start_position_;  // 3 n, m, positions at the start, of which the pins' count
  std::vector<char> pinned_;            // n
  std::optional<PrescribedMotion> pin_motion_;
  bool first_order_ = false, link_law_ = false;
  double rotation_rate_ = 0;       // rad/s, of the first-order field
  double gravity_[3] = {0, 0, 0};  // m/s^2
  std::vector<LinearSpring> springs_;
  std::vector<Dashpot> dashpots_;
  std::vector<Bar> bars_;  // what bending is
  std::vector<HardDistance> hard_distances_;
  std::vector<Signal> winds_, air_velocities_;  // m/s^2; m/s
  std::vector<int> triangles_;                  // 3 per triangle
  double rho_cd_ = 0;                           // density times coefficient, kg/m^3
  std::vector<double> x_, v_, f_;               // 3 n, scratch: positions, velocities, forces
  long evaluations_ = 0, degenerate_springs_ = 0;
};

}  // namespace crosscheck
