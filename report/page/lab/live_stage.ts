// The stage of a running engine: it draws the places that runs have now, over one another or side by side, with what
// the hand holds, the way that was gone, and the mode that grows.
// @ts-nocheck

import {boundsOf} from '../player/bounds';
import {rgb} from '../player/colours';
import {stretchOf} from '../player/motion';
import {tangent} from '../player/orbit';
import {stillWanted} from '../player/player';
import {ballMesh} from '../player/shapes';
import {gridOf, Stage} from '../player/stage';
import {minus, norm, plus, sumNormals} from '../player/vectors';

export const trailPoints = 600;

/** The scene of an engine as the stage takes it. */
export function stageScene(name, sim, floor, from) {
  const {scene} = sim, names = ['single', 'structural', 'shear', 'bend'];
  // springs in the order of their families, the threads first
  const hard = scene.constraints ?? [], order = Array.from(scene.families.keys()), ranks = [1, 0, 2, 3];
  order.sort((a, b) => ranks[scene.families[a]] - ranks[scene.families[b]] || a - b);
  const ends = [...hard, ...order.flatMap(s => [scene.springs[2 * s], scene.springs[2 * s + 1]])];
  const families = hard.length ? [{name: 'hard distance', count: hard.length / 2}] : [];
  for (const s of order) {
    const family = names[scene.families[s]];
    if (families[families.length - 1]?.name === family)
      ++families[families.length - 1].count;
    else
      families.push({name: family, count: 1});
  }
  const rests = [...(scene.constraintLengths ?? new Array(hard.length / 2).fill(0)), ...order.map(s => scene.rests[s])];
  const threads =
      families.filter(f => f.name === 'structural' || f.name === 'hard distance').reduce((sum, f) => sum + f.count, 0);
  const times = Array.from({length: trailPoints}, (_, i) => scene.duration * i / (trailPoints - 1));
  return {
    scene: name,
    particles: scene.particles,
    times,
    from,
    floor,
    triangles: scene.triangles.length > 0,
    pins: [...scene.pins],
    springs: {families, threads, rest_unit: 1},
    spheres: scene.spheres.map(({radius}) => ({radius, centres: []})),
    shared: {
      triangles: Uint16Array.from(scene.triangles),
      springs: Uint16Array.from(ends),
      rests: Float64Array.from(rests)
    },
  };
}

export class LiveStage extends Stage {
  constructor(canvas, scene, coarse) {
    super(canvas, scene, scene.shared, coarse);
    const rows = new Int32Array(3 * scene.particles);
    for (let i = 0; i < scene.particles; ++i) rows.set([i, scene.particles + i, 0], 3 * i);
    this.shapes.arrows = this.rods(rows);
    this.arrows = this.tools.table(2 * scene.particles);
    this.course = {table: null, count: 0};
  }

  /** The true course, drawn from the start on, whatever the runs do; none for no points. */
  setCourse(points) {
    const {course} = this;
    course.count = Math.max(0, points.length - 1);
    if (!points.length) return;
    course.table ??= this.tools.table(trailPoints);
    points.forEach((point, i) => course.table.data.set([...point, -1], 4 * i));
    this.tools.fill(course.table);
  }

  rods(rows) {
    return this.tools.shape({
      corners: new Float32Array([0, -1, 1, -1, 0, 1, 1, 1]),
      size: 2,
      slot: 2,
      ints: 3,
      index: new Uint16Array([0, 1, 2, 2, 1, 3]),
      instances: rows
    });
  }

  /** Pins after a change by hand. */
  setPins(pins) {
    if (pins.join() === this.scene.pins.join()) return;
    this.scene.pins = pins;
    this.tools.gl.deleteVertexArray(this.shapes.pins.array);
    const mesh = this.scene.particles > 60 ? ballMesh(10, 6) : ballMesh(24, 16);
    this.shapes.pins = this.tools.shape({...mesh, instances: Int32Array.from(pins), slot: 1, ints: 1});
  }

  /** What is held in view: places that were there, as lists of coordinates, and obstacles. */
  hold(pictures) {
    const last = pictures.length - 1;
    const motion =
        {well: true, begin: 0, end: 1, placesAt: (t, into) => (into.set(pictures[Math.round(t * last)]), into)};
    const bounds = boundsOf({...this.scene, floor: null}, [motion]);
    if (this.scene.floor !== null)
      this.scene.floor = Math.min(...bounds.held.map(h => h.at[1] - h.radius)) - 0.02 * bounds.size;
    Object.assign(this, boundsOf(this.scene, [motion]));
    this.low = [Infinity, Infinity, Infinity], this.high = [-Infinity, -Infinity, -Infinity];
    for (const places of pictures)
      places.forEach(
          (v, i) => (this.low[i % 3] = Math.min(this.low[i % 3], v), this.high[i % 3] = Math.max(this.high[i % 3], v)));
  }

  /** Whether places lie within what is in view, but for a small part of it. */
  sees(places, part = 0.03) {
    const {low, high, size} = this;
    for (let i = 0; i < places.length; ++i)
      if (places[i] < low[i % 3] - part * size || places[i] > high[i % 3] + part * size) return false;
    return true;
  }

  /** What is drawn: {places, look, ghost (drawn over the first, seen through), trail}, each in a panel. */
  show(views) {
    const {tools, scene} = this, n = scene.particles;
    for (const panel of this.panels)
      for (const table of [panel.points, panel.normals, panel.way])
        if (table) tools.gl.deleteTexture(table.texture);
    this.panels = views.map(view => ({
                              ...view,
                              points: tools.table(n),
                              normals: this.triangles.length ? tools.table(n) : null,
                              way: this.triangles.length ? null : tools.table(trailPoints),
                              gone: 0
                            }));
  }

  /** Places, values and normals of a panel go to their tables. */
  write(panel, time, colour) {
    const {scene, triangles} = this, {places, points, normals} = panel, into = points.data, n = scene.particles;
    const values = colour.name === 'stretch'   ? stretchOf(scene, this.shared, places) :
        colour.name === 'error' && colour.from ? this.apart(places, colour.from) :
                                                 null;
    for (let i = 0; i < n; ++i) {
      into[4 * i] = places[3 * i], into[4 * i + 1] = places[3 * i + 1], into[4 * i + 2] = places[3 * i + 2];
      into[4 * i + 3] = values ? Math.min(1, values[i] / colour.top) : -1;
    }
    this.tools.fill(points);
    if (panel.way) this.extend(panel);
    if (!normals) return;
    sumNormals(places, triangles, normals.data, 4);
    this.tools.fill(normals);
  }

  apart(places, from) {
    const out = new Float32Array(places.length / 3);
    for (let i = 0; i < out.length; ++i)
      out[i] = Math.hypot(
          places[3 * i] - from[3 * i], places[3 * i + 1] - from[3 * i + 1], places[3 * i + 2] - from[3 * i + 2]);
    return out;
  }

  /** The way of the last particle: its points up to now, taken from the run's trail. */
  extend(panel) {
    const {trail, way, places} = panel;
    if (panel.gone > trail.length) panel.gone = 0;
    for (; panel.gone < Math.min(trail.length, trailPoints - 1); ++panel.gone)
      way.data.set([...trail[panel.gone], -1], 4 * panel.gone);
    // from the last point kept to where the particle is
    way.data.set([...places.subarray(places.length - 3), -1], 4 * panel.gone);
    this.tools.fill(way);
  }

  /** As Stage.draw, with `over` for panels over one another; keeps what pointers need: boxes and the clip matrix. */
  draw({time, colour, springs, orbit, background, title, over, marked, centres, growth}) {
    const {gl} = this.tools, {canvas, scene, panels} = this;
    scene.spheres.forEach((sphere, i) => sphere.centres = [[...centres.subarray(3 * i, 3 * i + 3)]]);
    const ratio = canvas.width / canvas.clientWidth, room = Math.round(title * ratio);
    const {columns, rows} = over ? {columns: 1, rows: 1} : gridOf(panels.length, canvas.width, canvas.height, room);
    const cell = Math.floor(canvas.height / rows), wide = Math.floor(canvas.width / columns), high = cell - room,
          aspect = wide / high;
    const fit = this.fit = this.eased(orbit.fit(this.held, this.middle, aspect)), view = orbit.view(fit, aspect);
    Object.assign(this, {view, aspect, boxes: []});
    gl.scissor(0, 0, canvas.width, canvas.height);
    gl.clearColor(...background, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.growing = growth;
    return panels.map((panel, i) => {
      const column = over ? 0 : i % columns, row = over ? 0 : Math.floor(i / columns);
      this.write(panel, time, colour);
      const look = {
        ...view,
        time,
        springs,
        background,
        panel,
        pixel: 2 * tangent * fit.distance * orbit.zoom / high * ratio,
        valued: colour.name !== 'plain' && !(over && i > 0),
        surface: this.triangles.length && !springs,
        ghost: over && i > 0,
        marked,
      };
      if (scene.floor !== null && !look.ghost)
        this.castShadows(look);
      else if (scene.floor !== null)
        look.toKey = this.toKey;
      this.toKey = look.toKey;
      const box = [column * wide, canvas.height - (row + 1) * cell, wide, high];
      gl.viewport(...box);
      gl.scissor(...box);
      this.drawPanel(look, box);
      const place = {left: column / columns, top: row / rows, wide: 1 / columns, high: 1 / rows};
      this.boxes.push({left: box[0] / ratio, top: (row * cell + room) / ratio, wide: wide / ratio, high: high / ratio});
      return place;
    });
  }

  /** The camera moves on to what it has to hold; at once where it has not been before. */
  eased(fit) {
    const was = this.fit, part = 0.12;
    // a picture of another shape is another view
    const {clientWidth, clientHeight} = this.canvas, shape = `${clientWidth} ${clientHeight} ${this.panels.length}`;
    const other = !was || stillWanted.matches || this.shape !== shape;
    this.shape = shape;
    this.moving = !other &&
        (Math.abs(was.distance - fit.distance) > 1e-3 * fit.distance ||
         norm(minus(was.target, fit.target)) > 1e-3 * fit.distance);
    if (!this.moving) return fit;
    return {
      target: plus(was.target, part, minus(fit.target, was.target)),
      distance: was.distance + part * (fit.distance - was.distance)
    };
  }

  drawPanel(look, box) {
    const {floor} = this.scene;
    if (look.ghost) this.scene.floor = null;  // the ground is there already
    super.drawPanel(look, box);
    this.scene.floor = floor;
  }

  /** A ghost lets what lies behind it be seen; then what the hand holds, and the growing mode. */
  drawBodies(programs, look, light) {
    const {gl} = this.tools, lit = programs === this.programs, ghost = lit && look.ghost && look.surface;
    if (ghost) {
      this.drawGhost(look, light);
      return;
    }
    super.drawBodies(programs, look, light);
    if (lit) this.drawMarks(look, light);
  }

  drawGhost(look, light) {
    const {tools, shapes} = this, {gl} = tools, {panel} = look;
    const all = {
      ...light,
      points: panel.points.texture,
      normals: panel.normals.texture,
      nearer: 2e-5,
      plain: panel.look.plain,
      ball: [0, 0, 0, 0],
      by_value: 0
    };
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
    gl.blendColor(0, 0, 0, panel.faint ? 0.18 : 0.5);
    gl.depthMask(false);
    tools.use(this.programs.cloth, all);
    tools.draw(shapes.cloth, gl.TRIANGLES);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    tools.use(this.programs.thread, {...all, nearer: 8e-5, ink: panel.faint ? 0.35 : 0.6});
    tools.draw(shapes.threads, gl.LINES);
    gl.depthMask(true);
    gl.disable(gl.BLEND);
    this.drawMarks(look, light);
  }

  drawMarks(look, light) {
    const {tools, shapes, growing} = this, {gl} = tools, {panel, pixel, marked} = look, {places} = panel;
    const all = {...light, points: panel.points.texture, nearer: 0, by_value: 0, by_family: 0};
    if (marked && !look.ghost) {
      const at = 3 * marked.particle, ball = [places[at], places[at + 1], places[at + 2], 6 * pixel];
      tools.use(this.programs.ball, {...all, ball, plain: rgb(marked.held ? 'E0357B' : 'F2B01E')});
      tools.draw(shapes.obstacle, gl.TRIANGLES);
    }
    if (this.course.count && !look.ghost) {
      tools.use(
          this.programs.rod,
          {...all, points: this.course.table.texture, radius: 0.7 * pixel, plain: rgb('8A9099'), ball: [0, 0, 0, 0]});
      tools.draw(shapes.path, gl.TRIANGLES, this.course.count);
    }
    if (panel.way) {
      tools.use(
          this.programs.rod,
          {...all, points: panel.way.texture, radius: 0.9 * pixel, plain: panel.look.plain, ball: [0, 0, 0, 0]});
      tools.draw(shapes.path, gl.TRIANGLES, panel.gone);
    }
    if (!growing || growing.letter !== panel.letter) return;
    const {data} = this.arrows, n = this.scene.particles, {mode} = growing, size = 0.16 * this.size;
    for (let i = 0; i < n; ++i)
      for (let k = 0; k < 3; ++k) {
        data[4 * i + k] = places[3 * i + k];
        data[4 * (n + i) + k] = places[3 * i + k] + size * mode[3 * i + k];
        data[4 * i + 3] = data[4 * (n + i) + 3] = -1;
      }
    tools.fill(this.arrows);
    tools.use(
        this.programs.rod,
        {...all, points: this.arrows.texture, radius: 0.9 * pixel, plain: rgb('D3281C'), ball: [0, 0, 0, 0]});
    tools.draw(shapes.arrows, gl.TRIANGLES);
  }

  drawObstacles(programs, time, all) {
    for (const {radius, centres: [centre]} of this.scene.spheres) {
      this.tools.use(programs.ball, {...all, ball: [...centre, radius], plain: rgb('B6BBC3'), by_value: 0});
      this.tools.draw(this.shapes.obstacle, this.tools.gl.TRIANGLES);
    }
  }

  /** A place (m) in pixels of the canvas, in a panel: [x, y, distance]; null behind the eye. */
  project(place, {left, top, wide, high}) {
    const m = this.view.toClip, [x, y, z] = place;
    const w = m[3] * x + m[7] * y + m[11] * z + m[15];
    if (w <= 0) return null;
    const cx = (m[0] * x + m[4] * y + m[8] * z + m[12]) / w, cy = (m[1] * x + m[5] * y + m[9] * z + m[13]) / w;
    return [left + wide * (0.5 + cx / 2), top + high * (0.5 - cy / 2), w];
  }
}
