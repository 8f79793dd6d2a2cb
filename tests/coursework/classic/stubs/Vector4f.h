// A vector of 4 floats, with all conversions that submissions use.
#pragma once

#include <cmath>
#include <cstdio>

#include "Vector3f.h"

class Vector4f {
 public:
  Vector4f(float all = 0.0f) {
    for (int i = 0; i < 4; ++i) e_[i] = all;
  }
  Vector4f(float x, float y, float z, float w) { set(x, y, z, w); }
  Vector4f(const Vector3f& xyz, float w) { set(xyz[0], xyz[1], xyz[2], w); }
  Vector4f(float x, const Vector3f& yzw) { set(x, yzw[0], yzw[1], yzw[2]); }
  Vector4f(const Vector2f& xy, float z, float w) { set(xy[0], xy[1], z, w); }
  Vector4f(const Vector2f& xy, const Vector2f& zw) { set(xy[0], xy[1], zw[0], zw[1]); }
  void set(float x, float y, float z, float w) {
    e_[0] = x;
    e_[1] = y;
    e_[2] = z;
    e_[3] = w;
  }
  void Set(float x, float y, float z, float w) { set(x, y, z, w); }
  const float& operator[](int i) const { return e_[i]; }
  float& operator[](int i) { return e_[i]; }
  float& x() { return e_[0]; }
  float x() const { return e_[0]; }
  float& y() { return e_[1]; }
  float y() const { return e_[1]; }
  float& z() { return e_[2]; }
  float z() const { return e_[2]; }
  float& w() { return e_[3]; }
  float w() const { return e_[3]; }
  Vector2f xy() const { return Vector2f(e_[0], e_[1]); }
  Vector2f yz() const { return Vector2f(e_[1], e_[2]); }
  Vector2f zw() const { return Vector2f(e_[2], e_[3]); }
  Vector2f xz() const { return Vector2f(e_[0], e_[2]); }
  Vector3f xyz() const { return Vector3f(e_[0], e_[1], e_[2]); }
  Vector3f yzw() const { return Vector3f(e_[1], e_[2], e_[3]); }
  Vector4f homogenized() const { return Vector4f(e_[0] / e_[3], e_[1] / e_[3], e_[2] / e_[3], 1.0f); }
  void homogenize() { *this = homogenized(); }
  float absSquared() const {
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) sum += e_[i] * e_[i];
    return sum;
  }
  float abs() const { return std::sqrt(absSquared()); }
  void normalize() {
    const float length = abs();
    for (int i = 0; i < 4; ++i) e_[i] /= length;
  }
  Vector4f normalized() const {
    Vector4f copy(*this);
    copy.normalize();
    return copy;
  }
  void negate() {
    for (int i = 0; i < 4; ++i) e_[i] = -e_[i];
  }
  operator const float*() const { return e_; }
  operator float*() { return e_; }
  void print() const { std::printf("< %.4f, %.4f, %.4f, %.4f >\n", e_[0], e_[1], e_[2], e_[3]); }
  Vector4f& operator+=(const Vector4f& other) {
    for (int i = 0; i < 4; ++i) e_[i] += other.e_[i];
    return *this;
  }
  Vector4f& operator-=(const Vector4f& other) {
    for (int i = 0; i < 4; ++i) e_[i] -= other.e_[i];
    return *this;
  }
  Vector4f& operator*=(const Vector4f& other) {
    for (int i = 0; i < 4; ++i) e_[i] *= other.e_[i];
    return *this;
  }
  Vector4f& operator/=(const Vector4f& other) {
    for (int i = 0; i < 4; ++i) e_[i] /= other.e_[i];
    return *this;
  }
  Vector4f& operator*=(float f) {
    for (int i = 0; i < 4; ++i) e_[i] *= f;
    return *this;
  }
  Vector4f& operator/=(float f) {
    for (int i = 0; i < 4; ++i) e_[i] /= f;
    return *this;
  }
  static float dot(const Vector4f& a, const Vector4f& b) {
    float sum = 0.0f;
    for (int i = 0; i < 4; ++i) sum += a.e_[i] * b.e_[i];
    return sum;
  }
  static Vector4f lerp(const Vector4f& a, const Vector4f& b, float alpha) {
    Vector4f result;
    for (int i = 0; i < 4; ++i) result.e_[i] = (1.0f - alpha) * a.e_[i] + alpha * b.e_[i];
    return result;
  }

 private:
  float e_[4];
};

inline Vector4f operator+(Vector4f a, const Vector4f& b) { return a += b; }
inline Vector4f operator-(Vector4f a, const Vector4f& b) { return a -= b; }
inline Vector4f operator*(Vector4f a, const Vector4f& b) { return a *= b; }
inline Vector4f operator/(Vector4f a, const Vector4f& b) { return a /= b; }
inline Vector4f operator-(Vector4f a) {
  a.negate();
  return a;
}
inline Vector4f operator*(Vector4f a, float f) { return a *= f; }
inline Vector4f operator*(float f, Vector4f a) { return a *= f; }
inline Vector4f operator/(Vector4f a, float f) { return a /= f; }
inline bool operator==(const Vector4f& a, const Vector4f& b) {
  for (int i = 0; i < 4; ++i)
    if (a[i] != b[i]) return false;
  return true;
}
inline bool operator!=(const Vector4f& a, const Vector4f& b) { return !(a == b); }
