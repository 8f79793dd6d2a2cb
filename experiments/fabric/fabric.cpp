// Experiment `fabric`: strips of cloth with the bending term against Euler's elastica and a clamped beam, over the
// grid; and skip-one springs beside it.

#include <cmath>
#include <stdexcept>

#include "experiments/experiment.h"
#include "experiments/fabric/strip.h"
#include "experiments/tables/fabric.h"

namespace crosscheck {
namespace {

constexpr int grids[] = {8, 16, 32, 64};

double drop_at_rest(const StripNet& net, const Points& guess) {
  const auto rest = rest_near(strip_scene(net), guess);
  if (!rest) throw std::runtime_error("a clamped strip found no rest");
  return drop_of(net, *rest);
}

double drop_of_elastica(const StripNet& net) {
  const ClampedStrip strip = continuum_of(net);
  return Elastica(strip).tip().drop / strip.length;
}

void cantilevers(TableSet& tables) {
  Table table = table_of<CantileverRow>();
  const auto add_strips = [&](const std::string& load, double gamma, double tip_load) {
    for (const int cells : grids) {
      const StripNet net{cells, gamma, tip_load};
      const double drop = drop_at_rest(net, along_elastica(net)), truth = drop_of_elastica(net);
      add(table, CantileverRow{load, cells, gamma, tip_load, drop, truth, drop / truth - 1});
    }
  };
  for (const double gamma : {0.1, 1., 5., 20., 50.}) add_strips("its own weight", gamma, 0);
  for (const double tip_load : {1., 5.}) add_strips("a load near the tip", 0.1, tip_load);
  tables.add(table);
}

void vibrations(TableSet& tables) {
  Table table = table_of<StripVibrationRow>();
  for (const int cells : grids) {
    const StripNet net{cells, 5};
    const std::vector<double> found = frequencies_of(net);
    for (int mode = 0; mode < 3; ++mode) {
      const double truth = vibration_of_clamped_strip(continuum_of(net), strip_density, mode),
                   frequency = found[static_cast<size_t>(mode)];
      add(table, StripVibrationRow{cells, mode + 1, frequency, truth, frequency / truth - 1});
    }
  }
  tables.add(table);
}

/// The stiffness of skip-one springs (N/m) with which the strip droops as the elastica does, by the secant rule in
/// logarithms.
double fitted_skip_one(StripNet net) {
  const double wanted = drop_of_elastica(net), d = continuum_of(net).length / net.cells;
  const Points guess = along_elastica(net);
  const auto missed = [&](double log_k) {
    net.skip_one = std::exp(log_k);
    return std::log(drop_at_rest(net, guess) / wanted);
  };
  // two links at an angle phi stretch a skip-one spring by d phi^2 / 4: the energy of the bending term at the curvature
  // of half the clamp's
  const double curvature = net.gamma / 4 / continuum_of(net).length;
  double a = std::log(8 * continuum_of(net).rigidity / (curvature * curvature * std::pow(d, 4))), b = a + 0.5;
  double at_a = missed(a), at_b = missed(b);
  for (int i = 0; i < 20 && std::abs(at_b) > 1e-9; ++i) {
    const double next = b - at_b * (b - a) / (at_b - at_a);
    a = b, at_a = at_b, b = next, at_b = missed(b);
  }
  return std::exp(b);
}

void skip_one(TableSet& tables) {
  Table table = table_of<SkipOneRow>();
  constexpr double gamma = 5;
  constexpr int fitted_at = 16;
  const double k = fitted_skip_one({fitted_at, gamma});
  for (const int cells : grids)
    for (const bool is_skip_one : {false, true}) {
      StripNet net{cells, gamma};
      const Points guess = along_elastica(net);
      const double truth = drop_of_elastica(net);
      if (is_skip_one) net.skip_one = k;
      add(table, SkipOneRow{is_skip_one ? "skip-one springs" : "bending term", cells, is_skip_one ? k : 0,
                            drop_at_rest(net, guess), truth});
    }
  tables.add(table);
}

}  // namespace

std::vector<Point> fabric_points(const Request& request) {
  if (request.scenes_only) return {};
  return {{"fabric: cantilevers", "drops", cantilevers},
          {"fabric: vibrations", "frequencies", vibrations},
          {"fabric: skip-one springs", "drops", skip_one}};
}

}  // namespace crosscheck
