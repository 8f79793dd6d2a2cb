// <live-lab>: mysim in the page, next to the truth. Nothing is laid out, compiled or computed before the lab is opened
// by its button, an address, or openLab(). With data-part="step", it shows only the picture and the step's slider, and
// opens when it becomes visible. Sliders change numbers in the scene's text (TOML), and then the runs restart.

import {make, short} from '../player/controls';
import {dark, startsWebGl, stillWanted} from '../player/player';
import {Vec3} from '../player/vectors';

import {labModule, Simulation} from './engine';
import {openExperiment, openGuide} from './guide';
import {Hand} from './hand';
import {nameOfMethod, msText} from './knobs';
import {addressOf, commandOf, copyText, LabState, saveText, stateOf} from './lab_link';
import {LabPicture} from './lab_picture';
import {labScenes, sceneText, shortestFrame, smallScene} from './lab_runs';
import {labButton, LabView} from './lab_view';
import {LiveRun, messageOf} from './live_run';
import {Changes, changesBetween, MethodSpec, textAt, withMethod, withNumbers} from './scene_text';
import {labLanguage, questionInLanguage, say} from './words';

const longestFrame = 120;  // ms; longer frames count as this long
const pauseAtEnd = 1200;   // ms, before a looping run restarts

export class LiveLab extends LabPicture {
  link = '';                                             // last copied link
  waiting: {particle: number, place: Vec3}|null = null;  // pending move of a particle, applied in the next frame
  private opening: Promise<boolean>|null = null;
  private source: LiveRun|null = null;  // the run whose particle is held
  private loops = false;                // true: restart at the end, until the reader does something
  private again = 0;                    // timers
  private later = 0;
  private asked = false;
  private lastFrame: number|null = null;
  private told = 0;
  private frames: number[] = [];
  private average: number|null = null;  // ms of computation per frame

  get alone() { return this.dataset.alone !== undefined; }
  get isPart() { return this.dataset.part !== undefined; }

  connectedCallback() {
    if (this.dataset.state) return;
    const there = Boolean(document.getElementById('lab-module'));
    this.dataset.state = there ? 'closed' : 'unavailable';
    if (!there) return;
    document.addEventListener('lab-language', () => this.relabel());
    this.relabel();
    if (this.isPart)
      new IntersectionObserver(([entry], observer) => {
        if (!entry.isIntersecting) return;
        observer.disconnect();
        this.open();
      }).observe(this);
    else if (this.alone && !/^#lab=/.test(location.hash))
      this.open();
  }

  disconnectedCallback() {
    if (this.view) this.shut();
  }

  private showDoor() {
    const button = labButton('open', `▶ ${say('open')}`, () => this.open(), `▶ ${say('open')}`);
    this.replaceChildren(make('div', {class: 'lab-door'}, button, make('span', {}, say('openHint'))));
  }

  /** Opens the lab, by default with its own scene running. Resolves when the lab is visible. */
  async open(state?: LabState) {
    if (this.view) return this.setState(state ?? {});
    this.opening ??= this.begin();
    if (!await this.opening || (!state && this.sceneName)) return;  // another state was set meanwhile
    this.loops = !state && !stillWanted.matches;
    const names = Object.keys(labScenes()),
          own = this.dataset.scene || (names.includes('cloth-hang') ? 'cloth-hang' : names[0]);
    await this.setState({running: this.loops, ...state, scene: state?.scene ?? own});
  }

  private async begin() {
    this.dataset.state = 'opening';
    if (!this.isPart) this.replaceChildren(make('p', {class: 'lab-plain', role: 'status'}, say('waiting')));
    await new Promise(done => setTimeout(done));  // shows the message before the compiler blocks the thread
    const lab = await labModule(), missing = !lab ? 'noWasm' : !startsWebGl() ? 'noWebgl' : null;
    if (!lab || missing) {
      this.dataset.state = 'unavailable';
      this.dataset.missing = missing ?? '';
      this.relabel();
      return false;
    }
    this.lab = lab;
    const view = this.view = new LabView(this.acts);
    this.replaceChildren(view.root);
    this.hand = new Hand(view.layer, {
      stage: () => this.stage,
      orbit: () => this.orbit!,
      runs: () => this.drawn.map(each => each.run),
      draw: () => this.draw(),
      hover: on => view.layer.classList.toggle('on-particle', on),
      hold: (particle, place, run) => this.hold(particle, place, run),
      release: () => this.release(),
      choose: particle => this.choose(particle),
      pin: particle => this.pin(particle),
      toggle: () => this.acts.toggle(),
      step: () => this.acts.step(),
      restart: () => this.acts.restart()
    });
    new IntersectionObserver(([entry]) => (this.seen = entry.isIntersecting, this.wake())).observe(this);
    new ResizeObserver(() => (this.draw(), this.wake())).observe(view.stage);
    dark.addEventListener('change', () => this.runs.length && this.showViews());
    for (const name of ['dragenter', 'dragover', 'dragleave', 'drop'] as const)
      this.addEventListener(name, event => this.dragged(event));
    this.dataset.state = 'ready';
    return true;
  }


  /** Sets the given fields, such as a scene with its shipped text and method. Resolves when the state is displayed. */
  async setState(state: LabState): Promise<void> {
    if (!this.view) return this.open({scene: this.dataset.scene, ...state});
    const {scene, toml, changes, methods, speed, running} = state, other = scene !== undefined;
    if (other && toml === undefined && !sceneText(scene))
      return this.view.say(say('unknownScene', {name: scene}), true);
    const before = {sceneName: this.sceneName, original: this.original, toml: this.toml, methods: this.methods};
    if (other || toml !== undefined) {
      this.sceneName = scene ?? this.sceneName;
      this.original = sceneText(this.sceneName) ?? toml ?? '';
      this.toml = toml ?? this.original;
    }
    this.toml = withNumbers(this.toml, changes ?? {});
    if (methods)
      this.methods = methods.slice(0, 2).map(m => ({...m}));
    else if (other)
      this.methods = null;
    this.setLookOf(state);
    if (speed) this.setSpeed(speed);
    if (!this.load(other)) {
      Object.assign(this, before);
      if (before.toml) this.load(other);
      return;
    }
    if (running === false) this.loops = false;
    if (running !== undefined) running ? this.play() : this.pause();
    await new Promise(done => setTimeout(done));
    this.tell();
  }

  get state(): LabState {
    const {sceneName: scene, original, toml, methods, look} = this, state: LabState = {scene, methods};
    if (this.byHand)
      state.toml = this.runs[0].sim.sceneText();
    else if (toml !== original || !sceneText(scene)) {
      const changes = sceneText(scene) ? changesBetween(original, toml) : null;
      Object.assign(state, changes ? {changes} : {toml});
    }
    if (look.view !== 'over') state.view = look.view;
    if (look.colour !== 'plain') state.colour = look.colour;
    return state;
  }

  /** Current numbers, for the guide and for tests. */
  get reading() {
    const {runs} = this, [a] = runs;
    if (!a) return null;
    return {
      scene: this.sceneName,
      toml: this.toml,
      runs,
      t: this.clock,
      running: this.playing,
      ended: a.ended,
      byHand: this.byHand,
      limitA: a.limit,
      error: a.lastSample?.error ?? null,
      chosen: this.hand.chosen
    };
  }

  private tell() { this.dispatchEvent(new Event('reading', {bubbles: true})); }

  protected refused(words: string) { this.view?.say(words, true); }

  protected opened(fresh: boolean) {
    this.waiting = this.average = null;
    this.hand.held = this.hand.grabbed = null;
    if (fresh) {
      this.hand.forget();
      this.view?.knobs.build(this.toml, this.original);
    }
    this.setStage(fresh);
    this.sample();
    this.showViews();
    this.showState();
  }

  /** Reports failed runs, and shows the growing mode of the first. */
  judge() {
    const failed = this.runs.filter(run => run.failed), {stage} = this;
    for (const run of failed)
      if (!run.shown && stage) run.shown = true, run.stepBack(places => stage.sees(places, 0.1));
    if (!this.growth && failed.length && !failed[0].fault) {
      const mode = failed[0].sim.growth;
      this.growth = mode && {letter: failed[0].letter, mode: mode.slice()};
    }
    this.dataset.verdict = failed.length ? failed[0].verdict : 'ok';
    this.view?.setVerdict([...failed.map(run => this.verdictOf(run)), ...(this.growth ? [say('growth')] : [])]);
  }

  private verdictOf(run: LiveRun) {
    const {verdict, limit, sim: {h}} = run, known = /^(energy|nan|stretch|solver|frozen)$/.test(verdict);
    const key = known ? `verdict${verdict[0].toUpperCase()}${verdict.slice(1)}` : 'verdictOther';
    const words = say(key, {letter: run.letter, t: short(run.time), reason: run.reason});
    if (limit === null || !Number.isFinite(limit) || !(limit > 0) || !h) return words;
    const x = Number((h / limit).toPrecision(3));
    return `${words} ${say(x > 1 ? 'verdictPast' : 'verdictBelow', {x})}`;
  }


  play() {
    clearTimeout(this.again);
    if (this.runs.every(run => run.ended) || this.clock >= this.end - 1e-9) this.restart();
    this.playing = true;
    this.dataset.running = '';
    this.view?.setRunning(true);
    this.wake();
  }

  pause() {
    if (!this.playing) return;
    this.playing = false;
    delete this.dataset.running;
    this.view?.setRunning(false);
    this.showNow(true);
    if (this.loops && !this.runs.some(run => run.failed))
      this.again = window.setTimeout(() => this.loops && this.play(), pauseAtEnd);
    this.wake();
  }

  wake() {
    if (this.asked || !this.seen || !this.isConnected) return;
    this.asked = true;
    requestAnimationFrame(now => this.frame(now));
  }

  frame(now: number) {
    this.asked = false;
    if (!this.isConnected || !this.view || !this.runs.length) return;
    const begin = performance.now(), apart = this.lastFrame ? now - this.lastFrame : 0;  // ms
    const passed = Math.min(0.1, apart / 1000);  // limited, because frames stop while the page is hidden
    this.lastFrame = now;
    this.frameTime = Math.max(shortestFrame, Math.min(longestFrame, 0.8 * this.frameTime + 200 * passed));
    this.frames = this.playing ? [...this.frames.filter(time => time >= now - 1000), now] : [];
    if (!this.stage) this.showViews();
    if (this.stage && this.hand.grabbed?.pointer) this.hand.lead(this.hand.grabbed.pointer);
    if (this.waiting) this.moveHeld();
    const was = this.pending;
    if (was) {
      this.sample();
      if (this.playing) this.passed.push(0);
    } else if (this.playing)
      this.advance(this.speed * this.pace * passed, this.speed * passed);
    const eased = this.draw();
    this.showNow(was && !this.pending && !this.playing, now);
    this.watchDrawing(apart, performance.now() - begin);
    if (this.playing || eased || this.waiting || this.pending)
      this.wake();
    else
      this.lastFrame = null;
  }

  private get framesPerSecond() {
    const {frames} = this, count = frames.length - 1;
    return count > 1 ? Math.round(1000 * count / (frames[count] - frames[0])) : null;
  }


  setSpeed(speed: number) {
    this.speed = speed;
    if (this.view) this.view.speed.value = String(speed);
  }

  /** Makes a change. The lab then runs if it was running, or if a run had ended by itself. */
  private goOn(change: () => void) {
    const over = this.runs.some(run => run.ended && !run.refusal) && !stillWanted.matches;
    const runs = this.playing || over;
    if (!this.isPart) this.loops = false;
    change();
    if (runs) this.play();
  }

  private reload() {
    let well = false;
    this.goOn(() => (well = this.load()));
    return well;
  }

  private readonly acts = {
    toggle: () => {
      this.loops = !this.playing && this.isPart;
      this.playing ? this.pause() : this.play();
    },
    restart:
        () => {
          const runs = this.playing || this.view?.verdict.contains(document.activeElement);
          this.restart();
          if (runs) this.play();
        },
    /** Takes a step of the first method that still runs. */
    step:
        () => {
          this.loops = false;
          this.pause();
          if (this.runs.every(run => run.ended)) this.restart();
          const run = this.runs.find(r => !r.ended);
          if (!run) return;
          const begin = run.sim.steps, {step} = run.sim.scene;
          this.advance(Math.max(0, run.time + run.step - this.clock) + 1e-9 * step);
          if (run.sim.steps === begin && !run.ended) this.advance(run.step);
          this.draw();
          this.showNow(true);
          this.wake();
        },
    speed: (speed: number) => this.setSpeed(speed),
    /** Changes a method and restarts its run, in the same scene if the rule is the same. */
    method:
        (i: number, spec: MethodSpec, done: boolean) => {
          if (!this.methods) return;
          const same = this.methods[i].method === spec.method && !this.byHand;
          this.methods[i] = spec;
          this.settle(done);
          if (!same) return void this.reload();
          this.runs[i].spec = spec;
          this.goOn(() => this.restart());
        },
    second:
        () => {
          const [{method, step}] = this.methods ?? [{method: '', step: 0}], {scene} = this.runs[0].sim;
          const other = ['symplectic-euler', 'leapfrog', 'rk4', 'trapezoidal'].find(
              name => name !== method && (!scene.firstOrder || this.lab.stepperOf(name)?.firstOrder));
          this.methods = [...this.methods ?? [], {method: other ?? 'rk4', step: step ?? scene.step}];
          this.reload();
        },
    removeSecond:
        () => {
          this.methods = this.methods?.slice(0, 1) ?? null;
          this.reload();
        },
    /** Changes numbers of the scene. Opens the scene when the slider has rested briefly (longer for large scenes). */
    numbers:
        (changes: Changes, done: boolean) => {
          this.toml = withNumbers(this.toml, changes);
          this.settle(done);
          clearTimeout(this.later);
          const act = () => {
            this.view?.say('');
            if (!this.reload()) this.view?.knobs.show(this.toml = this.good);
          };
          const wait = this.runs[0].sim.scene.particles > smallScene ? 250 : 60;  // ms
          if (done)
            act();
          else
            this.later = window.setTimeout(act, wait);
        },
    scene: (scene: string) => void this.setState({scene, running: this.playing && !stillWanted.matches}),
    original: () => void this.setState({toml: this.original, running: this.playing}),
    look:
        (change: LabState) => {
          this.setLookOf(change);
          this.showViews();
        },
    resetView:
        () => {
          this.orbit?.reset();
          this.draw();
        },
    guide: () => openGuide(this),
    more:
        () => {
          delete this.dataset.part;
          this.draw();
          this.view?.layer.focus({preventScroll: true});
        },
    close:
        () => {
          const dialog = this.closest('dialog');
          if (dialog) return dialog.close();
          this.shut();
          this.showDoor();
          this.querySelector('button')?.focus();
        },
    pin: () => this.pin(),
    copyLink:
        async () => {
          this.link = `${location.href.split('#')[0]}#lab=${await addressOf(this.state)}`;
          this.view?.say(await copyText(this.link) ? say('linkCopied') : say('notCopied', {text: this.link}));
        },
    saveToml:
        () => {
          const file = `${this.sceneName}${this.isShipped ? '' : '-lab'}.toml`;
          saveText(file, this.tomlNow);
          this.view?.say(say('savedToml', {file}));
        },
    copyCommand:
        async () => {
          const scene = this.isShipped ? this.sceneName : `${this.sceneName}-lab.toml`;
          const command = commandOf(scene, this.methods?.[0] ?? {method: ''});
          this.view?.say(await copyText(command) ? say('commandCopied', {command}) : say('notCopied', {text: command}));
        },
    file:
        async (file: File) => {
          const toml = await file.text(), scene = file.name.replace(/\.toml$/i, '').replace(/[^\w-]/g, '-');
          const own = sceneText(scene) && toml !== sceneText(scene);
          this.view?.say('');
          await this.setState({scene: own ? `${scene}-own` : scene, toml, running: false});
        }
  };

  private shut() {
    this.loops = this.playing = false;
    delete this.dataset.running;
    this.classList.remove('guided');
    this.sleep();
    this.dropTruth();
    this.runs.forEach(run => run.close());
    Object.assign(this, {view: null, opening: null, runs: [], sceneName: '', methods: null, orbit: null});
    this.dataset.state = 'closed';
  }

  get tomlNow() {
    return this.byHand ? this.runs[0].sim.sceneText() : withMethod(this.toml, this.methods?.[0] ?? {method: ''});
  }

  private get isShipped() { return !this.byHand && this.toml === sceneText(this.sceneName); }

  private dragged(event: DragEvent) {
    const {dataTransfer: given} = event;
    if (!this.view || !given?.types.includes('Files')) return;
    event.preventDefault();
    const leaves = event.type === 'dragleave' && !this.contains(event.relatedTarget as Node | null),
          [file] = given.files;
    this.view.dropHere.hidden = event.type === 'drop' || leaves;
    if (event.type === 'drop' && file) this.acts.file(file);
  }


  private hold(particle: number, place: Vec3, run: LiveRun) {
    if (run.ended && (run.failed || run.refusal)) return false;
    this.loops = false;
    this.waiting = {particle, place};
    this.source = run;
    if (!this.playing && !stillWanted.matches) {
      this.moveHeld();
      this.play();
    }
    this.wake();
    return true;
  }

  /** Moves the held particle once per frame, because each move begins another scene. */
  private moveHeld() {
    if (!this.waiting) return;
    const {particle, place} = this.waiting;
    this.waiting = null;
    this.changeRuns(sim => sim.hold(particle, place));
    this.draw();
  }

  private changeRuns(act: (sim: Simulation) => void) {
    for (const run of this.runs) {
      if (run.refusal || run.failed) continue;
      try {
        run.change(act);
      } catch (problem) {
        run.fault = messageOf(problem);
      }
    }
    this.byHand = true;
    this.stage?.setCourse([]);
    this.end = Math.max(...this.runs.map(run => (run.refusal ? 0 : run.end)));
  }

  private release() {
    this.moveHeld();
    this.changeRuns(sim => sim.release());
    this.together();
  }

  /** After a change by hand, makes runs and truth continue from the state of one run. */
  private together() {
    const {source} = this, well = source && this.runs.includes(source) && !source.failed;
    const from = well ? source : this.runs.find(run => !run.failed && !run.refusal);
    this.dropTruth();
    if (!from) return;
    const text = from.sim.sceneText(), {time} = from;
    this.runs = this.runs.map(run => {
      if (run === from || run.refusal || run.failed) return run;
      const other = new LiveRun(this.lab, text, run.letter, run.spec, scene => this.observes(scene));
      const {samples, trail, since, look, handWork} = run;
      Object.assign(other, {samples, trail, since, look, handWork, offset: time});
      run.close();
      return other;
    });
    this.clock = time;
    this.end = from.end;
    this.stage?.setPins([...from.sim.scene.pins]);
    this.showViews();
    this.wake();
  }

  private pin(particle = this.hand.chosen) {
    const run = this.runs.find(r => !r.refusal && !r.failed);
    if (particle === null || !run) return;
    const pinned = run.sim.scene.pins.includes(particle);
    this.loops = false;
    this.source = run;
    this.changeRuns(sim => sim.pin(particle, !pinned));
    this.together();
    this.choose(particle);
  }

  private choose(particle: number|null) {
    const run = this.runs.find(r => !r.refusal);
    const pinned = particle !== null && Boolean(run?.sim.scene.pins.includes(particle));
    this.view?.setChosen(particle, pinned, Boolean(this.hand.held));
    this.draw();
    this.tell();
  }


  private relabel() {
    const {state, missing} = this.dataset, {view} = this;
    this.lang = labLanguage;
    if (this.alone) {
      document.documentElement.lang = labLanguage;
      document.querySelector('nav .made')?.replaceChildren(say('madeOf'));
    }
    if (this.isPart && !view) return;  // keeps the still picture
    if (state === 'closed') return this.showDoor();
    if (state === 'unavailable') return this.replaceChildren(make('p', {class: 'lab-plain'}, say(missing ?? '')));
    if (!view) return;
    view.build();
    view.speed.value = String(this.speed);
    view.knobs.build(this.toml, this.original);
    view.setRunning(this.playing);
    this.showLook();
    this.showState();
  }

  private showState() {
    const {view, hand: {chosen}, runs: [a]} = this;
    if (!view || !this.methods) return;
    view.setScene(
        Object.keys(labScenes()), this.sceneName, questionInLanguage(textAt(this.toml, 'question')),
        this.toml !== this.original || this.byHand, this.alone);
    view.setMethods(this.methods, this.runs, this.lab.steppers, this.scale);
    view.knobs.show(this.toml);
    view.setChosen(chosen, chosen !== null && a.sim.scene.pins.includes(chosen), false);
    this.judge();
    this.showNow(true);
  }

  /** Updates the clock, and, about ten times per second, curves and readings. */
  showNow(all: boolean, now = performance.now()) {
    const {view, runs} = this;
    if (!view) return;
    view.setTime(this.clock, this.end, this.byHand);
    if (!all && now - this.told < 110) return;
    this.told = now;
    // if all runs failed, the curves end at the last failure
    const over = runs.every(run => run.failed) ? 1.1 * Math.max(...runs.map(run => run.time)) : 0;
    view.plots.show(runs, over || Math.max(this.clock, this.end), this.clock, this.withoutCurves());
    if (this.look.colour === 'error') this.showLook();
    this.showReadout(view);
    this.tell();
  }

  private withoutCurves() {
    const soon = say('beforeRun'), begins = this.clock === 0 || this.runs.every(run => run.ended);
    return {
      energy: soon,
      residual: this.observes(this.runs[0].sim.scene) ? soon : say('noResidual'),
      error: this.truthGone ? say('noError') :
          begins            ? soon :
          this.hand.held    ? say('noErrorHeld') :
                              say('truthLate')
    };
  }

  private showReadout(view: LabView) {
    const {runs} = this, words: string[] = [], fps = this.framesPerSecond, [{handWork}] = runs;
    const digits = (value: number) => Number(value.toPrecision(2));
    if (handWork !== null) words.push(say('handWork', {energy: short(handWork)}));
    if (this.playing && fps) words.push(say('frames', {n: fps}));
    const computing = runs.reduce((sum, run) => sum + run.last, 0);
    if (this.playing) this.average = 0.8 * (this.average ?? computing) + 0.2 * computing;
    if (this.average) words.push(say('computing', {ms: digits(this.average)}));
    for (const {factor, letter} of runs) {
      if (!factor) continue;
      const x = say('realTime', {x: factor >= 10 ? Math.round(factor) : digits(factor)});
      words.push(runs.length > 1 ? `${letter} ${x}` : x);
    }
    const pace = this.passed.reduce((sum, v) => sum + v, 0) / (this.passed.length || 1);
    if (this.playing && this.passed.length > 20 && pace < 0.9) words.push(say('behind', {x: digits(pace)}));
    if (!this.playing && this.clock >= this.end - 1e-9 && !runs.some(run => run.failed)) words.push(say('endReached'));
    view.readout.textContent = words.join(' · ');
    view.truthWords.textContent = this.truthWords();
  }

  /** Describes the truth, or states why there is no truth. */
  private truthWords() {
    const {truth, truthGone} = this;
    if (truthGone === 'slow') return say('truthSlow', {ms: Number(this.truthCost.toPrecision(2))});
    if (truthGone) return say(truthGone === 'large' ? 'truthLarge' : 'truthNone');
    if (!truth?.known) return '';
    if (truth.same) return say('truthSame');
    const stepper = nameOfMethod(truth.spec.method), h = msText(truth.followers[0].step);
    const words = say(this.byHand ? 'truthByHand' : 'truthIs', {stepper, h});
    return this.late > 200 ? `${words} ${say('truthLate')}` : words;
  }
}

/** A lab state with a single method in short form, and an experiment to open. */
type LabWish = LabState&{method?: string, step?: number, tolerance?: number, experiment?: string};

/** Opens the scene's own lab on the page, or else the lab of a lab page, or else a lab in a window over the page. */
export async function openLab({method, step, tolerance, experiment, ...state}: LabWish) {
  if (!document.getElementById('lab-module')) return null;
  if (method) state.methods = [{method: method.replace(/^mysim\//, ''), step, tolerance}];
  const own = `live-lab[data-scene="${CSS.escape(state.scene ?? '')}"]`;
  let lab = document.querySelector<LiveLab>(`${own}:not([data-part])`) ??
      document.querySelector<LiveLab>('live-lab[data-alone]');
  if (!lab) {
    lab = document.createElement('live-lab') as LiveLab;
    lab.dataset.scene = state.scene;
    const dialog: HTMLDialogElement =
        make('dialog', {class: 'run lab-window', lang: labLanguage, 'aria-label': say('labTitle')}, lab);
    document.body.append(dialog);
    dialog.addEventListener('close', () => dialog.remove());
    dialog.showModal();
  }
  await lab.open(state);
  lab.scrollIntoView({block: 'nearest'});
  if (experiment) openExperiment(experiment, lab);
  return lab;
}

async function followLabAddress() {
  const state = await stateOf(location.hash);
  if (state)
    await openLab(state);
  else if (/^#lab=/.test(location.hash))
    document.querySelector<LiveLab>('live-lab[data-alone]')?.open();
}

export function startLab() {
  customElements.define('live-lab', LiveLab);
  addEventListener('hashchange', followLabAddress);
  if (document.readyState === 'loading')
    document.addEventListener('DOMContentLoaded', followLabAddress);
  else
    followLabAddress();
}
