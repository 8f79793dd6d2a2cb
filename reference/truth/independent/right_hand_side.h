// The physics of a scene, written a second time, independently of mysim's terms and steppers, for the integrators of
// other libraries (odeint, SUNDIALS). If both codes agree, neither has a coding error.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// Unknowns of the free particles, in order: 3 n positions (m), then 3 n velocities times a time unit (m); in a
/// first-order scene positions only. Positions of pins are functions of time.
using StateVector = std::vector<double>;

/// Prescribed motion of pins or of a solid.
class PrescribedMotion {
 public:
  explicit PrescribedMotion(const Motion& motion);
  /// Displacement from the start (m) and velocity (m/s).
  void at(double t, double displacement[3], double velocity[3]) const;
  /// Acceleration (m/s^2).
  void acceleration_at(double t, double acceleration[3]) const;

 private:
  double amplitude_[3];  // m
  double omega_, ramp_;  // rad/s, s
};

/// Time (s) by which integrators under error control multiply velocities to compare them with lengths: the geometric
/// mean of the duration and the time in which the fastest vibration turns by one radian, rounded down to a power of
/// two, so that the multiplication is exact. It scales with the scene's unit of time.
double velocity_time_unit(const Scene& scene);

Scene without_contact(Scene scene);

/// A ball or half-space at the time of the last move_to(). The surface includes the contact margin.
struct Solid {
  Vec3 start;                    // m: centre of a ball, point of a plane
  double radius;                 // m, infinite for a half-space
  Vec3 up = Vec3::Zero();        // outward normal of a half-space
  double friction, restitution;  // mu, e
  double size;                   // m, scale of heights above the surface: the radius, or the scene's size
  std::optional<PrescribedMotion> motion = {};
  Vec3 drift = Vec3::Zero();  // m/s, constant velocity of a half-space
  Vec3 centre = start, velocity = drift, acceleration = Vec3::Zero();

  bool flat() const { return std::isinf(radius); }
  bool moves() const { return motion || !drift.isZero(0); }
  void move_to(double t);
  double height(const Vec3& x) const { return flat() ? up.dot(x - centre) : (x - centre).norm() - radius; }  // m
  Vec3 normal(const Vec3& x) const { return flat() ? up : Vec3((x - centre).normalized()); }
  /// Foot of the perpendicular from x.
  Vec3 foot(const Vec3& x) const { return flat() ? Vec3(x - height(x) * up) : Vec3(centre + radius * normal(x)); }
};
/// The scene's solids. Throws Unsupported if there is no contact, or if there are hard distances.
std::vector<Solid> solids_of(const Scene& scene);

class RightHandSide {
 public:
  /// Copies its numbers from the scene, and calls none of mysim's forces, motions or gusts. Throws Unsupported if there
  /// is contact, which a right-hand side cannot represent. `time_unit` (s) multiplies the velocities among the
  /// unknowns.
  explicit RightHandSide(const Scene& scene, double time_unit = 1);

  StateVector start() const;
  /// rate = dy/dt at time t (s). With hard distances, it solves for the constraint forces with a dense matrix, and
  /// throws Unsupported if these forces are not unique.
  void operator()(const StateVector& y, StateVector& rate, double t);
  /// Writes all particles, including pins, in the scene's numbering.
  void write_state(const StateVector& y, double t, State& state);

  long evaluations() const { return evaluations_; }
  long degenerate_springs() const { return degenerate_springs_; }  // springs at zero length, over all evaluations

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
  struct Signal {  // w(t) = mean (1 + variation g1(t)) + side g2(t), with g1 and g2 sums of sines
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
  std::vector<int> free_;  // free particles
  StateVector start_;
  std::vector<double> mass_, drag_;     // n, kg and N s/m; drag_ is empty without drag
  std::vector<double> start_position_;  // 3 n, m, used for pins only
  std::vector<char> pinned_;            // n
  std::optional<PrescribedMotion> pin_motion_;
  bool first_order_ = false, link_law_ = false;
  double rotation_rate_ = 0;       // rad/s
  double gravity_[3] = {0, 0, 0};  // m/s^2
  std::vector<LinearSpring> springs_;
  std::vector<Dashpot> dashpots_;
  std::vector<Bar> bars_;  // represent bending
  std::vector<HardDistance> hard_distances_;
  std::vector<Signal> winds_, air_velocities_;  // m/s^2; m/s
  std::vector<int> triangles_;                  // 3 per triangle
  double rho_cd_ = 0;                           // density times coefficient, kg/m^3
  std::vector<double> x_, v_, f_;               // 3 n, scratch
  long evaluations_ = 0, degenerate_springs_ = 0;
};

}  // namespace crosscheck
