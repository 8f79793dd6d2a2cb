// Draws the methods of one scene side by side, seen by one camera, into one canvas.

import {boundsOf, footOf} from './bounds';
import {heat, palette, purple, rgb, scaleBytes} from './colours';
import {Gl, Program, Table, Uniforms} from './gl';
import {distances, Motion, SceneStage, Shared, stretchOf} from './motion';
import {Held, Orbit, tangent} from './orbit';
import {ballVertex, clothFragment, clothVertex, floorFragment, floorVertex, fragmentCommon, rodVertex, solidFragment, threadFragment} from './shaders';
import {shapesOf} from './shapes';
import {lightMatrix, minus, plus, sumNormals} from './vectors';

/** Panels in rows and columns so that the smaller side of each picture is as long as can be; `title` is above each. */
export function gridOf(count: number, wide: number, high: number, title: number) {
  let best = {columns: 1, least: 0};
  for (let columns = 1; columns <= count; ++columns) {
    const least = Math.min(wide / columns, high / Math.ceil(count / columns) - title);
    if (least > best.least * 1.01) best = {columns, least};
  }
  return {columns: best.columns, rows: Math.ceil(count / best.columns)};
}

/** What stands side by side: a motion in its own colours, or its difference from another one up to `top` (m). */
export interface View {
  motion: Motion;
  look: {plain: number[], ramp: number[][]};
  other?: Motion;
  top?: number;
}
interface Panel extends View {
  points: Table;
  normals: Table|null;
  path: Table|null;
}
/** What colours mean; `from`: the motion from which distances are told, `top`: the value of the last colour. */
export interface Colouring {
  name: string;
  top: number;
  from?: Motion|null;
}
export interface Drawing {
  time: number;  // s
  colour: Colouring;
  springs: boolean;
  orbit: Orbit;
  background: number[];
  title: number;  // pixels above each panel that stay free
}
/** A panel's drawing. */
interface PanelLook {
  toClip: number[];
  eye: number[];
  time: number;
  springs: boolean;
  background: number[];
  pixel: number;  // m
  panel: Panel;
  valued: boolean;
  surface: boolean;
  toKey?: number[];
}
type Programs = Record<string, Program>;

export class Stage {
  protected readonly tools: Gl;
  protected readonly triangles: Uint16Array;
  protected panels: Panel[] = [];
  protected readonly programs: Programs;
  protected readonly casts: Programs;
  protected readonly shapes: ReturnType<typeof shapesOf>;
  protected readonly map: ReturnType<Gl['shadowMap']>;
  protected readonly scales: {heat: WebGLTexture, apart: WebGLTexture};
  // results of boundsOf
  protected held: Held[] = [];
  protected key: number[] = [];
  protected middle: number[] = [];
  protected size = 1;
  protected reach = 1;

  /**
   * `shared`: triangles, springs and rests of the scene; `coarse`: drawn for speed, with edges and shadows less
   * smooth.
   */
  constructor(
      readonly canvas: HTMLCanvasElement, readonly scene: SceneStage, readonly shared: Shared,
      private readonly coarse = false) {
    this.triangles = shared.triangles;
    const tools = this.tools = new Gl(canvas, !coarse), gl = tools.gl;
    const shade = fragmentCommon;
    this.programs = {
      cloth: tools.program(clothVertex, shade + clothFragment),
      thread: tools.program(clothVertex, threadFragment),
      ball: tools.program(ballVertex, shade + solidFragment),
      rod: tools.program(rodVertex, shade + solidFragment, '#define ROD\n'),
      floor: tools.program(floorVertex, shade + floorFragment),
    };
    this.casts = Object.fromEntries(Object.entries({cloth: clothVertex, ball: ballVertex, rod: rodVertex})
                                        .map(([name, text]) => [name, tools.program(text, 'void main() {}')]));
    this.shapes = shapesOf(tools, scene, shared);
    this.map = tools.shadowMap(1024);
    this.scales = {heat: tools.colours(scaleBytes(heat)), apart: tools.colours(scaleBytes(purple))};
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SCISSOR_TEST);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
  }

  show(views: View[]) {
    const {tools, scene, triangles} = this, n = scene.particles, {times} = scene;
    for (const panel of this.panels)
      for (const table of [panel.points, panel.normals, panel.path])
        if (table) tools.gl.deleteTexture(table.texture);
    this.panels = views.map(view => ({
                              ...view,
                              points: tools.table(n),
                              normals: triangles.length ? tools.table(n) : null,
                              path: triangles.length || times.length < 2 ? null : tools.table(times.length)
                            }));
    for (const {motion, path} of this.panels) {
      if (!path) continue;
      const places = new Float32Array(3 * n);
      times.forEach((t, f) => path.data.set([...motion.placesAt(t, places).subarray(3 * n - 3), -1], 4 * f));
      tools.fill(path);
    }
    Object.assign(this, boundsOf(scene, this.panels.map(p => p.motion)));
  }

  /** Gives the context back. */
  release() { this.tools.gl.getExtension('WEBGL_lose_context')?.loseContext(); }

  /** Writes places and values of a panel's particles (0 to 1, negative for none), four numbers each. */
  write({motion, other, top, points, normals}: Panel, time: number, colour: Colouring) {
    const {scene, triangles} = this, places = motion.placesAt(time), into = points.data;
    const metres = other ? distances(motion.apartAt(time, other)) :
        colour.from      ? distances(motion.apartAt(time, colour.from)) :
                           null;
    const values = metres ?? (colour.name === 'stretch' ? stretchOf(scene, this.shared, places) : null);
    const most = other ? top ?? 1 : colour.top;
    for (let i = 0; i < scene.particles; ++i) {
      into.set(places.subarray(3 * i, 3 * i + 3), 4 * i);
      into[4 * i + 3] = values ? Math.min(1, values[i] / most) : -1;
    }
    this.tools.fill(points);
    if (!normals) return;
    sumNormals(places, triangles, normals.data, 4);
    this.tools.fill(normals);
  }

  /** Draws the panels. Returns their places in the canvas, parts of its size. */
  draw({time, colour, springs, orbit, background, title}: Drawing) {
    const {gl} = this.tools, {canvas, scene, panels} = this;
    const ratio = canvas.width / canvas.clientWidth, room = Math.round(title * ratio);
    const {columns, rows} = gridOf(panels.length, canvas.width, canvas.height, room),
                    cell = Math.floor(canvas.height / rows);
    const wide = Math.floor(canvas.width / columns), high = cell - room, aspect = wide / high;
    const fit = orbit.fit(this.held, this.middle, aspect), view = orbit.view(fit, aspect);
    gl.scissor(0, 0, canvas.width, canvas.height);
    gl.clearColor(background[0], background[1], background[2], 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    return panels.map((panel, i) => {
      const column = i % columns, row = Math.floor(i / columns);
      this.write(panel, time, colour);
      const pixel = 2 * tangent * fit.distance * orbit.zoom / high * ratio;
      const look: PanelLook = {
        ...view,
        time,
        springs,
        background,
        pixel,
        panel,
        valued: Boolean(panel.other) || colour.name !== 'plain',
        surface: this.triangles.length > 0 && !springs,
      };
      if (scene.floor !== null) this.castShadows(look);
      const box: [number, number, number, number] = [column * wide, canvas.height - (row + 1) * cell, wide, high];
      gl.viewport(...box);
      gl.scissor(...box);
      this.drawPanel(look, box);
      return {left: column / columns, top: row / rows, wide: 1 / columns, high: 1 / rows};
    });
  }

  private castShadows(look: PanelLook) {
    const {gl} = this.tools, {map} = this;
    const toKey = lightMatrix(this.key, this.middle, 1.03 * this.reach);
    look.toKey = toKey;
    gl.bindFramebuffer(gl.FRAMEBUFFER, map.frame);
    gl.viewport(0, 0, map.size, map.size);
    gl.scissor(0, 0, map.size, map.size);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2, 4);
    this.drawBodies(this.casts, look, {to_clip: toKey, eye: plus(this.middle, 100 * this.reach, this.key)});
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  private drawPanel(look: PanelLook, box: number[]) {
    const {gl} = this.tools, {floor} = this.scene, flat = floor === null;
    const light = {
      to_clip: look.toClip,
      eye: look.eye,
      key: this.key,
      to_key: look.toKey || look.toClip,
      key_map: this.map.texture,
      lift: 0.006 * this.reach,
      shadowed: flat ? 0 : 1,
      taps: this.coarse ? 4 : 12,
      scale_map: look.panel.other ? this.scales.apart : this.scales.heat,
      by_value: look.valued ? 1 : 0,
      ramp: look.panel.look.ramp.flat(),
      background: look.background,
      by_family: look.surface ? 0 : 1,
      families: palette.flatMap(rgb)
    };
    this.drawBodies(this.programs, look, light);
    if (flat) return;
    gl.depthMask(false);
    const foot = footOf(this.middle, floor, this.key);
    this.tools.use(this.programs.floor, {...light, floor_at: [foot[0], floor, foot[2], 2.2 * this.reach], panel: box});
    this.tools.draw(this.shapes.floor, gl.TRIANGLES);
    gl.depthMask(true);
  }

  /** Cloth or springs, beads, pins, path and obstacles, with the programs given. */
  private drawBodies(programs: Programs, look: PanelLook, light: Uniforms) {
    const {gl} = this.tools, {tools, scene, shapes} = this, {panel, pixel} = look;
    const lit = programs === this.programs;
    const all = {
      ...light,
      points: panel.points.texture,
      normals: panel.normals && panel.normals.texture,
      plain: look.panel.look.plain,
      nearer: 0,
      ball: [0, 0, 0, 0]
    };
    const thin = 0.9 * pixel, bead = Math.min(8 * pixel, 0.03 * this.size);
    if (look.surface) {
      tools.use(programs.cloth, all);
      tools.draw(shapes.cloth, gl.TRIANGLES);
      if (lit) {
        gl.enable(gl.BLEND);
        tools.use(programs.thread, {...all, nearer: 4e-5, ink: look.valued ? 0.3 : 0.42});
        tools.draw(shapes.threads, gl.LINES);
        gl.disable(gl.BLEND);
      }
    } else {
      if (look.springs) {
        const own = scene.triangles ? {} : {plain: rgb('8E9196'), by_family: 0};
        tools.use(programs.rod, {...all, ...own, radius: scene.particles > 60 ? thin : 0.3 * bead});
        tools.draw(shapes.rods, gl.TRIANGLES);
      }
      tools.use(programs.ball, {...all, radius: scene.particles > 60 ? 0.4 * bead : bead});
      if (!scene.triangles) tools.draw(shapes.beads, gl.TRIANGLES);
    }
    tools.use(programs.ball, {
      ...all,
      radius: 1.25 * Math.max(2.2 * pixel, scene.triangles ? 0 : bead),
      plain: rgb(look.background[0] > 0.5 ? '34363B' : 'A9AFB6'),
      by_value: 0
    });
    tools.draw(shapes.pins, gl.TRIANGLES);
    if (lit && panel.path) {
      tools.use(
          programs.rod,
          {...all, points: panel.path.texture, radius: 0.7 * pixel, plain: rgb('6C7A91'), by_value: 0, by_family: 0});
      tools.draw(shapes.path, gl.TRIANGLES, Math.max(0, Math.floor(this.frame(Math.min(look.time, panel.motion.end)))));
    }
    this.drawObstacles(programs, look.time, all);
  }

  /** Frame of the scene at a time, with its fraction. */
  private frame(time: number) {
    const {times} = this.scene, last = times.length - 1;
    return last > 0 ? last * Math.min(1, time / times[last]) : 0;
  }

  private drawObstacles(programs: Programs, time: number, all: Uniforms) {
    const {tools, scene} = this, last = scene.times.length - 1;
    const at = this.frame(time), first = Math.floor(at), next = Math.min(first + 1, last);
    for (const {radius, centres} of scene.spheres) {
      const a = centres[Math.min(first, centres.length - 1)], b = centres[Math.min(next, centres.length - 1)];
      const ball = [...plus(a, at - first, minus(b, a)), radius];
      tools.use(programs.ball, {...all, ball, plain: rgb('B6BBC3'), by_value: 0});
      tools.draw(this.shapes.obstacle, tools.gl.TRIANGLES);
    }
  }
}
