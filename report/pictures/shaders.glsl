// Shaders of all materials. A #define chooses one of them, because software GL pays for every branch: CLOTH, ROD, TRAIL
// (a rod without light), GROUND, or SUM (adds a pass to the sum). Further #defines: VALUES (cloth coloured by value),
// SHADOW (depth only), and VERTEX or FRAGMENT.

#ifdef VERTEX
uniform mat4 to_clip;
uniform vec3 eye;
uniform float lift;  // depth to which flat cloth may dip into a ball
uniform vec4 ground;   // centre x, height, centre z, half width

#if defined(CLOTH)
layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 corner_normal;
layout(location = 2) in vec3 corner_rim;
layout(location = 3) in float corner_value;
out vec3 rim;
out float value;
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
  // move towards the eye, so that only the depth changes
  vec3 to_eye = normalize(eye - place);
  shown += to_eye * lift / max(abs(dot(to_eye, normal)), 0.25);
#endif
  gl_Position = to_clip * vec4(shown, 1);
}

#elif defined(SHADOW)
void main() {}

#elif defined(SUM)
uniform sampler2D pass;
out vec4 result;
void main() { result = texelFetch(pass, ivec2(gl_FragCoord.xy), 0); }

#else
// one sample each of the key light and of the sky
uniform vec3 eye, key, sky;  // directions towards the light
uniform mat4 to_key, to_sky;  // from the frame to the shadow maps, 0..1
uniform sampler2DShadow key_map, sky_map;
uniform float key_texel, sky_texel;  // size of a texel in the frame
uniform float lift;
in vec3 place, normal, colour;
out vec4 result;

const vec3 key_colour = KEY_LIGHT * vec3(1.035, 1.0, 0.955);
const vec3 sky_colour = SKY_LIGHT * vec3(0.965, 0.99, 1.045);
const vec3 bounce_colour = vec3(0.215, 0.213, 0.21);

float lit(sampler2DShadow map, mat4 to_map, vec3 p) {
  vec3 q = (to_map * vec4(p, 1)).xyz;
  return textureLod(map, vec3(q.xy, min(q.z, 1)), 0);
}

// `through`: fraction of the key light that passes from the other side
vec3 light_on(vec3 n, float through) {
  float facing = dot(n, key);
  float side = facing < 0 && through > 0 ? -1 : 1;
  float direct = facing > 0 ? facing : -through * facing;
  direct *= lit(key_map, to_key, place + side * n * (2.0 * key_texel + lift));
  vec3 bounce = bounce_colour * (0.62 - 0.38 * n.y);
  float up = 2 * max(dot(n, sky), 0) * lit(sky_map, to_sky, place + n * (2.0 * sky_texel + lift));
  vec3 from_sky = sky_colour * up;
  return key_colour * direct + from_sky + bounce;
}

#if defined(CLOTH)
uniform sampler2D scale_map;
uniform vec3 plain;
in vec3 rim;
in float value;

void main() {
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);
#ifdef VALUES
  vec3 base = texture(scale_map, vec2(value * (255.0 / 256) + 0.5 / 256, 0.5)).rgb;
#else
  vec3 base = plain;
#endif
  if (!gl_FrontFacing) base *= 0.86;

  // threads are at least a pixel wide, and fade where they would crowd
  vec3 pixel = max(fwidth(rim), vec3(1e-6));
  vec3 line = clamp((max(vec3(1), 0.5 * pixel) - rim) / pixel + 0.5, 0, 1) * smoothstep(vec3(16), vec3(6), pixel);
  base *= mix(vec3(1), vec3(0.40, 0.385, 0.385), max(line.x, max(line.y, line.z)));
  result = vec4(base * light_on(n, 0.22), 1);
}

#elif defined(GROUND)
// the ground has the background's colour, darkened in shadow; elsewhere it is invisible
uniform vec3 background;
uniform float unoccluded;  // mean light on the open ground
uniform vec4 ground;
uniform vec3 panel;        // width, height, pixels
uniform float blur;  // 1 for the mean of many passes, larger for few

// `radius`: fraction of the map; on flat ground the filter need not follow a slope
float soft(sampler2DShadow map, mat4 to_map, float radius) {
  const vec2 disc[4] = vec2[](vec2(0.25, 0.75), vec2(-0.75, 0.25), vec2(-0.25, -0.75), vec2(0.75, -0.25));
  vec3 q = (to_map * vec4(place, 1)).xyz;
  float sum = 0;
  for (int i = 0; i < 4; ++i) sum += textureLod(map, vec3(q.xy + radius * disc[i], min(q.z, 1)), 0);
  return sum / 4;
}

void main() {
  float key_lost = KEY_LIGHT * key.y * (1 - soft(key_map, to_key, 0.007 * blur));
  float sky_lost = SKY_LIGHT * 2 * sky.y * (1 - soft(sky_map, to_sky, 0.012 * blur));
  // shadows fade far away and before the panel ends: the faint, wide shadow of the sky fades early, that of the key
  // light late
  float away = length(place.xz - ground.xz) / ground.w;
  vec2 border = (min(gl_FragCoord.xy, panel.xy - gl_FragCoord.xy) - 0.5) / panel.xy;  // 0 in the outermost pixels
  vec2 sky_fade = smoothstep(vec2(0), vec2(0.25), border), key_fade = smoothstep(vec2(0), vec2(0.06), border);
  float lost = key_lost * key_fade.x * key_fade.y + sky_lost * sky_fade.x * sky_fade.y;
  result = vec4(background * (1 - 0.9 * (1 - smoothstep(0.4, 1.0, away)) * lost / unoccluded), 1);
}

#else
void main() {
#ifdef TRAIL
  result = vec4(colour, 1);
#else
  vec3 n = normalize(normal);
  vec3 to_eye = normalize(eye - place);
  vec3 light = light_on(n, 0);
  float gloss = 0.16 * pow(max(dot(n, normalize(key + to_eye)), 0), 40) * step(0.5, light.r);
  result = vec4(colour * light + gloss, 1);
#endif
}
#endif
#endif
