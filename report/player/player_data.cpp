// Gathers a scene's motions for the player and writes them as JSON.
#include "report/player/player_data.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "report/figures/figure.h"
#include "report/findings/report_data.h"
#include "report/pictures/scene_picture.h"
#include "report/player/packed_numbers.h"
#include "report/player/static_geometry.h"
#include "report/player/thinned_trajectory.h"

namespace crosscheck {
namespace {

/// As many digits as a reader of a plot needs.
double five_digits(double value) { return std::stod(fmt::format("{:.5g}", value)); }

Json values_json(const ColourValues& values, size_t motion, size_t particles) {
  if (!(values.top > 0) || values.of[motion].empty()) return nullptr;
  return packed_json(pack(quantise(values.of[motion], values.top), particles, 1));
}

/// Lattice and numbers of a motion: on the lattice of all, less those of the first one where that takes less room; on
/// one of its own where it leaves that of all.
Json places_json(const ThinnedTrajectory& shown, const Lattice& lattice, const std::vector<std::uint16_t>& first,
                 double& bound) {
  const auto per_frame = static_cast<size_t>(shown.x[0].size());
  const auto numbers = lattice.numbers_of(shown.x);
  if (!numbers) {
    const QuantisedPositions own = quantise(shown.x);
    bound = own.bound;
    return {{"low", vector_json(own.low)},
            {"unit", vector_json(own.unit)},
            {"places", packed_json(pack(own.numbers, per_frame, 2))}};
  }
  bound = lattice.bound();
  Json json{{"low", vector_json(lattice.low)}, {"unit", vector_json(Vec3::Constant(lattice.unit))}};
  const PackedNumbers whole = pack(*numbers, per_frame, 2);
  if (!first.empty()) {
    const PackedNumbers apart = pack(subtract_frames(*numbers, first, per_frame), per_frame, 2);
    if (apart.data.size() < whole.data.size()) {
      json["over"] = 0;
      json["places"] = packed_json(apart);
      return json;
    }
  }
  json["places"] = packed_json(whole);
  return json;
}

/// The motions, and the largest distance of a place of a run that went well from what the page draws, m.
Json methods_json(const Scene& scene, const std::vector<ThinnedTrajectory>& all, const ThinnedTrajectory* known,
                  const ColourValues& stretch, const ColourValues& distance, double& bound) {
  const auto particles = static_cast<size_t>(scene.model.particles.size());
  const Lattice lattice = lattice_of(all);
  const auto first = lattice.numbers_of(all[0].x);
  Json methods = Json::list();
  for (size_t m = 0; m < all.size(); ++m) {
    Json json = motion_info_json(all[m]);
    double own = 0;
    json.update(places_json(all[m], lattice, m > 0 && first ? *first : std::vector<std::uint16_t>(), own));
    if (all[m].ok()) bound = std::max(bound, own);
    // the truth stands next to them at once where there is room for it, and it goes all the way
    json["first"] = all[m].answer || (all.size() <= 4 && all[m].t.back() > 0.98 * scene.duration);
    json["frames"] = all[m].x.size();
    json["stretch"] = values_json(stretch, m, particles), json["distance"] = values_json(distance, m, particles);
    json["plotted"] = Json::list();
    for (const auto& value : plotted_values(scene, all[m], known))
      json["plotted"].push(value ? Json(five_digits(*value)) : Json());
    methods.push(std::move(json));
  }
  return methods;
}

/// The words of distances: they are no errors where the truth is but the in-house contact rule's.
Json distance_json(const Scene& scene, const Truth& truth, double top, double until) {
  if (!(top > 0)) return nullptr;
  const std::string name =
      truth.under_contact_rule ? "difference from the converged contact rule" : "distance to the truth";
  const bool whole = until >= scene.duration * (1 - 1e-9);
  return {{"top", top}, {"name", name}, {"label", whole ? "mm" : fmt::format("mm, up to {:.3g} s", until)}};
}

Json plot_json(const Scene& scene) {
  if (scene.model.first_order())
    return {{"label", "distance / mm"}, {"unit", "mm"}, {"title", scene.name + ": distance to the truth over time"}};
  return {{"label", "energy / J"}, {"unit", "J"}, {"title", scene.name + ": total energy over time"}};
}

/// The part of it that all methods share.
Json shared_json(const Scene& scene, const CameraPlacement& placement, const std::vector<double>& times) {
  Json json{{"scene", scene.name}, {"particles", scene.model.particles.size()}, {"times", times}};
  json["from"] = vector_json(placement.from);
  json["floor"] = placement.floor ? Json(*placement.floor) : Json();
  json["triangles"] = triangles_json(scene);
  json["springs"] = springs_json(scene);
  json["pins"] = scene.model.particles.pins;
  json["spheres"] = spheres_json(scene, times);
  return json;
}

}  // namespace

std::string player_json(const Scene& scene, const std::vector<const Result*>& answers,
                        const std::optional<Truth>& truth) {
  const std::vector<ThinnedTrajectory> all = thin(scene, answers, truth);
  if (all.empty()) return "";
  const ThinnedTrajectory* known = all.back().answer ? nullptr : &all.back();
  const double until = known ? std::min({scene.window, truth->until, known->t.back()}) : 0;
  const ColourValues stretch = stretch_values(scene, all);
  const ColourValues distance = known ? distance_values(all, *known, until, truth->error_bar) : ColourValues();
  std::vector<double> times;
  for (int i = 0; i <= scene.samples; i += frame_stride(scene))
    times.push_back(five_digits(scene.duration * i / scene.samples));

  double bound = 0;
  Json methods = methods_json(scene, all, known, stretch, distance, bound);
  std::vector<Points> seen;
  for (const bool failed : {false, true})
    for (const ThinnedTrajectory& s : all)
      if (s.ok() != failed && (!failed || seen.empty())) seen.insert(seen.end(), s.x.begin(), s.x.end());
  const CameraPlacement placement = camera_placement(scene, seen, times);

  Json json = shared_json(scene, placement, times);
  json["stretch"] = stretch.top > 0 ? Json{{"top", stretch.top}, {"label", "%"}} : Json();
  json["distance"] = known ? distance_json(scene, *truth, distance.top, until) : Json();
  json["plot"] = plot_json(scene);
  json["methods"] = std::move(methods);
  json["finest"] = bound;
  json["at"] = scene.camera && scene.camera->at ? *scene.camera->at : scene.duration;  // the poster's time, s
  // an outside program may have said anything
  return json.dump();
}

std::string stage_json(const Scene& scene) {
  CameraPlacement placement = camera_placement(scene, {scene.start.x}, {0});
  placement.floor.reset();
  Json json = shared_json(scene, placement, {0});
  json["stretch"] = json["distance"] = nullptr;
  json["methods"] = Json::list();
  return json.dump();
}

}  // namespace crosscheck
