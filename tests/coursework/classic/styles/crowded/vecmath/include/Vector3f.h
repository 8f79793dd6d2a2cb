#ifndef VECTOR_3F_H
#define VECTOR_3F_H

/// The student's own vector library, with a function that no other library has.
class Vector3f {
 public:
  Vector3f(float f = 0.f);
  Vector3f(float x, float y, float z);
  float& operator[](int i) { return v[i]; }
  const float& operator[](int i) const { return v[i]; }
  float abs() const;
  Vector3f pulledTo(const Vector3f& other, float rest) const;
  Vector3f& operator+=(const Vector3f& o);
  operator float*() { return v; }
  operator const float*() const { return v; }
  static float dot(const Vector3f& a, const Vector3f& b);

 private:
  float v[3];
};

Vector3f operator+(const Vector3f& a, const Vector3f& b);
Vector3f operator-(const Vector3f& a, const Vector3f& b);
Vector3f operator-(const Vector3f& a);
Vector3f operator*(const Vector3f& a, float f);
Vector3f operator*(float f, const Vector3f& a);
Vector3f operator/(const Vector3f& a, float f);

#endif
