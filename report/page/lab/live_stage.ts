// Draws the current positions of runs, overlaid or side by side.

import {boundsOf} from '../player/bounds';
import {rgb} from '../player/colours';
import {Shape, Table, Uniforms} from '../player/gl';
import {stretchOf} from '../player/motion';
import {Fit} from '../player/orbit';
import {stillWanted} from '../player/player';
import {balls, rods} from '../player/shapes';
import {BaseStage, BodyPrograms, Colouring, isFloor, Panel, PanelPlace, PanelView, SharedGeometry, Shown, StageScene} from '../player/stage';
import {minus, norm, Numbers, placeOf, Places, plus, Vec3} from '../player/vectors';

import {Simulation} from './engine';
import {RunLook} from './lab_view';
import {LiveRun} from './live_run';

export const trailPoints = 600;

/** Converts the engine's scene for the stage. */
export function stageScene(name: string, {scene}: Simulation, floor: number|null, from: Numbers): StageScene&
    {shared: SharedGeometry} {
  const names = ['single', 'structural', 'shear', 'bend'], ranks = [1, 0, 2, 3];
  // order: distance constraints, then springs by family, beginning with those that are drawn as threads
  const order = [...scene.families.keys()];
  order.sort((a, b) => ranks[scene.families[a]] - ranks[scene.families[b]] || a - b);
  const hard = scene.constraintLengths.length, families = hard ? [{name: 'hard distance', count: hard}] : [];
  for (const s of order) {
    const family = names[scene.families[s]], last = families[families.length - 1];
    if (last?.name === family)
      ++last.count;
    else
      families.push({name: family, count: 1});
  }
  const threads =
      families.filter(f => f.name === 'structural' || f.name === 'hard distance').reduce((sum, f) => sum + f.count, 0);
  return {
    scene: name,
    particles: scene.particles,
    times: Array.from({length: trailPoints}, (_, i) => scene.duration * i / (trailPoints - 1)),
    from,
    floor,
    triangles: scene.triangles.length > 0,
    pins: [...scene.pins],
    springs: {families, threads, rest_unit: 1},
    spheres: scene.spheres.map(({radius}) => ({radius, centres: []})),
    planes: scene.planes,
    shared: {
      triangles: Uint16Array.from(scene.triangles),
      springs: Uint16Array.from(
          [...scene.constraints, ...order.flatMap(s => [scene.springs[2 * s], scene.springs[2 * s + 1]])]),
      rests: Float64Array.from([...scene.constraintLengths, ...order.map(s => scene.rests[s])])
    },
  };
}

/** A run that is drawn. If `run` is missing, the truth is drawn, faintly. */
export interface LiveView {
  run: LiveRun|null;
  letter: string;
  look: RunLook;
  places: Float64Array;
  trail: Vec3[];
  faint?: boolean;
}
type LivePanel = Panel&LiveView&{way: Table | null, gone: number};

/** Arrows on the particles of a run. */
export interface Growth {
  letter: string;
  mode: Float64Array;
}

export interface LiveShown extends Omit<Shown, 'colour'> {
  over: boolean;
  colour: Omit<Colouring, 'from'>&{from: Places | null};
  centres: Numbers;  // m, centres of the spheres
  growth: Growth|null;
  marked: {particle: number, held: boolean}|null;
}

export class LiveStage extends BaseStage<LivePanel> {
  made = '';  // numbers of elements for which the stage was made
  aspect = 1;
  boxes: PanelPlace[] = [];  // pictures without titles, CSS pixels
  moving = false;
  private toClip: number[] = [];
  private readonly arrowShape: Shape;
  private readonly arrows: Table;
  private readonly course: {table: Table|null, count: number} = {table: null, count: 0};
  private fit: Fit|null = null;
  private shape = '';
  private low: number[] = [];
  private high: number[] = [];
  private shown: LiveShown|null = null;

  constructor(canvas: HTMLCanvasElement, scene: StageScene, shared: SharedGeometry, coarse: boolean) {
    super(canvas, scene, shared, coarse);
    const rows = new Int32Array(3 * scene.particles);
    for (let i = 0; i < scene.particles; ++i) rows.set([i, scene.particles + i, 0], 3 * i);
    this.arrowShape = rods(this.tools, rows);
    this.arrows = this.tools.table(2 * scene.particles);
  }

  /** Sets the true path, which is drawn from the start. An empty path is not drawn. */
  setCourse(points: Vec3[]) {
    const {course} = this;
    course.count = Math.max(0, points.length - 1);
    if (!points.length) return;
    const table = course.table ??= this.tools.table(trailPoints);
    points.forEach((point, i) => table.data.set([...point, -1], 4 * i));
    this.tools.fill(table);
  }

  setPins(pins: number[]) {
    if (pins.join() === this.scene.pins.join()) return;
    this.scene.pins = pins;
    this.tools.gl.deleteVertexArray(this.shapes.pins.array);
    this.shapes.pins = balls(this.tools, this.scene.particles, pins);
  }

  /** Keeps past positions and obstacles in view. */
  hold(pictures: Places[]) {
    const last = pictures.length - 1;
    const placesAt = (t: number, into = new Float32Array(3 * this.scene.particles)) =>
        (into.set(pictures[Math.round(t * last)]), into);
    const motion = {well: true, begin: 0, end: 1, placesAt}, bounds = boundsOf({...this.scene, floor: null}, [motion]);
    const ground = this.scene.planes?.find(isFloor);
    if (this.scene.floor !== null)
      this.scene.floor = ground?.point[1] ?? Math.min(...bounds.held.map(h => h.at[1] - h.radius)) - 0.02 * bounds.size;
    this.bounds = boundsOf(this.scene, [motion]);
    this.low = [Infinity, Infinity, Infinity], this.high = [-Infinity, -Infinity, -Infinity];
    for (const places of pictures)
      for (let i = 0; i < places.length; ++i) {
        this.low[i % 3] = Math.min(this.low[i % 3], places[i]);
        this.high[i % 3] = Math.max(this.high[i % 3], places[i]);
      }
  }

  /** True if the positions are in view, up to a fraction of the scene's size. */
  sees(places: Places, part = 0.03) {
    const {low, high, size} = this;
    for (let i = 0; i < places.length; ++i)
      if (places[i] < low[i % 3] - part * size || places[i] > high[i % 3] + part * size) return false;
    return true;
  }

  show(views: LiveView[]) {
    const {tools, scene: {particles}} = this, cloth = this.triangles.length > 0;
    for (const {points, normals, way} of this.panels) this.dropTables(points, normals, way);
    this.panels = views.map(view => ({
                              ...view,
                              points: tools.table(particles),
                              normals: cloth ? tools.table(particles) : null,
                              way: cloth ? null : tools.table(trailPoints),
                              gone: 0,
                              scale: 'heat'
                            }));
  }

  /** Draws the last particle's path, from the run's trail. */
  private extend(panel: LivePanel, way: Table) {
    const {trail, places} = panel;
    if (panel.gone > trail.length) panel.gone = 0;
    for (; panel.gone < Math.min(trail.length, trailPoints - 1); ++panel.gone)
      way.data.set([...trail[panel.gone], -1], 4 * panel.gone);
    // the last piece, from the last stored point to the particle
    way.data.set([...placeOf(places, places.length / 3 - 1), -1], 4 * panel.gone);
    this.tools.fill(way);
  }

  /** Draws the panels, and keeps the data that pointers need. Returns the panels' positions. */
  draw(shown: LiveShown) {
    const {colour, over, centres} = shown;
    this.shown = shown;
    this.scene.spheres.forEach((sphere, i) => sphere.centres = [placeOf(centres, i)]);
    const prepare = (panel: LivePanel, ghost: boolean) => {
      const {places, way} = panel, {from} = colour;
      const values = colour.name === 'stretch' ? stretchOf(this.scene, this.shared, places) :
          colour.name === 'error' && from      ? apart(places, from) :
                                                 null;
      this.fill(panel, places, values, colour.top);
      if (way) this.extend(panel, way);
      return colour.name !== 'plain' && !ghost;
    };
    const {places, boxes, aspect, fit, toClip} = this.drawPanels(shown, over, next => this.eased(next), prepare);
    Object.assign(this, {boxes, aspect, fit, toClip});
    return places;
  }

  /** Moves the camera smoothly to a new target, or at once if there was no target before. */
  private eased(fit: Fit) {
    const was = this.fit, part = 0.12;
    // if the picture changes its shape, treat it as a new view
    const {clientWidth, clientHeight} = this.canvas, shape = `${clientWidth} ${clientHeight} ${this.panels.length}`;
    const other = !was || stillWanted.matches || this.shape !== shape;
    this.shape = shape;
    this.moving = !other &&
        (Math.abs(was.distance - fit.distance) > 1e-3 * fit.distance ||
         norm(minus(was.target, fit.target)) > 1e-3 * fit.distance);
    if (!this.moving || !was) return fit;
    return {
      target: plus(was.target, part, minus(fit.target, was.target)),
      distance: was.distance + part * (fit.distance - was.distance)
    };
  }

  protected drawBodies(programs: BodyPrograms, view: PanelView<LivePanel>, light: Uniforms) {
    if (programs === this.programs && view.ghost && view.surface)
      this.drawGhost(view, light);
    else
      super.drawBodies(programs, view, light);
  }

  private drawGhost(view: PanelView<LivePanel>, light: Uniforms) {
    const {tools, shapes} = this, {gl} = tools, {faint} = view.panel;
    const all = {...this.uniformsOf(view, light), nearer: 2e-5, by_value: 0};
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
    gl.blendColor(0, 0, 0, faint ? 0.18 : 0.5);
    gl.depthMask(false);
    tools.use(this.programs.cloth, all);
    tools.draw(shapes.cloth, gl.TRIANGLES);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    tools.use(this.programs.thread, {...all, nearer: 8e-5, ink: faint ? 0.35 : 0.6});
    tools.draw(shapes.threads, gl.LINES);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    this.drawPath(view, {...all, nearer: 0, by_family: 0});
  }

  /** Draws the true path, a particle's path, the held particle, and the growing mode. */
  protected drawPath({panel, pixel, ghost}: PanelView<LivePanel>, all: Uniforms) {
    const {tools, shapes, course} = this, {gl} = tools, {places, way} = panel, {marked, growth} = this.shown!;
    const rod = (table: Table, shape: Shape, radius: number, plain: number[], count?: number) => {
      tools.use(this.programs.rod, {...all, points: table.texture, radius: radius * pixel, plain});
      tools.draw(shape, gl.TRIANGLES, count);
    };
    if (marked && !ghost) {
      const ball = [...placeOf(places, marked.particle), 6 * pixel];
      tools.use(this.programs.ball, {...all, ball, plain: rgb(marked.held ? 'E0357B' : 'F2B01E')});
      tools.draw(shapes.obstacle, gl.TRIANGLES);
    }
    if (course.table && !ghost) rod(course.table, shapes.path, 0.7, rgb('8A9099'), course.count);
    if (way) rod(way, shapes.path, 0.9, panel.look.plain, panel.gone);
    if (growth?.letter !== panel.letter) return;
    const {data} = this.arrows, n = this.scene.particles, size = 0.16 * this.size;
    for (let i = 0; i < n; ++i) {
      const from = placeOf(places, i);
      data.set([...from, -1], 4 * i);
      data.set([...plus(from, size, placeOf(growth.mode, i)), -1], 4 * (n + i));
    }
    tools.fill(this.arrows);
    rod(this.arrows, this.arrowShape, 0.9, rgb('D3281C'));
  }

  protected obstaclesAt(): [number, Vec3][] {
    return this.scene.spheres.map(({radius, centres: [centre]}) => [radius, placeOf(centre, 0)]);
  }

  /** Position (m) in pixels within a panel: [x, y, distance]; null behind the eye. */
  project(place: Numbers, {left, top, wide, high}: PanelPlace): Vec3|null {
    const m = this.toClip, [x, y, z] = placeOf(place, 0);
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (!(w > 0)) return null;
    const cx = (m[0] * x + m[4] * y + m[8] * z + m[12]) / w, cy = (m[1] * x + m[5] * y + m[9] * z + m[13]) / w;
    return [left + wide * (0.5 + cx / 2), top + high * (0.5 - cy / 2), w];
  }
}

const apart = (places: Places, from: Places) =>
    Float32Array.from({length: places.length / 3}, (_, i) => norm(minus(placeOf(places, i), placeOf(from, i))));
