// Draws the runs of a scene side by side in one canvas, with a common camera.

import {Bounds, boundsOf, footOf} from './bounds';
import {heat, Look, palette, purple, rgb, scaleBytes} from './colours';
import {Gl, Program, Shape, Table, Uniforms} from './gl';
import {distances, Motion, stretchOf} from './motion';
import {Fit, Orbit, tangent} from './orbit';
import {ballVertex, clothFragment, clothVertex, floorFragment, floorVertex, fragmentCommon, rodVertex, solidFragment, threadFragment} from './shaders';
import {ShapeName, shapesOf} from './shapes';
import {cross, dot, lightMatrix, minus, Numbers, placeOf, Places, plus, sumNormals, unit, Vec3} from './vectors';

export interface StageScene {
  scene: string;
  particles: number;
  times: number[];  // s, times of the frames
  from: Numbers;    // direction towards the viewer
  floor: number|null;
  triangles: unknown;  // null or false: no cloth
  pins: number[];
  /** Families are in the order of the springs; the first `threads` springs are drawn on a cloth. */
  springs: {families: {name: string, count: number}[], threads: number, rest_unit: number};
  spheres: {radius: number, centres: Numbers[]}[];  // centres at equally spaced times
  planes?: PlaneFace[];
}
/** A plane: a point (m) and the outward normal. */
export interface PlaneFace {
  point: Numbers;
  normal: Numbers;
}
/** Only floors and slopes are drawn, because walls and ceilings would hide what is behind them. */
export const isFloor = ({normal}: PlaneFace) => normal[1] > 1 - 1e-9;
const isSlope = (plane: PlaneFace) => plane.normal[1] > 0.1 && !isFloor(plane);
export interface SharedGeometry {
  triangles: Uint16Array;
  springs: Uint16Array;  // indices of both ends of each spring
  rests: Numbers;        // rest lengths in `rest_unit`
}

export interface Panel {
  look: Pick<Look, 'plain'|'ramp'>;
  points: Table;        // position and value of each particle
  normals: Table|null;  // cloth only
  scale: 'heat'|'apart';
}
/** Colouring by method, or by a value up to `top`; `from`: reference motion for distances. */
export interface Colouring {
  name: string;
  top: number;
  from?: Motion|null;
}
export interface Shown {
  time: number;  // s
  colour: Colouring;
  springs: boolean;
  orbit: Orbit;
  background: number[];
  title: number;  // CSS pixels that stay free above each panel
}
/** Position of a panel, including its title. */
export interface PanelPlace {
  left: number;
  top: number;
  wide: number;
  high: number;
}
export interface PanelView<P> {
  panel: P;
  time: number;
  springs: boolean;
  background: number[];
  eye: Vec3;
  toClip: number[];
  toKey: number[]|null;  // matrix to the clip space of the light
  pixel: number;         // m
  valued: boolean;
  surface: boolean;
  ghost: boolean;  // true: drawn over the previous panel
}

/** Rows and columns that maximise the smaller side of each picture; `title`: height above it. */
export function gridOf(count: number, wide: number, high: number, title: number) {
  let best = {columns: 1, least: 0};
  for (let columns = 1; columns <= count; ++columns) {
    const least = Math.min(wide / columns, high / Math.ceil(count / columns) - title);
    if (least > best.least * 1.01) best = {columns, least};
  }
  return {columns: best.columns, rows: Math.ceil(count / best.columns)};
}

export type BodyPrograms = Record<'cloth'|'ball'|'rod', Program>;

/** Programs, shapes and light of a scene. Derived classes know the positions of particles. */
export class BaseStage<P extends Panel> {
  panels: P[] = [];
  protected readonly tools: Gl;
  protected readonly programs: BodyPrograms&Record<'thread'|'floor', Program>;
  private readonly casts: BodyPrograms;
  protected readonly shapes: Record<ShapeName, Shape>;
  private readonly map: ReturnType<Gl['shadowMap']>;
  private readonly scales: Record<'heat'|'apart', WebGLTexture>;
  protected readonly triangles: Uint16Array;
  protected bounds: Bounds;

  /** `coarse`: faster, with less smooth edges and shadows. */
  constructor(
      readonly canvas: HTMLCanvasElement, readonly scene: StageScene, readonly shared: SharedGeometry,
      readonly coarse = false) {
    this.triangles = shared.triangles;
    const tools = this.tools = new Gl(canvas, !coarse), gl = tools.gl;
    this.programs = {
      cloth: tools.program(clothVertex, fragmentCommon + clothFragment),
      thread: tools.program(clothVertex, threadFragment),
      ball: tools.program(ballVertex, fragmentCommon + solidFragment),
      rod: tools.program(rodVertex, fragmentCommon + solidFragment, '#define ROD\n'),
      floor: tools.program(floorVertex, fragmentCommon + floorFragment),
    };
    const cast = (vertex: string) => tools.program(vertex, 'void main() {}');
    this.casts = {cloth: cast(clothVertex), ball: cast(ballVertex), rod: cast(rodVertex)};
    this.shapes = shapesOf(tools, scene, shared);
    this.map = tools.shadowMap(1024);
    this.scales = {heat: tools.colours(scaleBytes(heat)), apart: tools.colours(scaleBytes(purple))};
    this.bounds = boundsOf(scene, []);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SCISSOR_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  /** Diagonal of the visible bounds, m. */
  get size() { return this.bounds.size; }

  release() { this.tools.gl.getExtension('WEBGL_lose_context')?.loseContext(); }

  protected dropTables(...tables: (Table|null)[]) {
    for (const table of tables)
      if (table) this.tools.gl.deleteTexture(table.texture);
  }

  /** Writes the positions of a panel's particles, and their values relative to `top` (-1 if there are no values). */
  protected fill({points, normals}: P, places: Numbers, values: Numbers|null, top: number) {
    const into = points.data;
    for (let i = 0; i < this.scene.particles; ++i) {
      into[4 * i] = places[3 * i], into[4 * i + 1] = places[3 * i + 1], into[4 * i + 2] = places[3 * i + 2];
      into[4 * i + 3] = values ? Math.min(1, values[i] / top) : -1;
    }
    this.tools.fill(points);
    if (!normals) return;
    sumNormals(places, this.triangles, normals.data, 4);
    this.tools.fill(normals);
  }

  /**
   * Draws panels in a grid, or over one another. `fitted` may limit the camera; `prepare` writes a panel's positions
   * and returns true if they have values. Returns the camera and the panels' places (pictures without titles, CSS
   * pixels).
   */
  protected drawPanels(
      {time, springs, orbit, background, title}: Omit<Shown, 'colour'>, over: boolean, fitted: (fit: Fit) => Fit,
      prepare: (panel: P, ghost: boolean) => boolean) {
    const {gl} = this.tools, {canvas, scene, panels} = this;
    const ratio = canvas.width / canvas.clientWidth, room = Math.round(title * ratio);
    const {columns, rows} = over ? {columns: 1, rows: 1} : gridOf(panels.length, canvas.width, canvas.height, room);
    const cell = Math.floor(canvas.height / rows), wide = Math.floor(canvas.width / columns), high = cell - room;
    const aspect = wide / high, fit = fitted(orbit.fit(this.bounds.held, this.bounds.middle, aspect));
    const camera = orbit.view(fit, aspect), pixel = 2 * tangent * fit.distance * orbit.zoom / high * ratio;
    gl.scissor(0, 0, canvas.width, canvas.height);
    gl.clearColor(background[0], background[1], background[2], 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    let toKey: number[]|null = null;
    const places: PanelPlace[] = [], boxes: PanelPlace[] = [];
    panels.forEach((panel, i) => {
      const ghost = over && i > 0, column = over ? 0 : i % columns, row = over ? 0 : Math.floor(i / columns);
      const valued = prepare(panel, ghost), surface = this.triangles.length > 0 && !springs;
      const view: PanelView<P> = {...camera, panel, time, springs, background, toKey, pixel, valued, surface, ghost};
      if (scene.floor !== null && !ghost) toKey = view.toKey = this.castShadows(view);
      const box = [column * wide, canvas.height - (row + 1) * cell, wide, high] as const;
      gl.viewport(...box);
      gl.scissor(...box);
      this.drawPanel(view, [...box]);
      places.push({left: column / columns, top: row / rows, wide: 1 / columns, high: 1 / rows});
      boxes.push({left: box[0] / ratio, top: (row * cell + room) / ratio, wide: wide / ratio, high: high / ratio});
    });
    return {places, boxes, aspect, fit, ...camera};
  }

  private castShadows(view: PanelView<P>) {
    const {gl} = this.tools, {map} = this, {key, middle, reach} = this.bounds;
    const toKey = lightMatrix(key, middle, 1.03 * reach);
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    gl.viewport(0, 0, map.size, map.size);
    gl.scissor(0, 0, map.size, map.size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 4);
    this.drawBodies(this.casts, view, {to_clip: toKey, eye: plus(middle, 100 * reach, key)});
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    return toKey;
  }

  private drawPanel(view: PanelView<P>, box: number[]) {
    const {gl} = this.tools, {floor} = this.scene, {key, middle, reach} = this.bounds;
    const shadows = floor !== null && !view.ghost;
    const light: Uniforms = {
      to_clip: view.toClip,
      eye: view.eye,
      key,
      to_key: view.toKey ?? view.toClip,
      key_map: this.map.texture,
      lift: 0.006 * reach,
      shadowed: shadows ? 1 : 0,
      taps: this.coarse ? 4 : 12,
      scale_map: this.scales[view.panel.scale],
      by_value: view.valued ? 1 : 0,
      ramp: view.panel.look.ramp.flat(),
      background: view.background,
      by_family: view.surface ? 0 : 1,
      families: palette.flatMap(rgb)
    };
    this.drawBodies(this.programs, view, light);
    if (view.ghost) return;
    gl.depthMask(false);
    const draw = (at: Vec3, u: Vec3, v: Vec3, wide: number, tint: number) => {
      const [floor_u, floor_v] = [plus([0, 0, 0], wide, u), plus([0, 0, 0], wide, v)];
      this.tools.use(this.programs.floor, {...light, floor_at: at, floor_u, floor_v, reach: wide, tint, panel: box});
      this.tools.draw(this.shapes.floor, gl.TRIANGLES);
    };
    for (const {point, normal} of (this.scene.planes ?? []).filter(isSlope)) {
      const level = unit(cross(normal, [0, 1, 0])), at = plus(middle, -dot(minus(middle, point), normal), normal);
      draw(at, level, cross(level, normal), 1.2 * reach, 0.09);
    }
    if (floor !== null) {
      const [x, , z] = footOf(middle, floor, key);
      draw([x, floor, z], [1, 0, 0], [0, 0, 1], 2.2 * reach, 0);
    }
    gl.depthMask(true);
  }

  protected uniformsOf({panel}: PanelView<P>, light: Uniforms): Uniforms {
    return {
      ...light,
      points: panel.points.texture,
      normals: panel.normals?.texture,
      plain: panel.look.plain,
      nearer: 0,
      ball: [0, 0, 0, 0]
    };
  }

  protected drawBodies(programs: BodyPrograms, view: PanelView<P>, light: Uniforms) {
    const {gl} = this.tools, {tools, scene, shapes} = this, {pixel} = view, lit = programs === this.programs;
    const all = this.uniformsOf(view, light), many = scene.particles > 60;
    const thin = 0.9 * pixel, bead = Math.min(8 * pixel, 0.03 * this.size);
    if (view.surface) {
      tools.use(programs.cloth, all);
      tools.draw(shapes.cloth, gl.TRIANGLES);
      if (lit) {
        gl.enable(gl.BLEND);
        tools.use(this.programs.thread, {...all, nearer: 4e-5, ink: view.valued ? 0.3 : 0.42});
        tools.draw(shapes.threads, gl.LINES);
        gl.disable(gl.BLEND);
      }
    } else {
      if (view.springs) {
        const own = scene.triangles ? {} : {plain: rgb('8E9196'), by_family: 0};
        tools.use(programs.rod, {...all, ...own, radius: many ? thin : 0.3 * bead});
        tools.draw(shapes.rods, gl.TRIANGLES);
      }
      tools.use(programs.ball, {...all, radius: many ? 0.4 * bead : bead});
      if (!scene.triangles) tools.draw(shapes.beads, gl.TRIANGLES);
    }
    tools.use(programs.ball, {
      ...all,
      radius: 1.25 * Math.max(2.2 * pixel, scene.triangles ? 0 : bead),
      plain: rgb(view.background[0] > 0.5 ? '34363B' : 'A9AFB6'),
      by_value: 0
    });
    tools.draw(shapes.pins, gl.TRIANGLES);
    if (lit) this.drawPath(view, {...all, by_value: 0, by_family: 0});
    for (const [radius, centre] of this.obstaclesAt(view.time)) {
      tools.use(programs.ball, {...all, ball: [...centre, radius], plain: rgb('B6BBC3'), by_value: 0});
      tools.draw(shapes.obstacle, gl.TRIANGLES);
    }
  }

  protected drawPath(_view: PanelView<P>, _all: Uniforms) {}

  /** Frame at a time, as a fraction. */
  protected frame(time: number) {
    const {times} = this.scene, last = times.length - 1;
    return last > 0 ? last * Math.min(1, time / times[last]) : 0;
  }

  /** Radius and centre of each sphere at a time. */
  protected obstaclesAt(time: number): [number, Vec3][] {
    const {scene} = this, last = scene.times.length - 1;
    const at = this.frame(time), first = Math.floor(at), next = Math.min(first + 1, last);
    return scene.spheres.map(({radius, centres}) => {
      const a = centres[Math.min(first, centres.length - 1)], b = centres[Math.min(next, centres.length - 1)];
      return [radius, plus(a, at - first, minus(b, a))];
    });
  }
}

/** A stored run; or, if `other` is given, its difference from that run, in colours up to `top` (m). */
export interface View {
  motion: Motion;
  look: Pick<Look, 'plain'|'ramp'>;
  other?: Motion|null;
  top?: number;
}
type MotionPanel = Panel&View&{path: Table | null};

export class Stage extends BaseStage<MotionPanel> {
  show(views: View[]) {
    const {tools, scene} = this, cloth = this.triangles.length > 0, n = scene.particles, {times} = scene;
    for (const {points, normals, path} of this.panels) this.dropTables(points, normals, path);
    this.panels = views.map(view => ({
                              ...view,
                              points: tools.table(n),
                              normals: cloth ? tools.table(n) : null,
                              path: cloth || times.length < 2 ? null : tools.table(times.length),
                              scale: view.other ? 'apart' : 'heat'
                            }));
    const places = new Float32Array(3 * n);
    for (const {motion, path} of this.panels) {
      if (!path) continue;
      times.forEach((t, f) => path.data.set([...placeOf(motion.placesAt(t, places), n - 1), -1], 4 * f));
      tools.fill(path);
    }
    this.bounds = boundsOf(scene, this.panels.map(p => p.motion));
  }

  draw(shown: Shown): PanelPlace[] {
    const {time, colour} = shown;
    const prepare = (panel: MotionPanel) => {
      const {motion, other, top = 1} = panel, from = other ?? colour.from, places: Places = motion.placesAt(time);
      const values = from           ? distances(motion.apartAt(time, from)) :
          colour.name === 'stretch' ? stretchOf(this.scene, this.shared, places) :
                                      null;
      this.fill(panel, places, values, other ? top : colour.top);
      return Boolean(other) || colour.name !== 'plain';
    };
    return this.drawPanels(shown, false, fit => fit, prepare).places;
  }

  protected drawPath({panel, time, pixel}: PanelView<MotionPanel>, all: Uniforms) {
    if (!panel.path) return;
    const steps = Math.max(0, Math.floor(this.frame(Math.min(time, panel.motion.end))));
    this.tools.use(this.programs.rod, {...all, points: panel.path.texture, radius: 0.7 * pixel, plain: rgb('6C7A91')});
    this.tools.draw(this.shapes.path, this.tools.gl.TRIANGLES, steps);
  }
}
