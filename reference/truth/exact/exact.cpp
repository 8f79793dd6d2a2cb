// Closed forms of rotation and free flight; the others are in linear.cpp and contact.cpp.
#include "reference/truth/exact/exact.h"

#include <cmath>

#include "mysim/model/system.h"
#include "reference/truth/exact/linear.h"

namespace crosscheck {

std::optional<Vec3> steady_acceleration(const Model& model) {
  Vec3 a = Vec3::Zero();
  if (const auto* gravity = model.find<Gravity>()) a += gravity->acceleration;
  if (const auto* wind = model.find<Wind>()) {
    if (wind->acceleration.gusts) return std::nullopt;
    a += wind->acceleration.mean;
  }
  return a;
}

namespace {

std::optional<ExactSolution> rigid_rotation(const Scene& scene) {
  const auto* rotation = scene.model.find<Rotation>();
  if (!rotation) return std::nullopt;
  return ExactSolution{
      "x(t) = rotation of x(0) by rate * t about z", [start = scene.start, rate = rotation->rate](double t) {
        State s = start;
        const double c = std::cos(rate * t), d = std::sin(rate * t);
        for (int i = 0; i < s.x.cols(); ++i)
          s.x.col(i).head<2>() << c * start.x(0, i) - d * start.x(1, i), d * start.x(0, i) + c * start.x(1, i);
        s.t = t;
        return s;
      }};
}

/// (z - 1 + exp(-z)) / z^2, as a series where it would cancel; 1/2 without drag.
double phi2(double z) {
  if (z > 0.5) return (z + std::expm1(-z)) / (z * z);
  double sum = 0, term = 0.5;
  for (int n = 3; n < 18; ++n) sum += term, term *= -z / n;
  return sum;
}

std::optional<ExactSolution> projectile(const Scene& scene) {
  const Model& model = scene.model;
  const auto a = steady_acceleration(model);
  if (model.particles.size() != 1 || !has_only<Gravity, Wind, Drag>(model) || !a) return std::nullopt;
  const auto* drag = model.find<Drag>();
  const double gamma = drag ? drag->c[0] / model.particles.mass[0] : 0;
  return ExactSolution{gamma > 0 ? "v(t) = a/gamma + (v0 - a/gamma) exp(-gamma t)" : "x(t) = x0 + v0 t + a t^2 / 2",
                       [start = scene.start, a = *a, gamma](double t) {
                         State s = start;
                         s.t = t;
                         const Vec3 x0 = start.x.col(0), v0 = start.v.col(0);
                         const double z = gamma * t;
                         const double gone = z > 0 ? -std::expm1(-z) / gamma : t;  // integral of exp(-gamma t), s
                         s.v.col(0) = v0 * std::exp(-z) + a * gone;
                         s.x.col(0) = x0 + v0 * gone + a * (t * t * phi2(z));
                         return s;
                       }};
}

}  // namespace

std::optional<ExactSolution> exact_solution(const Scene& scene) {
  for (const auto recognise :
       {rigid_rotation, projectile, normal_modes, bounces, held_by_friction, between_planes, slide_over_ball})
    if (auto solution = recognise(scene)) return solution;
  return std::nullopt;
}

}  // namespace crosscheck
