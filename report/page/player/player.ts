// <motion-player>: plays runs of a scene in lock-step, in a canvas over the poster. Without WebGL2, shows only the
// poster.

import {Acts, Controls, inTwo, length, Look, make, roundUp, settingOf, short} from './controls';
import {Orbit} from './orbit';
import {Point, Series, Shown} from './plot';
import {Colouring, Stage, View} from './stage';
import {attachPointerInput} from './pointer_input';
import {distances, failureOf, Motion, motionOf, rms, Run, runOf, SceneStage, Shared, stretchOf} from './motion';
import {lookOf} from './colours';
import {noContext} from './gl';
import {unpack} from './unpack';

export const mostStages = 3;  // scenes drawn at a time; limited, because browsers allow few contexts
export const alive: MotionPlayer[] = [];

export const stillWanted = matchMedia('(prefers-reduced-motion: reduce)');
export const dark = matchMedia('(prefers-color-scheme: dark)');

/** Checks features only, because starting WebGL takes long without a graphics processor. */
export let plays = 'DecompressionStream' in window && 'WebGL2RenderingContext' in window;
document.documentElement.classList.toggle('plays', plays);

export function startsWebGl() {
  const gl = document.createElement('canvas').getContext('webgl2');
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return Boolean(gl);
}

/** Called if WebGL does not start: the posters stay, without controls. */
function playNothing() {
  plays = false;
  document.documentElement.classList.remove('plays');
  document.querySelector<HTMLDialogElement>('dialog.run')?.close();
}

const sceneData = (() => {
  const known = new Map<string, SceneStage>();
  return (name: string) => {
    const script = () => document.querySelector(`script.motion[data-scene="${CSS.escape(name)}"]`);
    if (!known.has(name)) known.set(name, JSON.parse(script()!.textContent!));
    return known.get(name)!;
  };
})();

/** Dummy controls for the first screen, where one clock drives several players. */
const noControls: Pick<Controls, 'setLook'|'setPlaying'|'setTime'|'setPlots'|'setPicks'|'setHint'> = {
  setLook() {},
  setPlaying() {},
  setTime() {},
  setPlots() {},
  setPicks() {},
  setHint() {}
};

const rmsOf = (metres: Float32Array|null) => metres && rms(metres);

interface PlayerView extends View {
  letter: string;
  method: string;
  look: ReturnType<typeof lookOf>;
  state?: HTMLElement;  // in the title
}
const viewOf = (motion: Motion, letter: string): PlayerView =>
    ({motion, letter, method: motion.method, look: lookOf(motion.method)});

const seriesOf = ({motion, letter, look}: PlayerView, list: (number|null)[], dash = ''): Series => ({
  name: letter,
  css: look.css,
  dash,
  well: motion.well,
  points: motion.times.map((t, f): Point => [t, list[f] ?? null])
});

export class MotionPlayer extends HTMLElement {
  given?: {scene: SceneStage, motion: Motion, caption: string};  // the last pictures of a run in a map's cell
  scene!: SceneStage;
  picks: {a: string, b: string}|null = null;  // keys of the compared runs
  hero: string[]|null = null;                 // keys of the runs on the first screen
  stage: Stage|null = null;
  motions: Motion[] = [];
  views: PlayerView[] = [];
  box!: HTMLElement;
  titles!: HTMLElement;
  time = 0;  // s
  begin = 0;
  end = 0;
  settled = Infinity;  // s; after this time all kinetic energies stay below 2 % of their maximum
  top = 0;             // m, top of the scale of differences; 0: too small to resolve
  seen = false;
  private controls: typeof noControls = noControls;
  private orbit!: Orbit;
  private layer!: HTMLElement;
  private look: Look = {colour: 'plain', springs: false};
  private colouring: Colouring = {name: 'plain', top: 1};
  private truth: Motion|null = null;
  private letters: string[] = [];
  private loaded?: Promise<void>;
  private shared?: Promise<Shared>;
  private turn = {};
  private least = 0;  // m, resolution of differences
  private bound = 0;  // m, error bound of positions
  private untouched = true;
  private speed = 1;
  private pace = 1;
  private playing = false;
  private wanted = false;
  private resume?: boolean;

  connectedCallback() {
    if (!plays || this.scene) return;
    const root = this.parentElement!, scene = this.scene = this.given?.scene ?? sceneData(this.dataset.scene!);
    this.hero = this.dataset.shown ? JSON.parse(this.dataset.shown) : null;
    this.picks = this.dataset.a ? {a: this.dataset.a, b: this.dataset.b!} : null;
    this.box = root.querySelector('.stage')!;
    this.end = scene.times[scene.times.length - 1];
    this.orbit = new Orbit(scene.from);
    this.look = {colour: 'plain', springs: !scene.triangles};
    root.classList.toggle('comparing', Boolean(this.picks));
    this.classList.toggle('still', Boolean(this.given));
    const acts: Acts = {
      toggle: () => void (this.playing ? this.pause() : this.play()),
      seek: time => (this.pause(), this.seek(time), void this.wake()),
      speed: speed => void (this.speed = speed),
      look: change => this.setLook(change),
      reset: () => (this.orbit.reset(), this.draw()),
    };
    if (this.picks) acts.pick = (letter, key) => void this.pick({[letter]: key});
    if (!this.hero) this.controls = new Controls(this, scene, this.look, acts);
    if (this.picks) {
      this.controls.setPicks([this.picks.a, this.picks.b], null);
      this.controls.setHint(this.words());
    }
    this.controls.setPlaying(false);
    new IntersectionObserver(([entry]) => this.setSeen(entry.isIntersecting), {threshold: 0.3}).observe(this.box);
    new ResizeObserver(() => this.draw()).observe(this.box);
    dark.addEventListener('change', () => this.views.length && this.arrange());
  }

  /** Plays when visible (once, and not if reduced motion is preferred); pauses when invisible. */
  private async setSeen(seen: boolean) {
    this.seen = seen;
    if (!seen) {
      this.resume = this.wanted;
      this.pause();
      return;
    }
    // if the reader prefers reduced motion, the poster stays until a control is used
    if (stillWanted.matches && !this.dataset.state) return;
    await this.wake();
    if (this.seen && !stillWanted.matches && !this.dataset.shown && (this.resume ?? true)) this.play();
  }

  /** Unpacks the data once and opens a stage. An invisible player may have to release its stage. */
  async wake() {
    const shared = this.shared ??=
        Promise.all([this.scene.triangles, this.scene.springs.ends, this.scene.springs.rests].map(unpack))
            .then(([triangles, springs, rests]) => ({triangles, springs, rests}));
    this.loaded ??= this.load();
    const given = await shared;
    await this.loaded;
    if (this.stage) return;
    while (alive.length >= mostStages) (alive.find(player => !player.seen) ?? alive[0]).sleep();
    const canvas = make('canvas', {'aria-hidden': 'true'});
    canvas.addEventListener('webglcontextlost', () => this.stage?.canvas === canvas && this.sleep());
    if (!plays) return;
    try {
      this.stage = new Stage(canvas, this.scene, given);
    } catch (problem) {
      this.hidden = true;
      if (problem !== noContext) throw problem;
      return playNothing();
    }
    this.titles = make('div', {class: 'titles', 'aria-hidden': 'true'});
    this.layer = make(
        'div', {
          class: 'layer',
          tabindex: 0,
          role: 'group',
          'aria-label':
              `${this.scene.scene} in three dimensions; arrow keys turn, plus and minus zoom, 0 resets the view`
        },
        canvas, this.titles);
    attachPointerInput(this.layer, this.orbit, () => this.draw());
    this.box.append(this.layer);
    alive.push(this);
    this.showViews();
    this.dataset.state = 'ready';
    if (!performance.getEntriesByName('first-motion').length) performance.mark('first-motion');
  }

  private async load() {
    const keys = this.hero ?? (this.picks ? [this.picks.a, this.picks.b] : []), letters = this.picks ? ['A', 'B'] : [];
    const turn = this.turn = {};
    const motions = this.given ? [this.given.motion] : await Promise.all(keys.map(key => motionOf(this.scene, key)));
    const truth = this.picks && await motionOf(this.scene, 'truth');
    if (turn !== this.turn) return;  // the reader chose other runs meanwhile
    this.motions = motions.filter((motion): motion is Motion => motion !== null);
    this.letters = letters.filter((_, i) => motions[i]);
    this.truth = truth;
    const known = this.motions.filter(motion => motion.energy.some(e => e !== null));
    this.settled = known.length === 0 ? Infinity : Math.max(...known.map(motion => {
      const least = 0.02 * Math.max(...motion.energy.map(e => e ?? 0));
      return motion.times[motion.energy.reduce((last: number, e, i) => ((e ?? 0) > least ? i : last), 0)];
    }));
    this.arrange();
  }

  async pick(change: {a?: string, b?: string}) {
    Object.assign(this.picks!, change);
    this.loaded = this.load();
    await this.loaded;
    await this.wake();
    this.dispatchEvent(new Event('picked'));
  }

  private arrange() {
    const {scene, letters} = this;
    this.views = this.motions.map((motion, i) => viewOf(motion, letters[i] ?? ''));
    const pictures = this.given?.motion ?? this.motions.find(motion => motion.run.last_pictures);
    [this.begin, this.end] = pictures ? [pictures.begin, pictures.end] : [0, scene.times[scene.times.length - 1]];
    this.pace = pictures ? (this.end - this.begin) / 6 : 1;  // a run's last pictures take six seconds
    const plots: Omit<Shown, 'begin'|'end'>[] = [], [a, b] = this.views, purple = 'var(--difference)';
    if (this.picks && b) {
      const times = Array.from({length: 101}, (_, i) => this.begin + i / 100 * (this.end - this.begin));
      const apart = times.map(
          t => (t <= Math.min(a.motion.end, b.motion.end) + 1e-9 ? distances(a.motion.apartAt(t, b.motion)) : null));
      const largest = apart.reduce((top, metres) => metres?.reduce((x, y) => Math.max(x, y), top) ?? top, 0);
      // differences below this sum are not resolved
      this.least = a.motion.bound + b.motion.bound, this.bound = Math.max(a.motion.bound, b.motion.bound);
      this.top = largest > this.least ? roundUp(largest) : 0;
      this.views.push(
          {motion: a.motion, other: b.motion, top: this.top || 1, letter: 'A − B', look: a.look, method: ''});
      const dash = b.look.css === a.look.css ? '5 3' : '';
      const both = (kind: 'error'|'energy') => [seriesOf(a, a.motion[kind]), seriesOf(b, b.motion[kind], dash)];
      const known = (s: Series) => s.points.some(p => p[1] !== null);
      plots.push(
          {
            title: scene.truth?.rule ? 'difference from the contact limit' : 'RMS error',
            unit: 'm',
            series: both('error').filter(known),
            none: 'No reference solution is known here.'
          },
          {
            title: 'kinetic energy',
            unit: 'J',
            series: both('energy').filter(known),
            none: 'No velocities are known here.'
          },
          {
            title: 'difference',
            unit: 'm',
            series: this.top ?
                [{name: 'A − B', css: purple, well: true, points: times.map((t, i): Point => [t, rmsOf(apart[i])])}] :
                [],
            none: `Below the resolution of ${length(this.least)}.`
          });
      this.controls.setPicks([this.picks.a, this.picks.b], this.top, this.least);
      for (const cell of this.closest('article')?.querySelectorAll<HTMLElement>('.choose') ?? [])
        for (const button of cell.querySelectorAll<HTMLElement>('[data-as="a"], [data-as="b"]'))
          button.setAttribute('aria-pressed', String(this.picks[button.dataset.as as 'a' | 'b'] === cell.dataset.key));
      this.controls.setHint(this.words());
    } else if (this.given) {
      this.controls.setHint(this.given.caption);
    }
    this.controls.setPlots(plots, this.begin, this.end);
    if (this.untouched && !this.hero)
      this.time = this.picks && !pictures ? Math.min(this.end, scene.at ?? this.end) : this.begin;
    this.time = Math.max(this.begin, Math.min(this.end, this.time));
    this.controls.setTime(this.time);
    if (this.stage) this.showViews();
  }

  private words() {
    const said: string[] = [];
    for (const letter of ['a', 'b'] as const) {
      const found = runOf(this.scene, this.picks![letter]), name = letter.toUpperCase();
      if (!found) continue;
      const {file, run} = found;
      if (failureOf(run, short)) said.push(`${name}: ${failureOf(run, short)}: ${run.reason}.`);
      if (run.last_pictures)
        said.push(`${name}: the last ${run.frames} pictures of the run, from ${short(run.times[0] ?? 0)} s on.`);
      if (file.note) said.push(`${name} follows a different law: ${file.note}.`);
      if (this.endOf(file.method, run)) said.push(`${name}: ${this.endOf(file.method, run)}.`);
    }
    if (this.bound) said.push(`Positions are drawn to within ${length(this.bound)}.`);
    return said.join(' ');
  }

  /** Says where a truth ends, if it ends before the scene. */
  private endOf(method: string, {times}: Run) {
    const end = times[times.length - 1] ?? 0;
    return method === 'truth' && end < this.scene.times[this.scene.times.length - 1] - 1e-9 ?
        `known up to ${short(end)} s` :
        '';
  }

  private showViews() {
    this.stage!.show(this.views);
    this.titles.replaceChildren(...this.views.map(view => {
      const [engine, rule] =
          view.method === 'truth' ? ['truth', this.scene.truth!.name.replace(/^truth, /, '')] : inTwo(view.method);
      const {run} = view.motion, setting = settingOf(run),
            name = make(
                'b', {style: `--own: ${view.other ? 'var(--difference)' : view.look.css}`},
                this.hero ? engine : view.letter);
      const words = make(
          'span', {},
          this.hero ? [rule, run.step ? `step ${setting}` : setting].filter(Boolean).join(', ') :
              view.other || !view.letter? '' :
                      [engine, rule, setting].filter(Boolean).join(' '));
      view.state = make('span', {});
      return make(
          'div', view.method ? {'data-method': view.method} : {}, name, ...(words.textContent ? [words] : []),
          view.state);
    }));
    this.setLook({});
  }

  /** Releases the context and shows the poster. */
  sleep() {
    this.pause();
    alive.splice(alive.indexOf(this), 1);
    const {stage} = this;
    this.stage = null;
    stage!.release();
    this.layer.remove();
    this.dataset.state = 'asleep';
  }

  async play() {
    this.wanted = true;
    await this.wake();
    if (this.playing || !this.wanted) return;
    if (this.untouched || this.time >= this.end) this.seek(this.begin);  // at first the player shows the poster's time
    this.playing = true;
    this.controls.setPlaying(true);
    let last: number|null = null;
    const tick = (now: number) => {
      if (!this.playing) return;
      // limited, because frames stop while the page is hidden
      const passed = Math.min(0.1, last === null ? 0 : (now - last) / 1000);
      last = now;
      this.seek(this.time + this.speed * this.pace * passed);
      if (this.time >= this.end)
        this.pause();
      else
        requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    this.playing = this.wanted = false;
    this.controls.setPlaying(false);
  }

  seek(time: number) {
    this.untouched = false;
    this.time = Math.max(this.begin, Math.min(this.end, time));
    this.controls.setTime(this.time);
    this.draw();
  }

  private setLook(change: Partial<Look>) {
    Object.assign(this.look, change);
    const {colour} = this.look, {scene, stage} = this;
    this.colouring = {name: colour, top: 1};
    let scale: string|null = null;
    if (stage && colour !== 'plain') {
      const most = (of: (motion: Motion, time: number) => Float32Array) => Math.max(
          1e-12,
          ...this.motions.filter(m => m.well)
              .flatMap(
                  motion => [0.1, 0.25, 0.5, 0.75, 1].map(
                      part => of(motion, this.begin + part * (this.end - this.begin))
                                  .reduce((a, b) => Math.max(a, b), 0))));
      const from = colour === 'distance' ? this.truth : null;
      this.colouring.from = from;
      this.colouring.top = roundUp(most(
          from ? (m, t) => distances(m.apartAt(Math.min(t, from.end), from)) :
                 (m, t) => stretchOf(scene, stage.shared, m.placesAt(t))));
      scale = from ? length(this.colouring.top) : `${this.colouring.top} %`;
    }
    this.controls.setLook(this.look, scale);
    if (this.stage)
      this.draw();
    else if (Object.keys(change).length)
      this.wake();
  }

  draw() {
    if (!this.stage || !this.views.length) return;
    const {canvas} = this.stage, ratio = Math.min(2, window.devicePixelRatio || 1);
    const wide = Math.round(this.box.clientWidth * ratio), high = Math.round(this.box.clientHeight * ratio);
    if (!wide || !high) return;
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, {width: wide, height: high});
    const background =
        getComputedStyle(this.box).backgroundColor.match(/[\d.]+/g)!.slice(0, 3).map(v => Number(v) / 255);
    const title = this.hero ? (this.box.clientWidth < 420 ? 58 : 46) : this.given ? 0 : 24;  // px free above pictures
    const panels = this.stage.draw(
        {colour: this.colouring, springs: this.look.springs, time: this.time, orbit: this.orbit, background, title});
    panels.forEach((panel, i) => {
      const {motion, other} = this.views[i], state = this.views[i].state!, {run} = motion,
                     over = this.time > motion.end - 1e-9;
      Object.assign(
          (this.titles.children[i] as HTMLElement).style,
          {left: `${100 * panel.left}%`, top: `${100 * panel.top}%`, width: `${100 * panel.wide}%`});
      const failed = over && !other && failureOf(run, short);
      state.className = failed ? 'failed' : '';
      state.textContent = failed || (!other && this.time > motion.end + 1e-9 ? this.endOf(motion.method, run) : '');
    });
  }
}

/** Runs the players of the first screen on one clock, in a loop; shows a still picture if motion is unwanted. */
function runHero(hero: HTMLElement) {
  const players = [...hero.querySelectorAll<MotionPlayer>('motion-player')].filter(player => player.scene);
  const button = hero.querySelector('button')!, slider = hero.querySelector('input')!;
  const clock = hero.querySelector('.clock')!;
  const ends = players.map(player => player.end), end = Math.max(...ends);
  let time = 0, last: number|null = null, playing = false, seen = false;
  // show current errors instead of the largest ones
  const readouts = players.map(player => {
    const spans = [...player.closest('.views')!.nextElementSibling?.querySelectorAll<HTMLElement>('[data-key]') ?? []];
    return spans.map(span => ({span, still: [...span.childNodes]}));
  });
  const tell = (player: MotionPlayer, spans: {span: HTMLElement, still: ChildNode[]}[]) => {
    for (const {span, still} of spans) {
      const motion = player.motions.find(m => m.key === span.dataset.key),
            error = motion?.valueAt(motion.error, player.time);
      const part = player.scene.truth?.motion;
      if (error === null || error === undefined)
        span.replaceChildren(...still);
      else
        span.replaceChildren(
            make('b', {}, length(error)),
            player.scene.truth?.rule || !part ? ' off now' :
                                                ` ${Number((100 * error / part).toPrecision(2))} % off now`);
    }
  };
  const show = () => {
    players.forEach((player, i) => {
      if (!player.stage) return;
      player.seek(Math.min(time, ends[i]));
      tell(player, readouts[i]);
    });
    slider.value = String(1000 * time / end);
    clock.textContent = `${time.toFixed(2)} s, ${pace() < 1 ? '½' : '2'}× speed`;
  };
  const pace = () => (players.some((player, i) => time < Math.min(ends[i], player.settled)) ? 0.5 : 2);
  const tick = (now: number) => {
    if (!playing || !seen) return void (last = null);
    time += last === null ? 0 : pace() * Math.min(0.1, (now - last) / 1000);
    last = now;
    if (time > end + 0.6) time = 0;  // after a pause at the end
    show();
    requestAnimationFrame(tick);
  };
  const set = (on: boolean) => {
    playing = on;
    button.textContent = on ? '❚❚' : '▶';
    button.setAttribute('aria-label', on ? 'Pause' : 'Play');
    if (on) requestAnimationFrame(tick);
  };
  button.addEventListener('click', async () => {
    await Promise.all(players.map(player => player.wake()));
    set(!playing);
  });
  slider.addEventListener('input', async () => {
    await Promise.all(players.map(player => player.wake()));
    set(false);
    time = Number(slider.value) / 1000 * end;
    show();
  });
  new IntersectionObserver(([entry]) => {
    seen = entry.isIntersecting;
    if (seen && playing) requestAnimationFrame(tick);
  }).observe(hero);
  if (stillWanted.matches) return;
  Promise.all(players.map(player => player.wake())).then(() => plays && set(true));
}

export function startPlayers() {
  customElements.define('motion-player', MotionPlayer);
  document.addEventListener('DOMContentLoaded', () => {
    for (const hero of document.querySelectorAll<HTMLElement>('.hero'))
      if (plays && hero.querySelector('motion-player')) runHero(hero);
  });
}
