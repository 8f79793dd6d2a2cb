// GLSL: positions and lighting of bodies. Light is linear: a key light with a shadow map, and a sky.

export const header = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DShadow;
`;

export const vertexCommon = `
uniform mat4 to_clip;
uniform vec3 eye;          // the light's position, far away, when shadows are drawn
uniform sampler2D points;  // position of each particle (m), and its value: 0 to 1, or negative for none
out vec3 place, normal;
out float value;
vec4 point(int i) {
  int wide = textureSize(points, 0).x;
  return texelFetch(points, ivec2(i % wide, i / wide), 0);
}
`;

export const clothVertex = `
uniform sampler2D normals;
uniform float nearer;  // distance by which threads are lifted off the surface, as a fraction of the depth
void main() {
  vec4 p = point(gl_VertexID);
  int wide = textureSize(points, 0).x;
  place = p.xyz, value = p.w;
  normal = texelFetch(normals, ivec2(gl_VertexID % wide, gl_VertexID / wide), 0).xyz;
  gl_Position = to_clip * vec4(place, 1);
  gl_Position.z -= nearer * gl_Position.w;
}
`;

export const ballVertex = `
uniform vec4 ball;     // centre and radius of an obstacle; radius 0: beads at the particles
uniform float radius;  // bead radius, m
in vec3 corner;
in int which;
void main() {
  vec4 p = ball.w > 0.0 ? vec4(ball.xyz, -1) : point(which);
  place = p.xyz + corner * (ball.w > 0.0 ? ball.w : radius), value = p.w, normal = corner;
  gl_Position = to_clip * vec4(place, 1);
}
`;

// a flat strip that faces the eye, shaded as a rod
export const rodVertex = `
uniform float radius;  // m
uniform vec3 families[7];
in vec2 corner;        // 0 to 1 along, -1 to 1 across
in ivec3 ends;         // two particles and the family
out vec3 across, towards, family;
out float side;
void main() {
  vec4 a = point(ends.x), b = point(ends.y);
  vec3 along = b.xyz - a.xyz, middle = mix(a.xyz, b.xyz, corner.x), look = normalize(eye - middle);
  across = cross(along, look);
  across *= inversesqrt(max(dot(across, across), 1e-20));
  towards = normalize(look - along * dot(look, along) / max(dot(along, along), 1e-20));
  side = corner.y, family = families[ends.z], normal = towards;
  place = middle + across * side * radius;
  value = min(a.w, b.w) < 0.0 ? -1.0 : mix(a.w, b.w, corner.x);
  gl_Position = to_clip * vec4(place, 1);
}
`;

export const floorVertex = `
uniform vec3 floor_at, floor_u, floor_v;  // centre and half edges, m
in vec2 corner;
void main() {
  place = floor_at + corner.x * floor_u + corner.y * floor_v, normal = vec3(0, 1, 0), value = -1.0;
  gl_Position = to_clip * vec4(place, 1);
}
`;

export const fragmentCommon = `
uniform vec3 eye, key;
uniform mat4 to_key;
uniform sampler2DShadow key_map;
uniform float lift;      // m, offset from the surface for the shadow look-up
uniform float shadowed;  // 0 if nothing casts a shadow
uniform float taps;      // at most 12: number of shadow look-ups
in vec3 place, normal;
in float value;
out vec4 result;
vec3 linear(vec3 srgb) { return pow(srgb, vec3(2.2)); }
vec4 shown(vec3 light) { return vec4(pow(light, vec3(1.0 / 2.2)), 1); }

// fraction of the key light that arrives, from samples on a spiral, which is rotated from pixel to pixel
float lit(vec3 p, float spread) {
  if (shadowed < 0.5) return 1.0;
  vec3 q = (to_key * vec4(p, 1)).xyz * 0.5 + 0.5;
  if (any(lessThan(q.xy, vec2(0))) || any(greaterThan(q.xy, vec2(1)))) return 1.0;
  q.z = min(q.z, 1.0);  // the ground is behind everything that casts shadows
  float turn = 6.2832 * fract(52.98 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584)))), sum = 0.0;
  for (int i = 0; i < 12; ++i) {
    if (float(i) >= taps) break;
    float angle = 2.39996 * float(i) + turn;
    sum += texture(key_map, vec3(q.xy + spread * sqrt((float(i) + 0.5) / taps) * vec2(cos(angle), sin(angle)), q.z));
  }
  return sum / taps;
}

vec3 light_on(vec3 n, float through) {
  float facing = dot(n, key), side = facing < 0.0 ? -1.0 : 1.0;
  float direct = (facing > 0.0 ? facing : -through * facing) * lit(place + side * n * lift, 0.004);
  return 0.58 * direct * vec3(1.035, 1.0, 0.955) + (0.36 + 0.12 * n.y) * vec3(0.965, 0.99, 1.045) +
         0.25 * (0.6 - 0.4 * n.y);
}
`;

const coloured = `
uniform sampler2D scale_map;
uniform vec3 plain;
uniform float by_value;
vec3 colour_of(vec3 own) {
  if (by_value < 0.5) return linear(own);
  if (value < 0.0) return linear(vec3(0.74, 0.75, 0.76));
  return linear(texture(scale_map, vec2(value * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb);
}
`;

// the method's tint, lighter where the cloth faces the light
export const clothFragment = coloured + `
uniform vec3 ramp[3];
void main() {
  vec3 n = normalize(normal);
  bool behind = dot(n, eye - place) < 0.0;
  if (behind) n = -n;
  if (by_value < 0.5) {
    float facing = dot(n, key), part = clamp(abs(facing) * (facing < 0.0 ? 0.85 : 1.0), 0.0, 1.0);
    vec3 tint = part < 0.5 ? mix(ramp[0], ramp[1], 2.0 * part) : mix(ramp[1], ramp[2], 2.0 * part - 1.0);
    float shade = facing > 0.0 ? 0.72 + 0.28 * lit(place + n * lift, 0.004) : 0.86;
    result = shown(linear(tint) * (behind ? 0.9 : 1.0) * shade);
  } else {
    result = shown(colour_of(plain) * (behind ? 0.86 : 1.0) * light_on(n, 0.22));
  }
}
`;

export const threadFragment = `
uniform float ink;
uniform vec3 ramp[3];
out vec4 result;
void main() { result = vec4(ramp[0] * 0.55, ink); }
`;

export const solidFragment = coloured + `
#ifdef ROD
in vec3 across, towards, family;
in float side;
uniform float by_family;
#endif
void main() {
#ifdef ROD
  vec3 n = normalize(side * across + sqrt(max(0.0, 1.0 - side * side)) * towards);
  vec3 own = by_family > 0.5 ? family : plain;
#else
  vec3 n = normalize(normal), own = plain;
#endif
  vec3 light = light_on(n, 0.0);
  float gloss = 0.12 * pow(max(dot(n, normalize(key + normalize(eye - place))), 0.0), 40.0) * step(0.7, light.r);
  result = shown(colour_of(own) * light + gloss);
}
`;

// the ground has the colour of the background, darkened in shadow (invisible elsewhere); slopes are tinted
export const floorFragment = `
uniform vec3 background, floor_at;
uniform vec4 panel;         // lower left corner and size, pixels
uniform float reach, tint;  // half the width, m; amount by which a slope is darker than the background
void main() {
  float away = length(place - floor_at) / reach;
  vec2 in_panel = (gl_FragCoord.xy - panel.xy) / panel.zw, border = min(in_panel, 1.0 - in_panel);
  vec2 fade = smoothstep(vec2(0), vec2(0.07), border);  // fades before the next panel begins
  float lost = (1.0 - lit(place, 0.04)) * (1.0 - smoothstep(0.5, 1.0, away)) * fade.x * fade.y;
  result = vec4(background * (1.0 - 0.3 * lost - tint), 1);
}
`;
