// GLSL: where the corners of cloth, spheres, rods and ground go.
#include "report/render/shader_text.h"

namespace crosscheck::render {

std::string vertex_text() {
  return R"(
uniform mat4 to_clip;
uniform vec3 eye;
uniform float lift;    // depth that flat cloth may dip into a ball
uniform vec4 ground;   // centre x, height, centre z, half width

#if defined(CLOTH)
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 corner_normal;
layout(location = 2) in vec3 corner_rim;
layout(location = 3) in vec2 corner_value;
out vec3 rim;
out vec2 value;
#elif defined(SPHERE)
layout(location = 0) in vec4 corner;
layout(location = 1) in vec4 centre_radius;
layout(location = 2) in vec3 own_colour;
#elif defined(ROD) || defined(TRAIL)
layout(location = 0) in vec4 corner;
layout(location = 1) in vec4 start_radius;
layout(location = 2) in vec3 end;
layout(location = 3) in vec3 own_colour;
#endif
out vec3 place, normal, colour;

void main() {
  place = normal = colour = vec3(0);
#if defined(SUM)
  gl_Position = vec4(gl_VertexID % 2 * 4 - 1, gl_VertexID / 2 * 4 - 1, 0, 1);
  return;
#elif defined(CLOTH)
  place = corner;
  normal = corner_normal;
  rim = corner_rim;
  value = corner_value;
#elif defined(SPHERE)
  normal = corner.xyz;
  place = centre_radius.xyz + centre_radius.w * normal;
  colour = own_colour;
#elif defined(ROD) || defined(TRAIL)
  vec3 axis = end - start_radius.xyz;
  float size = length(axis);
  axis = size > 1e-9 ? axis / size : vec3(0, 1, 0);
  vec3 side = normalize(abs(axis.y) < 0.9 ? cross(axis, vec3(0, 1, 0)) : cross(axis, vec3(1, 0, 0)));
  normal = corner.x * side + corner.y * cross(axis, side) + corner.z * axis;
  place = mix(start_radius.xyz, end, corner.w) + start_radius.w * normal;
  colour = own_colour;
#elif defined(GROUND)
  place = vec3(ground.x, ground.y, ground.z) + ground.w * vec3(gl_VertexID % 2 * 2 - 1, 0, 1 - gl_VertexID / 2 * 2);
  normal = vec3(0, 1, 0);
#endif

  vec3 shown = place;
#if defined(CLOTH) && !defined(SHADOW)
  // towards the eye: the place on the screen stays, only the depth changes
  vec3 to_eye = normalize(eye - place);
  shown += to_eye * lift / max(abs(dot(to_eye, normal)), 0.25);
#endif
  gl_Position = to_clip * vec4(shown, 1);
}
)";
}

}  // namespace crosscheck::render
