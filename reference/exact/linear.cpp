// Stiffness, damping and modes of springs on a line.
#include "reference/exact/linear.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "mysim/frequency.h"
#include "reference/exact/eigenvalues.h"
#include "reference/exact/recognise.h"

namespace crosscheck {
namespace {

/// The line through the particles: its direction, and where each particle is along it.
struct Line {
  Vec3 direction;
  Eigen::VectorXd along, speed;  // n, m, m/s
};

std::optional<Line> line_through(const Scene& scene, const Vec3& acceleration) {
  const Points &x = scene.start.x, &v = scene.start.v;
  Eigen::Index farthest = 0;
  const double length = (x.colwise() - x.col(0)).colwise().norm().maxCoeff(&farthest);
  if (!(length > 0)) return std::nullopt;
  const Vec3 n = (x.col(farthest) - x.col(0)) / length;
  // what lies across the line is below the rounding of what was written
  auto across = [&](const Vec3& p, double size) { return (p - p.dot(n) * n).norm() > 1e-14 * size; };
  for (int i = 0; i < x.cols(); ++i)
    if (across(x.col(i) - x.col(0), length) || across(v.col(i), v.col(i).norm())) return std::nullopt;
  if (across(acceleration, acceleration.norm())) return std::nullopt;
  if (const auto& move = scene.model.particles.move; move && across(move->amplitude, move->amplitude.norm()))
    return std::nullopt;
  return Line{n, (x.colwise() - x.col(0)).transpose() * n, v.transpose() * n};
}

/// Sum over pairs of value times the difference of the two, as a matrix.
template <class Pairs, class Value>
Eigen::MatrixXd matrix_of(const Pairs& pairs, int n, Value value) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, n);
  for (const auto& p : pairs) {
    const double c = value(p);
    m(p.a, p.a) += c, m(p.b, p.b) += c, m(p.a, p.b) -= c, m(p.b, p.a) -= c;
  }
  return m;
}

LinearScene flight(const Scene& scene, const Vec3& acceleration, double drag) {
  LinearScene linear{scene.start.x, {}};
  for (int axis = 0; axis < 3; ++axis)
    linear.modes.push_back({0, drag, 0, acceleration[axis], 0, 0, scene.start.v(axis, 0), Vec3::Unit(axis)});
  return linear;
}

}  // namespace

double LinearScene::room(const Model& model, const std::vector<double>& centre,
                         const std::vector<double>& amplitude) const {
  double smallest = std::numeric_limits<double>::infinity();
  const auto* springs = model.find<Springs>();
  if (!springs) return smallest;
  for (const Spring& s : springs->list) {
    Vec3 d = rest.col(s.a) - rest.col(s.b);
    const Vec3 n = d.normalized();
    double swing = model.particles.pinned[s.a] != model.particles.pinned[s.b] ? shake : 0;
    for (size_t i = 0; i < modes.size(); ++i) {
      const Vec3 difference = modes[i].shape.col(s.a) - modes[i].shape.col(s.b);
      d += centre[i] * difference;
      swing += amplitude[i] * difference.norm();
    }
    smallest = std::min(smallest, d.dot(n) - swing);
  }
  return smallest;
}

std::optional<LinearScene> linear_scene(const Scene& scene) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto a = steady_acceleration(model);
  const auto drag = uniform_drag_rate(model);
  if (!a || !drag) return std::nullopt;
  if (particles.size() == 1 && particles.pins.empty() && only<Gravity, Wind, Drag>(model))
    return flight(scene, *a, *drag);
  const auto* springs = model.find<Springs>();
  if (!springs || springs->law != SpringLaw::hooke || !only<Springs, Dashpots, Gravity, Drag, Wind>(model))
    return std::nullopt;
  const auto line = line_through(scene, *a);
  if (!line) return std::nullopt;

  // M xi'' = f - K xi - C xi' - drag M xi' + M a of the displacement xi from the start, free particles only
  const int n = particles.size();
  std::vector<int> free;
  for (int i = 0; i < n; ++i)
    if (!particles.pinned[i]) free.push_back(i);
  const Eigen::MatrixXd k = matrix_of(springs->list, n, [](const Spring& s) { return s.k; })(free, free);
  Eigen::VectorXd all = Eigen::VectorXd::Zero(n);
  for (const Spring& s : springs->list) {
    const double d = line->along[s.a] - line->along[s.b];
    const double pull = s.k * (std::abs(d) - s.rest) * (d > 0 ? 1 : -1);  // exact where the start is the rest length
    all[s.a] -= pull, all[s.b] += pull;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(k);
  if (factor.info() != Eigen::Success) return std::nullopt;  // something floats freely
  const Eigen::VectorXd mass = particles.mass(free), rest = factor.solve(all(free));
  double beta = 0;  // s, dashpots over stiffness
  if (const auto* dashpots = model.find<Dashpots>()) {
    const Eigen::MatrixXd c = matrix_of(dashpots->list, n, [](const auto& d) { return d.c; })(free, free);
    beta = c.trace() / k.trace();
    // in proportion but for the rounding of what was written
    if (!((c - beta * k).norm() <= 1e-14 * c.norm())) return std::nullopt;
  }

  LinearScene linear{scene.start.x, {}};
  for (size_t i = 0; i < free.size(); ++i) linear.rest.col(free[i]) += rest[static_cast<int>(i)] * line->direction;
  if (particles.move) linear.shake = particles.move->amplitude.dot(line->direction);
  const Eigen::VectorXd inverse_root = mass.cwiseSqrt().cwiseInverse();
  const Eigensystem vibrations = symmetric_eigensystem(inverse_root.asDiagonal() * k * inverse_root.asDiagonal());
  for (int i = 0; i < static_cast<int>(free.size()); ++i) {
    Eigen::VectorXd shape = inverse_root.asDiagonal() * vibrations.vectors.col(i);
    const double largest = shape.cwiseAbs().maxCoeff();
    // the dual of the shape: of unit product with it over the masses
    const Eigen::VectorXd dual = largest * mass.asDiagonal() * shape;
    shape /= largest;
    const double w2 = vibrations.values[i];
    Mode mode{w2,
              *drag,
              beta * w2,
              a->dot(line->direction) * dual.sum(),
              dual.sum(),
              -dual.dot(rest),
              dual.dot(line->speed(free).eval()),
              Points::Zero(3, n)};
    for (size_t j = 0; j < free.size(); ++j) mode.shape.col(free[j]) = shape[static_cast<int>(j)] * line->direction;
    linear.modes.push_back(std::move(mode));
  }
  return linear;
}

}  // namespace crosscheck
