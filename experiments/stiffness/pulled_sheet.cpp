#include "experiments/stiffness/pulled_sheet.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <cmath>

#include "experiments/tables/stiffness.h"
#include "mysim/model/moduli.h"
#include "mysim/scene/scene.h"

namespace crosscheck {
namespace {

Scene net_scene(const NetSprings& net, int n) {
  const double side = (n - 1) * net.spacing;
  const std::string third = net.dimension == 3 ? fmt::format("w = [0, 0, {}]\n", side) : "";
  const std::string bend = net.bend > 0 ? fmt::format("bend = {}\n", net.bend) : "";
  return parse_scene(
      fmt::format("question = \"q\"\nparameters = \"p\"\n[time]\nduration = 1\nsamples = 1\nstep = 1e-3\nwindow = 1\n"
                  "tolerance = 1e-3\nmethod = \"leapfrog\"\n[grid]\nsize = [{0}, {0}{1}]\norigin = [0, 0, 0]\n"
                  "u = [{2}, 0, 0]\nv = [0, {2}, 0]\n{3}mass = 1\n[grid.stiffness]\nstructural = {4}\nshear = {5}\n{6}",
                  n, net.dimension == 3 ? fmt::format(", {}", n) : "", side, third, net.structural, net.shear, bend),
      "net");
}

double energy_of(const Scene& scene, const Eigen::Matrix3d& strain) {
  State state = scene.start;
  state.x += strain * scene.start.x;
  return potential_energy(*scene.model.find<Springs>(), scene.model.particles, state);
}

}  // namespace

StrainedNets::StrainedNets(const NetSprings& net)
    : cell_(std::pow(net.spacing, net.dimension)), dimension_(net.dimension) {
  constexpr int least = 4;  // particles a side: the smallest net with a skip-one spring and a spring next to it
  for (int n = least; n <= least + net.dimension; ++n) scenes_.push_back(net_scene(net, n));
}

double StrainedNets::energy_density(const Eigen::Matrix3d& strain) const {
  const auto at = [&](size_t i) { return energy_of(scenes_[i], strain); };
  // the second or third difference, divided by 2! or 3!, is the leading coefficient of a polynomial of that degree
  return dimension_ == 2 ? (at(0) - 2 * at(1) + at(2)) / 2 / cell_
                         : (-at(0) + 3 * at(1) - 3 * at(2) + at(3)) / 6 / cell_;
}

Eigen::Matrix3d StrainedNets::stiffness(double angle) const {
  constexpr double small = 1e-4;
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix3d turn;
  turn << c, -s, 0, s, c, 0, 0, 0, 1;
  const auto energy = [&](const Eigen::Vector3d& e) {
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    strain(0, 0) = e[0], strain(1, 1) = e[1], strain(0, 1) = strain(1, 0) = e[2] / 2;
    return energy_density(turn * strain * turn.transpose());
  };
  Eigen::Matrix3d c_ij;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d a = small * Eigen::Vector3d::Unit(i), b = small * Eigen::Vector3d::Unit(j);
      c_ij(i, j) = (energy(a + b) - energy(a - b) - energy(b - a) + energy(-a - b)) / (4 * small * small);
    }
  return c_ij;
}

double StrainedNets::young(double angle) const { return 1 / stiffness(angle).inverse()(0, 0); }

std::vector<Point> pulled_sheet_points() {
  return {{"stiffness: sheets pulled at angles", "strains of 1e-4", [](TableSet& tables) {
             Table table = table_of<PulledSheetRow>();
             const std::pair<const char*, NetSprings> nets[] = {
                 {"no skip-one springs", {200, 200, 0, 0.05}},
                 {"with skip-one springs as stiff", {200, 200, 200, 0.05}},
                 {"shear springs for isotropy", {200, 500, 200, 0.05}}};
             for (const auto& [name, net] : nets) {
               const StrainedNets strained(net);
               const Moduli moduli = *moduli_of(strained.largest().model, strained.largest().start).moduli;
               for (int degrees = 0; degrees <= 45; degrees += 5) {
                 const double angle = degrees * M_PI / 180, predicted = moduli.young_at(angle),
                              measured = strained.young(angle);
                 add(table, PulledSheetRow{name, net.structural, net.shear, net.bend, static_cast<double>(degrees),
                                           predicted, measured, measured / predicted - 1});
               }
             }
             tables.add(table);
           }}};
}

}  // namespace crosscheck
