#include "report/pictures/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace crosscheck::render {
namespace {

/// Rigid motion that moves `eye` to the origin, where it looks along -z at the former origin.
Eigen::Matrix4f look_at_origin(const Eigen::Vector3f& eye) {
  const Eigen::Vector3f back = eye.normalized();
  // if the scene is seen from straight above, the viewer's side is at the bottom of the picture
  const Eigen::Vector3f up = std::abs(back.y()) > 0.9999f ? Eigen::Vector3f(0, 0, -1) : Eigen::Vector3f(0, 1, 0);
  const Eigen::Vector3f right = up.cross(back).normalized();
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  m.block<1, 3>(0, 0) = right.transpose();
  m.block<1, 3>(1, 0) = back.cross(right).transpose();
  m.block<1, 3>(2, 0) = back.transpose();
  m.block<3, 1>(0, 3) = -m.block<3, 3>(0, 0) * eye;
  return m;
}

Eigen::Matrix4f perspective(float tan_half, float aspect, float near, float far) {
  Eigen::Matrix4f m = Eigen::Matrix4f::Zero();
  m(0, 0) = 1 / (tan_half * aspect);
  m(1, 1) = 1 / tan_half;
  m(2, 2) = -(far + near) / (far - near);
  m(2, 3) = -2 * far * near / (far - near);
  m(3, 2) = -1;
  return m;
}

}  // namespace

Eigen::Matrix3d upright_axes(const Vec3& towards_eye) {
  const bool from_above = std::hypot(towards_eye.x(), towards_eye.z()) < 1e-6 * towards_eye.norm();
  const Vec3 z = from_above ? Vec3(0, 0, 1) : Vec3(towards_eye.x(), 0, towards_eye.z()).normalized();
  Eigen::Matrix3d axes;
  axes << Vec3::UnitY().cross(z).transpose(), 0, 1, 0, z.transpose();
  return axes;
}

Frame frame_of(const View& view, double aspect) {
  const Vec3 towards = view.eye - view.target;
  if (!view.eye.allFinite() || !view.target.allFinite() || !(towards.norm() > 0))
    throw std::runtime_error("render: the view has no finite eye and target");

  Frame frame;
  const double tan_half = std::tan(field_of_view * std::numbers::pi / 360);
  frame.axes = upright_axes(towards);
  frame.origin = view.target;
  frame.size = 2 * towards.norm() * tan_half;
  frame.eye = frame.place(view.eye);
  const float distance = frame.eye.norm();
  frame.to_clip =
      perspective(float(tan_half), float(aspect), 0.02f * distance, 40 * distance) * look_at_origin(frame.eye);
  if (view.floor) frame.floor = float((*view.floor - view.target.y()) / frame.size);
  return frame;
}

Eigen::Vector3f key_direction() { return Eigen::Vector3f(-0.30f, 1, 0.44f).normalized(); }

Eigen::Matrix4f light_matrix(const Eigen::Vector3f& direction, const Eigen::Vector3f& centre, float radius) {
  const Eigen::Vector3f side = (std::abs(direction.y()) > 0.99f ? Eigen::Vector3f(1, 0, 0) : Eigen::Vector3f(0, 1, 0));
  const Eigen::Vector3f x = side.cross(direction).normalized(), y = direction.cross(x);
  Eigen::Matrix4f m = Eigen::Matrix4f::Identity();
  m.block<1, 3>(0, 0) = x.transpose() / radius;
  m.block<1, 3>(1, 0) = y.transpose() / radius;
  m.block<1, 3>(2, 0) = -direction.transpose() / radius;
  m.block<3, 1>(0, 3) = -m.block<3, 3>(0, 0) * centre;
  return m;
}

namespace {

constexpr float key_light_radius = 0.13f;  // radius of the light / its distance; determines the penumbra
constexpr float pixel_width = 1.3f;        // width of the box filter, pixels

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

    // on a hemisphere, a uniform height gives a uniform density
    const float height = (float(i) + 0.5f) / float(passes);
    const float angle = 2 * std::numbers::pi_v<float> * radical_inverse(2, i);
    const float flat = std::sqrt(1 - height * height);
    sample.sky = {flat * std::cos(angle), height, flat * std::sin(angle)};

    // uniform on a disc, shifted to avoid correlation with the pixel
    const float radius = key_light_radius * std::sqrt(fraction(radical_inverse(3, i + 1) + 0.37f));
    const float turn = 2 * std::numbers::pi_v<float> * radical_inverse(5, i + 1);
    sample.key = (key + radius * (std::cos(turn) * across + std::sin(turn) * along)).normalized();
    samples.push_back(sample);
  }
  return samples;
}

// The nearest camera in a given direction that sees everything. In camera axes (a to the right, b up, c towards the
// eye), a point is between the left and right edges if |a - A| <= s (C - c), with the eye at (A, B, C) and s the
// tangent of half the horizontal field of view. These conditions are linear in A and C, so the smallest C follows from
// the extremes of a + s c and -a + s c; likewise for b.

namespace {

constexpr double body_part = 1 - 2 * 0.06;  // fraction of the view for bodies and balls: a margin of 6 % on each side
constexpr double least_part = 0.7;          // minimum of body_part, even if shadows are cut off
constexpr double shadow_part = 1 - 2 * 0.015;  // fraction of the view for shadows
constexpr double clearance = 0.08;             // height of the lowest point above the ground / size

/// The conditions at both edges along an axis of the picture, for one slope.
struct Wedge {
  double slope;
  double upper = -std::numeric_limits<double>::infinity();  // maximum of  a + slope c
  double lower = -std::numeric_limits<double>::infinity();  // maximum of -a + slope c

  void hold(double a, double c, double radius) {
    const double reach = radius * std::sqrt(1 + slope * slope);  // maximum of a + slope c over a ball at the origin
    upper = std::max(upper, a + slope * c + reach);
    lower = std::max(lower, -a + slope * c + reach);
  }
  double least_distance() const { return (upper + lower) / (2 * slope); }
};

/// Conditions of bodies and shadows along an axis of the picture. `body` is for the largest part of the view that
/// bodies may fill, and `least` for the smallest.
struct Axis {
  Wedge body, least, shadow;
  /// `tangent`: half the width of the view at distance 1; `bead`: radius of the beads drawn around particles.
  Axis(double tangent, double bead)
      : body{tangent * body_part - bead}, least{tangent * least_part - bead}, shadow{tangent * shadow_part} {}

  void hold(double a, double c, double radius) { body.hold(a, c, radius), least.hold(a, c, radius); }
  /// Coordinate of the eye that centres the bodies.
  double middle() const { return (body.upper - body.lower) / 2; }
  double nearest() const { return body.least_distance(); }
  double farthest() const { return least.least_distance(); }
  /// Smallest distance at which all shadows are visible while the bodies are centred.
  double shadows_seen() const { return std::max(shadow.upper - middle(), shadow.lower + middle()) / shadow.slope; }
};

}  // namespace

View fit_view(const std::vector<Points>& points, const std::vector<Ball>& balls, const Vec3& direction, double aspect,
              bool ground) {
  std::vector<Ball> all = balls;
  for (const Points& set : points) {
    for (Eigen::Index i = 0; i < set.cols(); ++i) all.push_back({set.col(i), 0});
  }
  std::erase_if(all, [](const Ball& b) { return !b.centre.allFinite() || !std::isfinite(b.radius); });
  if (all.empty()) all.push_back({Vec3::Zero(), 0.5});

  Eigen::AlignedBox3d box;
  double lowest = std::numeric_limits<double>::infinity();
  for (const Ball& b : all) {
    box.extend(b.centre - Vec3::Constant(b.radius)), box.extend(b.centre + Vec3::Constant(b.radius));
    lowest = std::min(lowest, b.centre.y() - b.radius);
  }
  double size = box.diagonal().norm();
  if (!(size > 0)) {  // a single point gets a view of 1 m
    size = 1;
    all.push_back({box.center(), 0.5});
  }
  const double floor = lowest - clearance * size;

  const Vec3 back = direction.norm() > 0 ? direction.normalized() : Vec3(0, 0, 1);
  const Eigen::Matrix3d upright = upright_axes(back);
  const Vec3 right = upright.row(0).transpose(), top = back.cross(right);
  const Vec3 key = upright.transpose() * key_direction().cast<double>();

  const double tangent = std::tan(field_of_view * std::numbers::pi / 360);
  if (!(aspect > 0)) aspect = 1;
  const double bead = 0.03 * tangent * std::min(1.0, aspect);
  Axis horizontal(tangent * aspect, bead), vertical(tangent, bead);
  const Vec3 origin = box.center();
  for (const Ball& b : all) {
    const Vec3 x = b.centre - origin;
    horizontal.hold(right.dot(x), back.dot(x), b.radius);
    vertical.hold(top.dot(x), back.dot(x), b.radius);

    // the shadow on the ground is represented by a point, or by points on a circle
    const Vec3 foot = x - key * ((b.centre.y() - floor) / key.y());
    for (int i = 0; ground && i < (b.radius > 0 ? 8 : 1); ++i) {
      const double angle = i * std::numbers::pi / 4;
      const Vec3 rim = foot + 1.1 * b.radius * Vec3(std::cos(angle), 0, std::sin(angle));
      horizontal.shadow.hold(right.dot(rim), back.dot(rim), 0);
      vertical.shadow.hold(top.dot(rim), back.dot(rim), 0);
    }
  }
  const double nearest = std::max(horizontal.nearest(), vertical.nearest());
  const double farthest = std::max(horizontal.farthest(), vertical.farthest());
  const double distance = std::clamp(std::max(horizontal.shadows_seen(), vertical.shadows_seen()), nearest, farthest);
  View view;
  view.eye = origin + right * horizontal.middle() + top * vertical.middle() + back * distance;
  view.target = view.eye - back * distance;
  if (ground) view.floor = floor;
  return view;
}

}  // namespace crosscheck::render
