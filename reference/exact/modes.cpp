// Springs and masses on one line: a sum of normal modes.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>

#include "mysim/frequency.h"
#include "reference/exact/oscillator.h"
#include "reference/exact/recognise.h"

namespace crosscheck {
namespace {

/// The line through the particles: a point on it, its direction, and where each particle is along it.
struct Line {
  Vec3 origin, direction;
  Eigen::VectorXd along, speed;  // m, m/s
};

std::optional<Line> line_through(const Scene& scene, const Vec3& acceleration) {
  const Points &x = scene.start.x, &v = scene.start.v;
  Eigen::Index farthest = 0;
  const double length = (x.colwise() - x.col(0)).colwise().norm().maxCoeff(&farthest);
  if (!(length > 0)) return std::nullopt;
  Line line{x.col(0), (x.col(farthest) - x.col(0)) / length, {}, {}};
  const Vec3& n = line.direction;
  // what lies across the line is below the rounding of what was written
  auto across = [&](const Vec3& p) { return (p - p.dot(n) * n).norm(); };
  for (int i = 0; i < x.cols(); ++i)
    if (across(x.col(i) - line.origin) > 1e-14 * length || across(v.col(i)) > 1e-14 * v.col(i).norm())
      return std::nullopt;
  if (across(acceleration) > 1e-14 * acceleration.norm()) return std::nullopt;
  line.along = (x.colwise() - line.origin).transpose() * n;
  line.speed = v.transpose() * n;
  return line;
}

}  // namespace

std::optional<ExactSolution> normal_modes(const Scene& scene) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto* springs = model.find<Springs>();
  const auto a = steady_acceleration(model);
  const auto gamma = uniform_drag_rate(model);
  if (!springs || springs->law != SpringLaw::hooke || !a || !gamma || particles.move ||
      !only<Springs, Gravity, Drag, Wind>(model))
    return std::nullopt;
  const auto line = line_through(scene, *a);
  if (!line) return std::nullopt;

  // M xi'' = -K xi + b - gamma M xi', where no spring ever turns over
  const int n = particles.size();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = a->dot(line->direction) * particles.mass;
  for (const Spring& s : springs->list) {
    const double side = line->along[s.a] > line->along[s.b] ? 1 : -1;
    k(s.a, s.a) += s.k, k(s.b, s.b) += s.k, k(s.a, s.b) -= s.k, k(s.b, s.a) -= s.k;
    b[s.a] += side * s.k * s.rest, b[s.b] -= side * s.k * s.rest;
  }
  b -= k * line->along;  // of the unknown displacement from the start
  for (int pin : particles.pins) {
    k.row(pin).setZero(), k.col(pin).setZero();
    k(pin, pin) = 1, b[pin] = 0;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k);
  if (factor.info() != Eigen::Success) return std::nullopt;  // something floats freely
  const Eigen::VectorXd rest = factor.solve(b);
  const Eigen::VectorXd root = particles.mass.cwiseSqrt();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(root.cwiseInverse().asDiagonal() * k *
                                                             root.cwiseInverse().asDiagonal());
  const Eigen::MatrixXd shape = root.cwiseInverse().asDiagonal() * modes.eigenvectors();
  const Eigen::VectorXd q0 = -(shape.transpose() * particles.mass.asDiagonal() * rest);
  const Eigen::VectorXd p0 = shape.transpose() * particles.mass.asDiagonal() * line->speed;
  std::vector<Oscillator> q;
  for (int i = 0; i < n; ++i) q.push_back({modes.eigenvalues()[i], *gamma, q0[i], p0[i]});

  for (const Spring& s : springs->list) {
    double room = std::abs((line->along + rest)[s.a] - (line->along + rest)[s.b]);
    for (int i = 0; i < n; ++i) room -= std::abs(shape(s.a, i) - shape(s.b, i)) * q[i].largest();
    if (!(room > 0)) return std::nullopt;
  }
  return ExactSolution{"sum of the normal modes of springs and masses on a line",
                       [start = scene.start, direction = line->direction, rest, shape, q](double t) {
                         State s = start;
                         s.t = t;
                         Eigen::VectorXd position = rest, velocity = Eigen::VectorXd::Zero(rest.size());
                         for (size_t i = 0; i < q.size(); ++i) {
                           position += q[i].position(t) * shape.col(static_cast<int>(i));
                           velocity += q[i].velocity(t) * shape.col(static_cast<int>(i));
                         }
                         s.x += direction * position.transpose();
                         s.v = direction * velocity.transpose();
                         return s;
                       }};
}

}  // namespace crosscheck
