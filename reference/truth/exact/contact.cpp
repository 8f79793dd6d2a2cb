// Closed forms of particles on balls: held by friction, bouncing, sliding off.

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "reference/truth/exact/exact.h"

namespace crosscheck {

std::optional<ExactSolution> held_by_friction(const Scene& scene) {
  const Model& model = scene.model;
  const auto* spheres = model.find<Spheres>();
  const auto a = steady_acceleration(model);
  if (!spheres || !a || !(a->norm() > 0) || !has_only<Gravity, Wind, Drag, Spheres>(model) || spheres->moving() ||
      !model.particles.pins.empty() || !scene.start.v.isZero(0))
    return std::nullopt;
  for (int i = 0; i < model.particles.size(); ++i) {
    const Sphere* under = nullptr;
    Vec3 n;
    for (const Sphere& s : spheres->list) {
      const Vec3 d = scene.start.x.col(i) - s.centre;
      const double gap = d.norm() - s.contact_radius();
      if (gap > 1e-12 * s.contact_radius()) continue;
      if (under) return std::nullopt;  // wedged between two: that needs both forces at once
      under = &s, n = d.normalized();
    }
    if (!under) return std::nullopt;
    // Coulomb's cone: what acts along the surface is less than mu times what presses on it
    const double pressing = -a->dot(n), along = (*a + pressing * n).norm();
    if (!(along < under->friction * pressing || (along == 0 && pressing > 0))) return std::nullopt;
  }
  return ExactSolution{"friction holds every particle: it stays", [start = scene.start](double t) {
                         State s = start;
                         s.t = t;
                         return s;
                       }};
}

namespace {

/// Height over the surface and upward speed.
struct Flight {
  double height, speed;  // m, m/s
};

/// After time t (s) of falling and bouncing under g (m/s^2) with restitution e; speeds are reversed times e at height
/// 0.
Flight after_bounces(Flight f, double g, double e, double t) {
  for (;;) {
    const double impact = std::sqrt(f.speed * f.speed + 2 * g * f.height);  // m/s, downwards
    const double flight = (f.speed + impact) / g;
    if (t <= flight) return {f.height + t * (f.speed - g * t / 2), f.speed - g * t};
    t -= flight;
    f = {0, e * impact};
    // all later bounces together take 2 v / (g (1 - e)): then it lies still
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
      if (aside >= s.contact_radius()) continue;                    // falls past it
      if (aside > 1e-15 * s.contact_radius()) return std::nullopt;  // is thrown aside
      if (d.dot(up) > 0 && d.dot(up) - s.contact_radius() < gap) below = &s, gap = d.dot(up) - s.contact_radius();
      if (d.dot(up) < 0) return std::nullopt;  // one above: it could fly against it
    }
    if (!below) return std::nullopt;
    falling_particles.push_back({{std::max(0.0, gap), v.dot(up)}, below->restitution});
  }
  return ExactSolution{"parabolas between impacts that return the restitution's part of the speed",
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

// A particle that slides over a ball with Coulomb friction until it flies off. With theta the angle from the top and u
// = theta'^2, the motion on the ball is du/dtheta = 2 (g/R) (sin theta - mu cos theta) + 2 mu u, which is linear:
//   u = C e^(2 mu theta) + A cos theta + B sin theta,  A = (g/R) (4 mu^2 - 2) / (1 + 4 mu^2),  B = -6 mu (g/R) / (1 + 4
//   mu^2).
// It leaves where u = (g/R) cos theta; time is the integral of dtheta / sqrt(u).

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
  /// Finds where the particle leaves; false when friction stops it before.
  bool find_departure() {
    constexpr int pieces = 20000;
    double before = theta0_;
    for (int i = 1; i <= pieces; ++i) {
      const double theta = theta0_ + (1.6 - theta0_) * i / pieces;  // it leaves before the equator at 1.571
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
    for (int i = 0; i < 60; ++i) {  // Newton's method, halving where it would leave the interval
      const double off = time(at) - t;
      (off > 0 ? high : low) = at;
      const double next = at - off * std::sqrt(u(at));
      if (std::abs(next - at) < 1e-16) break;
      at = next > low && next < high ? next : (low + high) / 2;
    }
    return at;
  }

 private:
  /// Time from the start to the angle, s: Gauss's rule of 5 points on 40 pieces, error below rounding for u as smooth
  /// as this.
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
  // along the surface, in the plane of gravity
  if (std::abs(forward.dot(n)) > 1e-14 || std::abs(up.dot(n.cross(forward))) > 1e-14) return std::nullopt;
  const double theta0 = std::atan2(-up.dot(forward), up.dot(n));
  if (!(speed * speed / radius < g * std::cos(theta0))) return std::nullopt;  // it does not touch at all
  Slide slide(g / radius, ball.friction, theta0, speed / radius);
  if (!slide.find_departure()) return std::nullopt;

  const Vec3 side = std::sin(theta0) * n + std::cos(theta0) * forward;
  return ExactSolution{
      "Coulomb friction on a ball: speed by the angle in closed form, then free flight",
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
