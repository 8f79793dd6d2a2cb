// Plain expressions, component by component.
#include <math.h>

#include "contact.h"

static double distance_to_centre(const Sphere& s, const Vec3& p) {
  double dx = p.x - s.centre.x;
  double dy = p.y - s.centre.y;
  double dz = p.z - s.centre.z;
  return sqrt(dx * dx + dy * dy + dz * dz);
}

double gap(const Sphere& s, const Vec3& p) {
  double r = s.radius;
  r += s.margin;
  return distance_to_centre(s, p) - r;
}

Vec3 normal(const Sphere& s, const Vec3& p) {
  double l = distance_to_centre(s, p);
  Vec3 n(0, 1, 0);
  if (l > 0) {
    n.x = (p.x - s.centre.x) / l;
    n.y = (p.y - s.centre.y) / l;
    n.z = (p.z - s.centre.z) / l;
  }
  return n;
}

// moves p back along the normal by the gap
Vec3 nearest(const Sphere& s, const Vec3& p) { return p - gap(s, p) * normal(s, p); }

double gap(const Plane& p, const Vec3& x) {
  double height = (x.x - p.point.x) * p.normal.x;
  height += (x.y - p.point.y) * p.normal.y;
  height += (x.z - p.point.z) * p.normal.z;
  return height - p.margin;
}

Vec3 nearest(const Plane& p, const Vec3& x) { return x - gap(p, x) * p.normal; }
