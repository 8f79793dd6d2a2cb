// A matrix of 2 x 2 floats, stored by columns as OpenGL reads it.
#pragma once

#include <cmath>
#include <cstdio>

#include "Vector2f.h"

class Matrix2f {
 public:
  Matrix2f(float all = 0.0f) {
    for (int i = 0; i < 4; ++i) e_[i] = all;
  }
  Matrix2f(float m00, float m01, float m10, float m11) {
    const float rows[] = {m00, m01, m10, m11};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) (*this)(i, j) = rows[2 * i + j];
  }
  Matrix2f(const Vector2f& v0, const Vector2f& v1, bool columns = true) {
    const Vector2f* all[] = {&v0, &v1};
    for (int i = 0; i < 2; ++i) columns ? setCol(i, *all[i]) : setRow(i, *all[i]);
  }
  const float& operator()(int i, int j) const { return e_[2 * j + i]; }
  float& operator()(int i, int j) { return e_[2 * j + i]; }
  Vector2f getRow(int i) const {
    Vector2f v;
    for (int j = 0; j < 2; ++j) v[j] = (*this)(i, j);
    return v;
  }
  void setRow(int i, const Vector2f& v) {
    for (int j = 0; j < 2; ++j) (*this)(i, j) = v[j];
  }
  Vector2f getCol(int j) const {
    Vector2f v;
    for (int i = 0; i < 2; ++i) v[i] = (*this)(i, j);
    return v;
  }
  void setCol(int j, const Vector2f& v) {
    for (int i = 0; i < 2; ++i) (*this)(i, j) = v[i];
  }
  Matrix2f transposed() const {
    Matrix2f m;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) m(i, j) = (*this)(j, i);
    return m;
  }
  void transpose() { *this = transposed(); }
  float determinant() const { return e_[0] * e_[3] - e_[1] * e_[2]; }
  float cofactor(int i, int j) const { return ((i + j) % 2 ? -1.0f : 1.0f) * (*this)(1 - i, 1 - j); }
  Matrix2f inverse(bool* singular = nullptr, float epsilon = 0.0f) const {
    const float d = determinant();
    Matrix2f m;
    if (singular) *singular = std::fabs(d) < epsilon;
    if (std::fabs(d) < epsilon) return m;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) m(i, j) = cofactor(j, i) / d;
    return m;
  }
  operator const float*() const { return e_; }
  operator float*() { return e_; }
  void print() const {
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) std::printf(j == 1 ? "%.4f\n" : "%.4f ", (*this)(i, j));
  }
  static Matrix2f zeros() { return Matrix2f(); }
  static Matrix2f ones() { return Matrix2f(1.0f); }
  static Matrix2f identity() {
    Matrix2f m;
    for (int i = 0; i < 2; ++i) m(i, i) = 1.0f;
    return m;
  }
  static Matrix2f rotation(float a) { return Matrix2f(std::cos(a), -std::sin(a), std::sin(a), std::cos(a)); }

 private:
  float e_[4];
};

inline Vector2f operator*(const Matrix2f& m, const Vector2f& v) {
  Vector2f w;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) w[i] += m(i, j) * v[j];
  return w;
}
inline Matrix2f operator*(const Matrix2f& a, const Matrix2f& b) {
  Matrix2f m;
  for (int j = 0; j < 2; ++j) m.setCol(j, a * b.getCol(j));
  return m;
}
inline Matrix2f operator*(float f, const Matrix2f& a) {
  Matrix2f m;
  for (int j = 0; j < 2; ++j) m.setCol(j, f * a.getCol(j));
  return m;
}
inline Matrix2f operator*(const Matrix2f& a, float f) { return f * a; }
inline Matrix2f operator+(const Matrix2f& a, const Matrix2f& b) {
  Matrix2f m;
  for (int j = 0; j < 2; ++j) m.setCol(j, a.getCol(j) + b.getCol(j));
  return m;
}
inline Matrix2f operator-(const Matrix2f& a, const Matrix2f& b) {
  Matrix2f m;
  for (int j = 0; j < 2; ++j) m.setCol(j, a.getCol(j) - b.getCol(j));
  return m;
}
