// Turns and zooms the view, and holds, moves and pins particles, by pointer, finger or key.

import {Orbit, tangent} from '../player/orbit';
import {attachWheel, orbitKeys} from '../player/pointer_input';
import {minus, norm, placeOf, plus, Vec3} from '../player/vectors';

import {LiveRun} from './live_run';
import {LiveStage} from './live_stage';

/** Distance in pixels within which a pointer or finger grabs a particle. */
const reachOf = (type: string) => type === 'touch' ? 30 : 16;

interface At {
  clientX: number;
  clientY: number;
}
interface Hit {
  particle: number;
  run: LiveRun;
  panel: {left: number, top: number, wide: number, high: number};
}

export interface HandActs {
  stage(): LiveStage|null;
  orbit(): Orbit;
  runs(): (LiveRun|null)[];  // drawn runs, by panel
  draw(): void;
  hover(on: boolean): void;
  /** Holds a particle at a position. Returns false if that is impossible. */
  hold(particle: number, place: Vec3, run: LiveRun): boolean;
  release(): void;
  choose(particle: number|null): void;
  pin(particle: number): void;
  toggle(): void;
  step(): void;
  restart(): void;
}

export class Hand {
  chosen: number|null = null;
  held: {particle: number, place: Vec3, run: LiveRun, key: boolean}|null = null;
  grabbed: (Hit&{from: [number, number], moved: boolean, pointer?: At})|null = null;
  private readonly pointers = new Map<number, [number, number]>();

  constructor(private readonly layer: HTMLElement, private readonly act: HandActs) {
    layer.addEventListener('pointerdown', event => this.down(event));
    layer.addEventListener('pointermove', event => this.move(event));
    layer.addEventListener('pointerup', event => this.up(event));
    layer.addEventListener('pointercancel', event => this.up(event));
    layer.addEventListener('dblclick', event => {
      const hit = this.hit(event);
      if (hit) act.pin(hit.particle);
    });
    // touching a particle, or the picture with two fingers, must not scroll the page
    layer.addEventListener('touchstart', event => {
      if (event.touches.length > 1 || this.hit(event.touches[0], 'touch')) event.preventDefault();
    }, {passive: false});
    attachWheel(layer, () => act.orbit(), () => act.draw());
    layer.addEventListener('keydown', event => this.key(event));
    layer.addEventListener('blur', () => this.held?.key && this.release());
  }

  private hit({clientX, clientY}: At, type = 'mouse'): Hit|null {
    const stage = this.act.stage();
    if (!stage) return null;
    const box = this.layer.getBoundingClientRect(), x = clientX - box.left, y = clientY - box.top;
    const near: (Hit&{away: number, depth: number})[] = [];
    this.act.runs().forEach((run, i) => {
      const panel = stage.boxes[i];
      if (!run?.places || !panel || x < panel.left || x > panel.left + panel.wide) return;
      for (let particle = 0; particle < run.places.length / 3; ++particle) {
        const at = stage.project(placeOf(run.places, particle), panel);
        if (!at) continue;
        const away = Math.hypot(at[0] - x, at[1] - y);
        if (away < reachOf(type)) near.push({particle, panel, run, away, depth: at[2]});
      }
    });
    // the frontmost of the particles that are about equally near
    const least = Math.min(...near.map(n => n.away)), front = near.filter(n => n.away < least + 3);
    return front.sort((a, b) => a.depth - b.depth)[0] ?? null;
  }

  /** The point under a pointer, in the plane that is parallel to the picture and contains a particle. */
  private under({clientX, clientY}: At, {panel}: Hit, from: Vec3): Vec3 {
    const stage = this.act.stage(), box = this.layer.getBoundingClientRect(), at = stage?.project(from, panel);
    if (!stage || !at) return from;
    const [right, up] = this.act.orbit().axes();
    const across = 2 * (clientX - box.left - at[0]) / panel.wide * at[2] * tangent * stage.aspect;
    const upward = -2 * (clientY - box.top - at[1]) / panel.high * at[2] * tangent;
    return plus(plus(from, across, right), upward, up);
  }

  private down(event: PointerEvent) {
    this.layer.focus({preventScroll: true});
    this.layer.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (this.pointers.size > 1) {
      this.grabbed = null;
      return this.release();
    }
    const hit = event.button === 0 ? this.hit(event, event.pointerType) : null;
    this.grabbed = hit && {...hit, from: [event.clientX, event.clientY], moved: false};
    this.act.hover(Boolean(hit));
  }

  private move(event: PointerEvent) {
    const was = this.pointers.get(event.pointerId), now: [number, number] = [event.clientX, event.clientY];
    if (!was) {
      if (event.pointerType === 'mouse') this.act.hover(Boolean(this.hit(event)));
      return;
    }
    this.pointers.set(event.pointerId, now);
    if (this.pointers.size === 2) {
      const [other] = [...this.pointers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const apart = (at: number[]) => Math.hypot(at[0] - other[0], at[1] - other[1]);
      this.act.orbit().magnify(apart(now) / Math.max(1, apart(was)));
      return this.act.draw();
    }
    const {grabbed} = this;
    if (!grabbed) {
      this.act.orbit().turn(-0.008 * (now[0] - was[0]), 0.008 * (now[1] - was[1]));
      return this.act.draw();
    }
    if (!grabbed.moved && Math.hypot(now[0] - grabbed.from[0], now[1] - grabbed.from[1]) < 4) return;
    grabbed.moved = true;
    this.lead(event);
  }

  /** Puts the grabbed particle under the pointer after the pointer, the camera or the picture has moved. */
  lead({clientX, clientY}: At) {
    const {grabbed} = this, stage = this.act.stage();
    if (!grabbed?.run.places || !stage) return;
    grabbed.pointer = {clientX, clientY};
    const was = this.held?.place;
    const place = this.under(grabbed.pointer, grabbed, was ?? placeOf(grabbed.run.places, grabbed.particle));
    if (!was || norm(minus(place, was)) > 1e-9 * stage.size) this.hold(grabbed.particle, place, grabbed.run);
  }

  private up(event: PointerEvent) {
    this.pointers.delete(event.pointerId);
    const {grabbed} = this;
    this.grabbed = null;
    if (!grabbed) return;
    if (grabbed.moved)
      this.release();
    else
      this.choose(grabbed.particle);
  }

  private hold(particle: number, place: Vec3, run: LiveRun, key = false) {
    const before = this.held;
    this.held = {particle, place, run, key};
    if (!this.act.hold(particle, place, run)) {
      this.held = before;
      return;
    }
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

  choose(particle: number|null) {
    this.release();
    this.chosen = particle;
    this.act.choose(particle);
  }

  forget() { this.chosen = this.held = this.grabbed = null; }

  private key(event: KeyboardEvent) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const turned = orbitKeys(this.act.orbit())[event.key];
    const keys: Record<string, () => void> = {
      n: () => this.next(1),
      p: () => this.next(-1),
      x: () => this.chosen !== null && this.act.pin(this.chosen),
      j: () => this.nudge(-1, 0, 0),
      l: () => this.nudge(1, 0, 0),
      i: () => this.nudge(0, 1, 0),
      k: () => this.nudge(0, -1, 0),
      u: () => this.nudge(0, 0, -1),
      o: () => this.nudge(0, 0, 1),
      Escape: () => this.held ? this.release() : this.choose(null),
      ' ': () => this.act.toggle(),
      s: () => this.act.step(),
      r: () => this.act.restart(),
    };
    const act = turned ? () => (turned(), this.act.draw()) : keys[event.key];
    // if no particle is chosen, leave Escape to the page, which closes windows
    if (!act || (event.key === 'Escape' && this.chosen === null)) return;
    event.preventDefault();
    event.stopPropagation();
    act();
  }

  private next(by: number) {
    const count = (this.act.runs()[0]?.places?.length ?? 0) / 3;
    if (count) this.choose(this.chosen === null ? (by > 0 ? 0 : count - 1) : (this.chosen + by + count) % count);
  }

  private nudge(across: number, upward: number, nearer: number) {
    const [run] = this.act.runs(), stage = this.act.stage();
    if (this.chosen === null || !run?.places || !stage) return;
    const [right, up, back] = this.act.orbit().axes(), size = 0.03 * stage.size;
    const from = this.held?.place ?? placeOf(run.places, this.chosen);
    const place = plus(plus(plus(from, across * size, right), upward * size, up), nearer * size, back);
    this.hold(this.chosen, place, run, true);
  }
}
