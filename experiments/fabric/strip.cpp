#include "experiments/fabric/strip.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <numbers>

#include "experiments/stability/spectrum.h"

namespace crosscheck {
namespace {

constexpr double gravity = 9.81, hanging_span = 0.7 * strip_length;

double cell_of(const StripNet& net) { return strip_length / net.cells; }

/// `load`: N/m. A rigidity of 0 leaves out the bending term, and a skip-one stiffness of 0 the skip-one springs.
Scene two_rows(int cells, double from, double load, const std::array<int, 4>& pins, double rigidity, double skip_one) {
  const double d = strip_length / cells, k = load * 1e6 / 2;  // two rows, each with stiffness k, on a width of d
  return parse_scene(
      fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = 1e-4\nwindow = 1\n"
                  "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [{}, 2]\norigin = [{}, 0, 0]\n"
                  "u = [{}, 0, 0]\nv = [0, 0, {}]\nmass = {}\n{}[grid.stiffness]\nstructural = {}\nshear = {}\n{}"
                  "[pins]\nparticles = [{}]\n[gravity]\nacceleration = [0, {}, 0]\n",
                  cells + 1, from, strip_length, d, strip_density * d * d * (cells + 1),
                  rigidity > 0 ? fmt::format("bending = {}\n", rigidity) : "", k, k,
                  skip_one > 0 ? fmt::format("bend = {}\n", skip_one) : "", fmt::join(pins, ", "), -gravity),
      "strip");
}

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
  const int n = net.cells + 1;
  Scene scene = two_rows(net.cells, -d / 2, strip.weight * strip.length + strip.load, {0, 1, n, n + 1},
                         net.skip_one ? 0 : strip.rigidity, net.skip_one.value_or(0));
  for (const int last : {n - 1, 2 * n - 1}) scene.model.particles.mass[last] += strip.load * d / gravity / 2;
  scene.hash = hash_of(scene);
  return scene;
}

HangingStrip continuum_of(const HangingNet& net) {
  const double weight = strip_density * gravity;
  return {strip_length, hanging_span, weight, net.gamma > 0 ? weight * std::pow(strip_length, 3) / net.gamma : 0};
}

Scene strip_scene(const HangingNet& net) {
  const double weight = strip_density * gravity, d = strip_length / net.cells;
  const int n = net.cells + 1;
  Scene scene = two_rows(net.cells, -strip_length / 2, weight * strip_length, {0, n - 1, n, 2 * n - 1},
                         net.gamma > 0 ? weight * std::pow(strip_length, 3) / net.gamma : 0, 0);
  const HangingStrip strip = continuum_of(net);
  for (int i = 0; i < 2 * n; ++i) {
    const HangingStrip::Place place = strip.at((i % n) * d - strip_length / 2);
    scene.start.x.col(i).head<2>() << place.x, place.height - strip.sag();
  }
  for (int pin = 0; pin < 4; ++pin)
    scene.model.particles.pin_home.col(pin) = scene.start.x.col(scene.model.particles.pins[pin]);
  scene.hash = hash_of(scene);
  return scene;
}

double sag_of(const HangingNet& net, const Points& x) { return -x(1, net.cells / 2) / strip_length; }

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
      // slope of the elastica halfway between particles i - 1 and i
      const double angle = elastica.at((i - 1) * d).angle;
      x.col(row * n + i).head<2>() =
          x.col(row * n + i - 1).head<2>() + d * Vec3(std::cos(angle), -std::sin(angle), 0).head<2>();
    }
  return x;
}

std::vector<double> frequencies_of(const StripNet& net) {
  const Scene scene = strip_scene(net);
  const Linearised l = linearised(scene.model, scene.start);
  // both rows move alike: the sums of the unit offsets of two opposite particles, divided by sqrt(2), span these
  // motions
  const int n = net.cells - 1;  // number of free particles in a row, which have the same mass
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
