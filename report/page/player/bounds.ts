// Bounds of a scene: what the camera must show, and the ball that light and shadow must cover.

import {HeldBall} from './orbit';
import {StageScene} from './stage';
import {minus, norm, Numbers, placeOf, plus, unit, Vec3} from './vectors';

/** Positions over time, in s; `well`: the run did not fail. */
export interface MovingPlaces {
  well: boolean;
  begin: number;
  end: number;
  placesAt(time: number, into?: Float32Array): Float32Array;
}

export interface Bounds {
  held: HeldBall[];  // bodies and shadows
  key: Vec3;         // towards the light
  size: number;      // m, diagonal of the box around the bodies
  middle: Vec3;
  reach: number;  // m, radius of the ball around the bodies
}

/** Direction towards the key light, which is to the left behind the viewer. */
function keyDirection(from: Numbers) {
  const back: Vec3 = Math.hypot(from[0], from[2]) > 1e-9 ? unit([from[0], 0, from[2]]) : [0, 0, 1];
  const right = [back[2], 0, -back[0]];
  return unit(plus(plus([0, 1, 0], -0.3, right), 0.44, back));
}

/** Where the light's ray through a position meets the ground. */
export const footOf = (at: Numbers, floor: number, key: Vec3) => plus(at, -(at[1] - floor) / key[1], key);

/** Bounds of obstacles, shadows, and some particles in some frames of the completed runs. */
export function boundsOf(scene: StageScene, motions: MovingPlaces[]): Bounds {
  const held: HeldBall[] = [], well = motions.filter(motion => motion.well);
  const stride = Math.max(1, Math.floor(scene.particles / 300)), places = new Float32Array(3 * scene.particles);
  for (const motion of well.length ? well : motions)
    for (let f = 0; f <= 12; ++f) {
      motion.placesAt(motion.begin + f / 12 * (motion.end - motion.begin), places);
      for (let i = 0; i < scene.particles; i += stride) held.push({at: placeOf(places, i), radius: 0, margin: 0.07});
    }
  for (const sphere of scene.spheres)
    for (const at of sphere.centres) held.push({at, radius: sphere.radius, margin: 0.07});
  const most = (of: (ball: HeldBall) => number) => held.reduce((far, h) => Math.max(far, of(h)), -Infinity);
  const low = [0, 1, 2].map(k => -most(h => h.radius - h.at[k])) as Vec3;
  const high = [0, 1, 2].map(k => most(h => h.at[k] + h.radius));
  const size = norm(minus(high, low)) || 1, key = keyDirection(scene.from);
  // a single particle at rest gets a view of one metre
  if (norm(minus(high, low)) === 0) held.push({at: low, radius: 0.5, margin: 0});
  const middle = low.map((a, k) => (a + high[k]) / 2) as Vec3;
  const reach = most(h => norm(minus(h.at, middle)) + h.radius), {floor} = scene;
  const shadows =
      floor === null ? [] : held.map(({at, radius}) => ({at: footOf(at, floor, key), radius, margin: 0.015}));
  return {held: held.concat(shadows), key, size, middle, reach};
}
