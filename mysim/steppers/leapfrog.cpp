// Leapfrog in its drift-kick-drift form: one force evaluation a step, at the middle. Drag is averaged over old and new
// velocity, v' = v + h a - h gamma (v + v') / 2, so that the step stays its own inverse under h -> -h and of order 2.

#include "mysim/steppers/steppers.h"

namespace crosscheck {
namespace {

/// The h of a kick, s, as drag shortens it.
double kick_time(double gamma, double h) { return h / (1 + h / 2 * gamma); }

/// v' = v + h (a - gamma v) / (1 + h gamma/2) of one particle. Written as ((1 - h gamma/2) v + h a) / (1 + h gamma/2)
/// it would round the little that drag takes as a part of v, by the same amount in every step.
Vec3 kicked(double gamma, const Vec3& v, const Vec3& a, double kick_time) { return v + kick_time * (a - gamma * v); }

/// `middle`: the time of the force, s.
void step_with_position_forces(System& f, State& s, double middle, double h) {
  const Eigen::VectorXd& mass = f.model().particles.mass;
  const Eigen::ArrayXd& gamma = f.drag_rate();
  const double start = s.t;
  const bool few = s.x.cols() <= few_particles;

  // Few particles are taken one by one, so that nothing is loaded in other parts than it was stored in just before,
  // which would wait for the stores; many in one go, which takes fewer instructions.
  s.t = middle;
  if (few)
    for (int i = 0; i < s.x.cols(); ++i) s.x.col(i) += h / 2 * s.v.col(i);
  else
    s.x += h / 2 * s.v;
  const Points& force = f.position_forces(s);
  for (int i = 0; i < s.v.cols(); ++i) {
    const Vec3 v = kicked(gamma[i], s.v.col(i), force.col(i) / mass[i], kick_time(gamma[i], h));
    if (few) s.x.col(i) += h / 2 * v;
    s.v.col(i) = v;
  }
  if (!few) s.x += h / 2 * s.v;
  s.t = start;
}

/// The same with few springs and gravity, to the last bit, in three short loops: what a call takes there would be a
/// good part of the step. Each force lies in one line of the cache. Pins that stand still are where the caller placed
/// them; those that move are left where they are at the middle, as the caller places them again.
void step_with_few_forces(System& f, State& s, double middle, double h) {
  const Particles& particles = f.model().particles;
  const Vec3 gravity = f.gravity_of_few();
  const double *const mass = particles.mass.data(), *const gamma = f.drag_rate().data();
  const char* const pinned = particles.pinned.data();
  double *const x = s.x.data(), *const v = s.v.data();
  const int n = particles.size();
  const double start = s.t;
  using Point = Eigen::Map<Vec3>;
  alignas(64) double forces[4 * few_particles];

  for (int i = 0; i < n; ++i) Point(x + 3 * i) += h / 2 * Point(v + 3 * i);
  s.t = middle;
  if (particles.move) particles.place_pins(s);
  s.t = start;
  f.count_degenerate_springs(f.few_springs()->set_forces<4>(x, forces));
  f.count(1);
  double rate = gamma[0], time = kick_time(rate, h);
  for (int i = 0; i < n; ++i) {
    if (gamma[i] != rate) rate = gamma[i], time = kick_time(rate, h);
    if (pinned[i]) continue;
    const Vec3 a = (Point(forces + 4 * i) + mass[i] * gravity) / mass[i];
    const Vec3 next = kicked(rate, Point(v + 3 * i), a, time);
    Point(x + 3 * i) += h / 2 * next;
    Point(v + 3 * i) = next;
  }
}

void step_with_velocity_forces(System& f, State& s, double middle_time, double h, int passes, Workspace& w) {
  State& middle = w[0];
  Points &a = w[1].v, &position_only = w[1].x, &v = w[2].v;
  const Eigen::ArrayXd& gamma = f.drag_rate();

  // drift to the middle
  middle.t = middle_time;
  middle.x = s.x + h / 2 * s.v;
  middle.v = s.v;

  // kick with the force there
  f.position_acceleration(middle, position_only);
  for (int pass = 0; pass < passes; ++pass) {
    a = position_only;
    if (pass > 0) {
      middle.v = (s.v + v) / 2;
      f.model().particles.place_pin_velocities(middle);
    }
    f.add_velocity_acceleration(middle, a);
    for (int i = 0; i < s.v.cols(); ++i) v.col(i) = kicked(gamma[i], s.v.col(i), a.col(i), kick_time(gamma[i], h));
  }
  s.v = v;

  // drift to the end
  s.x = middle.x + h / 2 * s.v;
}

}  // namespace

void leapfrog_step(System& f, State& s, double h, int passes, Workspace& w) {
  const double middle = s.t + h / 2;
  if (f.has_velocity_forces())
    step_with_velocity_forces(f, s, middle, h, passes, w);
  else if (f.few_springs())
    step_with_few_forces(f, s, middle, h);
  else
    step_with_position_forces(f, s, middle, h);
}

void leapfrog(System& f, State& s, double h, Workspace& w) { leapfrog_step(f, s, h, 2, w); }

KickDriftComposition leapfrog_composition() { return {{1}}; }

}  // namespace crosscheck
