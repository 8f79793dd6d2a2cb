#include "Vector3f.h"

#include <cmath>

Vector3f::Vector3f(float f) { v[0] = v[1] = v[2] = f; }
Vector3f::Vector3f(float x, float y, float z) { v[0] = x, v[1] = y, v[2] = z; }
float Vector3f::abs() const { return std::sqrt(dot(*this, *this)); }
float Vector3f::dot(const Vector3f& a, const Vector3f& b) { return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2]; }
Vector3f& Vector3f::operator+=(const Vector3f& o) { return *this = *this + o; }
Vector3f Vector3f::pulledTo(const Vector3f& other, float rest) const {
  const Vector3f d = other - *this;
  return d * (1 - rest / d.abs());
}

Vector3f operator+(const Vector3f& a, const Vector3f& b) { return Vector3f(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }
Vector3f operator-(const Vector3f& a, const Vector3f& b) { return Vector3f(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }
Vector3f operator-(const Vector3f& a) { return Vector3f() - a; }
Vector3f operator*(const Vector3f& a, float f) { return Vector3f(a[0] * f, a[1] * f, a[2] * f); }
Vector3f operator*(float f, const Vector3f& a) { return a * f; }
Vector3f operator/(const Vector3f& a, float f) { return a * (1 / f); }
