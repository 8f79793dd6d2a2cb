// The hand in the picture: it turns and zooms the view, and it holds, moves and pins particles, by pointer, finger or
// key.
// @ts-nocheck

import {tangent} from '../player/orbit';
import {minus, norm, plus} from '../player/vectors';

/** Pixels around a particle that a pointer, or a finger, still meets. */
const reachOf = type => (type === 'touch' ? 30 : 16);

export class Hand {
  /**
   * On a layer over the stage. `act` has what it asks for: stage(), orbit, runs() (drawn, in the order of the panels),
   * hold(particle, place, run), release(), choose(particle or null), pin(particle), draw().
   */
  constructor(layer, act) {
    Object.assign(this, {layer, act, chosen: null, held: null, pointers: new Map()});
    layer.addEventListener('pointerdown', event => this.down(event));
    layer.addEventListener('pointermove', event => this.move(event));
    for (const name of ['pointerup', 'pointercancel']) layer.addEventListener(name, event => this.up(event));
    layer.addEventListener('dblclick', event => {
      const hit = this.hit(event);
      if (hit) act.pin(hit.particle);
    });
    // a finger on a particle does not scroll the page, nor do two
    layer.addEventListener('touchstart', event => {
      if (event.touches.length > 1 || this.hit(event.touches[0], 'touch')) event.preventDefault();
    }, {passive: false});
    layer.addEventListener('wheel', event => {
      if (!event.ctrlKey && document.activeElement !== layer) return;
      event.preventDefault();
      act.orbit.magnify(Math.exp(-0.0015 * event.deltaY));
      act.draw();
    }, {passive: false});
    layer.addEventListener('keydown', event => this.key(event));
    layer.addEventListener('blur', () => this.held?.key && this.release());
  }

  /** The particle under a pointer: {particle, panel, run}; null where there is none. */
  hit({clientX, clientY}, type) {
    const stage = this.act.stage();
    if (!stage?.boxes?.length) return null;
    const box = this.layer.getBoundingClientRect(), x = clientX - box.left, y = clientY - box.top;
    const near = [];
    this.act.runs().forEach((run, i) => {
      const panel = stage.boxes[i];
      if (!run?.places || !panel || x < panel.left || x > panel.left + panel.wide) return;
      for (let p = 0; p < run.places.length / 3; ++p) {
        const at = stage.project(run.places.subarray(3 * p, 3 * p + 3), panel),
              away = at ? Math.hypot(at[0] - x, at[1] - y) : Infinity;
        if (away < reachOf(type)) near.push({particle: p, panel, run, away, depth: at[2]});
      }
    });
    // the nearest of several particles in line
    const least = Math.min(...near.map(n => n.away));
    return near.filter(n => n.away < least + 3).reduce((best, n) => (best && best.depth <= n.depth ? best : n), null);
  }

  /** The place in the plane through a particle, parallel to the picture, that lies under a pointer. */
  under({clientX, clientY}, {particle, panel, run}, from) {
    const stage = this.act.stage(), box = this.layer.getBoundingClientRect();
    const place = from ?? [...run.places.subarray(3 * particle, 3 * particle + 3)], at = stage.project(place, panel);
    if (!at) return place;
    const [right, up] = this.act.orbit.axes();
    const across = 2 * (clientX - box.left - at[0]) / panel.wide * at[2] * tangent * stage.aspect;
    const upward = -2 * (clientY - box.top - at[1]) / panel.high * at[2] * tangent;
    return plus(plus(place, across, right), upward, up);
  }

  down(event) {
    this.layer.focus({preventScroll: true});
    this.layer.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size > 1) return void (this.grabbed = null, this.release());
    const hit = event.button === 0 ? this.hit(event, event.pointerType) : null;
    this.grabbed = hit && {...hit, from: [event.clientX, event.clientY], moved: false};
    this.act.hover(hit);
  }

  move(event) {
    const was = this.pointers.get(event.pointerId);
    if (!was) return void (event.pointerType === 'mouse' && this.act.hover(this.hit(event)));
    const now = [event.clientX, event.clientY];
    this.pointers.set(event.pointerId, now);
    if (this.pointers.size === 2) {
      const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const apart = at => Math.hypot(at[0] - other[0], at[1] - other[1]);
      this.act.orbit.magnify(apart(now) / Math.max(1, apart(was)));
      return void this.act.draw();
    }
    const {grabbed} = this;
    if (!grabbed) {
      this.act.orbit.turn(-0.008 * (now[0] - was[0]), 0.008 * (now[1] - was[1]));
      return void this.act.draw();
    }
    if (!grabbed.moved && Math.hypot(now[0] - grabbed.from[0], now[1] - grabbed.from[1]) < 4) return;
    grabbed.moved = true;
    this.lead(event);
  }

  /**
   * Puts the particle that a pointer has under it: where the pointer moves, and where the camera or the picture does.
   */
  lead({clientX, clientY}) {
    const {grabbed} = this;
    grabbed.pointer = {clientX, clientY};
    const was = this.held?.place, place = this.under(grabbed.pointer, grabbed, was);
    if (!was || norm(minus(place, was)) > 1e-9 * this.act.stage().size) this.hold(grabbed.particle, place, grabbed.run);
  }

  up(event) {
    this.pointers.delete(event.pointerId);
    const {grabbed} = this;
    this.grabbed = null;
    if (!grabbed) return;
    if (grabbed.moved)
      this.release();
    else
      this.choose(grabbed.particle);
  }

  hold(particle, place, run, key = false) {
    const before = this.held;
    this.held = {particle, place, run, key};
    if (!this.act.hold(particle, place, run)) return void (this.held = before);
    if (this.chosen === particle && before) return;
    this.chosen = particle;
    this.act.choose(particle);
  }

  release() {
    if (!this.held) return;
    this.held = null;
    this.act.release();
    this.act.choose(this.chosen);
  }

  choose(particle) {
    this.release();
    this.chosen = particle;
    this.act.choose(particle);
  }

  /** Forgets all, as the scene is another one. */
  forget() { Object.assign(this, {chosen: null, held: null, grabbed: null}); }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const {orbit} = this.act;
    const turn = (yaw, pitch) => () => (orbit.turn(yaw, pitch), this.act.draw());
    const zoom = factor => () => (orbit.magnify(factor), this.act.draw());
    const keys = {
      ArrowLeft: turn(-0.12, 0),
      ArrowRight: turn(0.12, 0),
      ArrowUp: turn(0, 0.1),
      ArrowDown: turn(0, -0.1),
      '+': zoom(1.15),
      '=': zoom(1.15),
      '-': zoom(1 / 1.15),
      0: () => (orbit.reset(), this.act.draw()),
      n: () => this.next(1),
      p: () => this.next(-1),
      x: () => this.chosen !== null && this.act.pin(this.chosen),
      j: () => this.nudge(-1, 0, 0),
      l: () => this.nudge(1, 0, 0),
      i: () => this.nudge(0, 1, 0),
      k: () => this.nudge(0, -1, 0),
      u: () => this.nudge(0, 0, -1),
      o: () => this.nudge(0, 0, 1),
      Escape: () => (this.held ? this.release() : this.choose(null)),
      ' ': () => this.act.toggle(),
      s: () => this.act.step(),
      r: () => this.act.restart(),
    };
    // Escape with nothing in the hand is the page's own: it closes windows
    if (!keys[event.key] || (event.key === 'Escape' && this.chosen === null)) return;
    event.preventDefault();
    event.stopPropagation();
    keys[event.key]();
  }

  /** The next particle or the one before. */
  next(by) {
    const [run] = this.act.runs(), count = run ? run.places.length / 3 : 0;
    if (count) this.choose(this.chosen === null ? (by > 0 ? 0 : count - 1) : (this.chosen + by + count) % count);
  }

  /** Moves the chosen particle a little to the right, upwards and towards the eye. */
  nudge(across, upward, nearer) {
    const [run] = this.act.runs(), stage = this.act.stage();
    if (this.chosen === null || !run) return;
    const [right, up, back] = this.act.orbit.axes(), size = 0.03 * stage.size;
    const from = this.held?.place ?? [...run.places.subarray(3 * this.chosen, 3 * this.chosen + 3)];
    const place = plus(plus(plus(from, across * size, right), upward * size, up), nearer * size, back);
    this.hold(this.chosen, place, run, true);
  }
}
