// Camera and light: the coordinate frame in which everything is drawn, and samples of the light.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// Coordinate frame in which everything is drawn: the view's target is the origin, up is +y, the viewer is towards +z,
/// and the view is 1 high. In this frame scenes have a common size, and are lit from the same side of the viewer.
struct Frame {
  Eigen::Matrix3d axes;        // rows: right, up, towards the viewer; the first and the last are horizontal
  Vec3 origin;                 // target of the view, m
  double size = 1;             // height of the view at the target, m
  Eigen::Vector3f eye;         // in the frame
  Eigen::Matrix4f to_clip;     // maps the frame to clip space, without jitter
  std::optional<float> floor;  // height of the ground in the frame

  Eigen::Vector3f place(const Vec3& world) const { return (axes * (world - origin) / size).cast<float>(); }
  float length(double metres) const { return static_cast<float>(metres / size); }
};

/// Frame of a view. Throws std::runtime_error if the view is not finite or the eye is at the target.
Frame frame_of(const View& view, double aspect);

/// Axes of the frame (Frame::axes) for a direction towards the eye.
Eigen::Matrix3d upright_axes(const Vec3& towards_eye);

/// Direction towards the centre of the key light: steep, from the left behind the viewer.
Eigen::Vector3f key_direction();

/// Clip matrix of a distant light that covers the sphere, with depth 0..1 from its near to its far side.
Eigen::Matrix4f light_matrix(const Eigen::Vector3f& direction, const Eigen::Vector3f& centre, float radius);

// intensity of light on a surface that faces the key light, and on one that faces up under an open sky
constexpr float key_light = 0.66f, sky_light = 0.47f;

struct Sample {
  Eigen::Vector2f pixel;  // offset within the pixel, pixels
  Eigen::Vector3f key;    // direction towards a point on the key light
  Eigen::Vector3f sky;    // direction towards a point of the sky, uniform over the upper hemisphere
};

/// Deterministic low-discrepancy points, in a different order for each member of Sample.
std::vector<Sample> light_samples(int passes);

}  // namespace crosscheck::render
