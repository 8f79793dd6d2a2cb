// One method's motion between the frames it was sampled at: places, values and normals of its particles.

const levels = 63;  // steps of a colour value, as packed

class Motion {
  constructor(method, unpacked, particles, triangles) { Object.assign(this, {method, unpacked, particles, triangles}); }

  /** Last frame before `frame`, and the part of the way to the next one; a run that ended earlier stays at its end. */
  between(frame) {
    const last = this.method.frames - 1, first = Math.max(0, Math.min(last, Math.floor(frame)));
    return {first, next: Math.min(last, first + 1), part: frame >= last ? 0 : frame - first};
  }

  /** Place of one particle in one frame, m. */
  place(frame, particle) {
    const {low, unit} = this.method, at = 3 * (frame * this.particles + particle);
    return [0, 1, 2].map(k => low[k] + unit[k] * this.unpacked.places[at + k]);
  }

  /** Writes place and value ('plain', 'stretch' or 'distance') of each particle, four numbers each. */
  places(frame, colour, into) {
    const {low, unit} = this.method, {first, next, part} = this.between(frame);
    const {places} = this.unpacked, values = this.unpacked[colour], n = this.particles;
    for (let i = 0, a = 3 * n * first, b = 3 * n * next; i < n; ++i)
      for (let k = 0; k < 3; ++k, ++a, ++b)
        into[4 * i + k] = low[k] + unit[k] * (places[a] + part * (places[b] - places[a]));
    const valued = values && n * (next + 1) <= values.length;
    for (let i = 0, a = n * first, b = n * next; i < n; ++i, ++a, ++b)
      into[4 * i + 3] = valued ? (values[a] + part * (values[b] - values[a])) / levels : -1;
  }

  /** Writes the normals of a surface whose places are given, four numbers each. */
  normals(places, into) {
    into.fill(0);
    const {triangles} = this;
    for (let i = 0; i < triangles.length; i += 3) {
      const a = 4 * triangles[i], b = 4 * triangles[i + 1], c = 4 * triangles[i + 2];
      const ux = places[b] - places[a], uy = places[b + 1] - places[a + 1], uz = places[b + 2] - places[a + 2];
      const vx = places[c] - places[a], vy = places[c + 1] - places[a + 1], vz = places[c + 2] - places[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      for (const at of [a, b, c]) into[at] += x, into[at + 1] += y, into[at + 2] += z;
    }
  }
}
