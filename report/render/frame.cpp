// Camera and light matrices.
#include "report/render/frame.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace crosscheck::render {
namespace {

/// Rigid motion that puts `eye` at the origin, looking along -z at the frame's origin.
Eigen::Matrix4f look_at_origin(const Eigen::Vector3f& eye) {
  const Eigen::Vector3f back = eye.normalized();
  // straight from above the viewer's side is the lower edge of the picture
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

Eigen::Matrix3d upright_axes(const Vec3& towards_eye, const Vec3& up) {
  const Vec3 y = up.normalized();
  Vec3 z = towards_eye - y * y.dot(towards_eye);
  if (z.norm() < 1e-6 * towards_eye.norm()) {
    Vec3::Index least;
    y.cwiseAbs().minCoeff(&least);
    z = Vec3::Unit(least) - y * y[least];
  }
  z.normalize();
  Eigen::Matrix3d axes;
  axes << y.cross(z).transpose(), y.transpose(), z.transpose();
  return axes;
}

Frame frame_of(const View& view, double aspect) {
  const Vec3 towards = view.eye - view.target;
  const bool usable = view.eye.allFinite() && view.target.allFinite() && view.up.allFinite() && view.up.norm() > 0 &&
                      towards.norm() > 0 && view.field_of_view > 0 && view.field_of_view < 170;
  if (!usable) throw std::runtime_error("render: the view has no finite eye, target, up and field of view");

  Frame frame;
  const double tan_half = std::tan(view.field_of_view * std::numbers::pi / 360);
  frame.axes = upright_axes(towards, view.up);
  frame.origin = view.target;
  frame.size = 2 * towards.norm() * tan_half;
  frame.eye = frame.place(view.eye);
  const float distance = frame.eye.norm();
  frame.to_clip =
      perspective(float(tan_half), float(aspect), 0.02f * distance, 40 * distance) * look_at_origin(frame.eye);
  if (view.floor) {
    frame.floor = float((*view.floor - view.up.normalized().dot(view.target)) / frame.size);
  }
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

}  // namespace crosscheck::render
