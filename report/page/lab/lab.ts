// <live-lab>: mysim itself in the page, the truth beside it. Nothing of it is laid out, compiled or computed before it
// is opened: by its button, by an address, or by openLab().
//
// Its state is a scene's text (TOML), one or two methods with a step or tolerance each, and a look. Sliders change
// numbers in the text; then the scene is opened anew and the runs start again. Runs share one clock.
// @ts-nocheck

import {dark, startsWebGl} from '../player/player';

import {LabError, labModule} from './engine';
import {Hand} from './hand';
import {labActs} from './lab_acts';
import {labButton, LabView, lookOfRun} from './lab_view';
import {LiveRun, Truth} from './live_run';
import {changesBetween, numberAt, textAt, withNumbers} from './scene_text';

import {make, short} from '../player/controls';
import {openExperiment} from './guide';
import {say} from './words';
import {stateOf} from './lab_link';

const computingBudget = 0.5;       // part of a frame's time, for the methods together
const truthBudget = 0.45;          // part of a frame's time
const shortestFrame = 17;          // ms
const longestFrame = 120;          // ms, by which budgets go where drawing is slow
const slowestPace = 0.1;           // minimum clock rate while waiting for the reference solution
const longestWait = 2500;          // ms of waiting for the truth
export const smallScene = 1500;    // particles; larger ones have no truth, and no energy balance unless asked
export const previewBudget = 150;  // ms for finding out how far a scene moves
const slowDrawing = 40;            // ms between frames beyond what their scripts take: then drawing is what takes it
export const coarseRatio = 0.7;    // share of the pixels per side while moving, where drawing is slow

/** The scenes of the page: {name: {toml, fingerprint (of each rule, after so many steps), steps}}. */
export const labScenes = (() => {
  let scenes;
  return () => (scenes ??= JSON.parse(document.getElementById('lab-scenes')?.textContent || '{}'));
})();
/** The text of a scene of the page as it is shipped. */
export const sceneText = name => labScenes()[name]?.toml;

class LiveLab extends HTMLElement {
  connectedCallback() {
    if (this.dataset.state) return;
    this.dataset.state = 'closed';
    this.showDoor();
    document.addEventListener('lab-language', () => this.relabel());
    const head = this.dataset.alone === undefined ? null : document.querySelector('nav .made');
    const sayHead = () => head?.replaceChildren(say('madeOf'));
    sayHead();
    document.addEventListener('lab-language', sayHead);
    if (this.dataset.alone !== undefined && !/^#lab=/.test(location.hash)) this.open();
  }

  disconnectedCallback() {
    if (this.view) this.shut();
  }

  /** The button that opens the lab. */
  showDoor() {
    const button = labButton('open', `▶ ${say('open')}`, () => this.open(), `▶ ${say('open')}`);
    this.replaceChildren(make('div', {class: 'lab-door'}, button, make('span', {}, say('openHint'))));
  }

  /** Opens the lab, in a state where one is given; resolves when it stands. */
  async open(state = {}) {
    if (this.view) return this.setState(state);
    this.opening ??= this.begin();
    if (await this.opening) return this.setState({scene: this.dataset.scene || Object.keys(labScenes())[0], ...state});
  }

  async begin() {
    this.dataset.state = 'opening';
    this.replaceChildren(make('p', {class: 'lab-plain', role: 'status'}, say('waiting')));
    await new Promise(done => setTimeout(done));  // the words are there before the compiler takes the thread
    this.lab = await labModule();
    const missing = !document.getElementById('lab-module') ? 'noModule' :
        !this.lab                                          ? 'noWasm' :
        !startsWebGl()                                     ? 'noWebgl' :
                                                             null;
    if (missing) {
      this.dataset.state = 'unavailable';
      this.dataset.missing = missing;
      this.replaceChildren(make('p', {class: 'lab-plain'}, say(missing)));
      return false;
    }
    Object.assign(this, {
      runs: [],
      clock: 0,
      speed: 1,
      playing: false,
      seen: true,
      drawing: 0,
      drawsSlowly: false,
      frameTime: shortestFrame,
      frames: [],
      passed: [],
      pictures: []
    });
    this.look = {view: 'over', colour: 'plain', springs: false, truth: false};
    const bind = name => (...given) => this[name](...given);
    this.view = new LabView(Object.fromEntries([
      'toggle', 'step', 'restart', 'speed', 'method', 'second', 'removeSecond', 'numbers', 'scene', 'original', 'close',
      'look', 'ledger', 'pin', 'resetView', 'copyLink', 'saveToml', 'copyCommand', 'file'
    ].map(name => [name, bind(`act_${name}`)])));
    this.replaceChildren(this.view.root);
    this.hand = new Hand(this.view.layer, {
      stage: () => this.stage,
      orbit: null,
      runs: () => this.drawn?.map(view => view.run) ?? [],
      draw: () => this.draw(),
      hover: hit => this.view.layer.classList.toggle('on-particle', Boolean(hit)),
      hold: (particle, place, run) => this.hold(particle, place, run),
      release: () => this.release(),
      choose: particle => this.choose(particle),
      pin: particle => this.act_pin(particle),
      toggle: () => this.act_toggle(),
      step: () => this.act_step(),
      restart: () => this.act_restart()
    });
    const {stage} = this.view;
    new IntersectionObserver(([entry]) => (this.seen = entry.isIntersecting, this.wake())).observe(this);
    new ResizeObserver(() => (this.draw(), this.wake())).observe(stage);
    dark.addEventListener('change', () => this.runs.length && this.showViews());
    for (const name of ['dragenter', 'dragover', 'dragleave', 'drop'])
      this.addEventListener(name, event => this.dragged(event));
    this.dataset.state = 'ready';
    return true;
  }

  // State.

  /**
   * Sets what is given: `scene` (its shipped text and method), `toml` (a text, or {path: number} to change),
   * `methods` [{method, step or tolerance}], `view`, `colour`, `springs`, `truth`, `speed`, `running`. Resolves when
   * shown.
   */
  async setState({scene, toml, changes, methods, view, colour, springs, truth, speed, running} = {}) {
    if (!this.view)
      return this.open(
          {scene: scene ?? this.dataset.scene, toml, changes, methods, view, colour, springs, truth, speed, running});
    const text = typeof toml === 'string' ? toml : null, edits = {...changes, ...(text === null ? toml : {})};
    const other = scene !== undefined && scene !== this.sceneName;
    if (scene !== undefined && text === null && !sceneText(scene))
      return this.view.say(say('unknownScene', {name: scene}), true);
    const before = {sceneName: this.sceneName, original: this.original, toml: this.toml, methods: this.methods};
    if (scene !== undefined || text !== null) {
      this.sceneName = scene ?? this.sceneName;
      this.original = sceneText(this.sceneName) ?? text;
      this.toml = text ?? this.original;
    }
    this.toml = withNumbers(this.toml, edits);
    if (methods)
      this.methods = methods.slice(0, 2).map(m => ({...m}));
    else if (scene !== undefined)
      this.methods = null;
    for (const [name, value] of Object.entries({view, colour, springs, truth}))
      if (value !== undefined) this.look[name] = value;
    if (speed) this.speed = speed, this.view.speed.value = String(speed);
    if (!this.load(other || scene !== undefined)) {
      Object.assign(this, before);
      if (before.toml) this.load(other);
      return;
    }
    if (running !== undefined) running ? this.play() : this.pause();
    await new Promise(done => setTimeout(done));
    this.tell();
  }

  /** What a link holds. */
  get state() {
    const {sceneName: scene, original, toml, methods, look} = this, state = {scene, methods};
    if (this.byHand)
      state.toml = this.runs[0].sim.sceneText();
    else if (toml !== original || !sceneText(scene)) {
      const changes = sceneText(scene) ? changesBetween(original, toml) : null;
      if (changes)
        state.changes = changes;
      else
        state.toml = toml;
    }
    if (look.view !== 'over') state.view = look.view;
    if (look.colour !== 'plain') state.colour = look.colour;
    return state;
  }

  /** Numbers of the present, for the guide and for tests. */
  get reading() {
    const {runs} = this, [a] = runs ?? [];
    if (!a) return null;
    const last = a.samples[a.samples.length - 1];
    return {
      scene: this.sceneName,
      toml: this.toml,
      runs,
      t: this.clock,
      running: this.playing,
      ended: a.ended,
      verdict: a.verdict,
      reason: a.reason,
      byHand: this.byHand,
      steps: runs.map(run => (run.refusal ? null : run.sim.h)),
      limitA: a.limit,
      error: last?.error ?? null,
      bar: last?.bar ?? null,
      energies: a.refusal || a.fault ? null : a.sim.energy,
      residual: last?.residual ?? null,
      framesPerSecond: this.framesPerSecond,
      factor: a.factor,
      chosen: this.hand.chosen
    };
  }

  tell() { this.dispatchEvent(new Event('reading', {bubbles: true})); }

  // The engine.

  /**
   * Opens the scene for every method and starts again; false, with the reason said, where it is not taken. `fresh`:
   * another scene.
   */
  load(fresh = false) {
    let opened = [];
    if (fresh) this.keepLedger = null;
    try {
      this.methods ??= [this.ownMethod()];
      for (const spec of this.methods) {
        const stepper = this.lab.steppers.find(s => s.name === spec.method.split('+')[0]);
        if (!stepper) throw new LabError('input', spec.method);
        if (stepper.adaptive)
          spec.tolerance ||= 1e-6;
        else
          spec.step ||= numberAt(this.toml, 'time.step');
      }
      for (const [i, spec] of this.methods.entries())
        opened.push(new LiveRun(
            this.lab, this.toml, 'AB'[i], spec, scene => this.keepLedger ??= scene.particles <= smallScene));
    } catch (problem) {
      opened.forEach(run => run.close());
      this.view.say(say('sceneRefused', {reason: problem.message}), true);
      return false;
    }
    this.good = this.toml;
    this.runs.forEach(run => run.close());
    this.runs = opened;
    this.start(fresh);
    return true;
  }

  /** The method that the scene's text names, where it is one of mysim's. */
  ownMethod() {
    const name = textAt(this.toml, 'method').replace(/^mysim\//, '');
    return {
      method: this.lab.steppers.some(s => s.name === name.split('+')[0]) ? name : 'leapfrog',
      step: numberAt(this.toml, 'time.step')
    };
  }

  /** After runs were opened: clock, truth, stage and words stand at the beginning. */
  start(fresh) {
    const [a] = this.runs, {scene} = a.sim;
    Object.assign(
        this, {clock: 0, end: scene.duration, byHand: false, growth: null, waiting: null, passed: [], average: null});
    this.dropTruth();
    this.bits = this.bitsOf(a);
    for (const run of this.runs) run.look = lookOfRun(run.letter);
    this.hand.held = this.hand.grabbed = null;
    if (fresh) {
      this.hand.forget();
      this.scale = a.sim.limit('leapfrog');
      this.view.knobs.build(this.toml, this.original);
    }
    this.view.ledger.checked = this.keepLedger;
    this.setStage(fresh);
    this.sample();
    this.showViews();
    this.showState();
  }

  /**
   * Whether the first steps of a scene of the page are here what the native engine made of them, bit for bit: the page
   * holds their fingerprint. Null where it holds none: other scenes, and rules that need not give the same bits.
   */
  bitsOf({spec}) {
    const {toml, fingerprint, steps} = labScenes()[this.sceneName] ?? {}, expected = fingerprint?.[spec.method];
    if (!expected || this.toml !== toml) return null;
    const key = `${this.sceneName} ${spec.method}`;
    this.knownBits ??= new Map();
    if (!this.knownBits.has(key)) {
      const sim = this.lab.open(toml);
      sim.start({stepper: spec.method, observe: false});
      sim.call('advance', Infinity, steps);
      this.knownBits.set(key, sim.fingerprint() === expected);
      sim.close();
    }
    return this.knownBits.get(key);
  }

  restart() {
    if (this.byHand) return this.load();
    this.runs.forEach(run => run.start());
    this.start(false);
  }

  /** The truth is opened when it is needed first. */
  findTruth() {
    if (this.truth || this.truthGone) return;
    const run = this.runs.find(r => !r.refusal && !r.failed);
    if (!run) return;
    if (run.sim.scene.particles > smallScene) return void (this.truthGone = 'large');
    try {
      this.truth =
          new Truth(this.lab, this.byHand ? run.sim.sceneText() : this.toml, run, run.sim.scene.spheres.length > 0);
    } catch {
      this.truth = null;
    }
    if (!this.truth?.known) this.truth = null, this.truthGone = 'none';
    this.late = 0;
  }

  dropTruth() {
    this.truth?.close();
    this.truth = this.truthGone = null;
    this.late = this.slow = 0, this.pace = 1, this.pending = false;
  }

  /**
   * Lets time pass: runs go on up to the clock, as far as the frame's computing allows. `wanted`: at the speed chosen.
   */
  advance(passed, wanted = passed) {
    const before = this.clock;
    let aim = Math.min(this.end, before + passed), left = computingBudget * this.frameTime;
    for (const run of [...this.runs].sort((x, y) => y.last - x.last)) {
      const was = run.failed, there = run.advance(aim, Math.max(1, left)), fails = run.failed && !was;
      left -= run.last;
      if (!there || fails) aim = Math.max(before, Math.min(aim, run.time + (fails ? 0 : run.sim.h || 0)));
    }
    this.clock = aim;
    if (!this.runs.some(run => run.bursting)) this.passed.push(wanted > 0 ? (aim - before) / wanted : 1);
    if (this.passed.length > 30) this.passed.shift();
    this.sample();
    this.judge();
    if (this.runs.every(run => run.ended) ||
        (this.clock >= this.end - 1e-9 && this.runs.every(run => run.ended || run.time >= this.end - 1e-6)))
      this.pause();
  }

  /**
   * Compares runs that moved on with the truth, and keeps what they have come to. Where the truth is not there within
   * the frame's computing, `pending` makes the clock wait for it, and go more slowly from then on; but not for ever.
   */
  sample() {
    // at the start nothing is off yet, and while a slider moves no truth is begun
    const free = !this.hand.held && this.clock > 0 && performance.now() > (this.settled ?? 0);
    if (free) this.findTruth();
    const begin = performance.now(),
          left = () => Math.max(1, truthBudget * this.frameTime - (performance.now() - begin));
    this.pending = false;
    for (const run of [...this.runs].sort((x, y) => x.time - y.time)) {
      const last = run.samples[run.samples.length - 1];
      if (run.refusal || last?.t === run.time || (last && run.time < last.t + this.end / 500 && !run.ended)) continue;
      const found = this.clock === 0        ? {error: 0, bar: null} :
          this.truth && free && !run.failed ? this.truth.compare(run.places, run.time, left()) :
                                              null;
      if (!found && this.truth && free && !run.failed && this.truth.isBefore(run.time))
        this.pending = true;
      else
        run.sample(found?.error ?? null, found?.bar ?? null);
    }
    this.pace = this.pending ? Math.max(slowestPace, 0.8 * this.pace) : Math.min(1, 1.04 * this.pace);
    this.late = this.pending ? this.late + this.frameTime : 0;
    this.slow = this.pace > 2 * slowestPace ? 0 : this.slow + this.frameTime;
    if (!this.pending || (this.late < longestWait && this.slow < longestWait)) return;
    this.truthCost = this.truth.cost * this.speed * this.frameTime / 1000;
    this.late = this.slow = 0, this.pace = 1;
    if (!this.truth.shed()) this.truth.close(), this.truth = null, this.truthGone = 'slow';
  }

  /** Says which runs have failed, and shows the mode that grows in the first that did. */
  judge() {
    const failed = this.runs.filter(run => run.failed);
    for (const run of failed)
      if (!run.shown && this.stage) run.shown = true, run.stepBack(places => this.stage.sees(places, 0.1));
    if (!this.growth && failed.length) {
      const mode = failed[0].fault ? null : failed[0].sim.growth;
      this.growth = mode && {letter: failed[0].letter, mode: Float64Array.from(mode)};
    }
    this.dataset.verdict = failed.length ? failed[0].verdict : 'ok';
    this.view.setVerdict([...failed.map(run => this.verdictOf(run)), ...(this.growth ? [say('growth')] : [])]);
  }

  verdictOf(run) {
    const key = {
      energy: 'verdictEnergy',
      nan: 'verdictNan',
      stretch: 'verdictStretch',
      solver: 'verdictSolver',
      frozen: 'verdictFrozen'
    }[run.verdict] ??
        'verdictOther';
    const words = say(key, {letter: run.letter, t: short(run.time), reason: run.reason}), {limit} = run, h = run.sim.h;
    if (!Number.isFinite(limit) || !(limit > 0) || !h) return words;
    const x = Number((h / limit).toPrecision(3));
    return `${words} ${say(x > 1 ? 'verdictPast' : 'verdictBelow', {x})}`;
  }

  // The loop.

  play() {
    if (this.runs.every(run => run.ended) || this.clock >= this.end - 1e-9) this.restart();
    this.playing = true;
    this.dataset.running = '';
    this.view.setRunning(true);
    this.wake();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    delete this.dataset.running;
    this.view.setRunning(false);
    this.showNow(true);
    this.wake();
  }

  /** Asks for the next frame, once. */
  wake() {
    if (this.asked || !this.seen || !this.isConnected) return;
    this.asked = true;
    requestAnimationFrame(now => this.frame(now));
  }

  frame(now) {
    this.asked = false;
    if (!this.isConnected || !this.view) return;
    const begin = performance.now(), apart = this.lastFrame ? now - this.lastFrame : 0;  // ms
    const passed = Math.min(0.1, apart / 1000);  // a page that was away goes on where it was
    this.lastFrame = now;
    this.frameTime = Math.max(shortestFrame, Math.min(longestFrame, 0.8 * this.frameTime + 200 * passed));
    if (this.playing) {
      this.frames.push(now);
      while (this.frames[0] < now - 1000) this.frames.shift();
    } else
      this.frames = [];
    if (!this.stage) this.showViews();
    if (this.stage && this.hand.grabbed?.pointer) this.hand.lead(this.hand.grabbed.pointer);
    if (this.waiting) this.moveHeld();
    const was = this.pending;
    if (was)
      this.sample();
    else if (this.playing)
      this.advance(this.speed * this.pace * passed, this.speed * passed);
    if (was && this.playing) this.passed.push(0);
    const eased = this.draw();
    this.showNow(was && !this.pending && !this.playing, now);
    this.watchDrawing(apart, performance.now() - begin);
    if (this.playing || eased || this.waiting || this.pending)
      this.wake();
    else
      this.lastFrame = null;
  }

  /**
   * Without a graphics processor drawing may take many times what computing does: then the stage becomes a coarse one.
   */
  watchDrawing(apart, script) {
    if (!this.playing || !this.stage || this.stage.coarse) return void (this.drawing = 0);
    this.drawing += 0.2 * (Math.min(100, apart - (this.scripted ?? 0)) - this.drawing);
    this.scripted = script;
    if (this.drawing < slowDrawing) return;
    this.drawsSlowly = true;
    this.sleep();
    this.showViews();
  }

  get framesPerSecond() {
    const {frames} = this;
    return frames.length > 2 ? Math.round(1000 * (frames.length - 1) / (frames[frames.length - 1] - frames[0])) : null;
  }
}

/**
 * Opens the lab in a state: {scene, method and step, or methods, toml, changes, experiment, ...} as setState() takes
 * it. The scene's own lab on the page, another that is there, or one in a window over the page.
 */
export async function openLab({method, step, tolerance, experiment, ...state}) {
  if (method) state.methods = [{method: method.replace(/^mysim\//, ''), step, tolerance}];
  let lab = document.querySelector(`live-lab[data-scene="${CSS.escape(state.scene ?? '')}"]`) ??
      document.querySelector('live-lab[data-alone]');
  if (!lab) {
    const dialog = make(
        'dialog', {class: 'run lab-window', 'aria-label': say('labTitle')},
        lab = make('live-lab', {'data-scene': state.scene}));
    document.body.append(dialog);
    dialog.addEventListener('close', () => dialog.remove());
    dialog.showModal();
  }
  await lab.open(state);
  lab.scrollIntoView({block: 'nearest'});
  if (experiment) openExperiment(experiment, lab);
  return lab;
}

/** Opens the lab in the state of the address, if it has one. */
async function followLabAddress() {
  const state = await stateOf(location.hash);
  if (state)
    await openLab(state);
  else if (/^#lab=/.test(location.hash))
    document.querySelector('live-lab[data-alone]')?.open();
}

/** Defines <live-lab> and opens the lab in the state that the address names. */
export function startLab() {
  Object.defineProperties(LiveLab.prototype, Object.getOwnPropertyDescriptors(labActs));
  customElements.define('live-lab', LiveLab);
  addEventListener('hashchange', followLabAddress);
  if (document.readyState === 'loading')
    document.addEventListener('DOMContentLoaded', followLabAddress);
  else
    followLabAddress();
}
