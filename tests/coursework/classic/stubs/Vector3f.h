// A vector of 3 floats, with all conversions that submissions use.
#pragma once

#include <cmath>
#include <cstdio>

#include "Vector2f.h"

class Vector3f {
 public:
  Vector3f(float all = 0.0f) {
    for (int i = 0; i < 3; ++i) e_[i] = all;
  }
  Vector3f(float x, float y, float z) { set(x, y, z); }
  Vector3f(const Vector2f& xy, float z) { set(xy[0], xy[1], z); }
  Vector3f(float x, const Vector2f& yz) { set(x, yz[0], yz[1]); }
  void set(float x, float y, float z) {
    e_[0] = x;
    e_[1] = y;
    e_[2] = z;
  }
  void Set(float x, float y, float z) { set(x, y, z); }
  const float& operator[](int i) const { return e_[i]; }
  float& operator[](int i) { return e_[i]; }
  float& x() { return e_[0]; }
  float x() const { return e_[0]; }
  float& y() { return e_[1]; }
  float y() const { return e_[1]; }
  float& z() { return e_[2]; }
  float z() const { return e_[2]; }
  Vector2f xy() const { return Vector2f(e_[0], e_[1]); }
  Vector2f yz() const { return Vector2f(e_[1], e_[2]); }
  Vector2f xz() const { return Vector2f(e_[0], e_[2]); }
  Vector3f xyz() const { return *this; }
  Vector3f yzx() const { return Vector3f(e_[1], e_[2], e_[0]); }
  Vector3f zxy() const { return Vector3f(e_[2], e_[0], e_[1]); }
  Vector2f homogenized() const { return Vector2f(e_[0] / e_[2], e_[1] / e_[2]); }
  float absSquared() const {
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) sum += e_[i] * e_[i];
    return sum;
  }
  float abs() const { return std::sqrt(absSquared()); }
  void normalize() {
    const float length = abs();
    for (int i = 0; i < 3; ++i) e_[i] /= length;
  }
  Vector3f normalized() const {
    Vector3f copy(*this);
    copy.normalize();
    return copy;
  }
  void negate() {
    for (int i = 0; i < 3; ++i) e_[i] = -e_[i];
  }
  operator const float*() const { return e_; }
  operator float*() { return e_; }
  void print() const { std::printf("< %.4f, %.4f, %.4f >\n", e_[0], e_[1], e_[2]); }
  Vector3f& operator+=(const Vector3f& other) {
    for (int i = 0; i < 3; ++i) e_[i] += other.e_[i];
    return *this;
  }
  Vector3f& operator-=(const Vector3f& other) {
    for (int i = 0; i < 3; ++i) e_[i] -= other.e_[i];
    return *this;
  }
  Vector3f& operator*=(const Vector3f& other) {
    for (int i = 0; i < 3; ++i) e_[i] *= other.e_[i];
    return *this;
  }
  Vector3f& operator/=(const Vector3f& other) {
    for (int i = 0; i < 3; ++i) e_[i] /= other.e_[i];
    return *this;
  }
  Vector3f& operator*=(float f) {
    for (int i = 0; i < 3; ++i) e_[i] *= f;
    return *this;
  }
  Vector3f& operator/=(float f) {
    for (int i = 0; i < 3; ++i) e_[i] /= f;
    return *this;
  }
  static float dot(const Vector3f& a, const Vector3f& b) {
    float sum = 0.0f;
    for (int i = 0; i < 3; ++i) sum += a.e_[i] * b.e_[i];
    return sum;
  }
  static Vector3f cross(const Vector3f& a, const Vector3f& b) {
    return Vector3f(a.e_[1] * b.e_[2] - a.e_[2] * b.e_[1], a.e_[2] * b.e_[0] - a.e_[0] * b.e_[2],
                    a.e_[0] * b.e_[1] - a.e_[1] * b.e_[0]);
  }
  static Vector3f lerp(const Vector3f& a, const Vector3f& b, float alpha) {
    Vector3f result;
    for (int i = 0; i < 3; ++i) result.e_[i] = (1.0f - alpha) * a.e_[i] + alpha * b.e_[i];
    return result;
  }
  static const Vector3f ZERO;
  static const Vector3f UP;
  static const Vector3f RIGHT;
  static const Vector3f FORWARD;

 private:
  float e_[3];
};

// weak, so that a header may define the constants under C++14
VECMATH_CONSTANT const Vector3f Vector3f::ZERO(0.0f, 0.0f, 0.0f);
VECMATH_CONSTANT const Vector3f Vector3f::UP(0.0f, 1.0f, 0.0f);
VECMATH_CONSTANT const Vector3f Vector3f::RIGHT(1.0f, 0.0f, 0.0f);
VECMATH_CONSTANT const Vector3f Vector3f::FORWARD(0.0f, 0.0f, -1.0f);

inline Vector3f operator+(Vector3f a, const Vector3f& b) { return a += b; }
inline Vector3f operator-(Vector3f a, const Vector3f& b) { return a -= b; }
inline Vector3f operator*(Vector3f a, const Vector3f& b) { return a *= b; }
inline Vector3f operator/(Vector3f a, const Vector3f& b) { return a /= b; }
inline Vector3f operator-(Vector3f a) {
  a.negate();
  return a;
}
inline Vector3f operator*(Vector3f a, float f) { return a *= f; }
inline Vector3f operator*(float f, Vector3f a) { return a *= f; }
inline Vector3f operator/(Vector3f a, float f) { return a /= f; }
inline bool operator==(const Vector3f& a, const Vector3f& b) {
  for (int i = 0; i < 3; ++i)
    if (a[i] != b[i]) return false;
  return true;
}
inline bool operator!=(const Vector3f& a, const Vector3f& b) { return !(a == b); }
inline Vector3f Vector2f::cross(const Vector2f& a, const Vector2f& b) {
  return Vector3f(0.0f, 0.0f, a[0] * b[1] - a[1] * b[0]);
}
