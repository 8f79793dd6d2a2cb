// A quaternion w + xi + yj + zk.
#pragma once

#include <cmath>

#include "Matrix3f.h"
#include "Matrix4f.h"

class Quat4f {
 public:
  Quat4f() : Quat4f(0.0f, 0.0f, 0.0f, 0.0f) {}
  Quat4f(float w, float x, float y, float z) : e_{w, x, y, z} {}
  Quat4f(const Vector3f& v) : Quat4f(0.0f, v[0], v[1], v[2]) {}
  Quat4f(const Vector4f& v) : Quat4f(v[0], v[1], v[2], v[3]) {}
  const float& operator[](int i) const { return e_[i]; }
  float& operator[](int i) { return e_[i]; }
  float w() const { return e_[0]; }
  float x() const { return e_[1]; }
  float y() const { return e_[2]; }
  float z() const { return e_[3]; }
  Vector3f xyz() const { return Vector3f(e_[1], e_[2], e_[3]); }
  float absSquared() const { return e_[0] * e_[0] + xyz().absSquared(); }
  float abs() const { return std::sqrt(absSquared()); }
  Quat4f conjugated() const { return Quat4f(e_[0], -e_[1], -e_[2], -e_[3]); }
  void conjugate() { *this = conjugated(); }
  Quat4f normalized() const { return scaled(1.0f / abs()); }
  void normalize() { *this = normalized(); }
  Quat4f inverse() const { return conjugated().scaled(1.0f / absSquared()); }
  void invert() { *this = inverse(); }
  Quat4f scaled(float f) const { return Quat4f(f * e_[0], f * e_[1], f * e_[2], f * e_[3]); }
  void setAxisAngle(float radians, const Vector3f& axis) {
    const Vector3f u = std::sin(radians / 2.0f) * axis.normalized();
    *this = Quat4f(std::cos(radians / 2.0f), u[0], u[1], u[2]);
  }
  Vector3f getAxisAngle(float* radians) const {
    *radians = 2.0f * std::atan2(xyz().abs(), e_[0]);
    return xyz().abs() > 0.0f ? xyz().normalized() : Vector3f(1.0f, 0.0f, 0.0f);
  }
  static float dot(const Quat4f& a, const Quat4f& b) { return a.e_[0] * b.e_[0] + Vector3f::dot(a.xyz(), b.xyz()); }
  static const Quat4f ZERO, IDENTITY;

 private:
  float e_[4];
};

VECMATH_CONSTANT const Quat4f Quat4f::ZERO(0.0f, 0.0f, 0.0f, 0.0f);
VECMATH_CONSTANT const Quat4f Quat4f::IDENTITY(1.0f, 0.0f, 0.0f, 0.0f);

inline Quat4f operator+(const Quat4f& a, const Quat4f& b) {
  return Quat4f(a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]);
}
inline Quat4f operator*(float f, const Quat4f& a) { return a.scaled(f); }
inline Quat4f operator*(const Quat4f& a, float f) { return a.scaled(f); }
inline Quat4f operator-(const Quat4f& a, const Quat4f& b) { return a + b.scaled(-1.0f); }
inline Quat4f operator*(const Quat4f& a, const Quat4f& b) {
  const Vector3f v = a[0] * b.xyz() + b[0] * a.xyz() + Vector3f::cross(a.xyz(), b.xyz());
  return Quat4f(a[0] * b[0] - Vector3f::dot(a.xyz(), b.xyz()), v[0], v[1], v[2]);
}

inline Matrix3f Matrix3f::rotation(const Quat4f& q) {
  float radians = 0.0f;
  const Vector3f axis = q.getAxisAngle(&radians);
  return rotation(axis, radians);
}
inline Matrix4f Matrix4f::rotation(const Quat4f& q) {
  float radians = 0.0f;
  const Vector3f axis = q.getAxisAngle(&radians);
  return rotation(axis, radians);
}
