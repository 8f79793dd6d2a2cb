// Actions of the lab's controls and of the hand: the second part of <live-lab> (lab.ts).
// @ts-nocheck

import {length, make, roundUp} from '../player/controls';
import {Orbit} from '../player/orbit';
import {alive, mostStages, stillWanted} from '../player/player';
import {minus} from '../player/vectors';

import {nameOfMethod, timeText} from './knobs';
import {coarseRatio, labScenes, previewBudget, sceneText, smallScene} from './lab';
import {addressOf, commandOf, copyText, saveText} from './lab_link';
import {lookOfRun, titleHeight} from './lab_view';
import {isFinite3, LiveRun, startOf} from './live_run';
import {LiveStage, stageScene, trailPoints} from './live_stage';
import {textAt, withMethod, withNumbers} from './scene_text';
import {questionInLanguage, say} from './words';

export const labActs = {
  act_toggle() { this.playing ? this.pause() : this.play();},

  act_restart() {
    const {playing} = this;
    this.restart();
    if (playing || this.view.verdict.contains(document.activeElement)) this.play();
  },

  /** One step of the first method that still runs. */
  act_step() {
    this.pause();
    if (this.runs.every(run => run.ended)) this.restart();
    const run = this.runs.find(r => !r.ended);
    if (!run) return;
    const begin = run.sim.steps;
    this.advance(Math.max(0, run.time + (run.sim.h || run.sim.scene.step) - this.clock) + 1e-9 * run.sim.scene.step);
    if (run.sim.steps === begin && !run.ended) this.advance(run.sim.h || run.sim.scene.step);
    this.draw();
    this.showNow(true);
    this.wake();
  },

  act_speed(speed) {
    this.speed = speed;
    this.view.speed.value = String(speed);
  },

  /** A method was changed: its run starts again at once, and in the same scene if the rule is the same. */
  act_method(i, spec, done) {
    const {playing} = this, same = this.methods[i].method === spec.method && !this.byHand;
    this.methods[i] = spec;
    this.settled = done ? 0 : performance.now() + 200;
    if (same) {
      this.runs[i].spec = spec;
      this.restart();
    } else
      this.load();
    if (playing) this.play();
  },

  act_second() {
    const other = ['symplectic-euler', 'leapfrog', 'rk4', 'trapezoidal'].find(
        name => name !== this.methods[0].method &&
            (!this.runs[0].sim.scene.firstOrder || this.lab.steppers.find(s => s.name === name).firstOrder));
    const {step} = this.runs[0].sim.scene;
    this.methods = [this.methods[0], {method: other, step: this.methods[0].step ?? step}];
    this.reload();
  },

  act_removeSecond() {
    this.methods = this.methods.slice(0, 1);
    this.reload();
  },

  /** Loads again and goes on running if it ran. */
  reload(fresh = false) {
    const {playing} = this;
    const well = this.load(fresh);
    if (well && playing) this.play();
    return well;
  },

  /** Numbers of the scene were moved. Large scenes are opened when the slider stands. */
  act_numbers(changes, done) {
    this.toml = withNumbers(this.toml, changes);
    this.settled = done ? 0 : performance.now() + 200;
    clearTimeout(this.opened);
    const act = () => {
      this.view.say('');
      if (!this.reload()) this.view.knobs.show(this.toml = this.good);
    };
    if (done)
      act();
    else
      this.opened = setTimeout(act, this.runs[0].sim.scene.particles > smallScene ? 250 : 60);
  },

  act_scene(scene) { this.setState({scene, running: this.playing && !stillWanted.matches});},
  act_original() { this.setState({toml: this.original, running: this.playing});},
  act_look(change) {
    Object.assign(this.look, change);
    this.showViews();
  },
  act_ledger(on) {
    this.keepLedger = on;
    this.reload();
  },
  act_resetView() {
    this.orbit.reset();
    this.draw();
  },

  act_close() {
    if (this.closest('dialog')) return this.closest('dialog').close();
    this.shut();
    this.showDoor();
    this.querySelector('button').focus();
  },

  /** Gives everything back. */
  shut() {
    this.playing = false;
    delete this.dataset.running;
    this.sleep();
    this.dropTruth();
    this.runs.forEach(run => run.close());
    Object.assign(this, {view: null, opening: null, runs: [], sceneName: null, methods: null, orbit: null});
    this.dataset.state = 'closed';
  },

  // Doors.

  /** The method of A, with the step that its run was asked for. */
  get tomlNow() { return this.byHand ? this.runs[0].sim.sceneText() : withMethod(this.toml, this.methods[0]);},

  async act_copyLink() {
    const link = `${location.href.split('#')[0]}#lab=${await addressOf(this.state)}`;
    this.link = link;
    this.view.say(await copyText(link) ? say('linkCopied') : say('notCopied', {text: link}));
  },

  act_saveToml() {
    const file = `${this.sceneName}${this.isShipped ? '' : '-lab'}.toml`;
    saveText(file, this.tomlNow);
    this.view.say(say('savedToml', {file}));
  },

  /** Whether the scene is the page's own, unchanged. */
  get isShipped() { return !this.byHand && this.toml === sceneText(this.sceneName);},

  async act_copyCommand() {
    const command = commandOf(this.isShipped ? this.sceneName : `${this.sceneName}-lab.toml`, this.methods[0]);
    this.view.say(await copyText(command) ? say('commandCopied', {command}) : say('notCopied', {text: command}));
  },

  async act_file(file) {
    const toml = await file.text(), scene = file.name.replace(/\.toml$/i, '').replace(/[^\w-]/g, '-');
    this.view.say('');
    await this.setState(
        {scene: sceneText(scene) && toml !== sceneText(scene) ? `${scene}-own` : scene, toml, running: false});
  },

  dragged(event) {
    if (!this.view || ![...event.dataTransfer?.types ?? []].includes('Files')) return;
    event.preventDefault();
    const file = event.dataTransfer.files?.[0];
    this.view.dropHere.hidden =
        event.type === 'drop' || (event.type === 'dragleave' && this.contains(event.relatedTarget) === false);
    if (event.type === 'drop' && file) this.act_file(file);
  },

  // The hand.

  /** Holds a particle at a place; false where there is nothing to hold. */
  hold(particle, place, run) {
    if (run.ended && (run.failed || run.refusal)) return false;
    this.waiting = {particle, place, run};
    this.source = run;
    if (!this.playing && !stillWanted.matches) {
      this.moveHeld();
      this.play();
    }
    this.wake();
    return true;
  },

  /** Moves what is held; once a frame, as the engine goes on from there as another scene. */
  moveHeld() {
    const {particle, place} = this.waiting;
    this.waiting = null;
    this.byHand = true;
    this.changeRuns(sim => sim.hold(particle, place));
    this.draw();
  },

  /** Changes by hand what every run has come to. */
  changeRuns(act) {
    for (const run of this.runs) {
      if (run.refusal || run.failed) continue;
      try {
        run.change(act);
      } catch (problem) {
        run.fault = problem.message;
      }
    }
    this.byHand = true;
    this.stage?.setCourse([]);
    this.end = Math.max(...this.runs.map(run => (run.refusal ? 0 : run.end)));
  },

  release() {
    if (this.waiting) this.moveHeld();
    this.changeRuns(sim => sim.release());
    this.together();
  },

  /** After a change by hand all runs, and the truth, go on from the state of one of them. */
  together() {
    const from = this.runs.includes(this.source) && !this.source.failed ?
        this.source :
        this.runs.find(run => !run.failed && !run.refusal);
    this.dropTruth();
    if (!from) return;
    const text = from.sim.sceneText(), time = from.time;
    this.runs.forEach((run, i) => {
      if (run === from || run.refusal || run.failed) return;
      const other = new LiveRun(this.lab, text, run.letter, run.spec, () => this.keepLedger);
      Object.assign(other, {samples: run.samples, trail: run.trail, since: run.since, offset: time, look: run.look});
      run.close();
      this.runs[i] = other;
    });
    this.clock = time;
    this.end = from.end;
    this.stage.setPins([...from.sim.scene.pins]);
    this.showViews();
    this.wake();
  },

  act_pin(particle = this.hand.chosen) {
    const run = this.runs.find(r => !r.refusal && !r.failed);
    if (particle === null || !run) return;
    const pinned = [...run.sim.scene.pins].includes(particle);
    this.source = run;
    this.changeRuns(sim => (pinned ? sim.unpin(particle) : sim.pin(particle)));
    this.together();
    this.choose(particle);
  },

  choose(particle) {
    const run = this.runs.find(r => !r.refusal);
    this.view.setChosen(particle, Boolean(run) && [...run.sim.scene.pins].includes(particle), Boolean(this.hand.held));
    this.draw();
    this.tell();
  },

  // The picture.

  /** A stage for the scene; a new one where particles or springs are others. */
  setStage(fresh) {
    const {sim} = this.runs[0], {scene} = sim,
          made = [scene.particles, scene.springs.length, scene.triangles.length].join();
    if (fresh || !this.pictures.length) this.pictures = this.preview();
    if (this.stage && made === this.stage.made && !fresh) {
      this.stage.setPins([...scene.pins]);
      return this.stage.setCourse(this.course());
    }
    const {camera} = scene,
          deep = this.pictures.some(p => p.some((v, i) => i % 3 === 2 && Math.abs(v - this.pictures[0][2]) > 1e-9));
    const flat = !scene.triangles.length && !deep;
    const from = camera ? minus(camera.eye, camera.target) : flat ? [0, 0, 1] : [0.55, 0.35, 1];
    this.sleep();
    while (alive.length >= mostStages) (alive.find(other => !other.seen && other !== this) ?? alive[0]).sleep();
    const canvas = make('canvas', {'aria-hidden': 'true'});
    canvas.addEventListener('webglcontextlost', () => this.stage?.canvas === canvas && this.sleep());
    const shown = stageScene(this.sceneName, sim, flat ? null : 0, from);
    const times = Array.from({length: 13}, (_, i) => scene.duration * i / 12).map(t => sim.centres(t));
    shown.spheres.forEach((sphere, i) => (sphere.centres = times.map(c => [...c.subarray(3 * i, 3 * i + 3)])));
    this.stage = new LiveStage(canvas, shown, this.drawsSlowly);
    this.stage.made = made;
    this.stage.hold(this.pictures);
    this.stage.setCourse(this.course());
    if (fresh || !this.orbit) this.orbit = new Orbit(from);
    this.hand.act.orbit = this.orbit;
    this.view.layer.replaceChildren(canvas);
    alive.push(this);
  },

  /**
   * The true course of the last particle of a first-order scene, which has no energy to be judged by: points, m; none
   * where a hand has changed it. RK4 in as many steps is off by less than a thousandth of a pixel.
   */
  course() {
    const [{sim: {scene}}] = this.runs;
    if (!scene.firstOrder || this.byHand) return [];
    const sim = this.lab.open(this.toml), points = [], last = trailPoints - 1;
    try {
      sim.start(startOf({method: 'rk4', step: scene.duration / (8 * last)}, scene.duration, false));
      for (let i = 0; i <= last; ++i) {
        sim.advance(scene.duration * i / last);
        points.push([...sim.positions.slice(-3)]);
      }
    } finally {
      sim.close();
    }
    return points;
  },

  /** Gives the stage's context back. */
  sleep() {
    if (!this.stage) return;
    const at = alive.indexOf(this);
    if (at >= 0) alive.splice(at, 1);
    this.stage.release();
    this.stage.canvas.remove();
    this.stage = null;
  },

  /** Places at some times of the scene, as far as they are found quickly: what the camera has to hold. */
  preview() {
    const [a] = this.runs, {scene} = a.sim, pictures = a.refusal ? [] : [Float64Array.from(a.sim.positions)];
    const begin = performance.now(), limit = a.sim.limit('leapfrog');
    for (const spec
             of [{method: 'leapfrog', step: limit > 0 && Number.isFinite(limit) ? 0.7 * limit : scene.step},
                 {method: 'rk4', step: scene.step}, {method: scene.method.replace(/^mysim\//, ''), step: scene.step}]) {
      try {
        const sim = this.lab.open(this.toml);
        sim.start(startOf(spec, scene.duration, false));
        if (a.refusal) pictures.push(Float64Array.from(sim.positions));
        for (let i = 1; i <= 12 && performance.now() - begin < previewBudget; ++i) {
          sim.advance(scene.duration * i / 12, previewBudget - (performance.now() - begin));
          if (sim.verdict !== 'ok' || !isFinite3(sim.positions)) break;
          pictures.push(Float64Array.from(sim.positions));
        }
        sim.close();
        break;
      } catch {
        continue;
      }
    }
    return pictures.length ? pictures : [new Float64Array(3 * scene.particles)];
  },

  /** What is drawn: the runs, and the truth where it is wanted and known. */
  showViews() {
    if (!this.stage) this.setStage(false);
    const drawn = this.runs.filter(run => run.places).map(run => ({
                                                            run,
                                                            letter: run.letter,
                                                            look: run.look = lookOfRun(run.letter),
                                                            trail: run.trail,
                                                            places: run.places
                                                          }));
    if (this.look.truth && this.truth?.known) {
      const places = this.truth.places, look = lookOfRun('T');
      drawn.push({run: null, letter: 'T', look, trail: [], places, faint: true});
    }
    this.drawn = drawn;
    this.stage.show(drawn);
    this.showLook();
    this.draw();
  },

  showLook() {
    const {colour} = this.look, all = this.runs.filter(run => !run.failed && run.places);
    let scale = null;
    if (colour === 'stretch')
      scale = `${this.colourTop = 10} %`;
    else if (colour === 'error') {
      const worst = Math.max(1e-9, ...all.map(run => run.samples.reduce((top, s) => Math.max(top, s.error ?? 0), 0)));
      scale = length(this.colourTop = roundUp(3 * worst));
    }
    const {triangles, firstOrder} = this.runs[0].sim.scene;
    this.view.setLook(this.look, this.drawn.length, triangles.length > 0, scale, firstOrder);
  },

  /** Draws the present; true while the camera still moves. */
  draw() {
    const {stage, view} = this;
    if (!stage || !view || !this.drawn?.length) return false;
    const {canvas} = stage, box = view.stage,
          ratio = Math.min(2, window.devicePixelRatio || 1) * (stage.coarse && this.playing ? coarseRatio : 1);
    const wide = Math.round(box.clientWidth * ratio), high = Math.round(box.clientHeight * ratio);
    if (!wide || !high) return false;
    if (canvas.width !== wide || canvas.height !== high) Object.assign(canvas, {width: wide, height: high});
    const over = this.look.view === 'over' || this.drawn.length < 2, [a] = this.runs;
    if (this.look.truth && Boolean(this.truth?.known) !== this.drawn.some(d => d.letter === 'T'))
      return this.showViews();
    // runs keep their places in the same array; a run that was replaced has another
    this.drawn.forEach((each, i) => {
      const panel = stage.panels[i], {run} = each;
      panel.places = run ? run.places : this.truth.places;
      panel.trail = run ? run.trail : [];
    });
    this.keepInView();
    const background = getComputedStyle(box).backgroundColor.match(/[\d.]+/g).slice(0, 3).map(v => v / 255);
    const {colour} = this.look,
          from = this.truth?.known && this.truth.followers[0].spent >= 0 ? this.truth.places : null;
    const places = stage.draw({
      time: this.clock,
      orbit: this.orbit,
      background,
      over,
      springs: this.look.springs || !a.sim.scene.triangles.length,
      colour: {name: colour === 'error' && !from ? 'plain' : colour, top: this.colourTop, from},
      title: over ? 20 + titleHeight * (this.drawn.length - 1) : 46,
      centres: a.refusal ? new Float64Array(0) : a.sim.centres(a.sim.t),
      growth: this.growth,
      marked: this.hand.chosen === null ? null : {particle: this.hand.chosen, held: Boolean(this.hand.held)}
    });
    view.setTitles(this.drawn.map(each => this.titleOf(each)), places, over);
    return stage.moving;
  },

  /** The camera steps back where a run that is well leaves the view, but not while a pointer leads a particle in it. */
  keepInView() {
    if (this.hand.grabbed) return;
    const run = this.runs.find(r => !r.failed && !r.bursting && r.places && !this.stage.sees(r.places));
    if (!run || this.pictures.length > 60) return;
    this.pictures.push(Float64Array.from(run.places));
    this.stage.hold(this.pictures);
  },

  titleOf({run, letter, look}) {
    if (!run) return {name: say('truth'), words: '', state: '', look, failed: false};
    const {step, tolerance, method} = run.spec, last = run.samples[run.samples.length - 1];
    const setting = tolerance && run.stepper?.adaptive ? `${say('tolerance')} ${tolerance}` :
                                                         timeText(run.refusal ? step : run.sim.h || step);
    const error = last?.error === null || last?.error === undefined || last.t === 0 ?
        '' :
        `${say(run.errorWord)} ${length(last.error)}${last.bar ? ` ${say('errorBar', {bar: length(last.bar)})}` : ''}`;
    return {
      name: letter,
      words: [nameOfMethod(method), setting].join(say('comma')),
      state: run.failed ? say('failed') : error,
      look,
      failed: run.failed
    };
  },

  // Words.

  relabel() {
    if (this.dataset.state === 'closed') return this.showDoor();
    if (this.dataset.state === 'unavailable')
      return this.replaceChildren(make('p', {class: 'lab-plain'}, say(this.dataset.missing)));
    if (!this.view) return;
    this.view.build();
    this.view.speed.value = String(this.speed);
    this.view.knobs.build(this.toml, this.original);
    this.view.ledger.checked = this.keepLedger;
    this.view.setRunning(this.playing);
    this.showLook();
    this.showState();
    this.judge();
  },

  /** All that depends on scene and methods. */
  showState() {
    const {view} = this;
    view.setScene(
        Object.keys(labScenes()), this.sceneName, questionInLanguage(textAt(this.toml, 'question')),
        this.toml !== this.original || this.byHand, this.dataset.alone !== undefined);
    view.setMethods(this.methods, this.runs, this.lab.steppers, this.scale);
    view.knobs.show(this.toml);
    view.setChosen(
        this.hand.chosen, this.hand.chosen !== null && [...this.runs[0].sim.scene.pins].includes(this.hand.chosen),
        false);
    this.judge();
    this.showNow(true);
  },

  /** The numbers of the present: the clock each frame, curves and readings about ten times a second. */
  showNow(all, now = performance.now()) {
    const {view, runs} = this;
    if (!view) return;
    view.setTime(this.clock, this.end, this.byHand);
    if (!all && now - (this.told ?? 0) < 110) return;
    this.told = now;
    // curves end where the last run failed
    const over = runs.every(run => run.failed) ? 1.1 * Math.max(...runs.map(run => run.time)) : 0;
    view.plots.show(
        runs.filter(run => run.look), over || Math.max(this.clock, this.end), this.clock, this.withoutCurves());
    if (this.look.colour === 'error') this.showLook();
    this.showReadout();
    this.tell();
  },

  /** What is said where there is no curve. */
  withoutCurves() {
    const soon = say('beforeRun'), {hand, truthGone, clock} = this;
    return {
      energy: soon,
      residual: this.keepLedger ? soon : say('noResidual'),
      error: truthGone                                     ? say('noError') :
          clock === 0 || this.runs.every(run => run.ended) ? soon :
          hand.held                                        ? say('noErrorHeld') :
                                                             say('truthLate')
    };
  },

  showReadout() {
    const {runs, view} = this, words = [], fps = this.framesPerSecond;
    if (this.playing && fps) words.push(say('frames', {n: fps}));
    const computing = runs.reduce((sum, run) => sum + (run.last || 0), 0);
    this.average = this.playing ? 0.8 * (this.average ?? computing) + 0.2 * computing : this.average;
    if (this.average) words.push(say('computing', {ms: Number(this.average.toPrecision(2))}));
    const factors =
        runs.filter(run => run.factor).map(run => `${runs.length > 1 ? `${run.letter} ` : ''}${say('realTime', {
                                             x: run.factor >= 10 ? Math.round(run.factor) :
                                                                   Number(run.factor.toPrecision(2))
                                           })}`);
    words.push(...factors);
    const pace = this.passed.reduce((sum, v) => sum + v, 0) / (this.passed.length || 1);
    if (this.playing && this.passed.length > 20 && pace < 0.9)
      words.push(say('behind', {x: Number(pace.toPrecision(2))}));
    if (!this.playing && this.clock >= this.end - 1e-9 && !runs.some(run => run.failed)) words.push(say('endReached'));
    view.readout.textContent = words.join(' · ');
    const bits = this.bits === null ? '' : say(this.bits ? 'sameBits' : 'otherBits', {stepper: this.methods[0].method});
    view.truthWords.textContent = [this.truthWords(), bits].filter(Boolean).join(' ');
  },

  /** What the truth is here, or why there is none. */
  truthWords() {
    const {truth} = this;
    if (this.truthGone === 'slow') return say('truthSlow', {ms: Number(this.truthCost.toPrecision(2))});
    if (this.truthGone) return say(this.truthGone === 'large' ? 'truthLarge' : 'truthNone');
    if (!truth?.known) return '';
    if (truth.same) return say('truthSame');
    const words =
        say(this.byHand ? 'truthByHand' : 'truthIs',
            {stepper: nameOfMethod(truth.spec.method), h: timeText(truth.followers[0].sim.h || truth.spec.step)});
    return this.late > 200 ? `${words} ${say('truthLate')}` : words;
  },
};
