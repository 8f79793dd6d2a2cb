// Small motion about an equilibrium: the vibrations of the stiffness there.

#include "mysim/frequency.h"
#include "reference/exact/eigenvalues.h"
#include "reference/exact/oscillator.h"
#include "reference/exact/recognise.h"

namespace crosscheck {

std::optional<LinearisedSolution> linearised_solution(const Scene& scene, const Points& equilibrium) {
  const Model& model = scene.model;
  const Particles& particles = model.particles;
  const auto* springs = model.find<Springs>();
  const auto a = steady_acceleration(model);
  const auto drag = uniform_drag_rate(model);
  if (!springs || springs->law != SpringLaw::hooke || !a || !drag || particles.move ||
      !only<Springs, Gravity, Wind, Drag>(model))
    return std::nullopt;

  // each spring is stiff by k along itself, and by tension over length across
  const int n = particles.size();
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  Points force = *a * particles.mass.transpose();
  double stiffness = 0;
  for (const Spring& s : springs->list) {
    const Vec3 d = equilibrium.col(s.a) - equilibrium.col(s.b);
    const double length = d.norm(), tension = s.k * (length - s.rest);
    if (!(length > 0)) return std::nullopt;
    const Vec3 along = d / length;
    const Eigen::Matrix3d block =
        tension / length * Eigen::Matrix3d::Identity() + (s.k - tension / length) * along * along.transpose();
    for (const int p : {s.a, s.b})
      for (const int q : {s.a, s.b}) k.block<3, 3>(3 * p, 3 * q) += p == q ? block : -block;
    force.col(s.a) -= tension * along;
    force.col(s.b) += tension * along;
    stiffness = std::max(stiffness, s.k);
  }
  for (int pin : particles.pins) force.col(pin).setZero();
  // an equilibrium, but for the rounding of what was written
  if (!(largest_column(force) <= 1e-10 * stiffness * scene.size())) return std::nullopt;

  std::vector<int> free;  // coordinates
  for (int i = 0; i < n; ++i)
    if (!particles.pinned[i]) free.insert(free.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  Eigen::VectorXd mass(3 * n);
  for (int i = 0; i < n; ++i) mass.segment<3>(3 * i).setConstant(particles.mass[i]);
  const Eigen::VectorXd root = mass(free).cwiseSqrt();
  const Eigensystem vibrations =
      symmetric_eigensystem(root.cwiseInverse().asDiagonal() * k(free, free) * root.cwiseInverse().asDiagonal());
  const Eigen::VectorXd& w2 = vibrations.values;
  if (!(w2.minCoeff() > 1e-12 * w2.maxCoeff())) return std::nullopt;  // slack or buckling
  const Points off = scene.start.x - equilibrium;
  const Eigen::MatrixXd to_modes = vibrations.vectors.transpose() * root.asDiagonal(),
                        shapes = root.cwiseInverse().asDiagonal() * vibrations.vectors;
  const Eigen::VectorXd u0 = to_modes * off.reshaped()(free), v0 = to_modes * scene.start.v.reshaped()(free);

  LinearisedSolution solution;
  std::vector<Oscillator> modes;
  for (int i = 0; i < w2.size(); ++i) {
    solution.omega.push_back(std::sqrt(w2[i]));
    modes.push_back({w2[i], *drag, u0[i], v0[i]});
  }
  solution.at = [equilibrium, free, shapes, modes](double t) {
    Eigen::VectorXd u(modes.size()), v(modes.size());
    for (size_t i = 0; i < modes.size(); ++i)
      u[static_cast<int>(i)] = modes[i].position(t), v[static_cast<int>(i)] = modes[i].velocity(t);
    State s{t, equilibrium, Points::Zero(3, equilibrium.cols())};
    s.x.reshaped()(free) += shapes * u;
    s.v.reshaped()(free) += shapes * v;
    return s;
  };
  return solution;
}

}  // namespace crosscheck
