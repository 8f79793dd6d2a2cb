#include "reference/truth/multipliers.h"

#include "mysim/base/errors.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

MultiplierWorld::MultiplierWorld(const Scene& scene, double h)
    : scene_(scene),
      constraints_(*scene.model.find<Constraints>()),
      h_(h),
      s_(scene.start),
      stage_(scene.start),
      k_{scene.start, scene.start, scene.start, scene.start},
      inverse_mass_(3 * scene.model.particles.size()) {
  const Particles& particles = scene.model.particles;
  forces_.f = Points::Zero(3, particles.size());
  for (int i = 0; i < particles.size(); ++i)
    inverse_mass_.segment<3>(3 * i).setConstant(particles.pinned[i] ? 0 : 1 / particles.mass[i]);
}

void MultiplierWorld::derivative(const State& stage, State& rate) {
  const Particles& particles = scene_.model.particles;
  forces_.clear();
  for (const Term& term : scene_.model.terms)
    std::visit(
        [&]<class T>(const T& t) {
          if constexpr (HasForce<T>) add_force(t, particles, stage, forces_);
        },
        term);

  const int n = static_cast<int>(constraints_.list.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd relative_speed_squared(n);  // |d'|^2
  for (int row = 0; row < n; ++row) {
    const auto& [a, b, length] = constraints_.list[row];
    const Vec3 d = stage.x.col(a) - stage.x.col(b);
    relative_speed_squared[row] = (stage.v.col(a) - stage.v.col(b)).squaredNorm();
    for (int axis = 0; axis < 3; ++axis) {
      entries.emplace_back(row, 3 * a + axis, d[axis]);
      entries.emplace_back(row, 3 * b + axis, -d[axis]);
    }
  }
  Eigen::SparseMatrix<double> jacobian(n, 3 * particles.size());
  jacobian.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd free_acceleration = inverse_mass_.cwiseProduct(forces_.f.reshaped());
  const Eigen::SparseMatrix<double> matrix = jacobian * inverse_mass_.asDiagonal() * jacobian.transpose();
  if (factor_.rows() == 0) factor_.analyzePattern(matrix);  // the sparsity pattern never changes
  factor_.factorize(matrix);
  // a dependent distance leaves a pivot at round-off: 1e-12 of the largest
  const auto pivots = factor_.vectorD();
  if (factor_.info() != Eigen::Success || !(pivots.minCoeff() > 1e-12 * pivots.maxCoeff()))
    throw Unsupported("its hard distances depend on each other: their forces are not unique");
  const Eigen::VectorXd lambda = factor_.solve(-(jacobian * free_acceleration) - relative_speed_squared);
  rate.v.reshaped() = free_acceleration + inverse_mass_.cwiseProduct(jacobian.transpose() * lambda);
  rate.x = stage.v;
}

void MultiplierWorld::step(double t, double t_next) {
  s_.t = t;
  rk4_step([&](const State& stage, State& rate) { derivative(stage, rate); }, s_, h_, {&k_[0], &k_[1], &k_[2], &k_[3]},
           stage_);
  s_.t = t_next;
}

}  // namespace crosscheck
