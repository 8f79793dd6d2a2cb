// Draws cloths side by side as Stage does, in a 2-D canvas with a depth buffer of its own: the first screen moves
// before a browser has started WebGL, and without it. Pixels are as in Stage: one key light with shadows, threads, a
// ground that is seen by its shadows alone.
// @ts-nocheck

import {boundsOf, footOf} from './bounds';
import {ballMesh} from './shapes';
import {gridOf} from './stage';
import {dot, lightMatrix, minus, norm, plus, sumNormals, unit} from './vectors';

/** A buffer of depths, and of colours where it is seen; what is drawn stays inside its box. */
class Raster {
  constructor(wide, high, pixels) {
    Object.assign(this, {wide, high, pixels, depth: new Float32Array(wide * high), box: [0, 0, wide, high]});
  }

  /**
   * A triangle between corners i, j and k of `at` (x, y in pixels and depth, lesser is nearer), its colour between
   * those of `rgb` (0 to 255); `keeps`: what is nearer to the eye stays hidden by it.
   */
  triangle(at, i, j, k, rgb, keeps = true) {
    const {depth, pixels, wide, box} = this;
    const ax = at[3 * i], ay = at[3 * i + 1], bx = at[3 * j], by = at[3 * j + 1], cx = at[3 * k], cy = at[3 * k + 1];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (!(Math.abs(area) > 1e-6)) return;
    const left = Math.max(box[0], Math.ceil(Math.min(ax, bx, cx) - 0.5)),
          right = Math.min(box[2] - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
    const top = Math.max(box[1], Math.ceil(Math.min(ay, by, cy) - 0.5)),
          bottom = Math.min(box[3] - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
    // parts of b and c at a place, and how they change from pixel to pixel
    const ux = (cy - ay) / area, uy = (ax - cx) / area, vx = (ay - by) / area, vy = (bx - ax) / area;
    const z = at[3 * i + 2], zu = at[3 * j + 2] - z, zv = at[3 * k + 2] - z, zx = zu * ux + zv * vx;
    let r = 0, g = 0, b = 0, ru = 0, rv = 0, gu = 0, gv = 0, bu = 0, bv = 0;
    if (pixels) {
      r = rgb[3 * i], g = rgb[3 * i + 1], b = rgb[3 * i + 2];
      ru = rgb[3 * j] - r, rv = rgb[3 * k] - r, gu = rgb[3 * j + 1] - g, gv = rgb[3 * k + 1] - g,
      bu = rgb[3 * j + 2] - b, bv = rgb[3 * k + 2] - b;
    }
    for (let y = top; y <= bottom; ++y) {
      let u = ux * (left + 0.5 - ax) + uy * (y + 0.5 - ay), v = vx * (left + 0.5 - ax) + vy * (y + 0.5 - ay);
      let near = z + u * zu + v * zv, inside = false;
      for (let x = left, p = y * wide + left; x <= right; ++x, ++p, u += ux, v += vx, near += zx) {
        if (u < 0 || v < 0 || u + v > 1) {
          if (inside) break;
          continue;
        }
        inside = true;
        if (near > depth[p]) continue;
        if (keeps) depth[p] = near;
        if (pixels)
          pixels[p] = 0xff000000 | (b + u * bu + v * bv) << 16 | (g + u * gu + v * gv) << 8 | (r + u * ru + v * rv);
      }
    }
  }

  /** A line between two corners, in one colour mixed into what is there. */
  line(at, i, j, rgb, ink, nearer) {
    const {depth, pixels, wide, box} = this;
    const ax = at[3 * i], ay = at[3 * i + 1], az = at[3 * i + 2] - nearer, dx = at[3 * j] - ax, dy = at[3 * j + 1] - ay,
          dz = at[3 * j + 2] - nearer - az;
    const steps = Math.max(1, Math.ceil(Math.max(Math.abs(dx), Math.abs(dy))));
    for (let s = 0; s < steps; ++s) {
      const part = s / steps, x = ax + part * dx | 0, y = ay + part * dy | 0, p = y * wide + x;
      if (x < box[0] || x >= box[2] || y < box[1] || y >= box[3] || az + part * dz > depth[p]) continue;
      const old = pixels[p];
      pixels[p] = 0xff000000 | mixedByte(old >> 16, rgb[2], ink) << 16 | mixedByte(old >> 8, rgb[1], ink) << 8 |
          mixedByte(old, rgb[0], ink);
    }
  }

  /** A disc in one colour. */
  disc(at, i, radius, rgb) {
    const {depth, pixels, wide, box} = this, cx = at[3 * i], cy = at[3 * i + 1], near = at[3 * i + 2] - 1e-3;
    for (let y = Math.max(box[1], Math.floor(cy - radius)); y < Math.min(box[3], cy + radius); ++y)
      for (let x = Math.max(box[0], Math.floor(cx - radius)), p = y * wide + x; x < Math.min(box[2], cx + radius);
           ++x, ++p)
        if ((x + 0.5 - cx) ** 2 + (y + 0.5 - cy) ** 2 < radius * radius && near <= depth[p])
          pixels[p] = 0xff000000 | rgb[2] << 16 | rgb[1] << 8 | rgb[0];
  }
}
const mixedByte = (old, own, part) => (old & 255) + part * (own - (old & 255)) | 0;

/** Places as a matrix shows them: pixels of a box and depth, three numbers each. */
function projected(places, matrix, [left, top, wide, high], into) {
  for (let i = 0; i < places.length; i += 3) {
    const x = places[i], y = places[i + 1], z = places[i + 2],
          w = matrix[3] * x + matrix[7] * y + matrix[11] * z + matrix[15];
    into[i] = left + wide * (0.5 + 0.5 * (matrix[0] * x + matrix[4] * y + matrix[8] * z + matrix[12]) / w);
    into[i + 1] = top + high * (0.5 - 0.5 * (matrix[1] * x + matrix[5] * y + matrix[9] * z + matrix[13]) / w);
    into[i + 2] = (matrix[2] * x + matrix[6] * y + matrix[10] * z + matrix[14]) / w;
  }
  return into;
}

/** What is drawn: places (m), normals, triangles, and room for what becomes of them. */
const bodyOf = (count, index) => ({
  places: new Float32Array(3 * count),
  normals: new Float32Array(3 * count),
  at: new Float32Array(3 * count),
  shadow: new Float32Array(3 * count),
  rgb: [new Float32Array(3 * count), new Float32Array(3 * count)],
  index,
  count
});

/** Normals of a surface, of length 1. */
function addNormals({places, normals, index}) {
  sumNormals(places, index, normals, 3);
  for (let i = 0; i < normals.length; i += 3) {
    const long = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    normals[i] /= long, normals[i + 1] /= long, normals[i + 2] /= long;
  }
}

export class RasterStage {
  /** Pixels of the canvas for one of the page: twice as many each way, which smooths edges. */
  static finer = 2;

  /** Whether it can draw a scene in time: cloths of the first screen. */
  static takes = scene => Boolean(scene.triangles) && scene.triangles.count <= 18000;

  /** As of Stage. */
  constructor(canvas, scene, shared) {
    const ball = ballMesh(48, 32), ground = 72, quads = [];
    for (let j = 0; j < ground; ++j)
      for (let i = 0; i < ground; ++i) {
        const here = j * (ground + 1) + i;
        quads.push(here, here + 1, here + ground + 1, here + 1, here + ground + 2, here + ground + 1);
      }
    Object.assign(this, {
      canvas,
      scene,
      shared,
      paper: canvas.getContext('2d', {alpha: false}),
      map: new Raster(256, 256, null),
      ball,
      ground
    });
    this.cloth = bodyOf(scene.particles, shared.triangles);
    this.balls = scene.spheres.map(() => bodyOf(ball.corners.length / 3, ball.index));
    this.floor = bodyOf((ground + 1) ** 2, quads);
    this.threads = shared.springs.subarray(0, 2 * scene.springs.threads);
  }

  show(views) {
    this.panels = views;
    Object.assign(this, boundsOf(this.scene, views.map(view => view.motion)));
  }

  release() { this.canvas.width = this.canvas.height = 0; }

  /** As of Stage, in plain colours. */
  draw({time, orbit, background, title}) {
    const {canvas, panels} = this, {width, height} = canvas, room = Math.round(title * width / canvas.clientWidth);
    if (this.image?.width !== width || this.image.height !== height) {
      this.image = this.paper.createImageData(width, height);
      this.raster = new Raster(width, height, new Uint32Array(this.image.data.buffer));
    }
    const {columns, rows} = gridOf(panels.length, width, height, room), cell = Math.floor(height / rows),
                    wide = Math.floor(width / columns), high = cell - room;
    const fit = orbit.fit(this.held, this.middle, wide / high), view = orbit.view(fit, wide / high);
    const bytes = background.map(v => Math.round(255 * v));
    this.raster.pixels.fill(0xff000000 | bytes[2] << 16 | bytes[1] << 8 | bytes[0]);
    this.raster.depth.fill(Infinity);
    const places = panels.map((panel, i) => {
      const column = i % columns, row = Math.floor(i / columns), box = [column * wide, row * cell + room, wide, high];
      this.raster.box = [box[0], box[1], box[0] + wide, box[1] + high];
      this.drawPanel(panel, time, view, box, bytes);
      return {left: column / columns, top: row / rows, wide: 1 / columns, high: 1 / rows};
    });
    this.paper.putImageData(this.image, 0, 0);
    return places;
  }

  drawPanel(panel, time, view, box, background) {
    const {scene, raster, cloth, balls, floor, map} = this, bodies = [cloth, ...balls];
    panel.motion.placesAt(time, cloth.places);
    addNormals(cloth);
    this.placeBalls(time);
    if (scene.floor !== null) {
      const toKey = lightMatrix(this.key, this.middle, 1.03 * this.reach);
      map.depth.fill(Infinity);
      for (const body of bodies) {
        projected(body.places, toKey, [0, 0, map.wide, map.high], body.shadow);
        for (let t = 0; t < body.index.length; t += 3)
          map.triangle(body.shadow, body.index[t], body.index[t + 1], body.index[t + 2]);
      }
      this.toKey = toKey;
    }
    this.shadeCloth(panel.look.ramp);
    balls.forEach(body => this.shadeBall(body, view.eye));
    for (const body of bodies) projected(body.places, view.toClip, box, body.at);
    for (const {index, at, rgb} of balls)
      for (let t = 0; t < index.length; t += 3) raster.triangle(at, index[t], index[t + 1], index[t + 2], rgb[0]);
    // a little nearer than it is, so that its facets do not hide in a ball's
    const nearer = 4e-3 * this.reach / norm(minus(view.eye, this.middle)), {index, at, rgb} = cloth;
    for (let i = 2; i < at.length; i += 3) at[i] -= nearer * (1 - at[i]);
    for (let t = 0; t < index.length; t += 3) {
      const i = index[t], j = index[t + 1], k = index[t + 2];
      const turn = (at[3 * j] - at[3 * i]) * (at[3 * k + 1] - at[3 * i + 1]) -
          (at[3 * j + 1] - at[3 * i + 1]) * (at[3 * k] - at[3 * i]);
      raster.triangle(at, i, j, k, rgb[turn < 0 ? 0 : 1]);
    }
    const dark = panel.look.ramp[0].map(v => 255 * 0.55 * v);
    for (let s = 0; s < this.threads.length; s += 2)
      raster.line(at, this.threads[s], this.threads[s + 1], dark, 0.5, 2e-4);
    const pin = (background[0] > 127 ? [52, 54, 59] : [169, 175, 182]);
    for (const i of scene.pins) raster.disc(at, i, 2.75 * RasterStage.finer, pin);
    if (scene.floor !== null) this.drawFloor(view, box, background);
  }

  placeBalls(time) {
    const {scene} = this, last = scene.times.length - 1,
          frame = last > 0 ? last * Math.min(1, time / scene.times[last]) : 0, first = Math.floor(frame);
    scene.spheres.forEach(({radius, centres}, s) => {
      const a = centres[Math.min(first, centres.length - 1)], b = centres[Math.min(first + 1, centres.length - 1)],
            at = plus(a, frame - first, minus(b, a));
      const {places, normals} = this.balls[s], {corners} = this.ball;
      normals.set(corners);
      for (let i = 0; i < corners.length; ++i) places[i] = at[i % 3] + radius * corners[i];
    });
  }

  /** Part of the key light that arrives at a place, lifted along a direction: nine looks into the map. */
  lit(x, y, z, spread) {
    const {toKey: m, map} = this;
    if (!m) return 1;
    const px = map.wide * (0.5 + 0.5 * (m[0] * x + m[4] * y + m[8] * z + m[12])),
          py = map.high * (0.5 - 0.5 * (m[1] * x + m[5] * y + m[9] * z + m[13])),
          near = m[2] * x + m[6] * y + m[10] * z + m[14];
    let sum = 0;
    for (let b = -1; b <= 1; ++b)
      for (let a = -1; a <= 1; ++a) {
        const u = Math.floor(px + spread * a), v = Math.floor(py + spread * b);
        if (u < 0 || v < 0 || u >= map.wide || v >= map.high || near <= map.depth[v * map.wide + u]) ++sum;
      }
    return sum / 9;
  }

  /**
   * Colours of the corners of a cloth from both sides: a method's own tint goes from dark to light with the light on
   * it.
   */
  shadeCloth(ramp) {
    const {places, normals, rgb, count} = this.cloth, {key} = this, lift = 0.012 * this.reach;
    for (let i = 0, p = 0; i < count; ++i, p += 3) {
      const x = normals[p], y = normals[p + 1], z = normals[p + 2], towards = x * key[0] + y * key[1] + z * key[2];
      for (const side of [0, 1]) {
        const facing = side ? -towards : towards, part = Math.min(1, Math.abs(facing) * (facing < 0 ? 0.85 : 1)),
              sign = side ? -lift : lift;
        const shade = facing > 0 ?
            0.72 + 0.28 * this.lit(places[p] + sign * x, places[p + 1] + sign * y, places[p + 2] + sign * z, 1) :
            0.86;
        const gain = 255 * ((side ? 0.9 : 1) * shade) ** (1 / 2.2), dark = part < 0.5 ? ramp[0] : ramp[1],
              light = part < 0.5 ? ramp[1] : ramp[2], mix = part < 0.5 ? 2 * part : 2 * part - 1;
        for (let k = 0; k < 3; ++k) rgb[side][p + k] = gain * (dark[k] + mix * (light[k] - dark[k]));
      }
    }
  }

  shadeBall({places, normals, rgb: [rgb], count}, eye) {
    const {key} = this, lift = 0.012 * this.reach, own = [0.463, 0.483, 0.524];  // B6BBC3 in linear light
    for (let i = 0, p = 0; i < count; ++i, p += 3) {
      const n = [normals[p], normals[p + 1], normals[p + 2]], facing = dot(n, key);
      const direct = 0.58 * Math.max(0, facing) *
          (facing > 0 ? this.lit(places[p] + lift * n[0], places[p + 1] + lift * n[1], places[p + 2] + lift * n[2], 1) :
                        0),
            sky = 0.36 + 0.12 * n[1], ground = 0.25 * (0.6 - 0.4 * n[1]);
      const half = unit(plus(key, 1, unit(minus(eye, places.subarray(p, p + 3))))),
            gloss = direct > 0.3 ? 0.12 * Math.max(0, dot(n, half)) ** 40 : 0;
      for (let k = 0; k < 3; ++k) {
        const light = direct * [1.035, 1, 0.955][k] + sky * [0.965, 0.99, 1.045][k] + ground;
        rgb[p + k] = Math.min(255, 255 * (own[k] * light + gloss) ** (1 / 2.2));
      }
    }
  }

  /** The ground is the background, darkened where it loses light. */
  drawFloor(view, box, background) {
    const {scene, floor, ground, raster} = this, {places, at, rgb: [rgb], index} = floor,
                                 foot = footOf(this.middle, scene.floor, this.key), half = 2.2 * this.reach;
    for (let j = 0, p = 0; j <= ground; ++j)
      for (let i = 0; i <= ground; ++i, p += 3)
        places[p] = foot[0] + half * (2 * i / ground - 1), places[p + 1] = scene.floor,
        places[p + 2] = foot[2] + half * (2 * j / ground - 1);
    projected(places, view.toClip, box, at);
    const step = (from, to, v) => {
      const t = Math.max(0, Math.min(1, (v - from) / (to - from)));
      return t * t * (3 - 2 * t);
    };
    const lost = floor.shadow;
    for (let p = 0; p < places.length; p += 3) {
      const away = Math.hypot(places[p] - foot[0], places[p + 2] - foot[2]) / half, u = (at[p] - box[0]) / box[2],
            v = (at[p + 1] - box[1]) / box[3];
      lost[p / 3] = away >= 1 ? 0 :
                                (1 - this.lit(places[p], places[p + 1], places[p + 2], 5)) * (1 - step(0.5, 1, away)) *
              step(0, 0.07, Math.min(u, 1 - u)) * step(0, 0.07, Math.min(v, 1 - v));
      for (let k = 0; k < 3; ++k) rgb[p + k] = background[k] * (1 - 0.3 * lost[p / 3]);
    }
    for (let t = 0; t < index.length; t += 3)
      if (lost[index[t]] + lost[index[t + 1]] + lost[index[t + 2]] > 0.01)
        raster.triangle(at, index[t], index[t + 1], index[t + 2], rgb, false);
  }
}
