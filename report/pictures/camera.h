// Camera and light: the coordinate frame of all drawing, and the light samples of an accumulated picture.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// The coordinate frame of all drawing: the view's target is the origin, up is +y, the viewer is towards +z, and the
/// view is 1 high. In this frame every scene has size one and is lit from the same side of the viewer, whatever its
/// unit and orientation.
struct Frame {
  Eigen::Matrix3d axes;        // rows: right, up, towards the viewer (both horizontal ones perpendicular to up)
  Vec3 origin;                 // the target, m
  double size = 1;             // height of the view at the target, m
  Eigen::Vector3f eye;         // in this frame
  Eigen::Matrix4f to_clip;     // this frame to clip space, without jitter
  std::optional<float> floor;  // height of the ground in this frame

  Eigen::Vector3f place(const Vec3& world) const { return (axes * (world - origin) / size).cast<float>(); }
  float length(double metres) const { return static_cast<float>(metres / size); }
};

/// Throws std::runtime_error if the view is not finite or the eye is at the target.
Frame frame_of(const View& view, double aspect);

/// Horizontal right and towards-the-viewer directions for a look along -towards, as rows 0 and 2; up is row 1.
Eigen::Matrix3d upright_axes(const Vec3& towards_eye);

/// Direction to the centre of the key light in the frame: steep, from the left behind the viewer.
Eigen::Vector3f key_direction();

/// Clip matrix of a distant light in this direction that covers the sphere: depth 0..1 from its near to its far side.
Eigen::Matrix4f light_matrix(const Eigen::Vector3f& direction, const Eigen::Vector3f& centre, float radius);

// light on a surface that faces the key light, and on one that faces up under an open sky
constexpr float key_light = 0.66f, sky_light = 0.47f;

struct Sample {
  Eigen::Vector2f pixel;  // offset within the pixel, pixels
  Eigen::Vector3f key;    // direction to a point of the key light
  Eigen::Vector3f sky;    // direction to a point of the sky, uniform over the upper hemisphere
};

/// Deterministic samples: low-discrepancy points, each of the three kinds in its own order.
std::vector<Sample> light_samples(int passes);

}  // namespace crosscheck::render
