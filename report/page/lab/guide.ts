// <lab-guide>: guided experiments in a <live-lab>. Each step asks for a guess, lets the reader perform the task in the
// lab, notices its completion, and explains the result.

import {make} from '../player/controls';
import {stillWanted} from '../player/player';

import {Before, centreOf, foundNumbers, GuideExperiment, GuideStep, labExperiments, Mode, Reading, Seen, shownNumbers, startAngle, Wanted} from './experiments';
import {LiveLab, openLab} from './lab';
import {labScenes, sceneText} from './lab_runs';
import {numberAt, valueAt, withNumbers} from './scene_text';
import {labLanguage, say} from './words';

/** Numbers of the lab for the experiments; null before the lab's first run. */
export function readingOf(lab: LiveLab): Reading|null {
  const {reading} = lab;
  if (!reading) return null;
  const {toml, scene, t} = reading, size = /^size\s*=\s*\[\s*(\d+)\s*,\s*(\d+)\s*\]/m.exec(toml);
  const runs = reading.runs.filter(run => run.places && !run.refusal).map(run => {
    const energy = run.fault ? null : run.sim.energy;
    return {
      method: run.spec.method,
      step: run.step,
      limit: run.limit ?? 0,
      t: run.time,
      steps: run.sim.steps,
      ended: run.ended,
      failed: run.failed,
      x: run.places!,
      energy,
      gain: energy && run.first ? energy.balance - run.first.balance : NaN,
      sim: run.sim
    };
  });
  if (!runs.length) return null;
  const [run] = runs, {sim} = run;
  return {
    scene,
    toml,
    run,
    runs,
    t,
    duration: sim.scene.duration,
    omega: sim.omega,
    particles: sim.scene.particles,
    columns: size ? Number(size[1]) : 0,
    rows: size ? Number(size[2]) : 0,
    at: path => numberAt(toml, path),
    vector: path => valueAt(toml, path) as number[] ?? []
  };
}

const beforeOf = (r: Reading): Before => ({
  limit: r.runs[0].limit,
  omega: r.omega,
  particles: r.particles,
  k: r.at('grid.stiffness.structural'),
  bend: r.at('grid.stiffness.bend'),
  mass: r.at('grid.mass'),
  friction: r.at('sphere.friction'),
  angle: startAngle(r),
  centre: centreOf(r.runs[0].x)
});

interface Result {
  guess: string|number|null;
  read?: number;  // the actual value
  values: Record<string, string|number>;
  before: Before;
}

/** Completed steps, kept while the tab is open, if the browser allows it. */
export const guideProgress = (() => {
  const key = 'lab-guide', nameOf = (experiment: GuideExperiment, step: GuideStep) => `${experiment.name}.${step.name}`;
  let done: Record<string, Result> = {};
  try {
    done = JSON.parse(sessionStorage.getItem(key) ?? '{}');
  } catch { /* a page opened from a folder may have no storage */
  }
  return {
    of: (experiment: GuideExperiment, step: GuideStep): Result | undefined => done[nameOf(experiment, step)],
    keep(experiment: GuideExperiment, step: GuideStep, result: Result) {
      done[nameOf(experiment, step)] = result;
      try {
        sessionStorage.setItem(key, JSON.stringify(done));
      } catch { /* there may be no storage */
      }
    },
    finished: (experiment: GuideExperiment) => experiment.steps.every(step => done[nameOf(experiment, step)])
  };
})();

const experimentOfAddress = () => /^#experiment=([\w-]+)/.exec(location.hash)?.[1];

/** Writes the experiment into the page's address, so that links can open it, or removes it there. */
function writeExperiment(name: string|null) {
  if (!name && !experimentOfAddress()) return;
  try {
    history.replaceState(null, '', name ? `#experiment=${name}` : location.href.replace(/#.*/, ''));
  } catch { /* the browser does not allow it: the address stays */
  }
}

/** Experiments whose scenes are in this page. */
const experimentsHere = () => labExperiments.filter(({scenes}) => scenes.every(name => name in labScenes()));

const guideButton = (key: string, words: string, act: () => void, attributes: Record<string, string> = {}) => {
  const button: HTMLButtonElement = make('button', {type: 'button', 'data-key': key, ...attributes}, words);
  button.addEventListener('click', act);
  return button;
};

type Phase = 'ask'|'try'|'why';

class LabGuide extends HTMLElement {
  lab!: LiveLab;
  phase: Phase = 'ask';
  acting: number|null = null;  // index of the act performed for the reader
  setting = false;             // true while the lab is being set to a state
  seen: Omit<Seen, 'before'>&{before: Before | null} = {before: null, all: {}, run: {}};
  private experiment: GuideExperiment|null = null;
  private step: GuideStep|null = null;
  private number = 0;
  private sandbox = false;
  private guess: string|number|null = null;
  private result: Result|null = null;
  private run = '';
  private time = 0;

  connectedCallback() {
    const lab = this.closest<LiveLab>('live-lab');
    if (this.lab || !lab) return;
    this.lab = lab;
    lab.addEventListener('reading', () => this.look());
    document.addEventListener('lab-language', () => this.render());
    this.setAttribute('role', 'region');
    this.showList();
  }

  showList() {
    if (this.experiment) writeExperiment(null);
    this.experiment = this.step = null;
    this.sandbox = false;
    this.render();
  }

  private showSandbox() {
    writeExperiment(null);
    this.experiment = this.step = null;
    this.sandbox = true;
    this.lab.setSpeed(1);  // an experiment may have changed the speed
    this.render();
    this.focusFirst();
  }

  private leave() {
    writeExperiment(null);
    this.remove();
    this.lab.classList.remove('guided');
  }

  /** Opens an experiment at its first unfinished step, or the list if the name is unknown. */
  show(name: string) {
    const experiment = experimentsHere().find(each => each.name === name);
    if (!experiment) return this.showList();
    const open = experiment.steps.findIndex(step => !guideProgress.of(experiment, step));
    return this.begin(experiment, Math.max(0, open));
  }

  /** Sets the lab to a step's first state. */
  private async begin(experiment: GuideExperiment, number: number, again = false) {
    const step = experiment.steps[number], known = again ? undefined : guideProgress.of(experiment, step);
    Object.assign(this, {experiment, number, step, sandbox: false, acting: null, phase: known ? 'why' : 'ask'});
    this.guess = known?.guess ?? null, this.result = known ?? null;
    this.seen = {before: known?.before ?? null, all: {}, run: {}};
    writeExperiment(experiment.name);
    this.render();
    this.focusFirst();
    await this.setLab(step.start);
  }

  private async setLab(wanted: Wanted, running = false) {
    const r = readingOf(this.lab), state = typeof wanted === 'function' ? r && wanted(r, this.seen as Seen) : wanted;
    if (!state) return;
    const {scene, numbers, edit = (toml: string) => toml, methods, speed = 1, from} = state;
    this.setting = true;
    await this.lab.setState({scene, toml: edit(withNumbers(sceneText(scene) ?? '', numbers)), methods, speed, running});
    if (from && this.lab.orbit) {
      Object.assign(this.lab.orbit, from);
      this.lab.draw();
    }
    this.setting = false;
    this.look();
  }

  /** Accepts the reader's guess, or null if the reader made none. */
  private async take(guess: string|number|null) {
    if (!this.step || !this.seen.before) return;
    Object.assign(this, {guess, phase: 'try'});
    this.render();
    this.querySelector<HTMLElement>('.task button')?.focus({preventScroll: true});
    if (this.step.then) await this.setLab(this.step.then);
  }

  private async act(index = 0) {
    const {step} = this, acts = step?.acts ?? (step ? [step.then ?? step.start] : []);
    if (index >= acts.length) return;
    this.acting = null;
    this.showLab();
    await this.setLab(acts[index], true);
    if (this.step === step && this.phase === 'try') this.acting = index;
  }

  /** Scrolls to the lab on narrow pages, where it is below the guide. */
  private showLab(parent: HTMLElement = this.lab, selector = '.stage') {
    const {root} = this.lab.view ?? {};
    if (!root || this.getBoundingClientRect().bottom > root.getBoundingClientRect().top + 1) return;
    parent.querySelector(selector)?.scrollIntoView(
        {block: 'nearest', behavior: stillWanted.matches ? 'auto' : 'smooth'});
  }

  /** Checks the lab: the question's numbers may be known now, or the task completed. */
  private look() {
    const {step, seen} = this, r = step && !this.setting && this.isConnected ? readingOf(this.lab) : null;
    if (!r || !step) return;
    if (!seen.before) {
      seen.before = beforeOf(r);
      return void (this.phase === 'ask' && this.render());
    }
    if (this.phase !== 'try') return;
    const run = r.toml + r.runs.map(({method, step: h}) => method + h);
    if (run !== this.run || r.t < this.time) seen.run = {};
    Object.assign(this, {run, time: r.t});
    step.watch?.(r, seen as Seen);
    if (step.done(r, seen as Seen)) return void this.complete(r, step);
    const over = r.runs.every(each => each.ended || each.failed) || step.enough?.(r);
    if (this.acting !== null && over) this.act(this.acting + 1);
  }

  private complete(r: Reading, step: GuideStep) {
    const {experiment, guess} = this, seen = this.seen as Seen, acted = this.acting !== null;
    this.phase = 'why', this.acting = this.result = null;
    const values = foundNumbers(step, r, seen);
    const result = {guess, read: step.guess?.read(r), values, before: seen.before};
    if (experiment) guideProgress.keep(experiment, step, result);
    if (this.step !== step) return;
    this.result = result;
    this.render();
    if (step.arrows) this.showMode(step.arrows(r), r);
    if (acted) setTimeout(() => this.step === step && this.showLab(this, '.why'), 1500);
    this.dispatchEvent(
        new CustomEvent('step-done', {bubbles: true, detail: {experiment: experiment?.name, step: step.name}}));
  }

  /** Shows the motion that grew in a failed run: deforms the cloth by up to `by` m, with arrows of that length. */
  private showMode({mode, places, by}: Mode, r: Reading) {
    const {lab} = this, [run] = lab.runs, most = mode.reduce((top, part) => Math.max(top, Math.abs(part)), 0);
    if (!lab.growth || !lab.stage || r.runs[0].sim !== run.sim) return;
    const {size} = lab.stage;
    run.places?.set(places.map((place, i) => place + 0.5 * by * mode[i] / most));
    lab.growth = {letter: 'A', mode: mode.map(part => by * part / most / (0.16 * size))};
    lab.draw();
  }

  private go(number: number) {
    if (this.experiment && number < this.experiment.steps.length) return this.begin(this.experiment, number);
    const next = this.following;
    return next ? this.begin(next, 0) : this.showSandbox();
  }

  private get following(): GuideExperiment|undefined {
    const all = experimentsHere();
    return all[all.findIndex(each => each === this.experiment) + 1];
  }

  private focusFirst() {
    this.querySelector<HTMLElement>('.asked, h3')?.focus({preventScroll: true});
    this.scrollIntoView({block: 'nearest'});
  }

  private render() {
    this.setAttribute('aria-label', say('guide.title'));
    this.lang = labLanguage;
    this.dataset.phase = this.step ? this.phase : this.sandbox ? 'sandbox' : 'list';
    this.dataset.experiment = this.experiment?.name ?? '';
    this.dataset.step = this.step?.name ?? '';
    const active = document.activeElement,
          focused = active instanceof HTMLElement && this.contains(active) && active.dataset.key;
    const {experiment, step} = this;
    this.replaceChildren(
        ...(experiment && step ? this.stepParts(experiment, step) :
                this.sandbox   ? this.sandboxParts() :
                                 this.listParts()));
    if (focused) this.querySelector<HTMLElement>(`[data-key="${focused}"]`)?.focus({preventScroll: true});
  }

  private listParts(): HTMLElement[] {
    const list: HTMLElement = make('ol', {class: 'entries'});
    const add = (key: string, done: boolean, act: () => void) => {
      const button = guideButton(key, '', act, {class: done ? 'entry done' : 'entry'});
      button.append(
          make('b', {}, say(`${key}.title`)), make('span', {}, say(`${key}.about`)),
          ...(done ? [make('i', {}, `✓ ${say('guide.done')}`)] : []));
      list.append(make('li', {}, button));
    };
    for (const experiment of experimentsHere())
      add(experiment.name, guideProgress.finished(experiment), () => this.show(experiment.name));
    add('sandbox', false, () => this.showSandbox());
    return [
      make('h3', {tabindex: -1}, say('guide.title')), make('p', {class: 'soft'}, say('guide.lead')), list,
      guideButton('leave', say('guide.leave'), () => this.leave(), {class: 'plain'})
    ];
  }

  private sandboxParts(): HTMLElement[] {
    return [
      this.allButton(), make('h3', {tabindex: -1}, say('sandbox.title')), make('p', {}, say('sandbox.text')),
      make('ul', {}, ...['a', 'b', 'c'].map(key => make('li', {}, say(`sandbox.${key}`))))
    ];
  }

  private allButton() { return guideButton('all', `‹ ${say('guide.all')}`, () => this.showList(), {class: 'plain'}); }

  private words(key: string|undefined, values?: Record<string, unknown>) {
    return say(`${this.experiment?.name}.${this.step?.name}.${key}`, values);
  }

  private stepParts(experiment: GuideExperiment, step: GuideStep): HTMLElement[] {
    const {number, phase, seen} = this, count = experiment.steps.length, why = phase === 'why';
    const values = why ? this.result?.values : seen.before ? shownNumbers(step, seen.before) : undefined;
    const ticks = experiment.steps.map((each, i) => {
      const done = guideProgress.of(experiment, each), name = say('guide.step', {number: i + 1, count});
      return make('li', {}, guideButton(`tick-${i}`, done ? '✓' : String(i + 1), () => this.begin(experiment, i), {
                    'aria-label': done ? `${name}, ${say('guide.done')}` : name,
                    class: done ? 'tick done' : 'tick',
                    ...(i === number ? {'aria-current': 'step'} : {})
                  }));
    });
    const parts: HTMLElement[] = [
      make('div', {class: 'over'}, this.allButton(), make('ol', {class: 'ticks'}, ...ticks)),
      make(
          'h3', {}, say(`${experiment.name}.title`), make('small', {}, say('guide.step', {number: number + 1, count}))),
      make('p', {class: 'asked', tabindex: -1}, values ? this.words('question', values) : '…'),
      step.guess ? this.numberGuess(step.guess.unit) : this.choiceGuess(step)
    ];
    if (phase === 'ask')
      parts.push(guideButton('without', say('guide.without'), () => this.take(null), {class: 'plain'}));
    if (phase === 'try')
      parts.push(make(
          'div', {class: 'task'}, make('h4', {}, say('guide.try')), make('p', {}, this.words('task', values)),
          guideButton('do', say('guide.do'), () => this.act()),
          make('p', {class: 'soft', role: 'status'}, say('guide.waiting'))));
    if (why && this.result) parts.push(this.reason(experiment, step, this.result));
    const last = number + 1 === count, onward = this.following?.name ?? 'sandbox';
    const next = !why ? say('guide.skip') :
        last          ? say('guide.onward', {title: say(`${onward}.title`)}) :
                        say('guide.next');
    parts.push(make(
        'div', {class: 'moves'},
        ...(number > 0 ? [guideButton('back', say('guide.back'), () => this.go(number - 1))] : []),
        ...(why ? [guideButton('again', say('guide.again'), () => this.begin(experiment, number, true))] : []),
        guideButton('next', next, () => this.go(number + 1), {class: why ? 'next main' : 'next'})));
    return parts;
  }

  private choiceGuess({choices = [], right}: GuideStep): HTMLElement {
    const why = this.phase === 'why';
    return make('fieldset', {class: 'guesses'}, make('legend', {}, say('guide.guess')), ...choices.map(choice => {
      const mark = !why ? '' : choice === right ? ' right' : choice === this.guess ? ' wrong' : '';
      const button = guideButton(
          choice, this.words(choice), () => this.take(choice),
          {'data-choice': choice, class: `guess${mark}`, 'aria-pressed': String(choice === this.guess)});
      button.disabled = this.phase !== 'ask';
      return button;
    }));
  }

  private numberGuess(unit: string): HTMLElement {
    const asks = this.phase === 'ask', id = `guess-${this.experiment?.name}-${this.step?.name}`;
    const field: HTMLInputElement =
        make('input', {id, type: 'number', step: 'any', min: 0, inputmode: 'decimal', 'data-key': 'number'});
    if (this.guess !== null) field.value = String(this.guess);
    field.disabled = !asks;
    const form: HTMLElement = make('form', {class: 'guesses number'}, make('label', {for: id
                                   }, say('guide.guess')), field, make('span', {}, unit));
    if (asks) form.append(make('button', {type: 'submit', 'data-key': 'give'}, say('guide.give')));
    form.addEventListener('submit', event => {
      event.preventDefault();
      if (field.value !== '') this.take(Number(field.value));
    });
    return form;
  }

  /** A sentence that judges the guess. */
  private outcome(step: GuideStep, {guess, read = 0}: Result) {
    if (!step.guess) {
      const answer = this.words(step.right);
      if (guess === null) return say('guide.answer', {answer});
      return say(guess === step.right ? 'guide.right' : 'guide.wrong', {guess: this.words(String(guess)), answer});
    }
    const {unit, within} = step.guess;
    const text = (value: number) => `${Number(value.toPrecision(3))}${unit === 'μ' ? '' : ` ${unit}`}`;
    if (guess === null) return say('guide.reads', {answer: text(read)});
    const near = Math.abs(Number(guess) / read - 1) <= within;
    return say(near ? 'guide.near' : 'guide.far', {guess: text(Number(guess)), answer: text(read)});
  }

  /** The judged guess, the explanation, and this run's numbers. */
  private reason(experiment: GuideExperiment, step: GuideStep, result: Result): HTMLElement {
    const {values} = result, last = this.number + 1 === experiment.steps.length;
    return make(
        'div', {class: 'why', role: 'status'}, make('p', {class: 'outcome'}, this.outcome(step, result)),
        make('h4', {}, say('guide.why')), make('p', {}, this.words('why', values)),
        make('p', {class: 'numbers'}, this.words('formula', values)),
        ...(last ?
                [make('p', {class: 'keep'}, make('b', {}, say('guide.remember')), say(`${experiment.name}.remember`))] :
                []));
  }
}

/** The guide of an open lab, created if necessary. */
export function openGuide(lab: LiveLab) {
  const there = lab.querySelector<LabGuide>('lab-guide');
  if (there) return there;
  const guide = document.createElement('lab-guide') as LabGuide;
  lab.classList.add('guided');
  lab.prepend(guide);
  return guide;
}

/**
 * Opens an experiment, or the list if the name is unknown. Default lab: the page's only one, or a lab with the
 * experiment's scene.
 */
export async function openExperiment(name: string, given?: LiveLab) {
  const scene = labExperiments.find(each => each.name === name)?.scenes[0] ?? 'cloth-hang';
  const lab = given ?? await openLab({scene});
  if (lab?.view) openGuide(lab).show(name);
}

const followExperiment = () => {
  const name = experimentOfAddress();
  if (name) openExperiment(name);
};

export function startGuide() {
  customElements.define('lab-guide', LabGuide);
  addEventListener('hashchange', followExperiment);
  followExperiment();
}
