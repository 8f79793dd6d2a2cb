// Contact with spheres and planes as a sequence of smooth motions: odeint's Dormand-Prince pair on the independent
// right-hand side, interrupted at each impact, take-off, stop and slip. An independent route to the limit of mysim's
// contact rules, none of which is called.
//
// Each free particle is in one of four modes. On a surface of radius R about c, let r = x - c, n = r / R, and let `a`
// be the acceleration relative to c without the surface's force:
//   flies    r'' = a, until |r| = R
//   slides   differentiating |r|^2 = R^2 twice gives r . r'' = -|r'|^2. The surface pushes with
//            N = -a.n - |r'|^2 / R along n (R is infinite for a plane), and with mu N against the motion, until N = 0
//            or r' = 0. Friction turns a slow motion into the direction of the force within |r'| / (mu N), which near
//            rest is shorter than any step. If friction would stop the particle within `shortest_slide`, and the
//            force is parallel to the motion to a hundredth, the particle keeps its direction ("creeps"). This neglects
//            a hundredth of |r'| at most
//   sticks   r'' = 0, until the component of `a` along the surface exceeds mu N
//   wedged   at rest between two fixed surfaces: `a` must lie between the planes of both, or the run is refused
// An impact reverses the normal speed u times e, and reduces the tangential speed by at most mu (1 + e) u. Rebounds
// lower than `lowest_rebound` are ignored. Both limits are relative to the scene's size.

#include <fmt/format.h>
#include <Eigen/Dense>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <variant>

#include "mysim/base/errors.h"
#include "mysim/run/engine.h"
#include "reference/truth/independent/integrators.h"
#include "reference/truth/independent/right_hand_side.h"

namespace crosscheck {
namespace {

namespace odeint = boost::numeric::odeint;

constexpr double lowest_rebound = 1e-12;    // relative to the scene's size, below every error bar
constexpr double shortest_slide = 1e-10;    // relative to the scene's size
constexpr double rounded_to_rest = 3e-13;   // relative to the speed after a fall over the scene's size
constexpr double surface_rounding = 2e-15;  // relative to radius and centre: no impact
constexpr double most_work = 1e7;           // particle accelerations between samples, which take a second or two
constexpr int most_events_in_interval = 10000;

/// A solid, now and at the start of the step. In this file, balls include planes.
struct Ball : Solid {
  Vec3 centre_before = start, velocity_before = velocity;
};

struct Particle {
  enum class Mode { flies, slides, sticks, wedged } mode = Mode::flies;
  int ball = -1, other = -1;    // indices of the balls that the particle touches
  Vec3 forward = Vec3::Zero();  // direction of the particle's slide at the start of the last step
  Vec3 offset = Vec3::Zero();   // m, from the centre of the ball that the particle sticks to
  bool creeps = false;          // slides close to rest
};

std::vector<Ball> balls_of(const Scene& scene) {
  std::vector<Ball> balls;
  for (const Solid& solid : solids_of(scene)) balls.push_back({solid});
  return balls;
}

/// First point, to round-off, at which `f` is negative; the returned point lies on the negative side. `f` must be
/// negative at `high`, where its value is `at_high`, but not at 0.
template <class Function>
double first_negative(Function f, double high, double at_high) {
  constexpr double least = std::numeric_limits<double>::min();
  const auto nowhere_zero = [&](double s) {
    const double value = f(s);
    return value == 0 ? least : value;
  };
  // f(0) = 0 (a slide from rest) counts as positive, so that the first trial halves the bracket
  const double at_start = std::max(f(0), -at_high);
  const auto narrow = [high](double a, double b) {
    return b - a <= 1e-13 * high + 4 * std::numeric_limits<double>::epsilon() * b;
  };
  std::uintmax_t iterations = 200;
  return boost::math::tools::toms748_solve(nowhere_zero, 0., high, at_start, at_high, narrow, iterations).second;
}

class EventDrivenWorld : public World {
 public:
  EventDrivenWorld(const Scene& scene, const Run& run)
      : balls_(balls_of(scene)),
        size_(scene.size()),
        time_unit_(velocity_time_unit(scene)),
        f_(without_contact(scene), time_unit_),
        y_(f_.start()),
        n_(static_cast<int>(y_.size() / 6)),
        particles_(n_),
        rule_(odeint::make_controlled(run.tolerance * size_, run.tolerance, odeint::runge_kutta_dopri5<StateVector>())),
        h_(std::min(run.step, run.duration)),
        longest_(run.step),
        state_(scene.start) {
    accelerations(0);
    for (int i = 0; i < n_; ++i) settle(i);
  }

  void step(double t, double t_next) override {
    const long begun = f_.evaluations();
    for (int events = 0; t < t_next;) {
      const bool last = t + 1.01 * h_ >= t_next;
      double h = last ? t_next - t : h_, now = t;
      if (!(h > 1e-15 * t_next)) {
        if (last) return;  // an event within rounding of the sample counts as at the sample
        throw SolverFailure(fmt::format("the step fell below round-off at t = {:.4g} s", t));
      }
      const StateVector before = y_;
      remember_start(t);
      if (controlled(y_, now, h) != odeint::success) {
        h_ = h;
        continue;
      }
      if (static_cast<double>(f_.evaluations() - begun) * n_ > most_work)
        throw SolverFailure(fmt::format("events too close to each other from t = {:.4g} s on", t));
      ++accepted_;
      const double taken = now - t;
      h_ = std::min(last ? std::max(h_, h) : h, longest_);
      const double after = least_margin(y_, before, now);
      if (!(after < 0)) {
        t = last ? t_next : now;
      } else {
        if (++events > most_events_in_interval) throw SolverFailure(fmt::format("endless impacts at t = {:.4g} s", t));
        // shorten the step until it ends at the event
        const auto margin = [&](double part) {
          y_ = advanced(before, t, part);
          return least_margin(y_, before, t + part);
        };
        const double high = first_negative(margin, taken, after);
        y_ = advanced(before, t, high);
        t += high;
        happen(before, t);
      }
      for (int i = 0; i < n_; ++i) hold(i);
    }
  }

  const State& state(double t) override {
    f_.write_state(y_, t, state_);
    return state_;
  }
  Work work() const override { return {f_.evaluations(), f_.degenerate_springs(), accepted_}; }
  bool chooses_steps() const override { return false; }

 private:
  using Mode = Particle::Mode;

  static Vec3 place(const StateVector& y, int i) { return Vec3(y[3 * i], y[3 * i + 1], y[3 * i + 2]); }
  Vec3 speed(const StateVector& y, int i) const { return place(y, n_ + i) / time_unit_; }
  /// Acceleration (m/s^2) in a rate of change of the unknowns.
  Vec3 acceleration(const StateVector& rate, int i) const { return speed(rate, i); }
  static void put(StateVector& y, int i, const Vec3& value) { std::copy_n(value.data(), 3, y.begin() + 3 * i); }
  /// Sets a velocity among the unknowns, or an acceleration among their rates.
  void put_speed(StateVector& y, int i, const Vec3& value) const { put(y, n_ + i, time_unit_ * value); }

  double height(const StateVector& y, int i, int ball) const { return balls_[ball].height(place(y, i)); }
  Vec3 normal(const StateVector& y, int i, int ball) const { return balls_[ball].normal(place(y, i)); }

  /// Velocity relative to a ball, m/s.
  Vec3 seen_from(const StateVector& y, int i, int ball) const { return speed(y, i) - balls_[ball].velocity; }
  /// Acceleration (m/s^2) by which a ball pushes a particle. `a`: the particle's acceleration relative to the ball
  /// without this push.
  double push(const StateVector& y, int i, int ball, const Vec3& a) const {
    const Vec3 n = normal(y, i, ball), w = seen_from(y, i, ball);
    return -a.dot(n) - (w - w.dot(n) * n).squaredNorm() / balls_[ball].radius;
  }
  static Vec3 along(const Vec3& a, const Vec3& n) { return a - a.dot(n) * n; }

  void derivative(const StateVector& y, StateVector& rate, double t) {
    rate.resize(y.size());
    f_(y, rate, t);
    move_balls(t);
    for (int i = 0; i < n_; ++i) {
      const Particle& p = particles_[i];
      if (p.mode == Mode::flies) continue;
      const Ball& ball = balls_[p.ball];
      if (p.mode != Mode::slides) {
        put(rate, i, ball.velocity);
        put_speed(rate, i, ball.acceleration);
        continue;
      }
      const Vec3 a = acceleration(rate, i) - ball.acceleration, n = normal(y, i, p.ball), v = seen_from(y, i, p.ball);
      const double pressed = push(y, i, p.ball, a), friction = ball.friction;
      // friction keeps its direction beyond a stop, so that the right-hand side is smooth; the step is cut at the stop
      Vec3 direction = along(v, n);
      const double size = direction.norm();
      direction = size > 0 ? Vec3(direction / size * (direction.dot(p.forward) < 0 ? -1 : 1)) : p.forward;
      Vec3 sum = a + pressed * n - friction * pressed * direction;
      if (p.creeps) {
        const Vec3 e = along(p.forward, n).normalized(), force = along(a, n);
        sum += force.dot(e) * e - force + friction * pressed * (direction - e);
      }
      put_speed(rate, i, ball.acceleration + sum);
    }
  }

  // steppers keep the last derivative, which is outdated if a mode has changed
  bool controlled(StateVector& y, double& t, double& h) {
    rule_.reset();
    return rule_.try_step([this](const StateVector& s, StateVector& r, double at) { derivative(s, r, at); }, y, t, h);
  }
  StateVector advanced(StateVector y, double t, double h) {
    single_.reset();
    if (h > 0)
      single_.do_step([this](const StateVector& s, StateVector& r, double at) { derivative(s, r, at); }, y, t, h);
    return y;
  }
  /// Accelerations without the balls' forces (m/s^2) at the present state.
  void accelerations(double t) {
    free_rate_.resize(y_.size());
    f_(y_, free_rate_, t);
    move_balls(t);
  }

  void move_balls(double t) {
    now_ = t;
    for (Ball& ball : balls_) ball.move_to(t);
  }

  /// Stores the balls and the directions of slides at the start t (s) of a step.
  void remember_start(double t) {
    move_balls(t);
    begun_ = t;
    for (Ball& ball : balls_) ball.centre_before = ball.centre, ball.velocity_before = ball.velocity;
    for (int i = 0; i < n_; ++i) {
      Particle& p = particles_[i];
      if (p.mode != Mode::slides) continue;
      if (const Vec3 w = seen_from(y_, i, p.ball); w.norm() > 0) p.forward = w.normalized();
    }
  }

  /// Smallest distance (m) between a particle and a ball during the step; negative if the particle enters the ball.
  double way_in(const StateVector& y, const StateVector& before, int i, int ball) const {
    const Ball& b = balls_[ball];
    const double scale = b.size + b.centre.norm() + (b.flat() ? place(y, i).norm() : 0),
                 rounding = surface_rounding * scale, above = height(y, i, ball) + rounding;
    if (b.flat()) {  // for entering and leaving in one step: lowest point of the parabola with the speeds at both ends
      const double down = (speed(before, i) - b.velocity_before).dot(b.up), rise = seen_from(y, i, ball).dot(b.up);
      if (above < 0 || !(down < 0 && rise > 0)) return above;
      const double begin = b.up.dot(place(before, i) - b.centre_before);
      const double lowest = begin - down * down * (now_ - begun_) / (2 * (rise - down)) + rounding;
      return begin > 0 ? std::min(above, lowest) : above;
    }
    // for entering and leaving in one step: nearest point of the chord, if the step is far shorter than the radius
    const Vec3 from = place(before, i) - b.centre_before, to = place(y, i) - b.centre;
    if (above < 0 || !(from.dot(speed(before, i) - b.velocity_before) < 0 && to.dot(seen_from(y, i, ball)) > 0) ||
        !(from.norm() > b.radius))
      return above;
    const Vec3 way = to - from;
    const Vec3 nearest = from - from.dot(way) / way.squaredNorm() * way;
    return std::min(above, nearest.norm() - b.radius + rounding);
  }

  /// Negative if a particle's mode has ended between the two states. Dimensionless, so that units do not decide which
  /// condition guides the search for the first event.
  double margin(const StateVector& y, const StateVector& before, int i) const {
    const Particle& p = particles_[i];
    const Vec3 a = felt(i, p.ball);
    const double unit = size_ / (time_unit_ * time_unit_);  // m/s^2
    double least = INFINITY;
    if (p.mode == Mode::flies || p.mode == Mode::slides)
      for (int ball = 0; ball < static_cast<int>(balls_.size()); ++ball)
        if (p.mode == Mode::flies || ball != p.ball) least = std::min(least, way_in(y, before, i, ball) / size_);
    if (p.mode == Mode::slides) {
      least = std::min(least, push(y, i, p.ball, a) / unit);
      if (balls_[p.ball].friction > 0)
        least = std::min(least, seen_from(y, i, p.ball).dot(p.forward) / (unit * time_unit_));
    }
    if (p.mode == Mode::sticks) {
      const double pressed = push(y, i, p.ball, a), aside = along(a, normal(y, i, p.ball)).norm();
      least = std::min(pressed, balls_[p.ball].friction * pressed - aside) / unit;
    }
    if (p.mode == Mode::wedged && !is_wedged(i, p.ball, p.other)) throw Unsupported("a particle leaves a wedge");
    return least;
  }
  bool ended(const StateVector& y, const StateVector& before, int i) const { return !(margin(y, before, i) >= 0); }
  double least_margin(const StateVector& y, const StateVector& before, double t) {
    f_(y, free_rate_, t);
    move_balls(t);
    double least = INFINITY;
    for (int i = 0; i < n_; ++i) least = std::min(least, margin(y, before, i));
    return least;
  }
  /// Settles the particles whose mode has ended.
  void happen(const StateVector& before, double t) {
    accelerations(t);
    for (int i = 0; i < n_; ++i) {
      if (!ended(y_, before, i)) continue;
      Particle& p = particles_[i];
      if (p.mode == Mode::slides && balls_[p.ball].friction > 0 && seen_from(y_, i, p.ball).dot(p.forward) < 0)
        put_speed(y_, i, balls_[p.ball].velocity);  // the speed across the direction of motion vanishes too
      settle(i);
    }
  }

  /// True if both balls push, and their normal forces alone hold the particle.
  bool is_wedged(int i, int first, int second) const {
    const Vec3 a = acceleration(free_rate_, i);
    Eigen::Matrix<double, 3, 2> normals;
    normals << normal(y_, i, first), normal(y_, i, second);
    const Eigen::Vector2d pushes = (normals.transpose() * normals).ldlt().solve(-normals.transpose() * a);
    // the acceleration `a` lies in the plane of both normals; friction would hold more directions
    return pushes.minCoeff() > 0 && (a + normals * pushes).norm() < 1e-9 * a.norm();
  }

  /// Acceleration without the balls' forces (m/s^2), relative to a ball, or absolute if `ball` is negative.
  Vec3 felt(int i, int ball) const {
    const Vec3 a = acceleration(free_rate_, i);
    return ball < 0 ? a : Vec3(a - balls_[ball].acceleration);
  }

  /// Applies impacts, then sets the mode by position and velocity.
  void settle(int i) {
    Particle& p = particles_[i];
    std::vector<int> touched;
    for (int ball = 0; ball < static_cast<int>(balls_.size()); ++ball)
      if (height(y_, i, ball) <= 1e-11 * balls_[ball].size) {
        touched.push_back(ball);
        // a particle inside by rounding would enter repeatedly
        if (height(y_, i, ball) < 0) put(y_, i, balls_[ball].foot(place(y_, i)));
      }
    p = {};
    bool hit = false;
    for (int round = 0; round < 10000; ++round) {
      bool again = false;
      for (const int ball : touched) {
        const Vec3 n = normal(y_, i, ball), v = seen_from(y_, i, ball);
        const double u = -v.dot(n), friction = balls_[ball].friction;
        if (!(u > 1e-15 * (speed(y_, i).norm() + balls_[ball].velocity.norm()))) continue;
        double e = balls_[ball].restitution;
        if (e * u * e * u < 2 * lowest_rebound * size_ * push(y_, i, ball, felt(i, ball))) e = 0;
        const Vec3 w = along(v, n);
        const double loss = friction * (1 + e) * u;
        put_speed(
            y_, i,
            balls_[ball].velocity + (w.norm() <= loss ? Vec3::Zero() : Vec3(w * (1 - loss / w.norm()))) + e * u * n);
        again = hit = true;
      }
      if (!again || touched.size() == 1) break;
    }
    std::vector<int> pressing;
    for (const int ball : touched) {
      const double pressed = push(y_, i, ball, felt(i, ball)), away = seen_from(y_, i, ball).dot(normal(y_, i, ball)),
                   rounding = 1e-14 * (speed(y_, i).norm() + balls_[ball].velocity.norm());
      const double rebound = hit && pressed > 0 ? std::sqrt(2 * lowest_rebound * size_ * pressed) : 0;
      if (pressed > 0 && away <= rebound + rounding) pressing.push_back(ball);
    }
    if (pressing.empty()) return;
    if (pressing.size() > 1) {
      const bool still = !balls_[pressing[0]].moves() && !balls_[pressing[1]].moves();
      if (!still || !is_wedged(i, pressing[0], pressing[1]) || pressing.size() > 2)
        throw Unsupported("a particle moves between two surfaces: this solver supports only rest there");
      p.mode = Mode::wedged, p.ball = pressing[0], p.other = pressing[1];
      put_speed(y_, i, Vec3::Zero());
      return;
    }
    p.ball = pressing[0];
    const Ball& ball = balls_[p.ball];
    const Vec3 n = normal(y_, i, p.ball), w = along(seen_from(y_, i, p.ball), n), a = felt(i, p.ball),
               force = along(a, n);
    const bool rests = w.norm() <= rounded_to_rest * std::sqrt(size_ * a.norm()) + 1e-15 * ball.velocity.norm();
    if (rests && force.norm() <= balls_[p.ball].friction * push(y_, i, p.ball, a)) {
      p.mode = Mode::sticks, p.offset = place(y_, i) - ball.centre;
      put_speed(y_, i, ball.velocity);
      return;
    }
    p.mode = Mode::slides;
    p.forward = rests ? Vec3(force.normalized()) : Vec3(w.normalized());
    p.creeps = rests && balls_[p.ball].friction > 0;
    if (rests) put_speed(y_, i, ball.velocity);
    hold(i);
  }

  /// Moves a particle back to its surface, from which rounding has moved it, and determines whether its slide creeps.
  void hold(int i) {
    Particle& p = particles_[i];
    if (p.mode == Mode::sticks && balls_[p.ball].moves()) {
      put(y_, i, balls_[p.ball].centre + p.offset);
      put_speed(y_, i, balls_[p.ball].velocity);
    }
    if (p.mode != Mode::slides) return;
    const Ball& ball = balls_[p.ball];
    const Vec3 n = normal(y_, i, p.ball);
    put(y_, i, ball.foot(place(y_, i)));
    put_speed(y_, i, ball.velocity + along(seen_from(y_, i, p.ball), n));
    if (!(ball.friction > 0)) return;
    const Vec3 a = felt(i, p.ball), force = along(a, n);
    const double held = ball.friction * push(y_, i, p.ball, a);
    const Vec3 aside = force - force.dot(p.forward) * p.forward;
    p.creeps = aside.norm() < 0.01 * held && seen_from(y_, i, p.ball).squaredNorm() < 2 * shortest_slide * size_ * held;
  }

  std::vector<Ball> balls_;
  const double size_, time_unit_;  // m, s
  RightHandSide f_;
  StateVector y_, free_rate_;
  const int n_;
  std::vector<Particle> particles_;
  odeint::result_of::make_controlled<odeint::runge_kutta_dopri5<StateVector>>::type rule_;
  odeint::runge_kutta_dopri5<StateVector> single_;
  double h_, begun_ = 0, now_ = 0;  // s: next step; start of this one; time of the solids' positions
  const double longest_;            // s
  State state_;
  long accepted_ = 0;
};

}  // namespace

Outcome run_event_driven(const Scene& scene, const Run& run, Observer& observer) {
  EventDrivenWorld world(scene, run);
  return run_loop(world, run, observer);
}

}  // namespace crosscheck
