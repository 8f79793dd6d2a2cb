#include "report/pictures/draw_list.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace crosscheck::render {
namespace {

using Edge = std::array<int, 2>;

struct PlacedBody {
  const Body& body;
  const Scale* scale;              // null: values have no colours
  std::vector<Eigen::Vector3f> x;  // in the frame

  PlacedBody(const Body& body_, const Frame& frame, const Scale* scale_) : body(body_), scale(scale_) {
    for (Eigen::Index i = 0; i < body.x.cols(); ++i) x.push_back(frame.place(body.x.col(i)));
  }
  const Eigen::Vector3f& at(int i) const { return x[std::size_t(i)]; }
  bool coloured() const { return scale && !body.value.empty(); }

  /// Position of a particle's value on the scale; 0 if the body has no values.
  float position(int i) const { return coloured() ? scale_position(*scale, body.value[std::size_t(i)]) : 0; }

  /// Median length of the edges; 0 if the list is empty.
  float median_length(const std::vector<Edge>& edges) const {
    std::vector<float> lengths;
    for (const auto& [i, j] : edges) lengths.push_back((at(i) - at(j)).norm());
    if (lengths.empty()) return 0;
    const auto middle = lengths.begin() + std::ptrdiff_t(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    return *middle;
  }
  /// Normal vector of a triangle, twice as long as the triangle's area.
  Eigen::Vector3f area_vector(const std::array<int, 3>& t) const {
    return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
  }
};

constexpr float absurd = 200;           // heights of the view; a body that extends farther is omitted
constexpr float near_view = 2.5f;       // heights of the view; nothing farther away casts a shadow
constexpr float no_thread = 1e6f;       // used as the distance to an edge that has no thread
constexpr float thread_width = 0.075f;  // in units of the spacing of the threads

Edge sorted(int i, int j) { return {std::min(i, j), std::max(i, j)}; }

/// Area-weighted mean of the triangles' normals around each particle.
std::vector<Eigen::Vector3f> smooth_normals(const PlacedBody& placed) {
  std::vector<Eigen::Vector3f> normal(placed.x.size(), Eigen::Vector3f::Zero());
  for (const auto& triangle : placed.body.triangles)
    for (const int i : triangle) normal[std::size_t(i)] += placed.area_vector(triangle);
  for (Eigen::Vector3f& n : normal) n = n.norm() > 1e-20f ? n.normalized() : Eigen::Vector3f(0, 1, 0);
  return normal;
}

/// A point of the curved surface: half way from the triangle to the corners' tangent planes (Phong tessellation,
/// Boubekeur and Alexa 2008). The surface follows a ball to second order.
ClothVertex curved(const std::array<ClothVertex, 3>& corner, const Eigen::Vector3f& part) {
  ClothVertex c{Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const float share = part[Eigen::Index(k)];
    c.x += share * corner[k].x, c.normal += share * corner[k].normal, c.rim += share * corner[k].rim;
    c.value += share * corner[k].value;
  }
  Eigen::Vector3f bulge = Eigen::Vector3f::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    bulge -= part[Eigen::Index(k)] * (c.x - corner[k].x).dot(corner[k].normal) * corner[k].normal;
  c.x += 0.5f * bulge;
  c.normal.normalize();
  return c;
}

/// Adds the triangle's curved surface as pieces * pieces triangles.
void add_curved(const std::array<ClothVertex, 3>& corner, int pieces, DrawList& list) {
  const unsigned first = unsigned(list.cloth.size());
  for (int i = 0; i <= pieces; ++i)
    for (int j = 0; i + j <= pieces; ++j)
      list.cloth.push_back(curved(corner, Eigen::Vector3f(float(pieces - i - j), float(i), float(j)) / float(pieces)));
  const auto at = [&](int i, int j) { return first + unsigned(i * (pieces + 1) - i * (i - 1) / 2 + j); };
  for (int i = 0; i < pieces; ++i)
    for (int j = 0; i + j < pieces; ++j) {
      for (const unsigned c : {at(i, j), at(i + 1, j), at(i, j + 1)}) list.cloth_index.push_back(c);
      if (i + j + 1 == pieces) continue;
      for (const unsigned c : {at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}) list.cloth_index.push_back(c);
    }
}

/// Adds the triangles. Returns the threads that are not edges of triangles.
std::vector<Edge> add_cloth(const PlacedBody& placed, DrawList& list) {
  std::set<Edge> threads;
  for (const auto& [i, j] : placed.body.threads) threads.insert(sorted(i, j));
  std::set<Edge> loose = threads;

  const std::vector<Eigen::Vector3f> normal = smooth_normals(placed);
  const float half_width = std::max(0.5f * thread_width * placed.median_length(placed.body.threads), 1e-9f);
  const int pieces = placed.body.triangles.size() < 1000 ? 3 : placed.body.triangles.size() < 12000 ? 2 : 1;
  for (const auto& triangle : placed.body.triangles) {
    std::array<ClothVertex, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = triangle[k];
      corner[k] = {placed.at(i), normal[std::size_t(i)], Eigen::Vector3f::Constant(no_thread), placed.position(i)};
    }
    // the distance to the edge opposite to corner k is linear: it equals the triangle's height at corner k, and 0 at
    // the other corners
    for (std::size_t k = 0; k < 3; ++k) {
      const int i = triangle[(k + 1) % 3], j = triangle[(k + 2) % 3];
      loose.erase(sorted(i, j));
      if (!threads.count(sorted(i, j))) continue;
      const float length = std::max((placed.at(i) - placed.at(j)).norm(), 1e-12f);
      for (ClothVertex& c : corner) c.rim[Eigen::Index(k)] = 0;
      corner[k].rim[Eigen::Index(k)] = placed.area_vector(triangle).norm() / length / half_width;
    }
    add_curved(corner, pieces, list);
  }
  return {loose.begin(), loose.end()};
}

// A cloth triangle is flat, but a ball is not. If all three corners are exactly on a ball of radius R, the middle of an
// edge of length l dips into the ball by l^2 / (8 R), and the middle of the triangle by l^2 / (6 R): the ball would
// show although no particle is inside. Therefore the cloth is drawn as a curved surface through the particles, made of
// smaller flat pieces. `lift` is the depth to which these pieces may still dip. The renderer moves the cloth towards
// the eye by `lift`, in depth only, and computes its shadows from there. Deeper penetration is visible.

// sizes in heights of the view
constexpr float few_tubes_radius = 0.0075f, view_bead_radius = 0.027f, pin_radius = 0.0085f, trail_radius = 0.0032f;

constexpr unsigned plain_tube = 0x8E9196, plain_bead = 0xDDA15E, pin_hex = 0x34363B, ball_hex = 0xB6BBC3;
constexpr unsigned trail_hex = 0x6C7A91, loose_thread = 0x6F6A62;

float tube_radius(const PlacedBody& placed, const Frame& frame) {
  if (placed.body.tube_radius > 0) return frame.length(placed.body.tube_radius);
  return std::min(few_tubes_radius, 0.16f * placed.median_length(placed.body.tubes));
}

Colour tube_colour(const PlacedBody& placed, std::size_t i) {
  const Body& body = placed.body;
  if (placed.scale && !body.tube_value.empty())
    return to_linear(scale_colour(scale_position(*placed.scale, body.tube_value[i])));
  return linear(body.tube_colour.empty() ? plain_tube : palette_hex(body.tube_colour[i]));
}

void add_rods(const PlacedBody& placed, const std::vector<Edge>& loose, const Frame& frame, DrawList& list) {
  const float radius = tube_radius(placed, frame);
  for (std::size_t i = 0; i < placed.body.tubes.size(); ++i) {
    const auto [a, b] = placed.body.tubes[i];
    list.rods.push_back({placed.at(a), radius, placed.at(b), tube_colour(placed, i)});
  }
  const float thin = std::min(0.3f * few_tubes_radius, 0.04f * placed.median_length(loose));
  for (const auto& [a, b] : loose) list.rods.push_back({placed.at(a), thin, placed.at(b), linear(loose_thread)});
}

void add_beads(const PlacedBody& placed, const Frame& frame, DrawList& list) {
  const Body& body = placed.body;
  const float radius = body.beads ? view_bead_radius : 0;
  // pins must be visible next to thick beads and tubes
  const float least = std::max(0.8f * radius, body.tubes.empty() ? 0 : 1.7f * tube_radius(placed, frame));
  for (int i = 0; i < int(placed.x.size()); ++i) {
    const Eigen::Vector3f& x = placed.at(i);
    if (std::ranges::count(body.pinned, i) > 0)
      list.beads.push_back({x, std::max(pin_radius, least), x, linear(pin_hex)});
    else if (body.beads)
      list.beads.push_back(
          {x, radius, x, placed.coloured() ? to_linear(scale_colour(placed.position(i))) : linear(plain_bead)});
  }
}

/// Adds the path as rods that grow and darken towards the present; the oldest rod comes first.
void add_trail(const Body& body, const Frame& frame, DrawList& list) {
  constexpr float least_step = 0.004f;  // heights of the view; shorter steps are merged
  std::vector<Eigen::Vector3f> path;
  for (const Vec3& point : body.trail) {
    const Eigen::Vector3f x = frame.place(point);
    if (!x.allFinite() || x.cwiseAbs().maxCoeff() > absurd) continue;
    if (path.empty() || (x - path.back()).norm() > least_step || &point == &body.trail.back()) path.push_back(x);
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    const float newness = float(i) / float(path.size() - 1);
    const float ink = 0.04f + 0.86f * newness * newness;
    const Colour colour = (1 - ink) * linear(background_hex) + ink * linear(trail_hex);
    list.trail.push_back({path[i - 1], trail_radius * (0.3f + 0.7f * newness), path[i], colour});
  }
}

/// Longest edge of a triangle that has a corner near the ball.
float longest_edge_near(const DrawList& list, const Rod& ball) {
  float longest = 0;
  for (std::size_t i = 0; i + 2 < list.cloth_index.size(); i += 3) {
    const auto at = [&](std::size_t k) { return list.cloth[list.cloth_index[i + k % 3]].x; };
    for (std::size_t k = 0; k < 3; ++k) {
      if ((at(k) - ball.a).norm() > 1.15f * ball.radius) continue;
      for (std::size_t m = 0; m < 3; ++m) longest = std::max(longest, (at(m) - at(m + 1)).norm());
    }
  }
  return longest;
}

/// Chooses a sphere around everything that is not absurdly far away, for the shadow maps.
void enclose(DrawList& list) {
  std::vector<std::pair<Eigen::Vector3f, float>> all;
  for (const ClothVertex& c : list.cloth) all.emplace_back(c.x, 0);
  for (const auto* rods : {&list.balls, &list.beads, &list.rods})
    for (const Rod& r : *rods) all.emplace_back(r.a, r.radius), all.emplace_back(r.b, r.radius);
  std::erase_if(all, [](const auto& each) { return each.first.cwiseAbs().maxCoeff() > near_view; });
  if (all.empty()) return;
  Eigen::AlignedBox3f box;
  for (const auto& [x, radius] : all)
    for (const float side : {-radius, radius}) box.extend((x.array() + side).matrix());
  list.centre = box.center();
  list.radius = 0.01f;
  for (const auto& [x, radius] : all) list.radius = std::max(list.radius, (x - list.centre).norm() + radius);
  list.radius *= 1.03f;  // keeps the outermost texels of shadow maps empty
}

}  // namespace

DrawList draw_list_of(const Panel& panel, const Frame& frame, const std::optional<Scale>& scale) {
  DrawList list;
  for (const Ball& ball : panel.balls) {
    const Eigen::Vector3f centre = frame.place(ball.centre);
    if (centre.allFinite() && ball.radius > 0)
      list.balls.push_back({centre, frame.length(ball.radius), centre, linear(ball_hex)});
  }
  for (const Body& body : panel.bodies) {
    const PlacedBody placed(body, frame, scale ? &*scale : nullptr);
    add_trail(body, frame, list);
    if (!std::ranges::all_of(placed.x, [](const auto& x) { return x.allFinite() && x.norm() < absurd; })) continue;
    add_rods(placed, add_cloth(placed, list), frame, list);
    add_beads(placed, frame, list);
    list.coloured = list.coloured || placed.coloured();
  }
  for (const Rod& ball : list.balls) {
    const float edge = longest_edge_near(list, ball);
    // the factor 2 allows for normals that only approximate those of the ball
    list.lift = std::max(list.lift, std::min(2 * edge * edge / (6 * ball.radius), 0.006f));
  }
  enclose(list);
  return list;
}

RodMesh rod_mesh(int around, int rings) {
  RodMesh mesh;
  for (const float end : {0.f, 1.f})
    for (int ring = 0; ring <= rings; ++ring) {
      const double latitude = 0.5 * std::numbers::pi * (double(ring) / rings - (end == 0 ? 1 : 0));
      for (int i = 0; i <= around; ++i) {
        const double angle = 2 * std::numbers::pi * (i % around) / around;
        mesh.corner.emplace_back(float(std::cos(latitude) * std::cos(angle)),
                                 float(std::cos(latitude) * std::sin(angle)), float(std::sin(latitude)), end);
      }
    }
  const auto at = [&](int row, int i) { return unsigned(row * (around + 1) + i); };
  for (int row = 0; row <= 2 * rings; ++row)
    for (int i = 0; i < around; ++i)
      for (const unsigned corner :
           {at(row, i), at(row, i + 1), at(row + 1, i + 1), at(row, i), at(row + 1, i + 1), at(row + 1, i)})
        mesh.index.push_back(corner);
  return mesh;
}

}  // namespace crosscheck::render
