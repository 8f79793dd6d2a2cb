// Cloth: smooth normals, values and thread distances, on a curved surface through the particles' true places.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "report/render/placed_body.h"

namespace crosscheck::render {
namespace {

using Edge = std::array<int, 2>;

constexpr float no_thread = 1e6f;       // distance to an edge that is no thread
constexpr float thread_width = 0.075f;  // of the spacing of the threads

Edge sorted(int i, int j) { return {std::min(i, j), std::max(i, j)}; }

bool is_sound(const PlacedBody& placed, const std::array<int, 3>& triangle) {
  return placed.is_sound(triangle[0]) && placed.is_sound(triangle[1]) && placed.is_sound(triangle[2]);
}

/// Twice the area of the triangle, along its normal.
Eigen::Vector3f area_vector(const PlacedBody& placed, const std::array<int, 3>& t) {
  return (placed.at(t[1]) - placed.at(t[0])).cross(placed.at(t[2]) - placed.at(t[0]));
}

/// Mean normal of the triangles around each particle, weighted by their area.
std::vector<Eigen::Vector3f> smooth_normals(const PlacedBody& placed) {
  std::vector<Eigen::Vector3f> normal(placed.x.size(), Eigen::Vector3f::Zero());
  for (const auto& triangle : placed.body.triangles) {
    if (!is_sound(placed, triangle)) continue;
    for (const int i : triangle) normal[std::size_t(i)] += area_vector(placed, triangle);
  }
  for (Eigen::Vector3f& n : normal) n = n.norm() > 1e-20f ? n.normalized() : Eigen::Vector3f(0, 1, 0);
  return normal;
}

/// A point of the curved surface through the three corners (Phong tessellation, Boubekeur and Alexa 2008): half way
/// from the flat triangle to the corners' tangent planes, which follows a ball to second order.
ClothCorner curved(const std::array<ClothCorner, 3>& corner, const Eigen::Vector3f& part) {
  ClothCorner c{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const float share = part[Eigen::Index(k)];
    c.x += share * corner[k].x, c.normal += share * corner[k].normal, c.rim += share * corner[k].rim;
    c.value += share * corner[k].value, c.no_value += share * corner[k].no_value;
  }
  Eigen::Vector3f bulge = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    bulge -= part[Eigen::Index(k)] * (c.x - corner[k].x).dot(corner[k].normal) * corner[k].normal;
  }
  c.x += 0.5f * bulge;
  c.normal.normalize();
  return c;
}

/// Adds the triangle as pieces * pieces smaller ones of its curved surface.
void add_curved(const std::array<ClothCorner, 3>& corner, int pieces, Stage& stage) {
  const unsigned first = unsigned(stage.cloth.size());
  // rows of pieces + 1, pieces, ..., 1 corners
  for (int i = 0; i <= pieces; ++i) {
    for (int j = 0; i + j <= pieces; ++j) {
      stage.cloth.push_back(curved(corner, Eigen::Vector3f(float(pieces - i - j), float(i), float(j)) / float(pieces)));
    }
  }
  const auto at = [&](int i, int j) { return first + unsigned(i * (pieces + 1) - i * (i - 1) / 2 + j); };
  for (int i = 0; i < pieces; ++i) {
    for (int j = 0; i + j < pieces; ++j) {
      for (const unsigned c : {at(i, j), at(i + 1, j), at(i, j + 1)}) stage.cloth_index.push_back(c);
      if (i + j + 1 == pieces) continue;
      for (const unsigned c : {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) stage.cloth_index.push_back(c);
    }
  }
}

}  // namespace

std::vector<Edge> add_cloth(const PlacedBody& placed, Stage& stage) {
  std::set<Edge> threads;
  for (const auto& [i, j] : placed.body.threads) threads.insert(sorted(i, j));
  std::set<Edge> apart = threads;

  const std::vector<Eigen::Vector3f> normal = smooth_normals(placed);
  const float half_width = std::max(0.5f * thread_width * placed.median_length(placed.body.threads), 1e-9f);
  const int pieces = placed.body.triangles.size() < 1000 ? 3 : placed.body.triangles.size() < 12000 ? 2 : 1;
  for (const auto& triangle : placed.body.triangles) {
    for (std::size_t k = 0; k < 3; ++k) apart.erase(sorted(triangle[k], triangle[(k + 1) % 3]));
    if (!is_sound(placed, triangle)) continue;

    std::array<ClothCorner, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = triangle[k];
      const float value = placed.position(i);
      const bool none = std::isnan(value);
      corner[k] = {placed.at(i), normal[std::size_t(i)], Eigen::Vector3f::Constant(no_thread), none ? 0 : value,
                   none ? 1.f : 0.f};
    }
    // the distance to the edge opposite to corner k is linear: the height at corner k, 0 at the other two
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = triangle[(k + 1) % 3], j = triangle[(k + 2) % 3];
      if (!threads.count(sorted(i, j))) continue;
      const float length = std::max((placed.at(i) - placed.at(j)).norm(), 1e-12f);
      for (ClothCorner& c : corner) c.rim[Eigen::Index(k)] = 0;
      corner[k].rim[Eigen::Index(k)] = area_vector(placed, triangle).norm() / length / half_width;
    }
    add_curved(corner, pieces, stage);
  }
  return {apart.begin(), apart.end()};
}

}  // namespace crosscheck::render
