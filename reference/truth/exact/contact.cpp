// Closed forms of particles on balls and planes: held by friction, bouncing, sliding.
//
// Without friction, the coordinates along the normals of perpendicular fixed planes are independent: each falls onto
// one wall, or between two. On a single plane with friction, the tangential speed changes at each impact and during
// resting contact.

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "reference/truth/exact/exact.h"

namespace crosscheck {

std::optional<ExactSolution> held_by_friction(const Scene& scene) {
  const Model& model = scene.model;
  const std::vector<Surface> surfaces = surfaces_of(model);
  const auto a = steady_acceleration(model);
  if (surfaces.empty() || !a || !(a->norm() > 0) || !has_only<Gravity, Wind, Drag, Spheres, Planes>(model) ||
      has_moving_surface(model) || !model.particles.pins.empty() || !scene.start.v.isZero(0))
    return std::nullopt;
  for (int i = 0; i < model.particles.size(); ++i) {
    const Surface* under = nullptr;
    Vec3 n;
    for (const Surface& s : surfaces) {
      const Vec3 d = scene.start.x.col(i) - s.origin_at(0);
      if (s.gap(d) > 1e-12 * (s.flat() ? scene.size() : s.radius())) continue;
      if (under) return std::nullopt;  // wedged: the forces of two surfaces depend on each other
      under = &s, n = s.normal(d);
    }
    if (!under) return std::nullopt;
    // Coulomb's cone: the tangential acceleration is less than mu times the normal one
    const double pressing = -a->dot(n), along = (*a + pressing * n).norm();
    if (!(along < under->friction * pressing || (along == 0 && pressing > 0))) return std::nullopt;
  }
  return ExactSolution{"friction holds every particle at rest", [start = scene.start](double t) {
                         State s = start;
                         s.t = t;
                         return s;
                       }};
}

namespace {

/// Height over the surface, and upward speed.
struct Flight {
  double height, speed;  // m, m/s
};

/// State after falling and bouncing for t (s) under g (m/s^2): at height 0 the speed is reversed and multiplied by e.
Flight after_bounces(Flight f, double g, double e, double t) {
  for (;;) {
    const double impact = std::sqrt(f.speed * f.speed + 2 * g * f.height);  // m/s, downwards
    const double flight = (f.speed + impact) / g;
    if (t <= flight) return {f.height + t * (f.speed - g * t / 2), f.speed - g * t};
    t -= flight;
    f = {0, e * impact};
    // all later bounces together take 2 v / (g (1 - e)); after them, the particle is at rest
    if (e < 1 && t >= 2 * f.speed / (g * (1 - e)) * (1 - 1e-15)) return {0, 0};
  }
}

}  // namespace

std::optional<ExactSolution> bounces(const Scene& scene) {
  const Model& model = scene.model;
  const auto* gravity = model.find<Gravity>();
  const auto* spheres = model.find<Spheres>();
  if (!gravity || !spheres || !has_only<Gravity, Spheres>(model) || !model.particles.pins.empty() || spheres->moving())
    return std::nullopt;
  const double g = gravity->acceleration.norm();
  if (!(g > 0)) return std::nullopt;
  const Vec3 up = -gravity->acceleration / g;

  struct FallingParticle {
    Flight start;
    double restitution;
  };
  std::vector<FallingParticle> falling_particles;
  for (int i = 0; i < model.particles.size(); ++i) {
    const Vec3 x = scene.start.x.col(i), v = scene.start.v.col(i);
    if ((v - v.dot(up) * up).norm() > 0) return std::nullopt;
    const Sphere* below = nullptr;
    double gap = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres->list) {
      const Vec3 d = x - s.centre;
      const double aside = (d - d.dot(up) * up).norm();
      if (aside >= s.contact_radius()) continue;                    // falls past the ball
      if (aside > 1e-15 * s.contact_radius()) return std::nullopt;  // is deflected sideways
      if (d.dot(up) > 0 && d.dot(up) - s.contact_radius() < gap) below = &s, gap = d.dot(up) - s.contact_radius();
      if (d.dot(up) < 0) return std::nullopt;  // a ball above: might be hit from below
    }
    if (!below) return std::nullopt;
    falling_particles.push_back({{std::max(0.0, gap), v.dot(up)}, below->restitution});
  }
  return ExactSolution{"parabolas between impacts with the given coefficient of restitution",
                       [start = scene.start, up, g, falling_particles](double t) {
                         State s = start;
                         s.t = t;
                         for (size_t i = 0; i < falling_particles.size(); ++i) {
                           const int at = static_cast<int>(i);
                           const Flight f =
                               after_bounces(falling_particles[i].start, g, falling_particles[i].restitution, t);
                           s.x.col(at) += (f.height - falling_particles[i].start.height) * up;
                           s.v.col(at) = f.speed * up;
                         }
                         return s;
                       }};
}

namespace {

/// A coordinate that falls and bounces between walls at 0 and at `width`, which may be infinite.
struct Fall {
  double q, v, a;      // m, m/s, m/s^2
  double width, e[2];  // m; restitution at 0 and at `width`
  double lying = 0;    // s, time in resting contact at the end
};

/// Time until q >= 0 falls to 0 (s), or infinity.
double time_to_zero(double q, double v, double a) {
  const double square = v * v - 2 * a * q;
  if ((v >= 0 && a >= 0) || square < 0) return INFINITY;
  return v < 0 ? 2 * q / (std::sqrt(square) - v) : (v + std::sqrt(square)) / -a;
}

/// State after a time t (s). `flight` is called with the duration of each flight, `impact` with the speed of each
/// impact and its restitution. Skips infinite sequences of bounces shorter than `negligible` (s).
template <class Flight, class Impact>
Fall fallen(Fall c, double t, double negligible, Flight flight, Impact impact) {
  for (;;) {
    const double low = time_to_zero(c.q, c.v, c.a), high = time_to_zero(c.width - c.q, -c.v, -c.a),
                 s = std::min(low, high);
    const double flown = std::min(t, s);
    flight(flown);
    c.q += flown * (c.v + c.a * flown / 2), c.v += c.a * flown;
    if (t <= s) return c;
    t -= s;
    const int wall = low <= high ? 0 : 1;
    const double out = wall == 0 ? 1 : -1, u = std::max(0.0, -out * c.v), e = c.e[wall], pull = -out * c.a;
    impact(u, e);
    c.q = wall == 0 ? 0 : c.width, c.v = out * e * u;
    if (!(pull > 0)) continue;
    const bool other_wall = e * u * e * u > 2 * pull * c.width;
    const double later = u == 0 || e == 0 ? 0 : e < 1 ? 2 * e * u / (pull * (1 - e)) : INFINITY;  // s, all bounces
    if (other_wall || !(later <= std::min(t * (1 + 1e-15), negligible))) continue;
    c.v = 0, c.lying = std::max(0.0, t - later);
    return c;
  }
}

/// Coordinate along a plane that pushes the particle with a normal acceleration N.
struct Slip {
  double y, v, a;  // m, m/s, m/s^2
  void fly(double t) { y += t * (v + a * t / 2), v += a * t; }
  void lose(double speed) { v = std::copysign(std::max(0.0, std::abs(v) - speed), v); }
  /// Slides for t (s) against the friction mu N (m/s^2), stops, and stays at rest or slides back.
  void slide(double t, double friction) {
    for (int stops = 0; t > 0 && !(v == 0 && std::abs(a) <= friction) && stops < 2; ++stops) {
      const double rate = a - std::copysign(friction, v != 0 ? v : a), stop = v * rate < 0 ? -v / rate : INFINITY;
      const double slid = std::min(t, stop);
      y += slid * (v + rate * slid / 2), v = slid == stop ? 0 : v + rate * slid;
      t -= slid;
    }
  }
};

/// Motion along the normal of one plane or of two opposite planes.
struct Between {
  Vec3 normal;
  double wall, speed;  // place (m) and speed (m/s) of the first plane, along the normal
  double friction;     // mu
  Fall fall;           // relative to the first plane; position and speed differ by particle
};

struct MotionBetweenPlanes {
  Vec3 a;                       // m/s^2
  std::vector<Between> axes;    // perpendicular; only one with friction
  std::vector<Vec3> direction;  // per particle; empty without friction
  Vec3 carried = Vec3::Zero();  // m/s, velocity of the plane with friction

  /// Replaces x and v of particle i by their values after a time t (s).
  void move(int i, double t, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v) const {
    const bool friction = !direction.empty();
    const Vec3 x0 = x, v0 = v, slip_direction = friction ? direction[i] : Vec3::Zero();
    Slip slip{0, (v0 - carried).dot(slip_direction), a.dot(slip_direction)};
    // the velocity and the acceleration that no plane changes
    Vec3 steady = v0 - slip.v * slip_direction, free = friction ? Vec3::Zero() : a;
    Vec3 moved = Vec3::Zero(), speed = Vec3::Zero();  // along the normals and the slip direction
    for (const Between& b : axes) {
      Fall fall = b.fall;
      const double begin = std::max(0.0, x0.dot(b.normal) - b.wall);
      fall.q = begin, fall.v = v0.dot(b.normal) - b.speed;
      fall = fallen(
          fall, t, friction ? 1e-16 * t : INFINITY, [&](double flown) { slip.fly(flown); },
          [&](double u, double e) { slip.lose(b.friction * (1 + e) * u); });
      slip.slide(fall.lying, b.friction * std::abs(fall.a));
      moved += (fall.q - begin + t * b.speed) * b.normal, speed += (fall.v + b.speed) * b.normal;
      steady -= steady.dot(b.normal) * b.normal, free -= free.dot(b.normal) * b.normal;
    }
    x = x0 + t * (steady + t / 2 * free) + moved + slip.y * slip_direction;
    v = steady + t * free + speed + slip.v * slip_direction;
  }
};

}  // namespace

std::optional<ExactSolution> between_planes(const Scene& scene) {
  const Model& model = scene.model;
  const auto* planes = model.find<Planes>();
  const auto steady = steady_acceleration(model);
  if (!planes || !steady || !has_only<Gravity, Wind, Planes>(model) || !model.particles.pins.empty())
    return std::nullopt;
  MotionBetweenPlanes motion{*steady, {}, {}};
  for (const Plane& p : planes->list) {
    if (p.friction > 0 && planes->list.size() > 1) return std::nullopt;
    const double offset = p.point.dot(p.normal) + p.margin, speed = p.velocity ? p.velocity->dot(p.normal) : 0;
    bool opposite = false;
    for (Between& b : motion.axes) {
      if (std::abs(b.normal.dot(p.normal)) < 1e-15) continue;
      if (!((p.normal + b.normal).norm() < 1e-15) || std::isfinite(b.fall.width) || speed != -b.speed)
        return std::nullopt;
      b.fall.width = -offset - b.wall, b.fall.e[1] = p.restitution;
      opposite = true;
    }
    if (opposite) continue;
    const Fall fall{0, 0, motion.a.dot(p.normal), INFINITY, {p.restitution, 0}};
    motion.axes.push_back({p.normal, offset, speed, p.friction, fall});
  }
  const Plane& first = planes->list[0];
  if (first.friction > 0) motion.carried = first.velocity.value_or(Vec3::Zero());
  // motion along a plane with friction must be straight
  for (int i = 0; first.friction > 0 && i < model.particles.size(); ++i) {
    const Vec3 n = first.normal, v = scene.start.v.col(i) - motion.carried, w = v - v.dot(n) * n,
               pull = motion.a - motion.a.dot(n) * n;
    if (w.cross(pull).norm() > 1e-15 * w.norm() * motion.a.norm()) return std::nullopt;
    motion.direction.push_back(w.isZero(0) ? pull.normalized() : w.normalized());
  }
  return ExactSolution{"falls between planes, each along its normal, with Coulomb friction along a single one",
                       [start = scene.start, motion = std::move(motion)](double t) {
                         State s = start;
                         s.t = t;
                         for (int i = 0; i < s.x.cols(); ++i) motion.move(i, t, s.x.col(i), s.v.col(i));
                         return s;
                       }};
}

// A particle that slides over a ball with Coulomb friction until it flies off. With theta the angle from the top and
// u = theta'^2, the motion on the ball is du/dtheta = 2 (g/R) (sin theta - mu cos theta) + 2 mu u, which is linear:
//   u = C e^(2 mu theta) + A cos theta + B sin theta,
//   A = (g/R) (4 mu^2 - 2) / (1 + 4 mu^2),  B = -6 mu (g/R) / (1 + 4 mu^2).
// The particle leaves the ball where u = (g/R) cos theta; time is the integral of dtheta / sqrt(u).

namespace {

class Slide {
 public:
  Slide(double g_over_r, double mu, double theta0, double rate0) : omega2_(g_over_r), mu_(mu), theta0_(theta0) {
    a_ = omega2_ * (4 * mu * mu - 2) / (1 + 4 * mu * mu);
    b_ = -6 * mu * omega2_ / (1 + 4 * mu * mu);
    c_ = (rate0 * rate0 - a_ * std::cos(theta0) - b_ * std::sin(theta0)) * std::exp(-2 * mu * theta0);
  }
  double u(double theta) const {  // 1/s^2
    return c_ * std::exp(2 * mu_ * theta) + a_ * std::cos(theta) + b_ * std::sin(theta);
  }
  /// Finds the angle of departure; false if friction stops the particle before it departs.
  bool find_departure() {
    constexpr int pieces = 20000;
    double before = theta0_;
    for (int i = 1; i <= pieces; ++i) {
      const double theta = theta0_ + (1.6 - theta0_) * i / pieces;  // it leaves the ball before the equator, 1.571
      if (!(u(theta) > 0)) return false;
      if (u(theta) >= omega2_ * std::cos(theta)) {
        double low = before, high = theta;
        for (int bisection = 0; bisection < 60; ++bisection) {
          const double middle = (low + high) / 2;
          (u(middle) >= omega2_ * std::cos(middle) ? high : low) = middle;
        }
        departure_ = low;
        departure_time_ = time(departure_);
        return true;
      }
      before = theta;
    }
    return false;
  }
  double end() const { return departure_; }
  double departure_time() const { return departure_time_; }
  /// Angle at time t <= departure_time().
  double theta(double t) const {
    double low = theta0_, high = departure_, at = theta0_ + (departure_ - theta0_) * t / departure_time_;
    for (int i = 0; i < 60; ++i) {  // Newton's method; bisection if it would leave the interval
      const double off = time(at) - t;
      (off > 0 ? high : low) = at;
      const double next = at - off * std::sqrt(u(at));
      if (std::abs(next - at) < 1e-16) break;
      at = next > low && next < high ? next : (low + high) / 2;
    }
    return at;
  }

 private:
  /// Time from the start to the angle (s): Gauss quadrature with 5 points on each of 40 pieces, whose error is below
  /// rounding because u is smooth.
  double time(double theta) const {
    constexpr double node[] = {0, 0.5384693101056831, 0.9061798459386640};
    constexpr double weight[] = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    constexpr int pieces = 40;
    const double half = (theta - theta0_) / pieces / 2;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
      const double middle = theta0_ + (2 * i + 1) * half;
      sum += weight[0] / std::sqrt(u(middle));
      for (int j = 1; j < 3; ++j)
        sum += weight[j] * (1 / std::sqrt(u(middle - node[j] * half)) + 1 / std::sqrt(u(middle + node[j] * half)));
    }
    return sum * half;
  }

  double omega2_, mu_, theta0_, a_, b_, c_;
  double departure_ = 0, departure_time_ = 0;
};

}  // namespace

std::optional<ExactSolution> slide_over_ball(const Scene& scene) {
  const Model& model = scene.model;
  const auto* gravity = model.find<Gravity>();
  const auto* spheres = model.find<Spheres>();
  if (!gravity || !spheres || spheres->list.size() != 1 || model.particles.size() != 1 || spheres->moving() ||
      !has_only<Gravity, Spheres>(model))
    return std::nullopt;
  const Sphere& ball = spheres->list[0];
  const double radius = ball.contact_radius(), g = gravity->acceleration.norm();
  const Vec3 v = scene.start.v.col(0), d = scene.start.x.col(0) - ball.centre;
  const double speed = v.norm();
  if (!(g > 0) || !(speed > 0) || std::abs(d.norm() - radius) > 1e-12 * radius) return std::nullopt;
  const Vec3 up = -gravity->acceleration / g, n = d.normalized(), forward = v / speed;
  // the velocity must be tangential, and in the plane of gravity and the normal
  if (std::abs(forward.dot(n)) > 1e-14 || std::abs(up.dot(n.cross(forward))) > 1e-14) return std::nullopt;
  const double theta0 = std::atan2(-up.dot(forward), up.dot(n));
  if (!(speed * speed / radius < g * std::cos(theta0))) return std::nullopt;  // not in contact at all
  Slide slide(g / radius, ball.friction, theta0, speed / radius);
  if (!slide.find_departure()) return std::nullopt;

  const Vec3 side = std::sin(theta0) * n + std::cos(theta0) * forward;
  return ExactSolution{
      "Coulomb friction on a ball: speed as a function of the angle in closed form, then free flight",
      [start = scene.start, slide, centre = ball.centre, a = gravity->acceleration, radius, up, side](double t) {
        const double on = std::min(t, slide.departure_time()), off = t - on;
        const double theta = slide.theta(on), rate = std::sqrt(slide.u(theta));
        const Vec3 normal = std::cos(theta) * up + std::sin(theta) * side;
        const Vec3 tangent = -std::sin(theta) * up + std::cos(theta) * side;
        State s = start;
        s.t = t;
        s.v.col(0) = radius * rate * tangent + off * a;
        s.x.col(0) = centre + radius * normal + off * radius * rate * tangent + off * off / 2 * a;
        return s;
      }};
}

}  // namespace crosscheck
