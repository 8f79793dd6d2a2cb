// Finds the nearest camera in a given direction whose view holds everything.
//
// In camera axes (a to the right, b up, c towards the eye) a point is inside the left and right edges if
// |a - A| <= s (C - c), with the eye at (A, B, C) and s the tangent of half the horizontal field of view. All these
// conditions are linear in A and C, so the smallest C comes from the extremes of a + s c and -a + s c; likewise for b.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "report/render/frame.h"

namespace crosscheck::render {
namespace {

constexpr double body_part = 1 - 2 * 0.06;  // of the view that bodies and balls may fill: a margin of 6 % on each side
constexpr double shadow_part = 1 - 2 * 0.015;  // of the view that shadows may fill
constexpr double clearance = 0.08;             // of the size: height of the lowest point above the ground

/// Conditions from both sides along one axis of the picture, for one slope.
struct Wedge {
  double slope;
  double upper = -std::numeric_limits<double>::infinity();  // greatest of  a + slope c
  double lower = -std::numeric_limits<double>::infinity();  // greatest of -a + slope c

  void hold(double a, double c, double radius) {
    const double reach = radius * std::sqrt(1 + slope * slope);  // a sphere touches the slanted plane
    upper = std::max(upper, a + slope * c + reach);
    lower = std::max(lower, -a + slope * c + reach);
  }
  double least_distance(const Wedge& other) const { return (upper + other.lower) / (slope + other.slope); }
};

/// Bodies and shadows along one axis of the picture.
struct Axis {
  Wedge body, shadow;
  /// Half the width of the view at distance 1 along this axis, and what beads may stick out beyond their middle.
  Axis(double tangent, double bead) : body{tangent * body_part - bead}, shadow{tangent * shadow_part} {}

  double least_distance() const {
    return std::max({body.least_distance(body), body.least_distance(shadow), shadow.least_distance(body),
                     shadow.least_distance(shadow)});
  }
  /// Where to put the eye at a distance: bodies in the middle if the shadows allow it.
  double middle(double distance) const {
    const double least = std::max(body.upper - body.slope * distance, shadow.upper - shadow.slope * distance);
    const double most = std::min(body.slope * distance - body.lower, shadow.slope * distance - shadow.lower);
    const double wanted = (body.upper - body.lower) / 2;
    return least < most ? std::clamp(wanted, least, most) : (least + most) / 2;
  }
};

}  // namespace

View view_that_holds(const std::vector<Points>& points, const std::vector<Ball>& balls, const Vec3& direction,
                     double aspect, const Vec3& up) {
  View view;
  view.up = up.normalized();
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
    lowest = std::min(lowest, view.up.dot(b.centre) - b.radius);
  }
  double size = box.diagonal().norm();
  if (!(size > 0)) {  // a single point: show it in a view of 1 m
    size = 1;
    all.push_back({box.center(), 0.5});
  }
  view.floor = lowest - clearance * size;

  const Vec3 back = direction.norm() > 0 ? direction.normalized() : Vec3(0, 0, 1);
  const Eigen::Matrix3d upright = upright_axes(back, view.up);
  const Vec3 right = upright.row(0).transpose(), top = back.cross(right);
  const Vec3 key = upright.transpose() * key_direction().cast<double>();

  const double tangent = std::tan(view.field_of_view * std::numbers::pi / 360);
  Axis horizontal(tangent * (aspect > 0 ? aspect : 1), 0.03 * tangent), vertical(tangent, 0.03 * tangent);
  const Vec3 origin = box.center();
  for (const Ball& b : all) {
    const Vec3 x = b.centre - origin;
    horizontal.body.hold(right.dot(x), back.dot(x), b.radius);
    vertical.body.hold(top.dot(x), back.dot(x), b.radius);

    // its shadow on the ground: a point, or a circle of a few points
    const Vec3 foot = x - key * ((view.up.dot(b.centre) - *view.floor) / view.up.dot(key));
    for (int i = 0; i < (b.radius > 0 ? 8 : 1); ++i) {
      const double angle = i * std::numbers::pi / 4;
      const Vec3 rim =
          foot + 1.1 * b.radius * (std::cos(angle) * upright.row(0) + std::sin(angle) * upright.row(2)).transpose();
      horizontal.shadow.hold(right.dot(rim), back.dot(rim), 0);
      vertical.shadow.hold(top.dot(rim), back.dot(rim), 0);
    }
  }
  const double distance = std::max(horizontal.least_distance(), vertical.least_distance());
  view.eye = origin + right * horizontal.middle(distance) + top * vertical.middle(distance) + back * distance;
  view.target = view.eye - back * distance;
  return view;
}

}  // namespace crosscheck::render
