// Camera and light: the frame that all drawing happens in, and the samples of light of an accumulated picture.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "report/pictures/picture.h"

namespace crosscheck::render {

/// The frame of all drawing, with the view's target at the origin, up = +y, the viewer towards +z and the view 1 high.
/// In it every scene is of size one and lit from the same side of the viewer, whatever its unit and direction.
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

/// Horizontal right and towards-the-viewer for a look along -towards, as rows 0 and 2; up is row 1.
Eigen::Matrix3d upright_axes(const Vec3& towards_eye);

/// Direction to the middle of the key light in the frame: steep, from the left behind the viewer.
Eigen::Vector3f key_direction();

/// Clip matrix of a light far away in this direction that holds the sphere: depth 0..1 from its near to its far side.
Eigen::Matrix4f light_matrix(const Eigen::Vector3f& direction, const Eigen::Vector3f& centre, float radius);

// light that falls on a surface facing the key light, and on one facing up under an open sky
constexpr float key_light = 0.66f, sky_light = 0.47f;

struct Sample {
  Eigen::Vector2f pixel;  // offset within the pixel, pixels
  Eigen::Vector3f key;    // direction to a point of the key light
  Eigen::Vector3f sky;    // direction to a point of the sky, uniform over the upper hemisphere
};

/// The same samples every time: low-discrepancy points, each of the three kinds in its own order.
std::vector<Sample> light_samples(int passes);

}  // namespace crosscheck::render
