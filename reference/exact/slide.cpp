// A particle that slides over a ball with Coulomb friction until it flies off. With theta the angle from the top and u
// = theta'^2, the motion on the ball is du/dtheta = 2 (g/R) (sin theta - mu cos theta) + 2 mu u, which is linear:
//   u = C e^(2 mu theta) + A cos theta + B sin theta,  A = (g/R) (4 mu^2 - 2) / (1 + 4 mu^2),  B = -6 mu (g/R) / (1 + 4
//   mu^2).
// It leaves where u = (g/R) cos theta; time is the integral of dtheta / sqrt(u).
#include <Eigen/Geometry>
#include <cmath>

#include "reference/exact/recognise.h"

namespace crosscheck {
namespace {

class Slide {
 public:
  Slide(double g_over_r, double mu, double theta0, double rate0) : w2_(g_over_r), mu_(mu), theta0_(theta0) {
    a_ = w2_ * (4 * mu * mu - 2) / (1 + 4 * mu * mu);
    b_ = -6 * mu * w2_ / (1 + 4 * mu * mu);
    c_ = (rate0 * rate0 - a_ * std::cos(theta0) - b_ * std::sin(theta0)) * std::exp(-2 * mu * theta0);
  }
  double u(double theta) const {  // 1/s^2
    return c_ * std::exp(2 * mu_ * theta) + a_ * std::cos(theta) + b_ * std::sin(theta);
  }
  /// Finds where the particle leaves; false when friction stops it before.
  bool find_end() {
    constexpr int pieces = 20000;
    double before = theta0_;
    for (int i = 1; i <= pieces; ++i) {
      const double theta = theta0_ + (1.6 - theta0_) * i / pieces;  // it leaves before the equator at 1.571
      if (!(u(theta) > 0)) return false;
      if (u(theta) >= w2_ * std::cos(theta)) {
        double low = before, high = theta;
        for (int bisection = 0; bisection < 60; ++bisection) {
          const double middle = (low + high) / 2;
          (u(middle) >= w2_ * std::cos(middle) ? high : low) = middle;
        }
        end_ = low;
        end_time_ = time(end_);
        return true;
      }
      before = theta;
    }
    return false;
  }
  double end() const { return end_; }
  double end_time() const { return end_time_; }
  /// Angle at time t <= end_time().
  double theta(double t) const {
    double low = theta0_, high = end_, at = theta0_ + (end_ - theta0_) * t / end_time_;
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

  double w2_, mu_, theta0_, a_, b_, c_;
  double end_ = 0, end_time_ = 0;
};

}  // namespace

std::optional<ExactSolution> slide_over_ball(const Scene& scene) {
  const Model& model = scene.model;
  const auto* gravity = model.find<Gravity>();
  const auto* spheres = model.find<Spheres>();
  if (!gravity || !spheres || spheres->list.size() != 1 || model.particles.size() != 1 || spheres->moving() ||
      !only<Gravity, Spheres>(model))
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
  if (!slide.find_end()) return std::nullopt;

  const Vec3 side = std::sin(theta0) * n + std::cos(theta0) * forward;
  return ExactSolution{
      "Coulomb friction on a ball: speed by the angle in closed form, then free flight",
      [start = scene.start, slide, centre = ball.centre, a = gravity->acceleration, radius, up, side](double t) {
        const double on = std::min(t, slide.end_time()), off = t - on;
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
