// The stage and camera of <live-lab> (lab.ts).

import {length, make, roundUp} from '../player/controls';
import {Orbit} from '../player/orbit';
import {alive, mostStages} from '../player/player';
import {minus, placeOf, Places, Vec3} from '../player/vectors';

import {msText, nameOfMethod} from './knobs';
import {LabState} from './lab_link';
import {LabRuns} from './lab_runs';
import {LabLook, LabView, lookOfRun, PanelTitle, titleHeight} from './lab_view';
import {isFinite3, startOf} from './live_run';
import {LiveStage, LiveView, stageScene, trailPoints} from './live_stage';
import {MethodSpec} from './scene_text';
import {say} from './words';

const previewBudget = 150;  // ms, to estimate how far a scene moves
const slowDrawing = 40;     // ms between frames, minus the time of scripts; above this, drawing is slow
const coarseRatio = 0.7;    // fraction of the pixels per side for slow drawing

/** An element that can release the context of its stage. */
interface Sleeper {
  seen: boolean;
  sleep(): void;
}

export abstract class LabPicture extends LabRuns {
  view: LabView|null = null;
  stage: LiveStage|null = null;
  orbit: Orbit|null = null;
  look: LabLook = {view: 'over', colour: 'plain', springs: false, truth: false};
  drawn: LiveView[] = [];
  pictures: Places[] = [];  // positions that the camera must show
  seen = true;
  drawsSlowly = false;
  private colourTop = 1;
  private drawing = 0;   // ms between frames, minus the time of scripts
  private scripted = 0;  // ms of scripts in the last frame

  /** Makes a new stage if the numbers of particles or springs differ. */
  setStage(fresh: boolean) {
    const [{sim}] = this.runs, {scene} = sim;
    const made = [scene.particles, scene.springs.length, scene.triangles.length].join();
    if (fresh || !this.pictures.length) this.pictures = this.preview();
    if (this.stage && made === this.stage.made && !fresh) {
      this.stage.setPins([...scene.pins]);
      return this.stage.setCourse(this.course());
    }
    const {camera} = scene, depth = this.pictures[0][2];
    const deep = this.pictures.some(p => p.some((v: number, i: number) => i % 3 === 2 && Math.abs(v - depth) > 1e-9));
    const flat = !scene.triangles.length && !deep;
    const from = camera ? minus(camera.eye, camera.target) : flat ? [0, 0, 1] : [0.55, 0.35, 1];
    this.sleep();
    const others: Sleeper[] = alive;
    while (others.length >= mostStages) (others.find(other => !other.seen && other !== this) ?? others[0]).sleep();
    const canvas: HTMLCanvasElement = make('canvas', {'aria-hidden': 'true'});
    canvas.addEventListener('webglcontextlost', () => this.stage?.canvas === canvas && this.sleep());
    const shown = stageScene(this.sceneName, sim, flat ? null : 0, from);
    const times = Array.from({length: 13}, (_, i) => sim.centres(scene.duration * i / 12));
    shown.spheres.forEach((sphere, i) => (sphere.centres = times.map(centres => placeOf(centres, i))));
    this.stage = new LiveStage(canvas, shown, shown.shared, this.drawsSlowly);
    this.stage.made = made;
    this.stage.hold(this.pictures);
    this.stage.setCourse(this.course());
    if (fresh || !this.orbit) this.orbit = new Orbit(from);
    this.view?.layer.replaceChildren(canvas);
    others.push(this);
  }

  /**
   * The true path (m) of the last particle of a first-order scene, which has no energy to judge by; empty after a
   * change by hand. With this number of steps, RK4 errs by less than a thousandth of a pixel.
   */
  private course() {
    const [{sim: {scene}}] = this.runs, points: Vec3[] = [], last = trailPoints - 1;
    if (!scene.firstOrder || this.byHand) return points;
    const sim = this.lab.open(this.toml);
    sim.start(startOf({method: 'rk4', step: scene.duration / (8 * last)}, scene.duration, false));
    for (let i = 0; i <= last; ++i) {
      sim.advance(scene.duration * i / last);
      points.push(placeOf(sim.positions, scene.particles - 1));
    }
    sim.close();
    return points;
  }

  /** Releases the context. */
  sleep() {
    if (!this.stage) return;
    const others: Sleeper[] = alive, at = others.indexOf(this);
    if (at >= 0) others.splice(at, 1);
    this.stage.release();
    this.stage.canvas.remove();
    this.stage = null;
  }

  /** Positions that the camera must show, as far as they can be computed quickly. */
  private preview() {
    const [a] = this.runs, {scene} = a.sim, pictures: Places[] = a.refusal ? [] : [a.sim.positions.slice()];
    const begin = performance.now(), limit = a.sim.limit('leapfrog'), {step} = scene;
    const left = () => previewBudget - (performance.now() - begin);
    const tried: MethodSpec[] = [
      {method: 'leapfrog', step: limit && Number.isFinite(limit) ? 0.7 * limit : step}, {method: 'rk4', step},
      {method: scene.method.replace(/^mysim\//, ''), step}
    ];
    for (const spec of tried) {
      try {
        const sim = this.lab.open(this.toml);
        sim.start(startOf(spec, scene.duration, false));
        if (a.refusal) pictures.push(sim.positions.slice());
        for (let i = 1; i <= 12 && left() > 0; ++i) {
          sim.advance(scene.duration * i / 12, left());
          if (sim.verdict !== 'ok' || !isFinite3(sim.positions)) break;
          pictures.push(sim.positions.slice());
        }
        sim.close();
        break;
      } catch {
        continue;
      }
    }
    return pictures.length ? pictures : [new Float64Array(3 * scene.particles)];
  }

  /** Chooses the runs to draw, and the truth if it is selected and known. */
  showViews() {
    if (!this.stage) this.setStage(false);
    this.drawn = [];
    for (const run of this.runs) {
      const look = run.look = lookOfRun(run.letter);
      if (run.places) this.drawn.push({run, letter: run.letter, look, places: run.places, trail: run.trail});
    }
    if (this.look.truth && this.truth?.known)
      this.drawn.push(
          {run: null, letter: 'T', look: lookOfRun('T'), places: this.truth.places, trail: [], faint: true});
    this.stage?.show(this.drawn);
    this.showLook();
    this.draw();
  }

  protected showLook() {
    const {colour} = this.look, {triangles, firstOrder} = this.runs[0].sim.scene;
    let scale = '';
    if (colour === 'stretch')
      scale = `${this.colourTop = 10} %`;
    else if (colour === 'error') {
      const errors = this.runs.filter(run => !run.failed).flatMap(run => run.samples.map(s => s.error ?? 0));
      scale = length(this.colourTop = roundUp(3 * errors.reduce((a, b) => Math.max(a, b), 1e-9)));
    }
    this.view?.setLook(this.look, this.drawn.length, triangles.length > 0, scale, firstOrder);
  }

  protected setLookOf(change: LabState) {
    for (const name of ['view', 'colour', 'springs', 'truth'] as const)
      if (change[name] !== undefined) Object.assign(this.look, {[name]: change[name]});
  }

  /** Returns true while the camera moves. */
  draw(): boolean {
    const {stage, view, orbit, look} = this;
    if (!stage || !view || !orbit || !this.drawn.length) return false;
    const {canvas} = stage, box = view.stage, [a] = this.runs, truth = this.truth?.known ? this.truth.places : null;
    const ratio = Math.min(2, devicePixelRatio || 1) * (stage.coarse && this.playing ? coarseRatio : 1);
    const width = Math.round(box.clientWidth * ratio), height = Math.round(box.clientHeight * ratio);
    if (!width || !height) return false;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    const over = look.view === 'over' || this.drawn.length < 2;
    if (look.truth && Boolean(truth) !== this.drawn.some(d => d.letter === 'T')) return this.showViews(), false;
    // a run reuses its array of positions, but the run itself may have been replaced
    this.drawn.forEach(({run}, i) => {
      const panel = stage.panels[i], places = run ? run.places : truth;
      if (places) panel.places = places;
      panel.trail = run?.trail ?? [];
    });
    this.keepInView();
    const colour = look.colour === 'error' && !truth ? 'plain' : look.colour, {chosen} = this.hand;
    const background = (getComputedStyle(box).backgroundColor.match(/[\d.]+/g) ?? ['255', '255', '255']).slice(0, 3);
    const places = stage.draw({
      time: this.clock,
      orbit,
      background: background.map(v => Number(v) / 255),
      over,
      springs: look.springs || !a.sim.scene.triangles.length,
      colour: {name: colour, top: this.colourTop, from: truth},
      title: over ? 20 + titleHeight * (this.drawn.length - 1) : 46,
      centres: a.refusal ? new Float64Array(3 * a.sim.scene.spheres.length) : a.sim.centres(a.sim.t),
      growth: this.growth,
      marked: chosen === null ? null : {particle: chosen, held: Boolean(this.hand.held)}
    });
    view.setTitles(this.drawn.map(each => this.titleOf(each)), places, over);
    return stage.moving;
  }

  /** Moves the camera back if a run that has not failed leaves the view, unless a pointer moves a particle. */
  private keepInView() {
    const {stage} = this;
    if (this.hand.grabbed || !stage) return;
    const run = this.runs.find(r => !r.failed && !r.bursting && r.places && !stage.sees(r.places));
    if (!run?.places || this.pictures.length > 60) return;
    this.pictures.push(run.places.slice());
    stage.hold(this.pictures);
  }

  private titleOf({run, letter, look}: LiveView): PanelTitle {
    if (!run) return {name: say('truth'), words: '', state: '', look, failed: false};
    const {tolerance, method} = run.spec, last = run.lastSample;
    const setting = tolerance && run.stepper?.adaptive ? `${say('tolerance')} ${tolerance}` : msText(run.step);
    const bar = last?.bar ? ` ${say('errorBar', {bar: length(last.bar)})}` : '';
    const error = last && last.error !== null && last.t > 0 ? `${say(run.errorWord)} ${length(last.error)}${bar}` : '';
    return {
      name: letter,
      words: [nameOfMethod(method), setting].join(say('comma')),
      state: run.failed ? say('failed') : error,
      look,
      failed: run.failed
    };
  }

  /**
   * Uses a coarse stage if drawing takes much longer than computing, as without a graphics processor. `apart`: ms
   * between frames; `script`: ms of this frame's script.
   */
  watchDrawing(apart: number, script: number) {
    if (!this.playing || !this.stage || this.stage.coarse) return void (this.drawing = 0);
    this.drawing += 0.2 * (Math.min(100, apart - this.scripted) - this.drawing);
    this.scripted = script;
    if (this.drawing < slowDrawing) return;
    this.drawsSlowly = true;
    this.sleep();
    this.showViews();
  }
}
