#include "experiments/fabric/strip.h"

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <cmath>
#include <numbers>

#include "experiments/stability/spectrum.h"
#include "mysim/model/energy.h"
#include "mysim/model/system.h"

namespace crosscheck {
namespace {

constexpr double strip_length = 0.2, gravity = 9.81;

double cell_of(const StripNet& net) { return strip_length / net.cells; }

}  // namespace

ClampedStrip continuum_of(const StripNet& net) {
  const double weight = strip_density * gravity,
               rigidity = weight * strip_length * strip_length * strip_length / net.gamma;
  return {rigidity, strip_length, weight, net.tip_load * rigidity / (strip_length * strip_length),
          strip_length - cell_of(net) / 2};
}

Scene strip_scene(const StripNet& net) {
  const ClampedStrip strip = continuum_of(net);
  const double d = cell_of(net);
  const int n = net.cells + 1;  // particles in a row
  // two rows of k each on a width of d
  const double k = (strip.weight * strip.length + strip.load) * 1e6 / 2;
  Scene scene = parse_scene(
      fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = 1e-4\nwindow = 1\n"
                  "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [{}, 2]\norigin = [{}, 0, 0]\n"
                  "u = [{}, 0, 0]\nv = [0, 0, {}]\nmass = {}\n{}[grid.stiffness]\nstructural = {}\nshear = {}\n{}"
                  "[pins]\nparticles = [0, 1, {}, {}]\n[gravity]\nacceleration = [0, {}, 0]\n",
                  n, -d / 2, strip.length, d, strip_density * d * d * n,
                  net.skip_one ? "" : fmt::format("bending = {}\n", strip.rigidity), k, k,
                  net.skip_one ? fmt::format("bend = {}\n", *net.skip_one) : "", n, n + 1, -gravity),
      "strip");
  for (const int last : {n - 1, 2 * n - 1}) scene.model.particles.mass[last] += strip.load * d / gravity / 2;
  scene.hash = hash_of(scene);
  return scene;
}

double drop_of(const StripNet& net, const Points& x) {
  const double last = x(1, net.cells), before = x(1, net.cells - 1);
  return -(last + (last - before) / 2) / strip_length;
}

Points along_elastica(const StripNet& net) {
  const Elastica elastica(continuum_of(net));
  const double d = cell_of(net);
  const int n = net.cells + 1;
  Points x = strip_scene(net).start.x;
  for (int row = 0; row < 2; ++row)
    for (int i = 2; i < n; ++i) {
      // the level half way between both particles
      const double angle = elastica.at((i - 1) * d).angle;
      x.col(row * n + i).head<2>() =
          x.col(row * n + i - 1).head<2>() + d * Vec3(std::cos(angle), -std::sin(angle), 0).head<2>();
    }
  return x;
}

std::optional<Points> rest_near(const Scene& scene, const Points& guess) {
  const Model& model = scene.model;
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
  constexpr int most = 5000;
  for (int i = 0; i < most; ++i) {
    const Linearised l = linearised(model, s);
    const double stiffest = l.k.diagonal().maxCoeff();
    Eigen::SparseMatrix<double> k = l.k;
    for (int j = 0; j < l.size(); ++j) k.coeffRef(j, j) += shift;
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(k);
    if (solver.info() == Eigen::Success && (solver.vectorD().array() > 0).all()) {
      State next = s;
      next.x += l.offsets(solver.solve(l.weighted(a)), static_cast<int>(s.x.cols()));
      f.acceleration(next, tried);
      const double reached = energy(next);
      const bool is_nearer = largest_column(tried) < 0.5 * largest_column(a);
      if (is_nearer || reached < lowest - 1e-13 * std::abs(lowest)) {
        s = std::move(next), a = tried, lowest = reached;
        shift = shift > 1e-12 * stiffest ? shift / 5 : 0;
        continue;
      }
      // nothing to gain, in forces by half or in energy above its rounding: what is left is that of stiff springs
      if (largest_column(a) <= 1e-4 * gravity) return s.x;
    }
    if (shift > stiffest) break;
    shift = std::max(4 * shift, 1e-12 * stiffest);
  }
  return std::nullopt;
}

std::vector<double> frequencies_of(const StripNet& net) {
  const Scene scene = strip_scene(net);
  const Linearised l = linearised(scene.model, scene.start);
  // across the strip both rows move alike: the sum of their unit offsets over sqrt(2) spans those motions
  const int n = net.cells - 1;  // free particles in a row, all of the same mass
  Eigen::MatrixXd pairs = Eigen::MatrixXd::Zero(l.size(), n);
  for (int i = 0; i < l.size(); ++i) {
    const int particle = l.free[static_cast<size_t>(i)] / 3, axis = l.free[static_cast<size_t>(i)] % 3;
    if (axis == 1) pairs(i, particle % (net.cells + 1) - 2) = std::numbers::sqrt2 / 2;
  }
  const Eigen::MatrixXd k = pairs.transpose() * (l.k * pairs);
  const Eigen::VectorXd squares = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
  std::vector<double> all;
  for (const double square : squares) all.push_back(std::sqrt(std::max(0., square)) / (2 * std::numbers::pi));
  return all;
}

}  // namespace crosscheck
