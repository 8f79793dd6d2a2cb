// Contact with resting spheres as a sequence of smooth motions: odeint's Dormand-Prince pair on the right-hand
// side written apart, cut at each impact, take-off, stop and slip. A second route to what mysim's contact rules
// approach; none of them is called.
//
// Each free particle is in one of four modes. On a sphere of radius R about c, with r = x - c and n = r / R:
//   flies    r'' = a, until |r| = R
//   slides   differentiating |r|^2 = R^2 twice, r . r'' = -|r'|^2: the sphere pushes by N = -a.n - |r'|^2 / R along n,
//            and by mu N against the motion; until N = 0 or r' = 0. Friction turns a slow motion along the force within
//            |r'| / (mu N), close to rest faster than any step: where that time is below 1e-5 s and the force along the
//            motion to a hundredth, it goes straight on ("creeps"), which leaves out a hundredth of |r'| at most
//   sticks   r'' = 0, until the part of a along the surface exceeds mu N
//   wedged   between two spheres, at rest: a lies between the planes of both, else the run is refused
// An impact reverses the normal speed u times e and takes at most mu (1 + e) u of the tangential one. A rebound that is
// over within `shortest_flight` is none.

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

constexpr double shortest_flight = 1e-6;    // s; within it gravity moves a particle by 5e-12 m
constexpr double fastest_turn = 1e5;        // 1/s, beyond it a slide creeps
constexpr double surface_rounding = 2e-15;  // of the radius and the centre: no impact
constexpr double most_work = 1e7;           // accelerations of a particle, from sample to sample: a second or two
constexpr int most_events_in_interval = 10000;

struct Ball {
  Vec3 centre;
  double radius, friction, restitution;
};

struct Particle {
  enum class Mode { flies, slides, sticks, wedged } mode = Mode::flies;
  int ball = -1, other = -1;    // those that it touches
  Vec3 forward = Vec3::Zero();  // of its slide, where the last step began
  bool creeps = false;          // a slide close to rest
};

std::vector<Ball> balls_of(const Scene& scene) {
  const auto* spheres = scene.model.find<Spheres>();
  if (!spheres) throw Unsupported("the scene has no contact: there are no events in it");
  if (spheres->moving()) throw Unsupported("this route knows spheres at rest only");
  if (scene.model.find<Constraints>()) throw Unsupported("this route knows no hard distances");
  std::vector<Ball> balls;
  for (const Sphere& s : spheres->list) balls.push_back({s.centre, s.radius + s.margin, s.friction, s.restitution});
  return balls;
}

/// Where a function that is negative at `high`, by `at_high`, and not at 0, becomes so, to round-off: a point where it
/// is negative.
template <class Function>
double first_negative(Function f, double high, double at_high) {
  constexpr double least = std::numeric_limits<double>::min();
  const auto nowhere_zero = [&](double s) {
    const double value = f(s);
    return value == 0 ? least : value;
  };
  // what is 0 at the start, of a slide from rest say, counts as not negative: a half of the bracket is then tried
  const double at_start = std::max(f(0), -at_high);
  const auto narrow = [](double a, double b) {
    return b - a <= 1e-16 + 4 * std::numeric_limits<double>::epsilon() * b;
  };
  std::uintmax_t iterations = 200;
  return boost::math::tools::toms748_solve(nowhere_zero, 0., high, at_start, at_high, narrow, iterations).second;
}

class EventDrivenWorld : public World {
 public:
  EventDrivenWorld(const Scene& scene, const Run& run)
      : balls_(balls_of(scene)),
        f_(without_spheres(scene)),
        y_(f_.start()),
        n_(static_cast<int>(y_.size() / 6)),
        particles_(n_),
        rule_(odeint::make_controlled(run.tolerance * scene.size(), run.tolerance,
                                      odeint::runge_kutta_dopri5<StateVector>())),
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
      if (!(h > 1e-15 * std::max(1.0, t)))
        throw SolverFailure(fmt::format("the step fell below round-off at t = {:.4g} s", t));
      const StateVector before = y_;
      remember_directions();
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
        if (++events > most_events_in_interval)
          throw SolverFailure(fmt::format("impacts without end at t = {:.4g} s", t));
        // the event is where the step is so short that nothing has happened yet
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
  Vec3 speed(const StateVector& y, int i) const { return place(y, n_ + i); }
  static void put(StateVector& y, int i, const Vec3& value) { std::copy_n(value.data(), 3, y.begin() + 3 * i); }

  double height(const StateVector& y, int i, int ball) const {
    return (place(y, i) - balls_[ball].centre).norm() - balls_[ball].radius;
  }
  Vec3 normal(const StateVector& y, int i, int ball) const { return (place(y, i) - balls_[ball].centre).normalized(); }

  /// What a ball pushes by, m/s^2, where all else accelerates by a.
  double push(const StateVector& y, int i, int ball, const Vec3& a) const {
    const Vec3 n = normal(y, i, ball), v = speed(y, i);
    return -a.dot(n) - (v - v.dot(n) * n).squaredNorm() / balls_[ball].radius;
  }
  static Vec3 along(const Vec3& a, const Vec3& n) { return a - a.dot(n) * n; }

  void derivative(const StateVector& y, StateVector& rate, double t) {
    rate.resize(y.size());
    f_(y, rate, t);
    for (int i = 0; i < n_; ++i) {
      const Particle& p = particles_[i];
      if (p.mode == Mode::flies) continue;
      if (p.mode != Mode::slides) {
        put(rate, i, Vec3::Zero());
        put(rate, n_ + i, Vec3::Zero());
        continue;
      }
      const Vec3 a = place(rate, n_ + i), n = normal(y, i, p.ball), v = speed(y, i);
      const double pressed = push(y, i, p.ball, a), friction = balls_[p.ball].friction;
      // beyond a stop, which cuts the step, friction goes on as before: the right-hand side stays smooth
      Vec3 direction = along(v, n);
      const double size = direction.norm();
      direction = size > 0 ? Vec3(direction / size * (direction.dot(p.forward) < 0 ? -1 : 1)) : p.forward;
      Vec3 sum = a + pressed * n - friction * pressed * direction;
      if (p.creeps) {
        const Vec3 e = along(p.forward, n).normalized(), force = along(a, n);
        sum += force.dot(e) * e - force + friction * pressed * (direction - e);
      }
      put(rate, n_ + i, sum);
    }
  }

  // both keep the last derivative of the step before, which another mode has changed since
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
  /// What acts but for the balls, m/s^2, at the present state.
  void accelerations(double t) {
    free_rate_.resize(y_.size());
    f_(y_, free_rate_, t);
  }

  void remember_directions() {
    for (int i = 0; i < n_; ++i) {
      Particle& p = particles_[i];
      if (p.mode != Mode::slides) continue;
      if (const Vec3 v = speed(y_, i); v.norm() > 0) p.forward = v.normalized();
    }
  }

  /// m: how far a particle is from running into a ball; negative where it does.
  double way_in(const StateVector& y, const StateVector& before, int i, int ball) const {
    const Vec3 c = balls_[ball].centre;
    const double rounding = surface_rounding * (balls_[ball].radius + c.norm()), above = height(y, i, ball) + rounding;
    // in and out again within the step: the height of the chord's nearest point, for steps far shorter than the ball
    const Vec3 from = place(before, i) - c, to = place(y, i) - c;
    if (above < 0 || !(from.dot(speed(before, i)) < 0 && to.dot(speed(y, i)) > 0) || !(height(before, i, ball) > 0))
      return above;
    const Vec3 way = to - from;
    const Vec3 nearest = from - from.dot(way) / way.squaredNorm() * way;
    return std::min(above, nearest.norm() - balls_[ball].radius + rounding);
  }

  /// Of a particle's mode, from one state to another: negative where it has ended. In m, m/s or m/s^2.
  double margin(const StateVector& y, const StateVector& before, int i) const {
    const Particle& p = particles_[i];
    const Vec3 a = place(free_rate_, n_ + i);
    double least = INFINITY;
    if (p.mode == Mode::flies || p.mode == Mode::slides)
      for (int ball = 0; ball < static_cast<int>(balls_.size()); ++ball)
        if (p.mode == Mode::flies || ball != p.ball) least = std::min(least, way_in(y, before, i, ball));
    if (p.mode == Mode::slides) {
      least = std::min(least, push(y, i, p.ball, a));
      if (balls_[p.ball].friction > 0) least = std::min(least, speed(y, i).dot(p.forward));
    }
    if (p.mode == Mode::sticks)
      least = balls_[p.ball].friction * push(y, i, p.ball, a) - along(a, normal(y, i, p.ball)).norm();
    if (p.mode == Mode::wedged && !is_wedged(i, p.ball, p.other)) throw Unsupported("a particle leaves a wedge");
    return least;
  }
  bool ended(const StateVector& y, const StateVector& before, int i) const { return !(margin(y, before, i) >= 0); }
  double least_margin(const StateVector& y, const StateVector& before, double t) {
    f_(y, free_rate_, t);
    double least = INFINITY;
    for (int i = 0; i < n_; ++i) least = std::min(least, margin(y, before, i));
    return least;
  }
  /// Lets what ended begin anew, at the present state.
  void happen(const StateVector& before, double t) {
    accelerations(t);
    for (int i = 0; i < n_; ++i) {
      if (!ended(y_, before, i)) continue;
      Particle& p = particles_[i];
      if (p.mode == Mode::slides && balls_[p.ball].friction > 0 && speed(y_, i).dot(p.forward) < 0)
        put(y_, n_ + i, Vec3::Zero());  // what is left across the motion goes to 0 with it
      settle(i);
    }
  }

  /// Whether both balls push, and nothing else is needed for rest.
  bool is_wedged(int i, int first, int second) const {
    const Vec3 a = place(free_rate_, n_ + i);
    Eigen::Matrix<double, 3, 2> normals;
    normals << normal(y_, i, first), normal(y_, i, second);
    const Eigen::Vector2d pushes = (normals.transpose() * normals).ldlt().solve(-normals.transpose() * a);
    // in the plane of both; friction would hold more
    return pushes.minCoeff() > 0 && (a + normals * pushes).norm() < 1e-9 * a.norm();
  }

  /// Impacts, and the mode that follows from place and speed.
  void settle(int i) {
    Particle& p = particles_[i];
    const Vec3 a = place(free_rate_, n_ + i);
    std::vector<int> touched;
    for (int ball = 0; ball < static_cast<int>(balls_.size()); ++ball)
      if (height(y_, i, ball) <= 1e-11 * balls_[ball].radius) {
        touched.push_back(ball);
        // what is inside by rounding would be found to run in, again and again
        if (height(y_, i, ball) < 0) put(y_, i, balls_[ball].centre + balls_[ball].radius * normal(y_, i, ball));
      }
    p = {};
    bool hit = false;
    for (int round = 0; round < 10000; ++round) {
      bool again = false;
      for (const int ball : touched) {
        const Vec3 n = normal(y_, i, ball), v = speed(y_, i);
        const double u = -v.dot(n), friction = balls_[ball].friction;
        if (!(u > 1e-15 * v.norm())) continue;
        double e = balls_[ball].restitution;
        if (2 * e * u < shortest_flight * push(y_, i, ball, a)) e = 0;
        const Vec3 w = along(v, n);
        const double loss = friction * (1 + e) * u;
        put(y_, n_ + i, (w.norm() <= loss ? Vec3::Zero() : Vec3(w * (1 - loss / w.norm()))) + e * u * n);
        again = hit = true;
      }
      if (!again || touched.size() == 1) break;
    }
    std::vector<int> pressing;
    for (const int ball : touched) {
      const double pressed = push(y_, i, ball, a), away = speed(y_, i).dot(normal(y_, i, ball));
      if (pressed > 0 && away <= (hit ? shortest_flight * pressed / 2 : 0) + 1e-14 * speed(y_, i).norm())
        pressing.push_back(ball);
    }
    if (pressing.empty()) return;
    if (pressing.size() > 1) {
      if (!is_wedged(i, pressing[0], pressing[1]) || pressing.size() > 2)
        throw Unsupported("a particle moves between two balls: this route knows rest there only");
      p.mode = Mode::wedged, p.ball = pressing[0], p.other = pressing[1];
      put(y_, n_ + i, Vec3::Zero());
      return;
    }
    p.ball = pressing[0];
    const Vec3 n = normal(y_, i, p.ball), w = along(speed(y_, i), n), force = along(a, n);
    const bool rests = w.norm() <= 1e-13 * (1 + a.norm());
    if (rests && force.norm() <= balls_[p.ball].friction * push(y_, i, p.ball, a)) {
      p.mode = Mode::sticks;
      put(y_, n_ + i, Vec3::Zero());
      return;
    }
    p.mode = Mode::slides;
    p.forward = rests ? Vec3(force.normalized()) : Vec3(w.normalized());
    p.creeps = rests && balls_[p.ball].friction > 0;
    if (rests) put(y_, n_ + i, Vec3::Zero());
    hold(i);
  }

  /// Takes the rounding of a slide off the surface, and tells whether it creeps.
  void hold(int i) {
    Particle& p = particles_[i];
    if (p.mode != Mode::slides) return;
    const Ball& ball = balls_[p.ball];
    const Vec3 n = normal(y_, i, p.ball);
    put(y_, i, ball.centre + ball.radius * n);
    put(y_, n_ + i, along(speed(y_, i), n));
    if (!(ball.friction > 0)) return;
    const Vec3 a = place(free_rate_, n_ + i), force = along(a, n);
    const double held = ball.friction * push(y_, i, p.ball, a);
    const Vec3 aside = force - force.dot(p.forward) * p.forward;
    p.creeps = aside.norm() < 0.01 * held && speed(y_, i).norm() * fastest_turn < held;
  }

  const std::vector<Ball> balls_;
  RightHandSide f_;
  StateVector y_, free_rate_;
  const int n_;
  std::vector<Particle> particles_;
  odeint::result_of::make_controlled<odeint::runge_kutta_dopri5<StateVector>>::type rule_;
  odeint::runge_kutta_dopri5<StateVector> single_;
  double h_;
  const double longest_;  // s
  State state_;
  long accepted_ = 0;
};

}  // namespace

Outcome run_event_driven(const Scene& scene, const Run& run, Observer& observer) {
  EventDrivenWorld world(scene, run);
  return run_loop(world, run, observer);
}

}  // namespace crosscheck
