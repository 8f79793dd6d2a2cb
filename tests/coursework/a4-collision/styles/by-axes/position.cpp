// Friction by coordinates on the sphere: shortens the tangential component along a unit vector.
#include <algorithm>

#include "contact.h"

Vec3 corrected_position(const Sphere& sphere, const Vec3& before, const Vec3& proposed) {
  const Vec3 from_centre = proposed - sphere.centre;
  const double r = sphere.radius + sphere.margin, distance = length(from_centre);
  if (!(distance < r)) return proposed;

  const Vec3 up = distance > 0 ? from_centre * (1 / distance) : Vec3(0, 1, 0);
  const Vec3 on_surface = sphere.centre + r * up;
  if (sphere.friction == 0) return on_surface;

  // friction draws the particle from `on_surface` back towards `before`, within the plane normal to `up`
  Vec3 back = before - on_surface;
  back -= dot(back, up) * up;
  const double way = length(back);
  if (way == 0) return on_surface;
  const double held = std::min(way, sphere.friction * (r - distance));
  const Vec3 rubbed = on_surface + (held / way) * back - sphere.centre;
  return sphere.centre + r / length(rubbed) * rubbed;
}

// a plane needs no second correction: motion within the tangent plane stays on the plane
Vec3 corrected_position(const Plane& plane, const Vec3& before, const Vec3& proposed) {
  const double depth = -gap(plane, proposed);
  if (!(depth > 0)) return proposed;
  const Vec3 on_surface = proposed + depth * plane.normal;
  Vec3 back = before - on_surface;
  back -= dot(back, plane.normal) * plane.normal;
  const double way = length(back);
  return way == 0 ? on_surface : on_surface + (std::min(way, plane.friction * depth) / way) * back;
}
