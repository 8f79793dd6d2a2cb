// Writes triangles, springs and obstacles.
#include "report/player/static_geometry.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace crosscheck {

Json packed_json(const PackedNumbers& p) {
  return {{"count", p.count}, {"lag", p.lag}, {"order", p.order}, {"data", p.data}};
}
Json vector_json(const Vec3& v) { return std::span(v.data(), 3); }

Json triangles_json(const Scene& scene) {
  if (scene.triangles.empty()) return nullptr;
  std::vector<std::uint16_t> corners;
  for (const auto& triangle : scene.triangles)
    for (const int corner : triangle) corners.push_back(static_cast<std::uint16_t>(corner));
  // two triangles fill a cell of a grid: from cell to cell their corners move by one
  return packed_json(pack(std::move(corners), 6, 2));
}

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
  return {{"ends", packed_json(pack(std::move(ends), 2, 2))},
          {"rests", packed_json(pack_small(rests))},
          {"rest_unit", unit},
          {"threads", threads},
          {"families", families}};
}

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

}  // namespace crosscheck
