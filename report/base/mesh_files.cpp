#include "report/base/mesh_files.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"

namespace crosscheck {

Shape shape_of(const Scene& scene) {
  Shape shape{scene.triangles, {}};
  std::vector<char> in_triangle(static_cast<std::size_t>(scene.model.particles.size()), 0);
  for (const auto& triangle : shape.triangles)
    for (const int corner : triangle) in_triangle[corner] = 1;
  const auto add = [&](int a, int b) {
    if (!in_triangle[a] || !in_triangle[b]) shape.lines.emplace_back(a, b);
  };
  if (const auto* springs = scene.model.find<Springs>())
    for (const Spring& s : springs->list) add(s.a, s.b);
  if (const auto* constraints = scene.model.find<Constraints>())
    for (const auto& c : constraints->list) add(c.a, c.b);
  return shape;
}

std::string obj_bytes(const Points& x, const Shape& shape) {
  std::string text = "# Crosscheck; metres\n";
  for (Eigen::Index i = 0; i < x.cols(); ++i) text += fmt::format("v {} {} {}\n", x(0, i), x(1, i), x(2, i));
  for (const auto& [a, b, c] : shape.triangles) text += fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
  for (const auto& [a, b] : shape.lines) text += fmt::format("l {} {}\n", a + 1, b + 1);
  if (shape.triangles.empty() && shape.lines.empty())
    for (Eigen::Index i = 0; i < x.cols(); ++i) text += fmt::format("p {}\n", i + 1);
  return text;
}

std::string ply_bytes(const Points& x, const Shape& shape) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment Crosscheck; metres\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\n",
      x.cols());
  if (!shape.triangles.empty())
    bytes += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", shape.triangles.size());
  if (!shape.lines.empty())
    bytes += fmt::format("element edge {}\nproperty int vertex1\nproperty int vertex2\n", shape.lines.size());
  bytes += "end_header\n";
  const auto add = [&](const auto& value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof raw);
  };
  bytes.append(reinterpret_cast<const char*>(x.data()), static_cast<std::size_t>(x.size()) * sizeof(double));
  for (const auto& triangle : shape.triangles) {
    add(std::uint8_t{3});
    for (const int corner : triangle) add(std::int32_t{corner});
  }
  for (const auto& [a, b] : shape.lines) add(std::int32_t{a}), add(std::int32_t{b});
  return bytes;
}

std::pair<Points, Shape> ball_mesh(double radius) {
  constexpr int around = 64, rings = 31, last = 1 + rings * around;
  Points x(3, last + 1);
  x.col(0) << 0, radius, 0;
  x.col(last) << 0, -radius, 0;
  Shape shape;
  const auto vertex = [](int ring, int meridian) { return 1 + ring * around + meridian % around; };
  for (int ring = 0; ring < rings; ++ring)
    for (int meridian = 0; meridian < around; ++meridian) {
      const double polar = std::numbers::pi * (ring + 1) / (rings + 1);
      const double azimuth = 2 * std::numbers::pi * meridian / around;
      const Vec3 normal(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
      x.col(vertex(ring, meridian)) = radius * normal;
      const int here = vertex(ring, meridian), beside = vertex(ring, meridian + 1);
      const bool first = ring == 0;
      shape.triangles.push_back({first ? 0 : vertex(ring - 1, meridian + 1), here, beside});
      shape.triangles.push_back({here, ring + 1 == rings ? last : vertex(ring + 1, meridian), beside});
    }
  return {x, shape};
}

MeshWriter::MeshWriter(std::filesystem::path folder, const Scene& scene, const std::string& form)
    : folder_(std::move(folder)), shape_(shape_of(scene)), form_(form) {
  if (form != "obj" && form != "ply") throw InputError(fmt::format("--meshes {}: expected obj or ply", form));
  if (const auto* spheres = scene.model.find<Spheres>()) spheres_ = *spheres;
}

void MeshWriter::write(const std::string& name, const Points& x, const Shape& shape) const {
  write_file(folder_ / fmt::format("{}.{}", name, form_), form_ == "obj" ? obj_bytes(x, shape) : ply_bytes(x, shape));
}

Verdict MeshWriter::observe(const State& state, bool sample) {
  if (!sample) return Verdict::ok;
  write(fmt::format("frame-{:04}", ++frames_), state.x, shape_);
  for (std::size_t i = 0; i < spheres_.list.size(); ++i) {
    const Sphere& sphere = spheres_.list[i];
    if (!sphere.motion && frames_ > 1) continue;
    auto [x, shape] = ball_mesh(sphere.radius);
    x.colwise() += sphere.centre_at(state.t);
    write(sphere.motion ? fmt::format("sphere-{}-{:04}", i + 1, frames_) : fmt::format("sphere-{}", i + 1), x, shape);
  }
  return Verdict::ok;
}

}  // namespace crosscheck
