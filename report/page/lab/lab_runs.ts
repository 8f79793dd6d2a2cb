// Runs with a common clock, and the truth at the same times, for <live-lab> (lab.ts).

import {EngineScene, Lab, LabError, solidsOf} from './engine';
import {Hand} from './hand';
import {LiveRun, messageOf, Truth} from './live_run';
import {Growth} from './live_stage';
import {MethodSpec, numberAt, textAt} from './scene_text';
import {say} from './words';

const computingBudget = 0.5;      // fraction of a frame's time, for all methods together
const truthBudget = 0.45;         // fraction of a frame's time
export const shortestFrame = 17;  // ms
const slowestPace = 0.1;          // minimum clock rate while waiting for the truth
const longestWait = 2500;         // ms that the clock waits for the truth
export const smallScene = 1500;   // number of particles; larger scenes have no truth and no energy balance
const beginsRuns = 200;           // ms from the last move of a slider to the start of a truth

/** Shipped texts of the page's scenes, by name. */
export const labScenes = (() => {
  let scenes: Record<string, string>|undefined;
  return () =>
             (scenes ??=
                  JSON.parse(document.getElementById('lab-scenes')?.textContent || '{}') as Record<string, string>);
})();
export const sceneText = (name: string): string|undefined => labScenes()[name];

export abstract class LabRuns extends HTMLElement {
  lab!: Lab;
  hand!: Hand;
  runs: LiveRun[] = [];
  sceneName = '';
  toml = '';
  original = '';  // scene text before changes
  good = '';      // last valid text
  methods: MethodSpec[]|null = null;
  clock = 0;  // s
  end = 0;    // s
  speed = 1;
  playing = false;
  byHand = false;
  truth: Truth|null = null;
  truthGone: 'large'|'none'|'slow'|null = null;  // reason why there is no truth
  truthCost = 0;                                 // ms per frame
  growth: Growth|null = null;                    // growing mode of a failed run
  pending = false;                               // true while the clock waits for the truth
  pace = 1;
  late = 0;               // ms that the clock has waited for the truth
  passed: number[] = [];  // actual / requested clock rates
  frameTime = shortestFrame;
  scale: number|null = null;  // s, critical step of the scene as it was opened
  private slow = 0;           // ms spent at the slowest pace
  private settled = 0;        // time from which sliders count as at rest

  /** Called after runs were opened; `fresh`: for another scene. */
  protected abstract opened(fresh: boolean): void;
  protected abstract refused(words: string): void;
  protected abstract judge(): void;
  abstract pause(): void;

  /** Called when a slider moves or stops: no truth is started while it moves. */
  protected settle(done: boolean) { this.settled = done ? 0 : performance.now() + beginsRuns; }

  protected observes(scene: EngineScene) { return scene.particles <= smallScene; }

  /** Opens the scene for every method. If the scene is invalid, displays the reason and returns false. */
  load(fresh = false) {
    const opened: LiveRun[] = [];
    try {
      this.methods ??= [this.ownMethod()];
      for (const spec of this.methods) {
        const stepper = this.lab.stepperOf(spec.method);
        if (!stepper) throw new LabError('input', spec.method);
        if (stepper.adaptive)
          spec.tolerance ||= 1e-6;
        else
          spec.step ||= numberAt(this.toml, 'time.step');
      }
      for (const [i, spec] of this.methods.entries())
        opened.push(new LiveRun(this.lab, this.toml, 'AB'[i], spec, scene => this.observes(scene)));
    } catch (problem) {
      opened.forEach(run => run.close());
      this.refused(say('sceneRefused', {reason: messageOf(problem)}));
      return false;
    }
    this.good = this.toml;
    this.runs.forEach(run => run.close());
    this.runs = opened;
    this.start(fresh);
    return true;
  }

  /** mysim's method in the scene's text, or else leapfrog. */
  private ownMethod(): MethodSpec {
    const name = textAt(this.toml, 'method').replace(/^mysim\//, '');
    return {method: this.lab.stepperOf(name) ? name : 'leapfrog', step: numberAt(this.toml, 'time.step')};
  }

  private start(fresh: boolean) {
    const [a] = this.runs;
    this.clock = 0, this.end = a.sim.scene.duration, this.byHand = false, this.growth = null, this.passed = [];
    this.dropTruth();
    if (fresh) this.scale = a.sim.limit('leapfrog');
    this.opened(fresh);
  }

  restart() {
    if (this.byHand) return void this.load();
    this.runs.forEach(run => run.start());
    this.start(false);
  }

  /** Opens the truth when it is first needed. */
  private findTruth() {
    if (this.truth || this.truthGone) return;
    const run = this.runs.find(r => !r.refusal && !r.failed);
    if (!run) return;
    if (run.sim.scene.particles > smallScene) return void (this.truthGone = 'large');
    try {
      const toml = this.byHand ? run.sim.sceneText() : this.toml;
      const truth = new Truth(this.lab, toml, run, solidsOf(run.sim.scene) > 0);
      if (truth.known) this.truth = truth;
    } catch {
      // the engine cannot read the text that it wrote for this state
    }
    if (!this.truth) this.truthGone = 'none';
    this.late = 0;
  }

  protected dropTruth() {
    this.truth?.close();
    this.truth = this.truthGone = null;
    this.late = this.slow = 0, this.pace = 1, this.pending = false;
  }

  /** Runs proceed up to the clock, as far as the frame's computing budget allows. `wanted`: time at full speed. */
  advance(passed: number, wanted = passed) {
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
    const over = this.clock >= this.end - 1e-9;
    if (this.runs.every(run => run.ended || (over && run.time >= this.end - 1e-6))) this.pause();
  }

  /**
   * Compares runs with the truth, and records samples. If the truth exceeds the frame's budget, `pending` makes the
   * clock wait for it, and `pace` slows the clock down. If that lasts too long, drops first the error bar, then
   * the truth.
   */
  sample() {
    // at the start no truth is needed; while a slider moves, none is started
    const free = !this.hand.held && this.clock > 0 && performance.now() > this.settled;
    if (free) this.findTruth();
    const begin = performance.now(), truth = free ? this.truth : null;
    const left = () => Math.max(1, truthBudget * this.frameTime - (performance.now() - begin));
    this.pending = false;
    for (const run of [...this.runs].sort((x, y) => x.time - y.time)) {
      const last = run.lastSample;
      if (run.refusal || last?.t === run.time || (last && run.time < last.t + this.end / 500 && !run.ended)) continue;
      const compared = !run.failed && run.places ? truth?.compare(run.places, run.time, left()) : null;
      const found = this.clock === 0 ? {error: 0, bar: null} : compared;
      if (!found && truth && !run.failed && truth.isBefore(run.time))
        this.pending = true;
      else
        run.sample(found?.error ?? null, found?.bar ?? null);
    }
    this.pace = this.pending ? Math.max(slowestPace, 0.8 * this.pace) : Math.min(1, 1.04 * this.pace);
    this.late = this.pending ? this.late + this.frameTime : 0;
    this.slow = this.pace > 2 * slowestPace ? 0 : this.slow + this.frameTime;
    if (!this.pending || !this.truth || (this.late < longestWait && this.slow < longestWait)) return;
    this.truthCost = this.truth.cost * this.speed * this.frameTime / 1000;
    this.late = this.slow = 0, this.pace = 1;
    if (!this.truth.shed()) this.truth.close(), this.truth = null, this.truthGone = 'slow';
  }
}
