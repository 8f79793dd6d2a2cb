// A vector of 2 floats, with all conversions that submissions use.
#pragma once

#include <cmath>
#include <cstdio>

class Vector3f;

class Vector2f {
 public:
  Vector2f(float all = 0.0f) {
    for (int i = 0; i < 2; ++i) e_[i] = all;
  }
  Vector2f(float x, float y) { set(x, y); }
  void set(float x, float y) {
    e_[0] = x;
    e_[1] = y;
  }
  void Set(float x, float y) { set(x, y); }
  const float& operator[](int i) const { return e_[i]; }
  float& operator[](int i) { return e_[i]; }
  float& x() { return e_[0]; }
  float x() const { return e_[0]; }
  float& y() { return e_[1]; }
  float y() const { return e_[1]; }
  Vector2f xy() const { return *this; }
  Vector2f yx() const { return Vector2f(e_[1], e_[0]); }
  Vector2f normal() const { return Vector2f(-e_[1], e_[0]); }
  float absSquared() const {
    float sum = 0.0f;
    for (int i = 0; i < 2; ++i) sum += e_[i] * e_[i];
    return sum;
  }
  float abs() const { return std::sqrt(absSquared()); }
  void normalize() {
    const float length = abs();
    for (int i = 0; i < 2; ++i) e_[i] /= length;
  }
  Vector2f normalized() const {
    Vector2f copy(*this);
    copy.normalize();
    return copy;
  }
  void negate() {
    for (int i = 0; i < 2; ++i) e_[i] = -e_[i];
  }
  operator const float*() const { return e_; }
  operator float*() { return e_; }
  void print() const { std::printf("< %.4f, %.4f >\n", e_[0], e_[1]); }
  Vector2f& operator+=(const Vector2f& other) {
    for (int i = 0; i < 2; ++i) e_[i] += other.e_[i];
    return *this;
  }
  Vector2f& operator-=(const Vector2f& other) {
    for (int i = 0; i < 2; ++i) e_[i] -= other.e_[i];
    return *this;
  }
  Vector2f& operator*=(const Vector2f& other) {
    for (int i = 0; i < 2; ++i) e_[i] *= other.e_[i];
    return *this;
  }
  Vector2f& operator/=(const Vector2f& other) {
    for (int i = 0; i < 2; ++i) e_[i] /= other.e_[i];
    return *this;
  }
  Vector2f& operator*=(float f) {
    for (int i = 0; i < 2; ++i) e_[i] *= f;
    return *this;
  }
  Vector2f& operator/=(float f) {
    for (int i = 0; i < 2; ++i) e_[i] /= f;
    return *this;
  }
  static float dot(const Vector2f& a, const Vector2f& b) {
    float sum = 0.0f;
    for (int i = 0; i < 2; ++i) sum += a.e_[i] * b.e_[i];
    return sum;
  }
  static Vector3f cross(const Vector2f& a, const Vector2f& b);
  static Vector2f lerp(const Vector2f& a, const Vector2f& b, float alpha) {
    Vector2f result;
    for (int i = 0; i < 2; ++i) result.e_[i] = (1.0f - alpha) * a.e_[i] + alpha * b.e_[i];
    return result;
  }
  static const Vector2f ZERO;
  static const Vector2f UP;
  static const Vector2f RIGHT;

 private:
  float e_[2];
};

// weak, so that a header may define the constants under C++14
#if defined(_MSC_VER)
#define VECMATH_CONSTANT __declspec(selectany)
#elif defined(_WIN32)
#define VECMATH_CONSTANT __attribute__((selectany, init_priority(101)))
#else
#define VECMATH_CONSTANT __attribute__((weak, init_priority(101)))
#endif
VECMATH_CONSTANT const Vector2f Vector2f::ZERO(0.0f, 0.0f);
VECMATH_CONSTANT const Vector2f Vector2f::UP(0.0f, 1.0f);
VECMATH_CONSTANT const Vector2f Vector2f::RIGHT(1.0f, 0.0f);

inline Vector2f operator+(Vector2f a, const Vector2f& b) { return a += b; }
inline Vector2f operator-(Vector2f a, const Vector2f& b) { return a -= b; }
inline Vector2f operator*(Vector2f a, const Vector2f& b) { return a *= b; }
inline Vector2f operator/(Vector2f a, const Vector2f& b) { return a /= b; }
inline Vector2f operator-(Vector2f a) {
  a.negate();
  return a;
}
inline Vector2f operator*(Vector2f a, float f) { return a *= f; }
inline Vector2f operator*(float f, Vector2f a) { return a *= f; }
inline Vector2f operator/(Vector2f a, float f) { return a /= f; }
inline bool operator==(const Vector2f& a, const Vector2f& b) {
  for (int i = 0; i < 2; ++i)
    if (a[i] != b[i]) return false;
  return true;
}
inline bool operator!=(const Vector2f& a, const Vector2f& b) { return !(a == b); }
