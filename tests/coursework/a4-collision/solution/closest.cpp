// Distance and normal.
#include "contact.h"

double gap(const Sphere& sphere, const Vec3& x) { return length(x - sphere.centre) - (sphere.radius + sphere.margin); }

Vec3 normal(const Sphere& sphere, const Vec3& x) {
  const Vec3 d = x - sphere.centre;
  const double l = length(d);
  if (l == 0) return {0, 1, 0};
  return d / l;
}

Vec3 nearest(const Sphere& sphere, const Vec3& x) {
  return sphere.centre + (sphere.radius + sphere.margin) * normal(sphere, x);
}

double gap(const Plane& plane, const Vec3& x) { return dot(x - plane.point, plane.normal) - plane.margin; }

Vec3 nearest(const Plane& plane, const Vec3& x) { return x - gap(plane, x) * plane.normal; }
