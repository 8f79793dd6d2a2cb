// A matrix of 3 x 3 floats, stored by columns as OpenGL reads it.
#pragma once

#include <cmath>
#include <cstdio>

#include "Matrix2f.h"
#include "Vector3f.h"

class Quat4f;

class Matrix3f {
 public:
  Matrix3f(float all = 0.0f) {
    for (int i = 0; i < 9; ++i) e_[i] = all;
  }
  Matrix3f(float m00, float m01, float m02, float m10, float m11, float m12, float m20, float m21, float m22) {
    const float rows[] = {m00, m01, m02, m10, m11, m12, m20, m21, m22};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) (*this)(i, j) = rows[3 * i + j];
  }
  Matrix3f(const Vector3f& v0, const Vector3f& v1, const Vector3f& v2, bool columns = true) {
    const Vector3f* all[] = {&v0, &v1, &v2};
    for (int i = 0; i < 3; ++i) columns ? setCol(i, *all[i]) : setRow(i, *all[i]);
  }
  const float& operator()(int i, int j) const { return e_[3 * j + i]; }
  float& operator()(int i, int j) { return e_[3 * j + i]; }
  Vector3f getRow(int i) const {
    Vector3f v;
    for (int j = 0; j < 3; ++j) v[j] = (*this)(i, j);
    return v;
  }
  void setRow(int i, const Vector3f& v) {
    for (int j = 0; j < 3; ++j) (*this)(i, j) = v[j];
  }
  Vector3f getCol(int j) const {
    Vector3f v;
    for (int i = 0; i < 3; ++i) v[i] = (*this)(i, j);
    return v;
  }
  void setCol(int j, const Vector3f& v) {
    for (int i = 0; i < 3; ++i) (*this)(i, j) = v[i];
  }
  Matrix2f getSubmatrix2x2(int i0, int j0) const {
    Matrix2f m;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) m(i, j) = (*this)(i0 + i, j0 + j);
    return m;
  }
  void setSubmatrix2x2(int i0, int j0, const Matrix2f& m) {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) (*this)(i0 + i, j0 + j) = m(i, j);
  }
  Matrix3f transposed() const {
    Matrix3f m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = (*this)(j, i);
    return m;
  }
  void transpose() { *this = transposed(); }
  float determinant() const {
    float sum = 0.0f;
    for (int j = 0; j < 3; ++j) sum += (*this)(0, j) * cofactor(0, j);
    return sum;
  }
  float cofactor(int row, int column) const {
    Matrix2f m;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) m(i, j) = (*this)(i + (i >= row), j + (j >= column));
    return ((row + column) % 2 ? -1.0f : 1.0f) * m.determinant();
  }
  Matrix3f inverse(bool* singular = nullptr, float epsilon = 0.0f) const {
    const float d = determinant();
    Matrix3f m;
    if (singular) *singular = std::fabs(d) < epsilon;
    if (std::fabs(d) < epsilon) return m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = cofactor(j, i) / d;
    return m;
  }
  operator const float*() const { return e_; }
  operator float*() { return e_; }
  void print() const {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) std::printf(j == 2 ? "%.4f\n" : "%.4f ", (*this)(i, j));
  }
  static Matrix3f zeros() { return Matrix3f(); }
  static Matrix3f ones() { return Matrix3f(1.0f); }
  static Matrix3f identity() {
    Matrix3f m;
    for (int i = 0; i < 3; ++i) m(i, i) = 1.0f;
    return m;
  }
  static Matrix3f rotateX(float radians) { return plane(1, 2, radians); }
  static Matrix3f rotateY(float radians) { return plane(2, 0, radians); }
  static Matrix3f rotateZ(float radians) { return plane(0, 1, radians); }
  static Matrix3f uniformScaling(float s) { return scaling(s, s, s); }
  static Matrix3f scaling(float x, float y, float z) {
    Matrix3f m = identity();
    m(0, 0) = x, m(1, 1) = y, m(2, 2) = z;
    return m;
  }
  static Matrix3f scaling(const Vector3f& s) { return scaling(s[0], s[1], s[2]); }
  /// Rotation about an axis, by Rodrigues' formula.
  static Matrix3f rotation(const Vector3f& axis, float radians) {
    const Vector3f u = axis.normalized();
    const float c = std::cos(radians), s = std::sin(radians);
    Matrix3f m = identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = (1.0f - c) * u[i] * u[j] + (i == j ? c : 0.0f);
    for (int i = 0; i < 3; ++i) m((i + 2) % 3, (i + 1) % 3) += s * u[i], m((i + 1) % 3, (i + 2) % 3) -= s * u[i];
    return m;
  }
  static Matrix3f rotation(const Quat4f& q);

 private:
  static Matrix3f plane(int p, int q, float radians) {
    Matrix3f m = identity();
    m(p, p) = m(q, q) = std::cos(radians);
    m(q, p) = std::sin(radians), m(p, q) = -m(q, p);
    return m;
  }
  float e_[9];
};

inline Vector3f operator*(const Matrix3f& m, const Vector3f& v) {
  Vector3f w;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) w[i] += m(i, j) * v[j];
  return w;
}
inline Matrix3f operator*(const Matrix3f& a, const Matrix3f& b) {
  Matrix3f m;
  for (int j = 0; j < 3; ++j) m.setCol(j, a * b.getCol(j));
  return m;
}
inline Matrix3f operator*(float f, const Matrix3f& a) {
  Matrix3f m;
  for (int j = 0; j < 3; ++j) m.setCol(j, f * a.getCol(j));
  return m;
}
inline Matrix3f operator*(const Matrix3f& a, float f) { return f * a; }
inline Matrix3f operator+(const Matrix3f& a, const Matrix3f& b) {
  Matrix3f m;
  for (int j = 0; j < 3; ++j) m.setCol(j, a.getCol(j) + b.getCol(j));
  return m;
}
inline Matrix3f operator-(const Matrix3f& a, const Matrix3f& b) {
  Matrix3f m;
  for (int j = 0; j < 3; ++j) m.setCol(j, a.getCol(j) - b.getCol(j));
  return m;
}
