// The table of known disagreements.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "experiments/disagreements/disagreements.h"
#include "experiments/metrics.h"
#include "experiments/tables/disagreements.h"
#include "mysim/model/energy.h"

namespace crosscheck {
namespace {

double moved(const Scene& scene, const State& s) { return (s.x.col(0) - scene.start.x.col(0)).norm(); }
double sag(const Scene& scene, const State& s) {
  return 1e3 * (scene.start.x.row(1).minCoeff() - s.x.row(1).minCoeff());
}
double length(const Scene&, const State& s) { return (s.x.col(1) - s.x.col(0)).norm(); }
double along_wind(const Scene&, const State& s) { return s.v.row(2).mean(); }
double gap(const Scene& scene, const State& s) { return 1e3 * *clearance(scene, s.t, s.x); }
/// By how much the particle moves steeper than the tangent of the ball where it is, mrad; 0 in its first half
/// millimetre, since it falls freely to where a field of 20 mm puts the surface, up to 0.1 mm below.
double steeper(const Scene& scene, const State& s) {
  const Vec3 v = s.v.col(0), from = s.x.col(0) - scene.model.find<Spheres>()->list[0].centre;
  return moved(scene, s) < 5e-4 ? 0 : 1e3 * (std::atan2(-v.y(), v.x()) - std::atan2(from.x(), from.y()));
}
double energy(const Scene& scene, const State& s) { return energy_of(scene.model, s).total(); }

/// Time between the first and the last upward passage through the middle, over the swings between, s.
double period(const Series& s) {
  double low = 1e300, high = -1e300, first = 0, last = 0;
  int passages = 0;
  for (const auto& [t, y] : s.points) low = std::min(low, y), high = std::max(high, y);
  const double middle = (low + high) / 2;
  for (size_t i = 1; i < s.points.size(); ++i) {
    const auto& [t0, y0] = s.points[i - 1];
    const auto& [t1, y1] = s.points[i];
    if (!(y0 < middle && y1 >= middle)) continue;
    last = t0 + (middle - y0) / (y1 - y0) * (t1 - t0);
    if (passages++ == 0) first = last;
  }
  return passages > 1 ? (last - first) / (passages - 1) : NAN;
}

double largest(const Series& s) {
  double most = -1e300;
  for (const auto& point : s.points) most = std::max(most, point.second);
  return most;
}

std::string friction_effect(const std::vector<Series>& all) {
  const double coulomb = all[0].last(), explicit_world = all[1].last(), pbd = all[2].last();
  return fmt::format(
      "In {:.2g} s the particle slides {:.4f} m by Coulomb's law and {:.4f} m in the deformable world, but creeps only "
      "{:.4f} m in the position-based world.",
      all[0].points.back().first, coulomb, explicit_world, pbd);
}

std::string stiffness_effect(const std::vector<Series>& all) {
  std::string text = fmt::format("Asked: a sag of {:.2f} mm.", all[0].last());
  for (size_t i = 1; i < all.size(); ++i)
    text += fmt::format("{} {:.2f} mm with {}", i == 1 ? " Found:" : ",", all[i].last(), all[i].variant.label);
  return text + ".";
}

std::string law_effect(const std::vector<Series>& all) {
  return fmt::format(
      "The period is {:.3f} s by Hooke's law and {:.3f} s in the position-based world; by the law k L (L² - r²) / "
      "(L² + r²) in mysim it is {:.3f} s.",
      period(all[0]), period(all[1]), period(all[2]));
}

std::string freeze_effect(const std::vector<Series>& all) {
  return fmt::format("With projection the mass swings to {:.2f} m; without it the run is {} at {:.4f} m.",
                     largest(all[1]), name_of(all[2].outcome.verdict), all[2].last());
}

std::string hessian_effect(const std::vector<Series>& all) {
  const Series& shipped = all[2];
  return fmt::format(
      "From {:.0f} J at the start Bullet's own force makes {:.2g} J and is stopped at {:.2g} s ({}); with the negative "
      "part of the second derivatives left out {}.",
      shipped.points[0].second, shipped.last(), shipped.outcome.end, in_words(shipped.outcome.verdict),
      all[1].last() < 1e-12 * shipped.points[0].second ? "the motion dies out"
                                                       : fmt::format("the energy ends at {:.2g} J", all[1].last()));
}

std::string rest_effect(const std::vector<Series>& all) {
  // between the turning points: a mean over time would depend on how many periods the run has
  auto middle = [](const Series& s) {
    const auto [low, high] =
        std::ranges::minmax(s.points | std::views::transform([](const auto& point) { return point.second; }));
    return (low + high) / 2;
  };
  return fmt::format(
      "Asked: swings about {:.3f} m. Left to itself Bullet swings about {:.3f} m (explicit) and {:.3f} m "
      "(position-based); the certificate stops such a comparison.",
      middle(all[0]), middle(all[1]), middle(all[2]));
}

std::string wind_effect(const std::vector<Series>& all) {
  // when each has half the speed that the scene prescribes at the end
  const double half = all[0].last() / 2;
  auto reached = [&](const Series& s) {
    for (const auto& [t, v] : s.points)
      if (v >= half) return fmt::format("after {:.2g} s", t);
    return fmt::format("not in {:.2g} s", s.points.back().first);
  };
  return fmt::format(
      "Half the final speed, {:.2f} m/s, is reached {}; by Bullet's own wind {}, when rounding has grown into a "
      "motion; "
      "by forces added to Bullet's nodes {}.",
      half, reached(all[0]), reached(all[1]), reached(all[2]));
}

std::string clamp_effect(const std::vector<Series>& all) {
  const auto& [t, way] = all[1].points.back();
  return fmt::format("Thrown at 80 m/s it flies {:.1f} m in {:.2g} s; in Bullet with the default margin {:.1f} m.",
                     all[0].last(), t, way);
}

std::string field_effect(const std::vector<Series>& all) {
  auto place = [](double mm) { return fmt::format("{:.3g} mm {}", std::abs(mm), mm < 0 ? "inside" : "outside"); };
  return fmt::format("The particle lies {} the surface with the default voxel of 0.25 m and {} with 0.02 m.",
                     place(all[1].last()), place(all[2].last()));
}

std::string direction_effect(const std::vector<Series>& all) {
  auto most = [](const Series& s) {
    double mrad = 0;
    for (const auto& point : s.points) mrad = std::max(mrad, std::abs(point.second));
    return mrad;
  };
  return fmt::format(
      "Sliding down from rest the particle moves up to {:.2g} mrad off the tangent, with a quarter of the step up to "
      "{:.2g} mrad; with voxels of 20 mm {:.2g} mrad, with 1.25 mm {:.2g} mrad; in mysim {:.1g} mrad.",
      most(all[1]), most(all[2]), most(all[3]), most(all[4]), most(all[0]));
}

/// Over the angle, as the step goes to 0.
TableWithSentence directions(const Disagreement& d) {
  constexpr double first = 2, last = 45;  // degrees
  std::vector<double> angles;
  for (double degrees = first; degrees <= last; degrees += 0.5) angles.push_back(degrees * std::numbers::pi / 180);
  const Scene scene = scene_of(d);
  Table table = table_of<ContactAngleRow>(d.name + "-angles");
  double steeper_by = 0, flatter_by = 0, sideways = 0;  // mrad
  const std::string bullet = d.variants[1].method;
  for (const std::string& method : {d.variants[0].method, bullet, d.variants[3].method, d.variants[4].method})
    for (const DirectionError& e : direction_errors(method, scene, angles)) {
      add(table, ContactAngleRow{method, e.angle, e.in_plane, e.sideways, scene.hash});
      if (method != bullet) continue;
      steeper_by = std::max(steeper_by, 1e3 * e.in_plane), flatter_by = std::min(flatter_by, 1e3 * e.in_plane);
      sideways = std::max(sideways, 1e3 * std::abs(e.sideways));
    }
  return {table,
          fmt::format("Let go at {:g} to {:g} degrees it is pushed off the normal by {:.2g} to {:.2g} mrad in the "
                      "plane of gravity and by up to {:.2g} mrad sideways, extrapolated to a step of zero.",
                      first, last, flatter_by, steeper_by, sideways)};
}

std::string hop_effect(const std::vector<Series>& all) {
  auto most = [](const Series& s) {
    double mm = 0;
    for (const auto& point : s.points) mm = std::max(mm, std::abs(point.second));
    return mm;
  };
  return fmt::format("While it slides the particle leaves the surface by up to {:.2g} mm, in mysim by {:.2g} mm.",
                     most(all[1]), most(all[0]));
}

std::string precision_effect(const std::vector<Series>& all) {
  // numbers of 24 bits are rounded by 6e-8 of their size; some ten roundings a step, that add up like a random walk
  constexpr double length = 2;  // m, of the positions in the scene
  const double expected = 10 * 6e-8 * length * std::sqrt(static_cast<double>(all[2].outcome.steps));
  return fmt::format(
      "From mysim, in double precision, Bullet parts by {:.1g} m in double and by {:.1g} m in single precision; the "
      "rounding of 24 bits lets one expect up to {:.1g} m.",
      largest(all[1]), largest(all[2]), expected);
}

}  // namespace

std::vector<Disagreement> disagreements() {
  return {
      {"pbd-friction",
       "bullet/pbd",
       "The position-based world sticks where Coulomb's law slides",
       "A touching node loses a fixed share f of its tangential motion in every step, whatever presses it on: it "
       "creeps "
       "at g sin θ h (1 - f) / f.",
       "distance slid",
       "m",
       {{"Coulomb's law, mysim", "mysim/leapfrog"},
        {"Bullet, deformable", "bullet/deformable-explicit"},
        {"Bullet, position-based", "bullet/pbd"}},
       moved,
       friction_effect},
      {"pbd-stiffness",
       "bullet/pbd",
       "The stiffness of position-based links depends on step and iterations",
       "Each link is solved by itself and in turn; in a network the neighbours spoil it again, so that the map from "
       "N/m "
       "to kLST holds only where k h² / μ is below about 0.01, and more iterations do not help.",
       "sag",
       "mm",
       {{"what is asked", "mysim/leapfrog"},
        {"1 iteration, 1/60 s", "bullet/pbd", 1. / 60},
        {"10 iterations, 1/60 s", "bullet/pbd+n=10", 1. / 60},
        {"1 iteration, 1/240 s", "bullet/pbd", 1. / 240},
        {"1 iteration, 1/1920 s", "bullet/pbd", 1. / 1920},
        {"the demos' settings, 1/60 s", "bullet/pbd+demo", 1. / 60}},
       sag,
       stiffness_effect},
      {"link-law",
       "bullet/pbd",
       "Position-based links do not follow Hooke's law",
       "A link corrects by (L^2 - r^2) / (L^2 + r^2), which is stiffer than Hooke's law where it is pulled and softer "
       "where it is pushed, however short the step.",
       "length",
       "m",
       {{"Hooke's law, mysim", "mysim/leapfrog"},
        {"Bullet, position-based", "bullet/pbd"},
        {"the link law, mysim", "mysim/leapfrog", 0, SpringLaw::bullet_link}},
       length,
       law_effect},
      {"implicit-freeze",
       "bullet/deformable-implicit",
       "The implicit world freezes unless its projection is switched on",
       "Without setUseProjection(true) the solver's preconditioner, not made for the implicit mode, yields no number, "
       "and the step's change of velocity is set to zero without a message.",
       "length",
       "m",
       {{"implicit Euler, mysim", "mysim/implicit-euler"},
        {"Bullet, with projection", "bullet/deformable-implicit"},
        {"Bullet, without it", "bullet/deformable-implicit+unprojected"}},
       length,
       freeze_effect},
      {"indefinite-hessian",
       "bullet/deformable-implicit",
       "Bullet's implicit spring force blows up where springs are pushed",
       "A pushed spring has a negative stiffness across itself; the shipped force hands it over as it is, and one "
       "Newton "
       "step on an indefinite matrix may go anywhere.",
       "total energy",
       "J",
       {{"implicit Euler, one Newton step, mysim", "mysim/implicit-euler+linear"},
        {"Bullet, negative part left out", "bullet/deformable-implicit"},
        {"Bullet, as shipped", "bullet/deformable-implicit+shipped"}},
       energy,
       hessian_effect},
      {"rest-lengths",
       "bullet",
       "Rest lengths are overwritten in the first step",
       "Adding a node, a link or a mass sets a flag, upon which the first step takes the lengths it finds for the rest "
       "lengths.",
       "length",
       "m",
       {{"what is asked, mysim", "mysim/leapfrog"},
        {"Bullet, explicit, flag left", "bullet/deformable-explicit+default-rest"},
        {"Bullet, position-based, flag left", "bullet/pbd+default-rest"}},
       length,
       rest_effect},
      {"wind-at-rest",
       "bullet/pbd",
       "Bullet's wind does not set a cloth at rest in motion",
       "The force of the air on a node is limited by what would stop the node, and a node at rest is stopped by "
       "nothing.",
       "speed along the wind",
       "m/s",
       {{"what is asked, mysim", "mysim/leapfrog"},
        {"Bullet's own wind", "bullet/pbd+own-wind"},
        {"Bullet, forces added to nodes", "bullet/pbd"}},
       along_wind,
       wind_effect},
      {"speed-clamp",
       "bullet/deformable-explicit",
       "The deformable world limits the speed of small bodies",
       "A node may not move farther in a step than the body's box is wide; a small body in long steps is slowed in "
       "silence.",
       "distance",
       "m",
       {{"what is asked, mysim", "mysim/leapfrog"},
        {"Bullet, default margin of 0.25 m", "bullet/deformable-explicit+default-margin"},
        {"Bullet, margin of 10 m", "bullet/deformable-explicit"}},
       moved,
       clamp_effect},
      {"distance-field",
       "bullet/pbd",
       "The default distance field misplaces obstacles",
       "Distances to an obstacle are read from a grid; on a ball of radius R the depth in a voxel of size a is wrong "
       "by up to a^2 / 4R (how wrong its direction is: see the direction of contact).",
       "height over the surface",
       "mm",
       {{"what is asked, mysim", "mysim/leapfrog"},
        {"Bullet, voxel of 0.25 m", "bullet/pbd+default-voxel"},
        {"Bullet, voxel of 0.02 m", "bullet/pbd"}},
       gap,
       field_effect},
      {"contact-direction",
       "bullet/deformable-explicit",
       "Contact pushes in a direction that is off, whatever the step",
       "The normal is the gradient of the grid of distances inside one voxel, constant along each axis there: exact in "
       "the middle of a voxel of size a, off by up to a / 2R in each direction at its faces. A smooth ball is felt as "
       "one with facets.",
       "direction of motion, less the tangent's",
       "mrad",
       {{"mysim", "mysim/leapfrog"},
        {"Bullet, voxel of 5 mm", "bullet/deformable-explicit"},
        {"the same, a quarter of the step", "bullet/deformable-explicit", 1.25e-4},
        {"Bullet, voxel of 20 mm", "bullet/deformable-explicit+voxel=0.02"},
        {"Bullet, voxel of 1.25 mm", "bullet/deformable-explicit+voxel=0.00125"}},
       steeper,
       direction_effect,
       directions},
      {"contact-hop",
       "bullet/deformable-explicit",
       "Sliding nodes hop on curved obstacles",
       "Contact is found at the proposed position, but normal and gap are those of the old one: the node leaves along "
       "the tangent plane, by (v h)^2 / 2R in a step.",
       "height over the surface",
       "mm",
       {{"mysim", "mysim/leapfrog"}, {"Bullet, deformable", "bullet/deformable-explicit"}},
       gap,
       hop_effect},
      {"single-precision",
       "bullet32",
       "Single precision loses half of the digits",
       "Bullet's usual build keeps 24 bits of each number: every position is rounded by 6e-8 of its size in every "
       "step, "
       "whatever the rule.",
       "distance from mysim",
       "m",
       {{"mysim, double precision", "mysim/symplectic-euler"},
        {"Bullet, double precision", "bullet/deformable-explicit"},
        {"Bullet, single precision", "bullet32/deformable-explicit"}},
       nullptr,
       precision_effect},
  };
}

}  // namespace crosscheck
