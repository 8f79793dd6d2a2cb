// The light and camera samples of an accumulated picture: one point of the key light, sky and pixel per pass.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace crosscheck::render {

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
