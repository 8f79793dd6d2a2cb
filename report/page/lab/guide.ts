// <lab-guide>: guided experiments beside a <live-lab>. Each step asks for a guess, lets the reader do it in the lab,
// ticks itself when it has happened, and then says why. Nobody is forced: every step can be skipped, repeated or left.
// @ts-nocheck

import {make} from '../player/controls';
import {stillWanted} from '../player/player';

import {labExperiments} from './experiments';
import {labScenes, openLab, sceneText} from './lab';
import {numberAt, withNumbers} from './scene_text';
import {labLanguage, say} from './words';

/** Numbers of the lab as the experiments read them; null before its first run. */
export function readingOf(lab) {
  const {reading} = lab;
  if (!reading?.runs?.length) return null;
  const {toml} = reading, size = /^size\s*=\s*\[\s*(\d+)\s*,\s*(\d+)\s*\]/m.exec(toml);
  const runs = reading.runs.filter(run => run.places && !run.refusal).map(run => ({
                                                                            method: run.spec.method,
                                                                            step: run.sim.h || run.spec.step,
                                                                            limit: run.limit,
                                                                            t: run.time,
                                                                            steps: run.sim.steps,
                                                                            ended: run.ended,
                                                                            failed: run.failed,
                                                                            x: run.places,
                                                                            ...energyOf(run),
                                                                            sim: run.sim
                                                                          }));
  if (!runs.length) return null;
  const {scene} = runs[0].sim;
  return {
    scene: reading.scene,
    toml,
    runs,
    t: reading.t,
    duration: scene.duration,
    omega: scene.omega,
    particles: scene.particles,
    columns: size ? Number(size[1]) : 0,
    rows: size ? Number(size[2]) : 0,
    at: path => numberAt(toml, path)
  };
}

/** Energy of a run now, and what it has gained since the start without a cause, J; neither in first-order scenes. */
function energyOf(run) {
  const energy = run.fault ? null : run.sim.energy;
  return {energy, gain: energy ? energy.balance - run.first.balance : null};
}

/** What a step remembers of the lab as it was beside the question. */
function beforeOf(r) {
  const place = r.at('particle.position');
  return {
    limit: r.runs[0].limit,
    omega: r.omega,
    particles: r.particles,
    k: r.at('grid.stiffness.structural'),
    bend: r.at('grid.stiffness.bend'),
    mass: r.at('grid.mass'),
    friction: r.at('sphere.friction'),
    angle: place && Math.atan2(place[0], place[1]),
    centre: [0, 1, 2].map(k => r.runs[0].x.reduce((sum, c, i) => (i % 3 === k ? sum + c : sum), 0) / r.particles)
  };
}

/**
 * What was done so far: {"EXPERIMENT.STEP": {guess, values, read}}, kept while the page's tab lives where that is
 * allowed.
 */
export const guideProgress = (() => {
  const key = 'lab-guide';
  let done = {};
  try {
    done = JSON.parse(sessionStorage.getItem(key)) ?? {};
  } catch { /* pages of a folder may have no storage */
  }
  return {
    of: (experiment, step) => done[`${experiment.name}.${step.name}`],
    keep(experiment, step, what) {
      done[`${experiment.name}.${step.name}`] = what;
      try {
        sessionStorage.setItem(key, JSON.stringify(done));
      } catch { /* as above */
      }
    },
    finished: experiment => experiment.steps.every(step => done[`${experiment.name}.${step.name}`])
  };
})();

const experimentOfAddress = () => /^#experiment=([\w-]+)/.exec(location.hash)?.[1];

/** Writes the experiment that is shown into the address, or none: then a link to it opens it again. */
function writeExperiment(name) {
  if (!name && !experimentOfAddress()) return;
  try {
    history.replaceState(null, '', name ? `#experiment=${name}` : location.href.replace(/#.*/, ''));
  } catch { /* the address stays */
  }
}

/** The experiments whose scenes are in this page. */
const experimentsHere = () => labExperiments.filter(({scenes}) => scenes.every(name => name in labScenes()));

const guideButton = (words, act, attributes = {}) => {
  const button = make('button', {type: 'button', ...attributes}, words);
  button.addEventListener('click', act);
  return button;
};

class LabGuide extends HTMLElement {
  connectedCallback() {
    if (this.lab) return;
    this.lab =
        this.nextElementSibling?.matches('live-lab') ? this.nextElementSibling : document.querySelector('live-lab');
    if (!this.lab) return void (this.hidden = true);
    this.lab.addEventListener('reading', () => this.look());
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

  showSandbox() {
    writeExperiment(null);
    this.experiment = this.step = null;
    this.sandbox = true;
    if (this.lab.view) this.lab.act_speed(1);  // an experiment may have gone faster
    this.render();
    this.focusFirst();
  }

  /** Opens an experiment, at its first step that is not done unless one is given. */
  show(name, number) {
    const experiment = experimentsHere().find(each => each.name === name);
    this.hidden = false;
    if (!experiment) return this.showList();
    const open = experiment.steps.findIndex(step => !guideProgress.of(experiment, step));
    return this.begin(experiment, number ?? Math.max(0, open));
  }

  /** Sets the lab to the state beside a step's question. */
  async begin(experiment, number, again = false) {
    const step = experiment.steps[number];
    Object.assign(this, {
      experiment,
      number,
      step,
      sandbox: false,
      seen: {run: {}},
      guess: null,
      result: null,
      acting: null,
      phase: 'ask'
    });
    const known = !again && guideProgress.of(experiment, step);
    if (known)
      Object.assign(this, {phase: 'why', guess: known.guess, result: known, seen: {before: known.before, run: {}}});
    writeExperiment(experiment.name);
    this.render();
    this.focusFirst();
    await this.setLab(step.start);
  }

  /** Sets the lab to a state of an experiment. */
  async setLab(wanted, running = false) {
    const r = readingOf(this.lab),
          {scene, numbers, edit, methods, speed = 1, from} =
              typeof wanted === 'function' ? wanted(r, this.seen) : wanted;
    const toml = withNumbers(sceneText(scene), numbers);
    this.setting = true;
    await this.lab.setState({scene, toml: edit ? edit(toml) : toml, methods, speed, running});
    if (from && this.lab.orbit) {
      Object.assign(this.lab.orbit, from);
      this.lab.draw();
    }
    this.setting = false;
    this.look();
  }

  /** Takes the reader's guess, or null for none. */
  async take(guess) {
    const {step} = this;
    if (!this.seen.before) return;
    Object.assign(this, {guess, phase: 'try'});
    this.render();
    this.querySelector('.task button')?.focus({preventScroll: true});
    if (step.then) await this.setLab(step.then);
  }

  /** Does the task for the reader. */
  async act(index = 0) {
    const {step} = this, acts = step.acts ?? [step.then ?? step.start];
    if (index >= acts.length) return;
    this.acting = null;
    this.showLab();
    await this.setLab(acts[index], true);
    if (this.step === step && this.phase === 'try') this.acting = index;
  }

  /** On a narrow page the lab stands below the guide: brings its picture into view, and the reason when it is there. */
  showLab(parent = this.lab, selector = '.stage') {
    if (this.getBoundingClientRect().bottom > this.lab.getBoundingClientRect().top + 1) return;
    parent.querySelector(selector)?.scrollIntoView(
        {block: 'nearest', behavior: stillWanted.matches ? 'auto' : 'smooth'});
  }

  /** Looks at a new reading of the lab: whether the question's numbers are known, whether the task is done. */
  look() {
    const {step} = this, r = step && !this.setting && readingOf(this.lab);
    if (!r) return;
    if (!this.seen.before) {
      this.seen.before = beforeOf(r);
      return void (this.phase === 'ask' && this.render());
    }
    if (this.phase !== 'try') return;
    const run = r.toml + r.runs.map(({method, step: h}) => method + h);
    if (run !== this.run || r.t < this.time) this.seen.run = {};
    Object.assign(this, {run, time: r.t});
    step.watch?.(r, this.seen);
    if (step.done(r, this.seen)) return void this.complete(r);
    const over = r.runs.every(run => run.ended || run.failed) || step.enough?.(r);
    if (this.acting !== null && over) this.act(this.acting + 1);
  }

  async complete(r) {
    const {experiment, step, guess, seen} = this;
    const acted = this.acting !== null;
    this.phase = 'why', this.acting = this.result = null;
    const read = step.guess?.read(r);
    const values = {...step.shown?.(seen), ...await step.values(r, seen)};
    const result = {guess, read, values, before: seen.before};
    guideProgress.keep(experiment, step, result);
    if (this.step !== step) return;
    this.result = result;
    this.render();
    if (step.arrows) await this.showMode(step.arrows, r);
    if (acted) setTimeout(() => this.step === step && this.showLab(this, '.why'), 1500);
    this.dispatchEvent(
        new CustomEvent('step-done', {bubbles: true, detail: {experiment: experiment.name, step: step.name}}));
  }

  /** Shows where the run has failed which motion grew: the cloth bent by it, up to `by` m, and arrows as long. */
  async showMode(find, r) {
    const {lab} = this, {mode, places, by} = await find(r),
          most = mode.reduce((top, part) => Math.max(top, Math.abs(part)), 0);
    if (!lab.growth || r.runs[0].sim !== lab.runs[0].sim) return;
    lab.runs[0].places.set(places.map((place, i) => place + 0.5 * by * mode[i] / most));
    lab.growth = {letter: 'A', mode: mode.map(part => by * part / most / (0.16 * lab.stage.size))};
    lab.draw();
  }

  go(number) {
    if (number < this.experiment.steps.length) return this.begin(this.experiment, number);
    const next = this.following;
    return next ? this.begin(next, 0) : this.showSandbox();
  }

  /** The experiment after this one; undefined after the last. */
  get following() {
    const all = experimentsHere();
    return all[all.indexOf(this.experiment) + 1];
  }

  focusFirst() {
    this.querySelector('.asked, h3')?.focus({preventScroll: true});
    this.scrollIntoView({block: 'nearest'});
  }

  render() {
    this.setAttribute('aria-label', say('guide.title'));
    this.lang = labLanguage;
    this.dataset.phase = this.step ? this.phase : this.sandbox ? 'sandbox' : 'list';
    this.dataset.experiment = this.experiment?.name ?? '';
    this.dataset.step = this.step?.name ?? '';
    const focused = this.contains(document.activeElement) ? document.activeElement.dataset.key : null;
    this.replaceChildren(...(this.step ? this.stepParts() : this.sandbox ? this.sandboxParts() : this.listParts()));
    if (focused) this.querySelector(`[data-key="${focused}"]`)?.focus({preventScroll: true});
  }

  listParts() {
    const list = make('ol', {class: 'entries'});
    const add = (key, done, act) => {
      const button = guideButton('', act, {'data-key': key, class: done ? 'entry done' : 'entry'});
      button.append(
          make('b', {}, say(`${key}.title`)), make('span', {}, say(`${key}.about`)),
          ...(done ? [make('i', {}, `✓ ${say('guide.done')}`)] : []));
      list.append(make('li', {}, button));
    };
    for (const experiment of experimentsHere())
      add(experiment.name, guideProgress.finished(experiment), () => this.show(experiment.name));
    add('sandbox', false, () => this.showSandbox());
    const leave = 'alone' in this.lab.dataset ?
        [] :
        [guideButton(say('guide.leave'), () => (this.hidden = true), {class: 'plain', 'data-key': 'leave'})];
    return [
      make('h3', {tabindex: -1}, say('guide.title')), make('p', {class: 'soft'}, say('guide.lead')), list, ...leave
    ];
  }

  sandboxParts() {
    return [
      this.allButton(), make('h3', {tabindex: -1}, say('sandbox.title')), make('p', {}, say('sandbox.text')),
      make('ul', {}, ...['a', 'b', 'c'].map(key => make('li', {}, say(`sandbox.${key}`))))
    ];
  }

  allButton() {
    return guideButton(`‹ ${say('guide.all')}`, () => this.showList(), {class: 'plain', 'data-key': 'all'});
  }

  words(key, values) { return say(`${this.experiment.name}.${this.step.name}.${key}`, values); }

  stepParts() {
    const {experiment, number, step, phase} = this, count = experiment.steps.length;
    const values = phase === 'why' ? this.result?.values : this.seen.before ? step.shown?.(this.seen) : {};
    const ticks = experiment.steps.map((each, i) => {
      const done = guideProgress.of(experiment, each), name = say('guide.step', {number: i + 1, count});
      return make('li', {}, guideButton(done ? '✓' : String(i + 1), () => this.begin(experiment, i), {
                    'aria-label': done ? `${name}, ${say('guide.done')}` : name,
                    class: done ? 'tick done' : 'tick',
                    'data-key': `tick-${i}`,
                    ...(i === number ? {'aria-current': 'step'} : {})
                  }));
    });
    const waits = step.shown && !values;
    const parts = [
      make('div', {class: 'over'}, this.allButton(), make('ol', {class: 'ticks'}, ...ticks)),
      make(
          'h3', {}, say(`${experiment.name}.title`), make('small', {}, say('guide.step', {number: number + 1, count}))),
      make('p', {class: 'asked', tabindex: -1}, waits ? '…' : this.words('question', values)),
      step.guess ? this.numberGuess() : this.choiceGuess()
    ];
    if (phase === 'ask')
      parts.push(guideButton(say('guide.without'), () => this.take(null), {class: 'plain', 'data-key': 'without'}));
    if (phase === 'try')
      parts.push(make(
          'div', {class: 'task'}, make('h4', {}, say('guide.try')), make('p', {}, this.words('task', values)),
          guideButton(say('guide.do'), () => this.act(), {'data-key': 'do'}),
          make('p', {class: 'soft', role: 'status'}, say('guide.waiting'))));
    if (phase === 'why' && this.result) parts.push(this.reason(values));
    const onward = number + 1 < count ? null : this.following?.name ?? 'sandbox';
    const next = phase !== 'why' ? say('guide.skip') :
        onward                   ? say('guide.onward', {title: say(`${onward}.title`)}) :
                                   say('guide.next');
    parts.push(make(
        'div', {class: 'moves'},
        ...(number > 0 ? [guideButton(say('guide.back'), () => this.go(number - 1), {'data-key': 'back'})] : []),
        ...(phase === 'why' ?
                [guideButton(say('guide.again'), () => this.begin(experiment, number, true), {'data-key': 'again'})] :
                []),
        guideButton(
            next, () => this.go(number + 1), {'data-key': 'next', class: phase === 'why' ? 'next main' : 'next'})));
    return parts;
  }

  choiceGuess() {
    const {step, phase} = this;
    return make('fieldset', {class: 'guesses'}, make('legend', {}, say('guide.guess')), ...step.choices.map(choice => {
      const mark = phase !== 'why' ? '' : choice === step.right ? ' right' : choice === this.guess ? ' wrong' : '';
      const button = guideButton(
          this.words(choice), () => this.take(choice),
          {'data-key': choice, 'data-choice': choice, class: `guess${mark}`, 'aria-pressed': choice === this.guess});
      button.disabled = phase !== 'ask';
      return button;
    }));
  }

  numberGuess() {
    const {step, phase} = this, id = `guess-${this.experiment.name}-${step.name}`;
    const field = make('input', {id, type: 'number', step: 'any', min: 0, inputmode: 'decimal', 'data-key': 'number'});
    if (this.guess !== null) field.value = this.guess;
    field.disabled = phase !== 'ask';
    const form = make('form', {class: 'guesses number'}, make('label', {for: id
                      }, say('guide.guess')), field, make('span', {}, step.guess.unit));
    if (phase === 'ask') form.append(make('button', {type: 'submit', 'data-key': 'give'}, say('guide.give')));
    form.addEventListener('submit', event => {
      event.preventDefault();
      if (field.value !== '') this.take(Number(field.value));
    });
    return form;
  }

  /** What came of the guess, the reason, and the numbers of this run. */
  reason(values) {
    const {experiment, number, step, guess, result} = this, about = [];
    if (step.guess) {
      const {unit, within} = step.guess,
                   text = value => `${Number(value.toPrecision(3))}${unit === 'μ' ? '' : ` ${unit}`}`;
      const near = guess !== null && Math.abs(guess / result.read - 1) <= within;
      about.push(
          say(guess === null ? 'guide.reads' :
                  near       ? 'guide.near' :
                               'guide.far',
              {guess: guess === null ? '' : text(guess), answer: text(result.read)}));
    } else
      about.push(
          say(guess === null           ? 'guide.answer' :
                  guess === step.right ? 'guide.right' :
                                         'guide.wrong',
              {guess: guess === null ? '' : this.words(guess), answer: this.words(step.right)}));
    const box = make(
        'div', {class: 'why', role: 'status'}, make('p', {class: 'outcome'}, ...about),
        make('h4', {}, say('guide.why')), make('p', {}, this.words('why', values)),
        make('p', {class: 'numbers'}, this.words('formula', values)));
    if (number + 1 === experiment.steps.length)
      box.append(make('p', {class: 'keep'}, make('b', {}, say('guide.remember')), say(`${experiment.name}.remember`)));
    return box;
  }
}

/** The guide before a lab, made where there is none; side by side where the two have a box for themselves. */
function guideOf(lab) {
  const there = lab.previousElementSibling, box = lab.parentElement;
  if (there?.matches('lab-guide')) return there;
  const guide = make('lab-guide');
  if (box.matches('dialog') || box.childElementCount === 1) box.classList.add('guided');
  lab.before(guide);
  return guide;
}

/**
 * Opens an experiment beside a lab, the list of them for a name that there is none of. Without a lab: on the lab's own
 * page in the one that is there, else in one of the experiment's scene.
 */
export function openExperiment(name, lab) {
  const scene = labExperiments.find(each => each.name === name)?.scenes[0] ?? 'cloth-hang';
  lab ??= document.querySelector('live-lab[data-alone]') ?? document.querySelector(`live-lab[data-scene="${scene}"]`);
  lab ? guideOf(lab).show(name) : openLab({scene, experiment: name});
}

const followExperiment = () => experimentOfAddress() && openExperiment(experimentOfAddress());

/** Defines <lab-guide>. The page of the lab alone begins with the list of experiments. */
export function startGuide() {
  customElements.define('lab-guide', LabGuide);
  addEventListener('hashchange', followExperiment);
  for (const lab of document.querySelectorAll('live-lab[data-alone]')) guideOf(lab);
  followExperiment();
}
