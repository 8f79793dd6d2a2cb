// Experiment `fabric`: strips of cloth with the bending term or skip-one springs compared with Euler's elastica, a
// clamped beam and the catenary; and Cusick's drape test.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "experiments/experiment.h"
#include "experiments/fabric/disc.h"
#include "experiments/fabric/rest.h"
#include "experiments/fabric/strip.h"
#include "experiments/tables/fabric.h"
#include "mysim/model/energy.h"

namespace crosscheck {
namespace {

constexpr int grids[] = {8, 16, 32, 64};

double drop_at_rest(const StripNet& net, const Points& guess) {
  const auto rest = rest_near(strip_scene(net), guess);
  if (!rest) throw std::runtime_error("no state of rest was found for a clamped strip");
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

/// Stiffness of skip-one springs (N/m) for which the strip droops like the elastica, found by the secant method in
/// logarithms.
double fitted_skip_one(StripNet net) {
  const double wanted = drop_of_elastica(net), d = continuum_of(net).length / net.cells;
  const Points guess = along_elastica(net);
  const auto missed = [&](double log_k) {
    net.skip_one = std::exp(log_k);
    return std::log(drop_at_rest(net, guess) / wanted);
  };
  // two links at an angle phi stretch a skip-one spring by d phi^2 / 4. In the initial guess, the spring has the energy
  // that the bending term has at half of the curvature at the clamp
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

void hanging(TableSet& tables) {
  Table table = table_of<HangingStripRow>(), shapes = table_of<HangingShapeRow>();
  for (const double gamma : {0., 60.})
    for (const int cells : grids) {
      const HangingNet net{cells, gamma};
      const HangingStrip strip = continuum_of(net);
      const Scene scene = strip_scene(net);
      const auto rest = rest_near(scene, scene.start.x);
      if (!rest) throw std::runtime_error("no state of rest was found for a hanging strip");
      const double sag = sag_of(net, *rest), truth = strip.sag() / strip_length;
      add(table, HangingStripRow{cells, gamma, sag, truth, sag / truth - 1});
      constexpr int drawn = 16, fine = 4;  // cells of the net in the figure; points of the curve per cell
      if (cells == drawn)
        for (int i = 0; i <= drawn * fine; ++i) {
          const HangingStrip::Place place = strip.at(strip_length * (static_cast<double>(i) / (drawn * fine) - 0.5));
          HangingShapeRow row{gamma, place.x, place.height - strip.sag()};
          if (i % fine == 0) row.net_x = (*rest)(0, i / fine), row.net_height = (*rest)(1, i / fine);
          add(shapes, row);
        }
    }
  tables.add(table);
  tables.add(shapes);
}

/// Rigidity for which the draped cloth has a bending length (B / w)^(1/3) of 2.4 cm.
constexpr double draped_rigidity = 2e-5;  // N m

struct Drape {
  DrapedDisc disc;
  std::string start;
  Points rest;
  double energy;
};

std::optional<Drape> drape_from(const DrapedDisc& disc, const std::string& start, const Points& guess) {
  const Scene scene = disc_scene(disc);
  const auto rest = rest_near(scene, guess);
  if (!rest) return std::nullopt;
  const Energy energy = energy_of(scene.model, State{0, *rest, scene.start.v});
  return Drape{disc, start, *rest, energy.elastic + energy.gravitational};
}

void add_drape(Table& table, const Drape& drape) {
  add(table, DrapedDiscRow{drape.start, drape.disc.rings, drape.disc.rigidity, drape.disc.shear,
                           nodes_of(drape.disc, drape.rest), drape_coefficient(drape.disc, drape.rest), drape.energy});
}

/// Searches for a state of rest from several starts on a coarse net, and follows the lowest one to finer nets.
void drapes(TableSet& tables, int finest, int most_waves, unsigned random_starts) {
  Table table = table_of<DrapedDiscRow>(), shape = table_of<DrapedParticleRow>();
  std::vector<Drape> found;
  const DrapedDisc coarse{8, draped_rigidity};
  const auto search = [&](const DrapedDisc& disc, const std::string& start, const Points& guess) {
    auto drape = drape_from(disc, start, guess);
    if (drape)
      add_drape(table, *drape);
    else
      tables.notes.push_back(fmt::format("fabric: no state of rest was found from {} on {} rings", start, disc.rings));
    return drape;
  };
  const auto search_from = [&](int waves, unsigned seed, const std::string& start) {
    if (auto drape = search(coarse, start, wavy(coarse, waves, seed))) found.push_back(std::move(*drape));
  };
  for (int waves = 4; waves <= most_waves; ++waves) search_from(waves, 1, fmt::format("{} waves", waves));
  for (unsigned seed = 1; seed <= random_starts; ++seed) search_from(0, seed, fmt::format("random {}", seed));
  if (found.empty()) throw std::runtime_error("no state of rest was found for a draped disc");
  Drape lowest = *std::ranges::min_element(found, {}, &Drape::energy);
  DrapedDisc sheared = coarse;
  sheared.shear *= 4;
  search(sheared, lowest.start, lowest.rest);
  while (2 * lowest.disc.rings <= finest) {
    DrapedDisc finer = lowest.disc;
    finer.rings *= 2;
    auto drape = search(finer, lowest.start, on_net(lowest.disc, lowest.rest, finer));
    if (!drape) break;
    lowest = std::move(*drape);
    if (finer.rings == 16)
      for (int i = 0; i <= finer.rings + 1; ++i)
        for (int j = 0; j < finer.spokes(); ++j) {
          const Vec3 at = lowest.rest.col(finer.particle(i, j));
          add(shape, DrapedParticleRow{i, j, at.x(), at.y(), at.z()});
        }
  }
  tables.add(table);
  tables.add(shape);
}

}  // namespace

std::vector<Point> fabric_points(const Request& request) {
  if (request.scenes_only) return {};
  const bool full = request.full;
  return {{"fabric: cantilevers", "drops", cantilevers},
          {"fabric: vibrations", "frequencies", vibrations},
          {"fabric: skip-one springs", "drops", skip_one},
          {"fabric: hanging strips", "sags", hanging},
          {"fabric: drapes", full ? "up to 64 rings" : "up to 16 rings",
           [full](TableSet& tables) { full ? drapes(tables, 64, 9, 10) : drapes(tables, 16, 7, 0); }, false, true}};
}

}  // namespace crosscheck
