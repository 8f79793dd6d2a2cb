// Camera of all panels, which turns about a point at a distance from which everything is visible.

import {cross, dot, minus, norm, Numbers, perspective, plus, times, toEye, Vec3} from './vectors';

const fieldOfView = 25 * Math.PI / 180;
export const tangent = Math.tan(fieldOfView / 2);

/** A ball to keep in view; `margin`: fraction of the view that stays free around the ball. */
export interface HeldBall {
  at: Numbers;
  radius: number;
  margin: number;
}

export interface Fit {
  target: Vec3;
  distance: number;  // m
}

export class Orbit {
  private readonly home: {yaw: number; pitch: number};
  yaw = 0;
  pitch = 0;
  zoom = 1;

  constructor(from: Numbers) {
    this.home = {yaw: Math.atan2(from[0], from[2]), pitch: Math.asin(from[1] / norm(from))};
    this.reset();
  }

  reset() { Object.assign(this, this.home, {zoom: 1}); }

  turn(yaw: number, pitch: number) {
    this.yaw += yaw;
    this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + pitch));
  }

  magnify(factor: number) { this.zoom = Math.max(0.15, Math.min(4, this.zoom / factor)); }

  /** Directions to the right, up and backwards. */
  axes({yaw, pitch}: {yaw: number, pitch: number} = this): Vec3[] {
    const back: Vec3 = [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
    const right: Vec3 = [Math.cos(yaw), 0, -Math.sin(yaw)];
    return [right, cross(back, right), back];
  }

  /**
   * Smallest distance at which the balls are inside a panel of this shape, seen from the home direction. The target is
   * near `middle`.
   */
  fit(balls: HeldBall[], middle: Vec3, aspect: number): Fit {
    const [right, up, back] = this.axes(this.home);
    const half = (axis: Vec3, slope: number) => {
      const most = [-Infinity, -Infinity];
      for (const {at, radius, margin} of balls) {
        const from = minus(at, middle);
        const s = slope * (1 - 2 * margin);
        // the edge of the view is a plane of slope s
        const reach = radius * Math.sqrt(1 + s * s), deep = s * dot(back, from);
        most[0] = Math.max(most[0], (dot(axis, from) + deep + reach) / s);
        most[1] = Math.max(most[1], (-dot(axis, from) + deep + reach) / s);
      }
      return {distance: (most[0] + most[1]) / 2, shift: slope * (most[0] - most[1]) / 2};
    };
    const wide = half(right, tangent * aspect), high = half(up, tangent);
    return {
      target: plus(plus(middle, wide.shift, right), high.shift, up),
      distance: Math.max(wide.distance, high.distance)
    };
  }

  view({target, distance}: Fit, aspect: number) {
    const axes = this.axes(), far = distance * this.zoom;
    const eye = plus(target, far, axes[2]);
    return {eye, toClip: times(perspective(tangent, aspect, far / 30, far * 8), toEye(axes, eye))};
  }
}
