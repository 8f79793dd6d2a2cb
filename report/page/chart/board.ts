// Positions of labels: next to the curve, joined to its end by a leader line, or in a column at the right.

import {Frame} from './axes';
import {Box, letters, lineHeight, widthOf} from './sheet';
import {Pair} from './spec';

/** Points along a path, at most `apart` px from each other. */
export function dense(path: readonly Pair[], apart = 6): Pair[] {
  const points: Pair[] = path.slice(0, 1);
  for (let i = 1; i < path.length; ++i) {
    const [[x, y], [toX, toY]] = [path[i - 1], path[i]], steps = Math.ceil(Math.hypot(toX - x, toY - y) / apart);
    for (let k = 1; k <= steps; ++k) points.push([x + (toX - x) * k / steps, y + (toY - y) * k / steps]);
  }
  return points;
}

export function distance(box: Box, points: readonly Pair[]): number {
  let least = Infinity;
  for (const [x, y] of points)
    least =
        Math.min(least, Math.hypot(Math.max(0, box.left - x, x - box.right), Math.max(0, box.top - y, y - box.bottom)));
  return least;
}

const cell = 3;  // px

/** A box for a text. `more` is the part of its cost that is computed only if the other part is low. */
export interface Candidate {
  box: Box;
  penalty: number;
  more?: () => number;
}

/** Occupied areas of a plot. */
export class Board {
  private readonly across: number;
  private readonly cells: Uint8Array;

  constructor(private readonly frame: Frame) {
    this.across = Math.ceil((frame.right - frame.left) / cell) + 1;
    this.cells = new Uint8Array(this.across * (Math.ceil((frame.bottom - frame.top) / cell) + 1));
  }

  private mark(box: Box, value: number) {
    const {left, right, top, bottom} = this.frame;
    for (let y = Math.max(top, box.top); y <= Math.min(bottom, box.bottom + cell - 0.01); y += cell)
      for (let x = Math.max(left, box.left); x <= Math.min(right, box.right + cell - 0.01); x += cell) {
        const place = Math.floor((y - top) / cell) * this.across + Math.floor((x - left) / cell);
        this.cells[place] = Math.max(this.cells[place], value);
      }
  }

  add(box: Box) { this.mark(box, 2); }
  addMark([x, y]: Pair) { this.add({left: x - 5, right: x + 5, top: y - 5, bottom: y + 5}); }
  /** Adds a line. Labels may cross it if `yields` is true. */
  addLine(path: readonly Pair[], yields: boolean) {
    for (const [x, y] of dense(path, cell))
      this.mark({left: x - 1, right: x + 1, top: y - 1, bottom: y + 1}, yields ? 1 : 2);
  }

  /** Number of cells of yielding lines that a box covers; infinite if it covers other content or leaves the frame. */
  cost(box: Box): number {
    const {left, right, top, bottom} = this.frame;
    if (box.left < left || box.right > right || box.top < top || box.bottom > bottom) return Infinity;
    let sum = 0;
    for (let y = Math.floor((box.top - top) / cell); y <= Math.floor((box.bottom - top) / cell); ++y)
      for (let x = Math.floor((box.left - left) / cell); x <= Math.floor((box.right - left) / cell); ++x) {
        const value = this.cells[y * this.across + x];
        if (value > 1) return Infinity;
        sum += value;
      }
    return sum;
  }

  /** Occupies the cheapest box and returns it. Returns null if no box is cheap enough. */
  take(boxes: Iterable<Candidate>): Box|null {
    let best = 60, found: Box|null = null;
    for (const {box, penalty, more} of boxes) {
      if (penalty >= best) continue;
      let cost = penalty + this.cost(box);
      if (cost < best && more) cost += more();
      if (cost < best) best = cost, found = box;
    }
    if (found) this.add(grown(found, 2));
    return found;
  }
}

const grown = (box: Box, by: number): Box =>
    ({left: box.left - by, right: box.right + by, top: box.top - by, bottom: box.bottom + by});

export const boxOfLines = (lines: readonly string[], left: number, baseline: number, bold = false): Box => ({
  left,
  right: left + Math.max(...lines.map(line => widthOf(line, bold))),
  top: baseline - 0.76 * letters,
  bottom: baseline + 0.24 * letters + lineHeight * (lines.length - 1)
});

/** Boxes for a label at the ends of its curve and along it. Boxes nearer to another curve have infinite cost. */
export function* boxesBeside(name: string, paths: readonly Pair[][], others: readonly Pair[]) {
  const width = widthOf(name, true), own = paths.flat();
  const at = (left: number, middle: number, penalty: number) => {
    const box = {left, right: left + width, top: middle - 0.5 * letters, bottom: middle + 0.5 * letters};
    const more = () => {
      const near = distance(box, own), other = distance(box, others);
      return near > 16 || other < near + 3 ? Infinity : Math.max(0, 12 - other);
    };
    return {box, penalty, more};
  };
  for (const path of paths) {
    const stride = Math.max(1, Math.floor(path.length / 30)), last = path[path.length - 1], first = path[0];
    for (const away of [0, 4, 9]) {
      yield at(last[0] + 8 + away, last[1], away);
      yield at(first[0] - 8 - away - width, first[1], 14 + away);
    }
    for (let k = path.length - 1; k >= 0; k -= stride)
      for (const away of [0, 4])
        for (const side of [-1, 1])
          for (const shift of [0.5, 0, 1, 0.25, 0.75])
            yield at(
                path[k][0] - shift * width, path[k][1] + side * (13 + away), 5 + away + 10 * (1 - k / path.length));
  }
}

/** Boxes for text around a point, at growing distances; a leader line can join a box's near side to the point. */
export function* boxesAround(lines: readonly string[], [x, y]: Pair, bold = false) {
  const high = lineHeight * (lines.length - 1);
  for (let away = 18; away < 110; away += 8)
    for (let k = 0; k < 16; ++k) {
      const angle = Math.PI * k / 8, px = x + away * Math.cos(angle), py = y + away * Math.sin(angle);
      const box = boxOfLines(lines, px, py + 4 - high / 2, bold), wide = box.right - box.left;
      const shift = px < x - 1 ? -wide : Math.abs(px - x) <= 1 ? -wide / 2 : 0;
      yield {box: {...box, left: box.left + shift, right: box.right + shift}, penalty: away / 4};
    }
}

/** Point of a box that is nearest to a given point: the end of its leader line. */
export const nearestOf = (box: Box, [x, y]: Pair):
    Pair => [Math.max(box.left - 2, Math.min(x, box.right + 2)), Math.max(box.top, Math.min(y, box.bottom))];

/** Moves heights as little as possible, and within the limits, until they are at least `apart` from each other. */
export function pushedApart(wanted: readonly number[], low: number, high: number, apart: number): number[] {
  const order = wanted.map((_, i) => i).sort((a, b) => wanted[a] - wanted[b]), places = order.map(i => wanted[i]);
  for (let pass = 0; pass < 200; ++pass)
    for (let k = 0; k < places.length; ++k) {
      const gap = k > 0 ? places[k - 1] + apart - places[k] : 0;
      if (gap > 0) places[k] += gap / 2, places[k - 1] -= gap / 2;
      places[k] = Math.min(Math.max(places[k], low + apart * k), high - apart * (places.length - 1 - k));
    }
  const result: number[] = [];
  order.forEach((i, k) => result[i] = places[k]);
  return result;
}

export const isInside = ([x, y]: Pair, {left, right, top, bottom}: Frame) =>
    x >= left - 1 && x <= right + 1 && y >= top - 1 && y <= bottom + 1;

export function clipped(path: readonly Pair[], {left, right, top, bottom}: Frame): Pair[][] {
  const runs: Pair[][] = path.length === 1 && isInside(path[0], {left, right, top, bottom}) ? [[path[0]]] : [];
  let open = false;
  for (let i = 1; i < path.length; ++i) {
    const [x, y] = path[i - 1], dx = path[i][0] - x, dy = path[i][1] - y;
    let from = 0, to = 1;
    for (const [step, room] of [[-dx, x - left], [dx, right - x], [-dy, y - top], [dy, bottom - y]]) {
      if (step < 0) from = Math.max(from, room / step);
      if (step > 0) to = Math.min(to, room / step);
      if (step === 0 && room < 0) to = -1;
    }
    if (from > to) {
      open = false;
      continue;
    }
    if (!open || from > 0) runs.push([[x + from * dx, y + from * dy]]);
    runs[runs.length - 1].push([x + to * dx, y + to * dy]);
    open = to === 1;
  }
  return runs;
}
