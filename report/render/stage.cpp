// Turns the bodies of a panel into what the painter draws.
//
// A cloth triangle is flat, a ball is not: with all three corners exactly on a ball of radius R, the middle of an edge
// of length l dips l^2 / (8 R) into it and the middle of the triangle l^2 / (6 R): the ball would poke through although
// no particle is inside. The cloth is therefore drawn as a curved surface through the particles (cloth.cpp); `lift` is
// the depth that its smaller flat pieces may still dip. The painter moves the cloth towards the eye by as much, in
// depth only, and takes its shadows from there. Whatever is deeper inside than `lift` is seen inside.
#include "report/render/stage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "report/render/placed_body.h"

namespace crosscheck::render {
namespace {

// sizes chosen by the view, in heights of the view
constexpr float few_tubes_radius = 0.0075f, bead_radius = 0.027f, pin_radius = 0.0085f, trail_radius = 0.0032f;

constexpr unsigned plain_tube = 0x8E9196, plain_bead = 0xDDA15E, pin_hex = 0x34363B, ball_hex = 0xB6BBC3;
constexpr unsigned trail_hex = 0x6C7A91, loose_thread = 0x6F6A62;

float tube_radius(const PlacedBody& placed, const Frame& frame) {
  if (placed.body.tube_radius > 0) return frame.length(placed.body.tube_radius);
  return std::min(few_tubes_radius, 0.16f * placed.median_length(placed.body.tubes));
}

float radius_of_beads(const Body& body, const Frame& frame) {
  return body.bead_radius < 0 ? bead_radius : frame.length(body.bead_radius);
}

Colour tube_colour(const PlacedBody& placed, std::size_t i) {
  const Body& body = placed.body;
  if (placed.scale && !body.tube_value.empty()) {
    return to_linear(scale_colour(placed.scale->diverging, scale_position(*placed.scale, body.tube_value[i])));
  }
  return linear(body.tube_colour.empty() ? plain_tube : palette_hex(body.tube_colour[i]));
}

void add_rods(const PlacedBody& placed, const std::vector<std::array<int, 2>>& loose, const Frame& frame,
              Stage& stage) {
  const float radius = tube_radius(placed, frame);
  for (std::size_t i = 0; i < placed.body.tubes.size(); ++i) {
    const auto [a, b] = placed.body.tubes[i];
    if (!placed.is_sound(a) || !placed.is_sound(b)) continue;
    stage.rods.push_back({placed.at(a), radius, placed.at(b), tube_colour(placed, i)});
  }
  const float thin = std::min(0.3f * few_tubes_radius, 0.04f * placed.median_length(loose));
  for (const auto& [a, b] : loose) {
    if (!placed.is_sound(a) || !placed.is_sound(b)) continue;
    stage.rods.push_back({placed.at(a), thin, placed.at(b), linear(loose_thread)});
  }
}

void add_beads(const PlacedBody& placed, const Frame& frame, Stage& stage) {
  const Body& body = placed.body;
  const float radius = radius_of_beads(body, frame);
  std::vector<bool> pinned(placed.x.size(), false);
  for (const int i : body.pinned) pinned[std::size_t(i)] = true;
  for (int i = 0; i < int(placed.x.size()); ++i) {
    if (!placed.is_sound(i)) continue;
    if (pinned[std::size_t(i)]) {
      // a pin must show whatever is drawn around it
      const float least = std::max(0.8f * radius, body.tubes.empty() ? 0 : 1.7f * tube_radius(placed, frame));
      stage.beads.push_back({placed.at(i), std::max(pin_radius, least), linear(pin_hex)});
    } else if (radius > 0) {
      const Colour colour =
          placed.coloured() ? to_linear(scale_colour(placed.scale->diverging, placed.position(i))) : linear(plain_bead);
      stage.beads.push_back({placed.at(i), radius, colour});
    }
  }
}

/// The path as rods that grow and darken towards now, the oldest first.
void add_trail(const Body& body, const Frame& frame, Stage& stage) {
  constexpr float least_step = 0.004f;  // heights of the view: shorter steps of the path are joined
  std::vector<Eigen::Vector3f> path;
  for (const Vec3& point : body.trail) {
    const Eigen::Vector3f x = frame.place(point);
    if (!x.allFinite() || x.cwiseAbs().maxCoeff() > 200) continue;
    if (path.empty() || (x - path.back()).norm() > least_step || &point == &body.trail.back()) path.push_back(x);
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    const float newness = float(i) / float(path.size() - 1);
    const float ink = 0.04f + 0.86f * newness * newness;
    const Colour colour = (1 - ink) * linear(background_hex) + ink * linear(trail_hex);
    stage.trail.push_back({path[i - 1], trail_radius * (0.3f + 0.7f * newness), path[i], colour});
  }
}

/// Longest edge of a triangle that has a corner close to the ball.
float longest_edge_near(const Stage& stage, const Sphere& ball) {
  float longest = 0;
  for (std::size_t i = 0; i + 2 < stage.cloth_index.size(); i += 3) {
    const auto at = [&](std::size_t k) { return stage.cloth[stage.cloth_index[i + k % 3]].x; };
    for (std::size_t k = 0; k < 3; ++k) {
      if ((at(k) - ball.centre).norm() > 1.15f * ball.radius) continue;
      for (std::size_t m = 0; m < 3; ++m) longest = std::max(longest, (at(m) - at(m + 1)).norm());
    }
  }
  return longest;
}

/// A sphere around what is not absurdly far out of view: the shadow maps are spread over it.
void enclose(Stage& stage) {
  constexpr float near_view = 2.5f;
  Eigen::AlignedBox3f box;
  const auto add = [&](const Eigen::Vector3f& x, float radius) {
    if (x.cwiseAbs().maxCoeff() > near_view) return;
    box.extend(x - Eigen::Vector3f::Constant(radius)), box.extend(x + Eigen::Vector3f::Constant(radius));
  };
  for (const ClothCorner& c : stage.cloth) add(c.x, 0);
  for (const Sphere& s : stage.balls) add(s.centre, s.radius);
  for (const Sphere& s : stage.beads) add(s.centre, s.radius);
  for (const Rod& r : stage.rods) add(r.a, r.radius), add(r.b, r.radius);
  if (box.isEmpty()) return;
  stage.centre = box.center();
  const auto reach = [&](const Eigen::Vector3f& x, float radius) {
    if (x.cwiseAbs().maxCoeff() <= near_view) stage.radius = std::max(stage.radius, (x - stage.centre).norm() + radius);
  };
  stage.radius = 0.01f;
  for (const ClothCorner& c : stage.cloth) reach(c.x, 0);
  for (const Sphere& s : stage.balls) reach(s.centre, s.radius);
  for (const Sphere& s : stage.beads) reach(s.centre, s.radius);
  for (const Rod& r : stage.rods) reach(r.a, r.radius), reach(r.b, r.radius);
  stage.radius *= 1.03f;  // the outermost texels of a shadow map stay empty
}

}  // namespace

Stage stage_of(const Panel& panel, const Frame& frame, const std::optional<Scale>& scale) {
  Stage stage;
  for (const Ball& ball : panel.balls) {
    const Sphere sphere{frame.place(ball.centre), frame.length(ball.radius), linear(ball_hex)};
    if (sphere.centre.allFinite() && std::isfinite(sphere.radius)) stage.balls.push_back(sphere);
  }
  for (const Body& body : panel.bodies) {
    const PlacedBody placed = place_body(body, frame, scale ? &*scale : nullptr);
    add_rods(placed, add_cloth(placed, stage), frame, stage);
    add_beads(placed, frame, stage);
    add_trail(body, frame, stage);
    stage.coloured = stage.coloured || placed.coloured();
  }
  for (const Sphere& ball : stage.balls) {
    const float edge = longest_edge_near(stage, ball);
    // the factor is for normals that are only near the ball's
    if (ball.radius > 0) stage.lift = std::max(stage.lift, std::min(2 * edge * edge / (6 * ball.radius), 0.006f));
  }
  enclose(stage);
  return stage;
}

}  // namespace crosscheck::render
