// Corners and instances of shapes.

import {Gl, Mesh, Shape} from './gl';
import {SharedGeometry, StageScene} from './stage';

/** Mesh of a ball of radius 1. */
export function ballMesh(around: number, along: number) {
  const corners: number[] = [], index: number[] = [];
  for (let j = 0; j <= along; ++j)
    for (let i = 0; i <= around; ++i) {
      const a = 2 * Math.PI * i / around, b = Math.PI * j / along;
      corners.push(Math.sin(b) * Math.cos(a), Math.cos(b), Math.sin(b) * Math.sin(a));
      const here = j * (around + 1) + i, below = here + around + 1;
      if (i < around && j < along) index.push(here, below, here + 1, here + 1, below, below + 1);
    }
  return {corners: new Float32Array(corners), size: 3, index: new Uint16Array(index)};
}

const square = new Uint16Array([0, 1, 2, 2, 1, 3]);

/** Strips that are shaded as rods, one per row of two particles and a family. */
export const rods = (tools: Gl, rows: Int32Array) => tools.shape(
    {corners: new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]), size: 2, slot: 2, ints: 3, index: square, instances: rows});

/** Balls at particles, coarse if there are many. */
export const balls = (tools: Gl, particles: number, list: number[]) =>
    ballsOf(tools, particles > 60 ? ballMesh(10, 6) : ballMesh(24, 16), list);
const ballsOf = (tools: Gl, mesh: Mesh, list: number[]) =>
    tools.shape({...mesh, instances: Int32Array.from(list), slot: 1, ints: 1});

/** Rows (a, b, family) of the springs; `counts`: springs per family. */
function springRows(ends: Uint16Array, counts: number[]) {
  const rows = new Int32Array(ends.length / 2 * 3);
  let row = 0;
  counts.forEach((count, family) => {
    for (let k = 0; k < count; ++k, ++row) rows.set([ends[2 * row], ends[2 * row + 1], family], 3 * row);
  });
  return rows;
}

export type ShapeName = 'cloth'|'threads'|'rods'|'path'|'beads'|'pins'|'obstacle'|'floor';

export function shapesOf(tools: Gl, scene: StageScene, {triangles, springs}: SharedGeometry): Record<ShapeName, Shape> {
  const steps = scene.times.slice(1).flatMap((_, f) => [f, f + 1, 0]);
  return {
    cloth: tools.shape({index: triangles}),
    threads: tools.shape({index: springs.subarray(0, 2 * scene.springs.threads)}),
    rods: rods(tools, springRows(springs, scene.springs.families.map(f => f.count))),
    path: rods(tools, Int32Array.from(steps)),
    beads: balls(tools, scene.particles, Array.from({length: scene.particles}, (_, i) => i)),
    pins: balls(tools, scene.particles, scene.pins),
    obstacle: ballsOf(tools, ballMesh(72, 48), [0]),
    floor: tools.shape({corners: new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), size: 2, index: square}),
  };
}
