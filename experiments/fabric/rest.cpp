#include "experiments/fabric/rest.h"

#include <Eigen/SparseCholesky>

#include <cmath>

#include "experiments/stability/spectrum.h"
#include "mysim/model/energy.h"
#include "mysim/model/system.h"

namespace crosscheck {

std::optional<Points> rest_near(const Scene& scene, const Points& guess) {
  const Model& model = scene.model;
  const auto* field = model.find<Gravity>();
  const double gravity = field ? field->acceleration.norm() : 0;
  System f(model);
  State s = scene.start;
  s.x = guess;
  Points a(3, s.x.cols()), tried(3, s.x.cols());
  const auto energy = [&](const State& state) {
    const Energy e = energy_of(model, state);
    return e.elastic + e.gravitational;
  };
  f.acceleration(s, a);
  double lowest = energy(s), shift = 0;
  Linearised l = linearised(model, s);
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  solver.analyzePattern(l.k);  // the pattern is the same in every state
  constexpr int most = 5000;
  for (int i = 0; i < most; ++i) {
    const double stiffest = l.k.diagonal().maxCoeff();
    solver.setShift(shift);
    solver.factorize(l.k);
    if (solver.info() == Eigen::Success && (solver.vectorD().array() > 0).all()) {
      State next = s;
      next.x += l.offsets(solver.solve(l.weighted(a)), static_cast<int>(s.x.cols()));
      f.acceleration(next, tried);
      const double reached = energy(next);
      const bool is_nearer = largest_column(tried) < 0.5 * largest_column(a);
      if (is_nearer || reached < lowest - 1e-13 * std::abs(lowest)) {
        s = std::move(next), a = tried, lowest = reached;
        shift = shift > 1e-9 * stiffest ? shift / 10 : 0;
        l = linearised(model, s);
        continue;
      }
      // no step halves the forces, or lowers the energy by more than its rounding error: the remaining forces come from
      // the rounding of stiff springs
      if (largest_column(a) <= 1e-4 * gravity) {
        if (shift <= 1e-9 * stiffest) return s.x;  // already positive definite with a smaller shift
        solver.setShift(1e-9 * stiffest);
        solver.factorize(l.k);
        if ((solver.vectorD().array() > 0).all()) return s.x;
        return std::nullopt;
      }
    }
    if (shift > stiffest) break;
    shift = std::max(5 * shift, 1e-9 * stiffest);
  }
  return std::nullopt;
}

}  // namespace crosscheck
