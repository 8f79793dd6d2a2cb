#include "report/player/stage.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "mysim/base/text.h"
#include "report/pictures/scene_picture.h"
#include "report/player/packed_numbers.h"
#include "report/player/runs.h"

namespace crosscheck {
namespace {

Json vector_json(const Vec3& v) { return std::span(v.data(), 3); }

/// JSON of rows as {"count", "columns", "data"} for unpack.ts.
Json packed_json(const std::vector<std::uint16_t>& numbers, size_t columns) {
  return {{"count", numbers.size()}, {"columns", columns}, {"data", base64(pack(numbers, columns))}};
}

/// The surface's triangles; null if the scene has no surface.
Json triangles_json(const Scene& scene) {
  if (scene.triangles.empty()) return nullptr;
  std::vector<std::uint16_t> corners;
  for (const auto& triangle : scene.triangles)
    for (const int corner : triangle) corners.push_back(static_cast<std::uint16_t>(corner));
  return packed_json(corners, 6);  // 6, because a grid's cell has two triangles with three corners each
}

/// Distance constraints, then springs, by family. The first `threads` of these links are drawn on the surface.
Json springs_json(const Scene& scene) {
  std::vector<std::uint16_t> ends;
  Json families = Json::array();
  size_t threads = 0;
  std::vector<double> lengths;
  const auto add = [&](int a, int b, double length) {
    for (const int end : {a, b}) ends.push_back(static_cast<std::uint16_t>(end));
    lengths.push_back(length);
  };
  const auto close = [&](std::string_view name, size_t from) {
    if (ends.size() > from) families.push_back({{"name", name}, {"count", (ends.size() - from) / 2}});
  };
  if (const auto* distances = scene.model.find<Constraints>()) {
    for (const auto& [a, b, length] : distances->list) add(a, b, length);
    close("hard distance", 0);
    threads = ends.size() / 2;
  }
  if (const auto* springs = scene.model.find<Springs>())
    for (const Family family : {Family::structural, Family::shear, Family::bend, Family::single}) {
      const size_t from = ends.size();
      for (const Spring& s : springs->list)
        if (s.family == family) add(s.a, s.b, s.rest);
      close(name_of(family), from);
      if (family == Family::structural) threads = ends.size() / 2;
    }
  const double unit = lengths.empty() ? 1 : std::max(1e-12, std::ranges::max(lengths)) / 65535;
  std::vector<std::uint16_t> rests;
  for (const double length : lengths) rests.push_back(static_cast<std::uint16_t>(std::lround(length / unit)));
  return {{"ends", packed_json(ends, 2)},
          {"rests", packed_json(rests, 1)},
          {"rest_unit", unit},
          {"threads", threads},
          {"families", families}};
}

/// Obstacles. A moving one has a centre for each of the times (s).
Json spheres_json(const Scene& scene, const std::vector<double>& times) {
  Json list = Json::array();
  if (const auto* spheres = scene.model.find<Spheres>())
    for (const Sphere& s : spheres->list) {
      Json centres;
      for (const double t : times)
        if (s.motion || centres.is_null()) centres.push_back(vector_json(s.centre_at(t)));
      list.push_back({{"radius", s.radius}, {"centres", std::move(centres)}});
    }
  return list;
}

/// Planes at their initial positions.
Json planes_json(const Scene& scene) {
  Json list = Json::array();
  if (const auto* planes = scene.model.find<Planes>())
    for (const Plane& p : planes->list)
      list.push_back({{"point", vector_json(p.point)}, {"normal", vector_json(p.normal)}});
  return list;
}

Json stage_of(const Scene& scene, const std::vector<Points>& shown, const std::vector<double>& times) {
  const CameraPlacement placement = camera_placement(scene, shown, times);
  return {{"scene", scene.name},
          {"particles", scene.model.particles.size()},
          {"times", times},
          {"from", vector_json(placement.from)},
          {"floor", placement.floor ? Json(*placement.floor) : Json()},
          {"triangles", triangles_json(scene)},
          {"springs", springs_json(scene)},
          {"pins", scene.model.particles.pins},
          {"spheres", spheres_json(scene, times)},
          {"planes", planes_json(scene)}};
}

}  // namespace

std::string stage_json(const Scene& scene, const std::vector<Points>& shown, const std::optional<StageTruth>& truth) {
  const int stride = frame_stride(scene);
  if (stride == 0) return "";
  std::vector<double> times;
  for (int i = 0; i <= scene.samples; i += stride) times.push_back(scene.duration * i / scene.samples);
  Json json = stage_of(scene, shown.empty() ? std::vector{scene.start.x} : shown, times);
  json["at"] = scene.camera && scene.camera->at ? *scene.camera->at : scene.duration;  // time of the poster, s
  if (truth)
    json["truth"] = {{"name", truth->name}, {"rule", truth->rule}, {"bar", truth->bar}, {"motion", truth->motion}};
  return dump(json);
}

std::string stage_json(const Scene& scene, bool with_text) {
  Json json = stage_of(scene, {scene.start.x}, {0});
  json["floor"] = nullptr;
  if (with_text) json["toml"] = scene.source;
  return dump(json);
}

}  // namespace crosscheck
