#include "experiments/disagreements/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "experiments/metrics.h"
#include "experiments/tables/disagreements.h"
#include "mysim/model/energy.h"

namespace crosscheck::effects {
namespace {

/// Mean time between upward passages through the middle, s; NaN if there are fewer than two passages.
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

double largest_size(const Series& s) {
  double most = 0;
  for (const auto& point : s.points) most = std::max(most, std::abs(point.second));
  return most;
}

}  // namespace

double moved(const Scene& scene, const State& s) { return (s.x.col(0) - scene.start.x.col(0)).norm(); }
double sag(const Scene& scene, const State& s) {
  return 1e3 * (scene.start.x.row(1).minCoeff() - s.x.row(1).minCoeff());
}
double length(const Scene&, const State& s) { return (s.x.col(1) - s.x.col(0)).norm(); }
double along_wind(const Scene&, const State& s) { return s.v.row(2).mean(); }
double gap(const Scene& scene, const State& s) { return 1e3 * *clearance(scene, s.t, s.x); }
/// Angle by which the particle's path is steeper than the ball's tangent, mrad. Returns 0 in the first half millimetre,
/// where the particle falls freely to the surface of a grid of 20 mm, which is up to 0.1 mm too low.
double steeper(const Scene& scene, const State& s) {
  const Vec3 v = s.v.col(0), from = s.x.col(0) - scene.model.find<Spheres>()->list[0].centre;
  return moved(scene, s) < 5e-4 ? 0 : 1e3 * (std::atan2(-v.y(), v.x()) - std::atan2(from.x(), from.y()));
}
double stretch(const Scene& scene, const State& s) {
  return 1e3 * ((s.x.col(1) - s.x.col(0)).norm() - scene.model.find<Springs>()->list[0].rest);
}
double second_stretch(const Scene& scene, const State& s) {
  return 1e3 * ((s.x.col(3) - s.x.col(2)).norm() - scene.model.find<Springs>()->list[1].rest);
}
double lowest(const Scene&, const State& s) { return s.x.row(1).minCoeff(); }
double energy(const Scene& scene, const State& s) { return energy_of(scene.model, s).total(); }

std::string friction_effect(const std::vector<Series>& all) {
  const double coulomb = all[0].last(), explicit_world = all[1].last(), pbd = all[2].last();
  return fmt::format(
      "In {:.2g} s the particle slides {:.4f} m by Coulomb's law and {:.4f} m in the deformable world, but creeps only "
      "{:.4f} m in the position-based world.",
      all[0].points.back().first, coulomb, explicit_world, pbd);
}

std::string stiffness_effect(const std::vector<Series>& all) {
  std::string text = fmt::format("The sag should be {:.2f} mm.", all[0].last());
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
  return fmt::format("With projection the mass swings to {:.2f} m; without projection the run is {} at {:.4f} m.",
                     largest(all[1]), name_of(all[2].outcome.verdict), all[2].last());
}

std::string hessian_effect(const std::vector<Series>& all) {
  const Series& shipped = all[2];
  return fmt::format(
      "With Bullet's own force the energy grows from {:.0f} J at the start to {:.2g} J, and the run is stopped at "
      "{:.2g} s ({}). Without the negative part of the second derivatives, {}.",
      shipped.points[0].second, shipped.last(), shipped.outcome.end, in_words(shipped.outcome.verdict),
      all[1].last() < 1e-12 * shipped.points[0].second ? "the motion dies out"
                                                       : fmt::format("the energy ends at {:.2g} J", all[1].last()));
}

std::string rest_effect(const std::vector<Series>& all) {
  // uses the middle between the turning points, because a mean over time would depend on the number of periods
  auto middle = [](const Series& s) {
    const auto [low, high] =
        std::ranges::minmax(s.points | std::views::transform([](const auto& point) { return point.second; }));
    return (low + high) / 2;
  };
  return fmt::format(
      "The length should oscillate about {:.3f} m. With Bullet's defaults it does so about {:.3f} m (explicit) and "
      "{:.3f} m "
      "(position-based); the certificate stops such a comparison.",
      middle(all[0]), middle(all[1]), middle(all[2]));
}

std::string wind_effect(const std::vector<Series>& all) {
  // time at which a run reaches half of the reference's final speed
  const double half = all[0].last() / 2;
  auto reached = [&](const Series& s) {
    for (const auto& [t, v] : s.points)
      if (v >= half) return fmt::format("after {:.2g} s", t);
    return fmt::format("not in {:.2g} s", s.points.back().first);
  };
  return fmt::format(
      "In mysim half the final speed, {:.2f} m/s, is reached {}. With Bullet's own wind it is reached {}, when "
      "rounding has grown into a motion, and with forces added to Bullet's nodes {}.",
      half, reached(all[0]), reached(all[1]), reached(all[2]));
}

std::string clamp_effect(const std::vector<Series>& all) {
  const auto& [t, way] = all[1].points.back();
  return fmt::format(
      "The particle is thrown at 80 m/s and flies {:.1f} m in {:.2g} s; in Bullet, with the default margin, it flies "
      "{:.1f} m.",
      all[0].last(), t, way);
}

std::string field_effect(const std::vector<Series>& all) {
  auto place = [](double mm) { return fmt::format("{:.3g} mm {}", std::abs(mm), mm < 0 ? "inside" : "outside"); };
  return fmt::format("The particle lies {} the surface with the default voxel of 0.25 m and {} with 0.02 m.",
                     place(all[1].last()), place(all[2].last()));
}

std::string direction_effect(const std::vector<Series>& all) {
  return fmt::format(
      "As the particle slides down from rest, its direction deviates from the tangent by up to {:.2g} mrad, and by up "
      "to {:.2g} mrad with a quarter of the step. With voxels of 20 mm the deviation is {:.2g} mrad, with voxels of "
      "1.25 mm {:.2g} mrad, and in mysim {:.1g} mrad.",
      largest_size(all[1]), largest_size(all[2]), largest_size(all[3]), largest_size(all[4]), largest_size(all[0]));
}

TableWithSentence directions(const Disagreement& d) {
  constexpr double first = 2, last = 45;  // degrees
  std::vector<double> angles;
  for (double degrees = first; degrees <= last; degrees += 0.5) angles.push_back(degrees * std::numbers::pi / 180);
  const Scene scene = scene_of(d);
  Table table = table_of<ContactAngleRow>(d.name + "-angles");
  double steeper_by = 0, flatter_by = 0, sideways = 0;
  const std::string bullet = d.variants[1].method;
  for (const std::string& method : {d.variants[0].method, bullet, d.variants[3].method, d.variants[4].method})
    for (const DirectionError& e : direction_errors(method, scene, angles)) {
      add(table, ContactAngleRow{method, e.angle, e.in_plane, e.sideways, scene.hash});
      if (method != bullet) continue;
      steeper_by = std::max(steeper_by, 1e3 * e.in_plane), flatter_by = std::min(flatter_by, 1e3 * e.in_plane);
      sideways = std::max(sideways, 1e3 * std::abs(e.sideways));
    }
  return {table,
          fmt::format(
              "If the particle is released at {:g} to {:g} degrees, the push deviates from the normal by {:.2g} to "
              "{:.2g} mrad in the plane of gravity and by up to {:.2g} mrad sideways, extrapolated to a step of zero.",
              first, last, flatter_by, steeper_by, sideways)};
}

std::string hop_effect(const std::vector<Series>& all) {
  return fmt::format("While the particle slides, it leaves the surface by up to {:.2g} mm; in mysim by {:.2g} mm.",
                     largest_size(all[1]), largest_size(all[0]));
}

std::string precision_effect(const std::vector<Series>& all) {
  // numbers of 24 bits are rounded by 6e-8 of their value; the errors of about ten roundings per step accumulate like a
  // random walk
  constexpr double length = 2;  // m, positions in the scene
  const double expected = 10 * 6e-8 * length * std::sqrt(static_cast<double>(all[2].outcome.steps));
  return fmt::format(
      "Bullet differs from mysim's run in double precision by {:.1g} m in double precision and by {:.1g} m in single "
      "precision; rounding to 24 bits explains up to {:.1g} m.",
      largest(all[1]), largest(all[2]), expected);
}

std::string pieces_effect(const std::vector<Series>& all) {
  const Outcome &pieces = all[1].outcome, &joined = all[2].outcome;
  return fmt::format(
      "With a network in two pieces, the program ({}) {} after {:.2g} s of CPU time, without any result. If a spring "
      "of 1e-9 N/m joins the two pieces, the program ends after {:.2g} s, and the motion is within {:.1g} m of the "
      "right one.",
      all[1].variant.method, pieces.verdict == Verdict::timeout ? "had not ended" : "ended", pieces.process_seconds,
      joined.process_seconds, most_apart(all[2], all[0]));
}

std::string one_stiffness_effect(const std::vector<Series>& all) {
  return fmt::format(
      "The second spring is stretched by up to {:.3g} mm instead of {:.3g} mm, {:.1f} times as much: it has the "
      "stiffness of the first spring, a tenth of its own. If both stiffnesses belong to one force, it is stretched by "
      "up to {:.3g} mm.",
      largest(all[1]), largest(all[0]), largest(all[1]) / largest(all[0]), largest(all[2]));
}

std::string gravity_factor_effect(const std::vector<Series>& all) {
  return fmt::format(
      "With twice the gravity and a factor of a half, the particle falls by {:.2f} m in {:.2g} s instead of {:.2f} m; "
      "in the deformable world it falls by {:.2f} m.",
      all[1].last(), all[1].points.back().first, all[0].last(), all[2].last());
}

std::string unused_effect(const std::vector<Series>& all) {
  return fmt::format(
      "Ten times the stiffness should reduce the sag from {:.3g} to {:.3g} mm. In the position-based world the sag "
      "stays at {:.3g} mm (change {:.1g}); in the deformable world it falls from {:.3g} to {:.3g} mm, whereas kLST of "
      "0.01 instead of 1 changes it by {:.1g} mm.",
      all[0].last(), all[1].last(), all[2].last(), most_apart(all[3], all[2]), all[4].last(), all[5].last(),
      most_apart(all[6], all[4]));
}

std::string over_relaxation_effect(const std::vector<Series>& all) {
  // every step is a sample; by step 6 the link's decaying mode has vanished, and until step 12 the stretch is small
  auto growth = [](const Series& s) -> double {
    constexpr size_t from = 6, to = 12;
    if (s.points.size() <= to) return NAN;
    return std::pow(std::abs(s.points[to].second / s.points[from].second), 1. / (to - from));
  };
  return fmt::format(
      "The stretch of 0.1 mm is multiplied by {:.3f} in each step at kLST 1.5 (expected 1.366) and by {:.3f} at 1.25 "
      "(expected 0.809); it reaches {:.2g} mm: {}.",
      growth(all[3]), growth(all[2]), largest_size(all[3]), in_words(all[3].outcome.verdict));
}

std::string small_effect(const std::vector<Series>& all) {
  return fmt::format(
      "A particle at rest on a ball of 10 mm is {:.2g} mm off with the default voxel. With the default margin it is "
      "pushed out and is {:.3g} mm off after {:.2g} s; with both scaled like the ball it is {:.1g} mm off.",
      most_apart(all[1], all[0]), most_apart(all[2], all[0]), all[0].points.back().first, most_apart(all[3], all[0]));
}

std::string sleeping_effect(const std::vector<Series>& all) {
  const auto& points = all[1].points;
  size_t still = points.size() - 1;
  while (still > 0 && points[still - 1].second == points.back().second) --still;
  return fmt::format(
      "A swing of {:.2g} mm stops at {:.3g} s, at {:.2g} mm. With sleeping switched off it continues, within {:.1g} mm "
      "of the right motion.",
      largest(all[0]), points[still].first, points.back().second, most_apart(all[2], all[0]));
}

void ten_times_stiffer(Scene& scene) {
  for (Spring& s : scene.model.find<Springs>()->list) s.k *= 10;
}
void join(Scene& scene) {
  const double distance = (scene.start.x.col(2) - scene.start.x.col(1)).norm();
  scene.model.find<Springs>()->list.push_back({1, 2, 1e-9, distance, {}});
}

}  // namespace crosscheck::effects
