// Vectors as arrays of three numbers, matrices as arrays of sixteen, column by column.

export type Vec3 = [number, number, number];
/** A vector, or a row of a larger array. */
export type Numbers = ArrayLike<number>;
/** Coordinates of particles, three each, m. */
export type Places = Float32Array|Float64Array;

export const minus = (a: Numbers, b: Numbers): Vec3 => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const plus = (a: Numbers, s: number, b: Numbers): Vec3 => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
export const dot = (a: Numbers, b: Numbers) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross =
    (a: Numbers, b: Numbers): Vec3 => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const norm = (a: Numbers) => Math.sqrt(dot(a, a));
export const unit = (a: Numbers) => plus([0, 0, 0], 1 / (norm(a) || 1), a);
export const placeOf = (places: Numbers, particle: number):
    Vec3 => [places[3 * particle], places[3 * particle + 1], places[3 * particle + 2]];

/** Rigid motion of the eye to the origin, and of its axes to x, y and z. */
export function toEye([right, up, back]: Numbers[], eye: Numbers) {
  return [
    right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0, -dot(right, eye),
    -dot(up, eye), -dot(back, eye), 1
  ];
}

export function times(a: Numbers, b: Numbers) {
  const m: number[] = new Array(16).fill(0);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r)
      for (let k = 0; k < 4; ++k) m[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return m;
}

/** Clip space for an eye at the origin that looks along -z; `tangent`: that of half the vertical field of view. */
export function perspective(tangent: number, aspect: number, near: number, far: number) {
  const depth = near - far;
  return [
    1 / (tangent * aspect), 0, 0, 0, 0, 1 / tangent, 0, 0, 0, 0, (far + near) / depth, -1, 0, 0,
    (2 * far * near) / depth, 0
  ];
}

/** Sums of triangle normals (of twice the triangle's area) at each corner; `stride`: numbers per point. */
export function sumNormals(places: Numbers, triangles: Numbers, sums: Float32Array|Float64Array, stride: number) {
  sums.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
    const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
    const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (let k = 0; k < 3; ++k) {
      const at = stride * triangles[t + k];
      sums[at] += x, sums[at + 1] += y, sums[at + 2] += z;
    }
  }
}

/** Clip space of a distant light: a box around the ball. */
export function lightMatrix(direction: Numbers, centre: Numbers, radius: number) {
  const right = unit(cross(Math.abs(direction[1]) > 0.99 ? [1, 0, 0] : [0, 1, 0], direction));
  const up = cross(direction, right);
  const s = 1 / radius;
  return times([s, 0, 0, 0, 0, s, 0, 0, 0, 0, -s, 0, 0, 0, 0, 1], toEye([right, up, direction], centre));
}
