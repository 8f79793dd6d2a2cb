// Low-discrepancy samples of pixel, key light and sky (Hammersley and Halton points).
#include "report/render/lights.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "report/render/frame.h"

namespace crosscheck::render {
namespace {

constexpr float key_light_radius = 0.13f;  // of its distance: the width of the penumbra
constexpr float pixel_width = 1.3f;        // of the box filter, pixels

float radical_inverse(int base, int i) {
  double inverse = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) inverse += digit * (i % base);
  return float(inverse);
}

float fraction(float x) { return x - std::floor(x); }

}  // namespace

std::vector<Sample> light_samples(int passes) {
  const Eigen::Vector3f key = key_direction();
  const Eigen::Vector3f across = Eigen::Vector3f::UnitX().cross(key).normalized(), along = key.cross(across);
  std::vector<Sample> samples;
  for (int i = 0; i < passes; ++i) {
    Sample sample;
    sample.pixel = pixel_width * Eigen::Vector2f(radical_inverse(2, i + 1) - 0.5f, radical_inverse(3, i + 1) - 0.5f);

    // uniform over a hemisphere: the height is uniform
    const float height = (float(i) + 0.5f) / float(passes);
    const float angle = 2 * std::numbers::pi_v<float> * radical_inverse(2, i);
    const float flat = std::sqrt(1 - height * height);
    sample.sky = {flat * std::cos(angle), height, flat * std::sin(angle)};

    // uniform over a disc, shifted so that it does not go in step with the pixel
    const float radius = key_light_radius * std::sqrt(fraction(radical_inverse(3, i + 1) + 0.37f));
    const float turn = 2 * std::numbers::pi_v<float> * radical_inverse(5, i + 1);
    sample.key = (key + radius * (std::cos(turn) * across + std::sin(turn) * along)).normalized();
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace crosscheck::render
