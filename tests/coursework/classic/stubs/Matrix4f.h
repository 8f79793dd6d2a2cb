// A matrix of 4 x 4 floats, stored by columns as OpenGL reads it.
#pragma once

#include <cmath>
#include <cstdio>

#include "Matrix3f.h"
#include "Vector4f.h"

class Quat4f;

class Matrix4f {
 public:
  Matrix4f(float all = 0.0f) {
    for (int i = 0; i < 16; ++i) e_[i] = all;
  }
  Matrix4f(float m00, float m01, float m02, float m03, float m10, float m11, float m12, float m13, float m20, float m21,
           float m22, float m23, float m30, float m31, float m32, float m33) {
    const float rows[] = {m00, m01, m02, m03, m10, m11, m12, m13, m20, m21, m22, m23, m30, m31, m32, m33};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) (*this)(i, j) = rows[4 * i + j];
  }
  Matrix4f(const Vector4f& v0, const Vector4f& v1, const Vector4f& v2, const Vector4f& v3, bool columns = true) {
    const Vector4f* all[] = {&v0, &v1, &v2, &v3};
    for (int i = 0; i < 4; ++i) columns ? setCol(i, *all[i]) : setRow(i, *all[i]);
  }
  const float& operator()(int i, int j) const { return e_[4 * j + i]; }
  float& operator()(int i, int j) { return e_[4 * j + i]; }
  Vector4f getRow(int i) const {
    Vector4f v;
    for (int j = 0; j < 4; ++j) v[j] = (*this)(i, j);
    return v;
  }
  void setRow(int i, const Vector4f& v) {
    for (int j = 0; j < 4; ++j) (*this)(i, j) = v[j];
  }
  Vector4f getCol(int j) const {
    Vector4f v;
    for (int i = 0; i < 4; ++i) v[i] = (*this)(i, j);
    return v;
  }
  void setCol(int j, const Vector4f& v) {
    for (int i = 0; i < 4; ++i) (*this)(i, j) = v[i];
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
  Matrix3f getSubmatrix3x3(int i0, int j0) const {
    Matrix3f m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = (*this)(i0 + i, j0 + j);
    return m;
  }
  void setSubmatrix3x3(int i0, int j0, const Matrix3f& m) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) (*this)(i0 + i, j0 + j) = m(i, j);
  }
  Matrix4f transposed() const {
    Matrix4f m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m(i, j) = (*this)(j, i);
    return m;
  }
  void transpose() { *this = transposed(); }
  float determinant() const {
    float sum = 0.0f;
    for (int j = 0; j < 4; ++j) sum += (*this)(0, j) * cofactor(0, j);
    return sum;
  }
  float cofactor(int row, int column) const {
    Matrix3f m;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = (*this)(i + (i >= row), j + (j >= column));
    return ((row + column) % 2 ? -1.0f : 1.0f) * m.determinant();
  }
  Matrix4f inverse(bool* singular = nullptr, float epsilon = 0.0f) const {
    const float d = determinant();
    Matrix4f m;
    if (singular) *singular = std::fabs(d) < epsilon;
    if (std::fabs(d) < epsilon) return m;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) m(i, j) = cofactor(j, i) / d;
    return m;
  }
  operator const float*() const { return e_; }
  operator float*() { return e_; }
  void print() const {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) std::printf(j == 3 ? "%.4f\n" : "%.4f ", (*this)(i, j));
  }
  static Matrix4f zeros() { return Matrix4f(); }
  static Matrix4f ones() { return Matrix4f(1.0f); }
  static Matrix4f identity() {
    Matrix4f m;
    for (int i = 0; i < 4; ++i) m(i, i) = 1.0f;
    return m;
  }
  static Matrix4f rotateX(float radians) { return plane(1, 2, radians); }
  static Matrix4f rotateY(float radians) { return plane(2, 0, radians); }
  static Matrix4f rotateZ(float radians) { return plane(0, 1, radians); }
  static Matrix4f uniformScaling(float s) { return scaling(s, s, s); }
  static Matrix4f scaling(float x, float y, float z) {
    Matrix4f m = identity();
    m(0, 0) = x, m(1, 1) = y, m(2, 2) = z;
    return m;
  }
  static Matrix4f scaling(const Vector3f& s) { return scaling(s[0], s[1], s[2]); }
  /// Rotation about an axis, by Rodrigues' formula.
  static Matrix4f rotation(const Vector3f& axis, float radians) {
    const Vector3f u = axis.normalized();
    const float c = std::cos(radians), s = std::sin(radians);
    Matrix4f m = identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = (1.0f - c) * u[i] * u[j] + (i == j ? c : 0.0f);
    for (int i = 0; i < 3; ++i) m((i + 2) % 3, (i + 1) % 3) += s * u[i], m((i + 1) % 3, (i + 2) % 3) -= s * u[i];
    return m;
  }
  static Matrix4f rotation(const Quat4f& q);
  static Matrix4f translation(float x, float y, float z) {
    Matrix4f m = identity();
    m(0, 3) = x, m(1, 3) = y, m(2, 3) = z;
    return m;
  }
  static Matrix4f translation(const Vector3f& t) { return translation(t[0], t[1], t[2]); }
  static Matrix4f lookAt(const Vector3f& eye, const Vector3f& center, const Vector3f& up) {
    const Vector3f z = (eye - center).normalized(), x = Vector3f::cross(up, z).normalized(), y = Vector3f::cross(z, x);
    Matrix4f m = identity();
    const Vector3f axes[] = {x, y, z};
    for (int i = 0; i < 3; ++i) m.setRow(i, Vector4f(axes[i], -Vector3f::dot(axes[i], eye)));
    return m;
  }
  static Matrix4f perspectiveProjection(float fov, float aspect, float near_, float far_, bool = false) {
    Matrix4f m;
    m(1, 1) = 1.0f / std::tan(fov / 2.0f), m(0, 0) = m(1, 1) / aspect;
    m(2, 2) = -(far_ + near_) / (far_ - near_), m(2, 3) = -2.0f * far_ * near_ / (far_ - near_), m(3, 2) = -1.0f;
    return m;
  }
  static Matrix4f orthographicProjection(float width, float height, float near_, float far_, bool = false) {
    Matrix4f m = scaling(2.0f / width, 2.0f / height, -2.0f / (far_ - near_));
    m(2, 3) = -(far_ + near_) / (far_ - near_);
    return m;
  }

 private:
  static Matrix4f plane(int p, int q, float radians) {
    Matrix4f m = identity();
    m(p, p) = m(q, q) = std::cos(radians);
    m(q, p) = std::sin(radians), m(p, q) = -m(q, p);
    return m;
  }
  float e_[16];
};

inline Vector4f operator*(const Matrix4f& m, const Vector4f& v) {
  Vector4f w;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) w[i] += m(i, j) * v[j];
  return w;
}
inline Matrix4f operator*(const Matrix4f& a, const Matrix4f& b) {
  Matrix4f m;
  for (int j = 0; j < 4; ++j) m.setCol(j, a * b.getCol(j));
  return m;
}
inline Matrix4f operator*(float f, const Matrix4f& a) {
  Matrix4f m;
  for (int j = 0; j < 4; ++j) m.setCol(j, f * a.getCol(j));
  return m;
}
inline Matrix4f operator*(const Matrix4f& a, float f) { return f * a; }
inline Matrix4f operator+(const Matrix4f& a, const Matrix4f& b) {
  Matrix4f m;
  for (int j = 0; j < 4; ++j) m.setCol(j, a.getCol(j) + b.getCol(j));
  return m;
}
inline Matrix4f operator-(const Matrix4f& a, const Matrix4f& b) {
  Matrix4f m;
  for (int j = 0; j < 4; ++j) m.setCol(j, a.getCol(j) - b.getCol(j));
  return m;
}
