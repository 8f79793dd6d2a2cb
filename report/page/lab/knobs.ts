// Sliders for the scene's numbers, and for each method's step with its predicted critical step.

import {check, make} from '../player/controls';

import {solidsOf, Stepper} from './engine';
import {LiveRun} from './live_run';
import {Changes, MethodSpec, numberAt, numbersOf, stepOf, tomlNumber, Value, valueAt} from './scene_text';
import {labLanguage, labWords, say} from './words';

/** A slider. Its range is relative to the scene's own value. */
interface KnobRow {
  path: string;
  scales?: string[];  // subpaths whose numbers are scaled together
  word: string;
  unit: string;
  from?: number;
  to?: number;
  most?: number;  // in the number's unit
  zero?: boolean;
  even?: boolean;  // linear scale, which starts at 0 if there is no `from`
}

const shownKnobs = 4;  // others are folded

/** The most instructive sliders are first. */
const knobTable: KnobRow[] = [
  {
    path: 'grid.stiffness',
    scales: ['structural', 'shear', 'bend'],
    word: 'stiffness',
    unit: 'N/m',
    from: 1 / 50,
    to: 50
  },
  {path: 'spring.stiffness', word: 'stiffness', unit: 'N/m', from: 1 / 50, to: 50},
  {path: 'rotation.rate', word: 'rate', unit: 'rad/s', to: 4, even: true},
  {path: 'sphere.friction', word: 'friction', unit: '', to: 2, even: true},
  {path: 'plane.friction', word: 'friction', unit: '', to: 2, even: true},
  {path: 'grid.mass', word: 'mass', unit: 'kg', from: 1 / 10, to: 10},
  {path: 'grid.stiffness.bend', word: 'bend', unit: 'N/m', from: 1 / 50, to: 50, zero: true},
  {path: 'drag.gamma', word: 'drag', unit: '1/s', from: 1 / 100, to: 10, zero: true},
  {path: 'drag.coefficient', word: 'drag', unit: 'N s/m', from: 1 / 100, to: 10, zero: true},
  {path: 'grid.bending', word: 'bending', unit: 'N m', from: 1 / 50, to: 50, zero: true},
  {path: 'wind.acceleration', word: 'wind', unit: 'm/s²', to: 4, even: true},
  {path: 'aerodynamics.velocity', word: 'airSpeed', unit: 'm/s', to: 4, even: true},
  {path: 'grid.dashpot', word: 'dashpot', unit: 'N s/m', from: 1 / 50, to: 50, zero: true},
  {path: 'gravity.acceleration', word: 'gravity', unit: 'm/s²', to: 2, even: true},
  {path: 'sphere.radius', word: 'ballRadius', unit: 'm', from: 0.3, to: 1.1, even: true},
  {path: 'sphere.restitution', word: 'restitution', unit: '', most: 1, even: true},
  {path: 'plane.restitution', word: 'restitution', unit: '', most: 1, even: true},
  {path: 'grid.stiffness.structural', word: 'structural', unit: 'N/m', from: 1 / 50, to: 50},
  {path: 'grid.stiffness.shear', word: 'shear', unit: 'N/m', from: 1 / 50, to: 50, zero: true},
  {path: 'wind.gusts.variation', word: 'gusts', unit: 'm/s²', to: 4, even: true},
  {path: 'aerodynamics.gusts.variation', word: 'gusts', unit: 'm/s', to: 4, even: true},
  {path: 'pins.motion.frequency', word: 'frequency', unit: 'Hz', from: 1 / 10, to: 10},
];

const knobSteps = 1000;
const rounded = (value: number, digits = 3) => Number(value.toPrecision(digits));
let knobCount = 0;

type Changed = (value: number, done: boolean) => void;

/** Range of a slider; `snap` maps a value to the nearest possible value. */
interface Reach {
  low: number;
  high: number;
  even?: boolean;
  zero?: boolean;
  snap?: (value: number) => number;
}

/** A slider and a field. Calls `changed(value, done)` while it moves and when it stops. */
class Slider {
  readonly box: HTMLElement;
  readonly rail: HTMLElement;
  private readonly field: HTMLInputElement;
  private readonly range: HTMLInputElement;
  private value = 0;
  private reached: Reach = {low: 0, high: 1};

  constructor(
      label: string, private readonly unit: string, name: string, private readonly changed: Changed, spoken = label) {
    const id = `lab-number-${++knobCount}`;
    const field: HTMLInputElement = make('input', {type: 'number', id, step: 'any', inputmode: 'decimal'});
    const range: HTMLInputElement =
        make('input', {type: 'range', min: 0, max: knobSteps, step: 1, 'aria-label': spoken});
    this.field = field, this.range = range;
    this.rail = make('div', {class: 'rail'}, range);
    this.box = make('div', {class: 'knob', 'data-knob': name}, make('label', {for: id
                    }, label), make('span', {class: 'field'}, field, make('span', {class: 'unit'}, unit)), this.rail);
    range.addEventListener('input', () => this.take(this.valueAt(Number(range.value)), false));
    range.addEventListener('change', () => this.changed(this.value, true));
    field.addEventListener('change', () => {
      const value = Number(field.value), {zero, even} = this.reached;
      if (field.value === '' || !Number.isFinite(value) || value < 0 || (value === 0 && !zero && !even))
        return this.show(this.value);
      this.take(value, true);
    });
  }

  reach(reached: Reach) { this.reached = reached; }

  private valueAt(place: number) {
    const part = place / knobSteps, {low, high, even, zero, snap = rounded} = this.reached;
    if (zero && place === 0) return 0;
    return snap(even ? low + part * (high - low) : low * (high / low) ** part);
  }

  /** Position along the slider, 0 to 1. */
  partOf(value: number) {
    const {low, high, even} = this.reached;
    const part = even ? (value - low) / (high - low) : value > 0 ? Math.log(value / low) / Math.log(high / low) : 0;
    return Math.min(1, Math.max(0, part));
  }

  private take(value: number, done: boolean) {
    this.show(value);
    this.changed(value, done);
  }

  show(value: number) {
    this.value = value;
    const {zero, even} = this.reached, place = Math.round(knobSteps * this.partOf(value)), words = rounded(value, 4);
    this.field.value = String(words);
    this.range.value = String(zero && value > 0 ? Math.max(1, place) : place);
    this.range.setAttribute('aria-valuetext', value === 0 && zero && !even ? say('leftOut') : `${words} ${this.unit}`);
    this.box.classList.toggle('out', value === 0 && Boolean(zero));
  }
}

/** Sliders for a scene's own numbers. */
export class SceneKnobs {
  readonly box: HTMLElement = make('div', {class: 'knobs'});
  private knobs: {row: KnobRow, slider: Slider}[] = [];
  private original = '';
  private toml = '';

  constructor(private readonly changed: (changes: Changes, done: boolean) => void) {}

  /** Makes the sliders; `original` determines their ranges. */
  build(toml: string, original: string) {
    const unfolded = this.box.querySelector('details')?.open;
    this.original = original;
    this.knobs = knobTable.filter(row => this.has(row, original)).map(row => {
      const own = numberAt(original, this.pathOf(row)), {from, to = 1, most, even} = row;
      const slider = new Slider(
          say(row.word), row.unit, row.path, (value, done) => this.changed(this.changesOf(row, value), done));
      slider.reach({
        low: from ? from * own : 0,
        high: most ?? Math.max(to * own, row.unit === '' ? 1 : 0),
        even,
        zero: row.zero || (even && !from)
      });
      return {row, slider};
    });
    const boxes = this.knobs.map(k => k.slider.box), more = boxes.splice(shownKnobs);
    const fold = make('details', {}, make('summary', {}, say('more')), ...more);
    fold.open = Boolean(unfolded);
    this.box.replaceChildren(...boxes, ...(more.length ? [fold] : []));
    this.show(toml);
  }

  private pathOf({path, scales}: KnobRow) { return scales ? `${path}.${scales[0]}` : path; }

  /** True if the text has the number, with the same nonzero value wherever it occurs. */
  private has(row: KnobRow, toml: string) {
    if (row.scales && row.scales.filter(k => numberAt(toml, `${row.path}.${k}`)).length < 2) return false;
    const path = this.pathOf(row), all = numbersOf(toml).filter(e => e.path === path).map(e => tomlNumber(e.value));
    return numberAt(toml, path) > 0 && all.every(value => value === all[0]);
  }

  private changesOf(row: KnobRow, value: number): Changes {
    const {path, scales} = row;
    if (scales) {
      const was = numberAt(this.toml, this.pathOf(row)), paths = scales.map(k => `${path}.${k}`);
      return Object.fromEntries(
          paths.filter(p => numberAt(this.toml, p)).map(p => [p, rounded(numberAt(this.toml, p) * value / was, 6)]));
    }
    const own: Value = valueAt(this.original, path) ?? 0, size = numberAt(this.original, path);
    return {[path]: Array.isArray(own) ? own.map(v => rounded(v * value / size, 9)) : value};
  }

  show(toml: string) {
    this.toml = toml;
    for (const {row, slider} of this.knobs) slider.show(numberAt(toml, this.pathOf(row)));
  }
}

export const msText = (s: number) => `${Number((1000 * s).toPrecision(3))} ms`;

export class MethodKnobs {
  readonly box: HTMLElement;
  private readonly select: HTMLSelectElement;
  private readonly sticky: HTMLInputElement;
  private readonly stickyLabel: HTMLElement;
  private readonly step: Slider;
  private readonly tolerance: Slider;
  private readonly tick: HTMLElement = make('i', {class: 'tick', 'aria-hidden': 'true'});
  private readonly mark: HTMLElement = make('span', {class: 'mark-words'});
  private readonly note: HTMLElement = make('p', {class: 'note', role: 'status'});
  private steppers: Stepper[] = [];
  private spec: MethodSpec = {method: ''};
  private own = 0;  // step of the scene, s
  private solids = 0;

  constructor(
      letter: string, private readonly changed: (spec: MethodSpec, done: boolean) => void, removed: () => void) {
    this.select = make('select', {'aria-label': say('stepperOf', {letter}), 'data-stepper': letter});
    const remove: HTMLElement =
        make('button', {type: 'button', class: 'remove', 'aria-label': say('removeSecond', {letter})}, '✕');
    [this.stickyLabel, this.sticky] = check(say('sticky'), false);
    const take = (key: 'step'|'tolerance', size: number) => (value: number, done: boolean) =>
        this.take({[key]: value * size}, done);
    this.step = new Slider(say('timeStep'), 'ms', `step-${letter}`, take('step', 1e-3), say('stepOf', {letter}));
    this.tolerance =
        new Slider(say('tolerance'), '', `tolerance-${letter}`, take('tolerance', 1), say('toleranceOf', {letter}));
    this.tolerance.reach({low: 1e-10, high: 1e-2, snap: v => rounded(v, 1)});
    this.step.rail.append(this.tick);
    this.step.box.append(this.mark);
    this.box = make(
        'div', {class: 'method', 'data-letter': letter},
        make('div', {class: 'who'}, make('b', {}, letter), this.select, ...(letter === 'B' ? [remove] : [])),
        make('div', {class: 'options'}, this.stickyLabel), this.step.box, this.tolerance.box, this.note);
    for (const each of [this.select, this.sticky]) each.addEventListener('change', () => this.take({}, true));
    remove.addEventListener('click', removed);
  }

  /** Reads the controls; `moved` is a new step or tolerance. */
  private take(moved: Partial<MethodSpec>, done: boolean) {
    const stepper = this.steppers.find(s => s.name === this.select.value);
    if (!stepper) return;
    // keep other options (+events, +linear) only with the stepper to which they belong
    const [name, ...options] = this.spec.method.split('+');
    const kept = this.sticky.checked && this.solids ? ['sticky'] :
        name === stepper.name                       ? options.filter(option => option !== 'sticky') :
                                                      [];
    const {step, tolerance} = {...this.spec, ...moved}, method = [stepper.name, ...kept].join('+');
    this.changed(stepper.adaptive ? {method, tolerance: tolerance || 1e-6} : {method, step: step || this.own}, done);
  }

  /** Shows a method and its run; `scale`: critical step (s), which determines the slider's range. */
  show(spec: MethodSpec, run: LiveRun, steppers: Stepper[], scale: number|null) {
    const {scene} = run.sim, [name, ...options] = spec.method.split('+'), {limit} = run;
    const h = run.refusal ? 0 : run.sim.h;
    const stepper = steppers.find(s => s.name === name), interval = scene.duration / scene.samples;
    const known = limit !== null && Number.isFinite(limit) && limit > 0;
    const bound = known && limit <= interval;  // steps never exceed the sampling interval
    Object.assign(this, {spec, steppers, own: scene.step, solids: solidsOf(scene)});
    const usable = steppers.filter(s => !scene.firstOrder || s.firstOrder);
    if (this.select.childElementCount !== usable.length)
      this.select.replaceChildren(...usable.map(s => make('option', {value: s.name}, chosenAs(s.name))));
    this.select.value = name;
    this.sticky.checked = options.includes('sticky');
    this.stickyLabel.hidden = !this.solids;
    this.step.box.hidden = Boolean(stepper?.adaptive), this.tolerance.box.hidden = !stepper?.adaptive;
    const step = spec.step ?? 0, shortened = !stepper?.adaptive && h && msText(h) !== msText(step);
    this.note.textContent = run.refusal ? say('refused', {method: nameOfMethod(spec.method), reason: run.refusal}) :
        shortened ? say('taken', {h: msText(h), n: Math.round(interval / h), interval: msText(interval)}) :
                    '';
    this.note.classList.toggle('failed', Boolean(run.refusal));
    if (stepper?.adaptive) return this.tolerance.show(spec.tolerance ?? 1e-6);
    const base = scale !== null && Number.isFinite(scale) && scale > 0 ? scale : 4 * scene.step;
    const high = limit === Infinity ? interval : Math.min(interval, Math.max(2.5 * base, bound ? 2.2 * limit : 0));
    const low = Math.min(base / 40, bound ? limit / 4 : Infinity, high / 10);
    this.step.reach({
      low: 1000 * Math.min(low, step),
      high: 1000 * Math.max(high, step),
      snap: ms => 1000 * stepOf(interval, Math.max(1, Math.round(interval / (ms / 1000))))
    });
    this.step.show(1000 * step);
    this.box.style.setProperty('--at', String(bound ? this.step.partOf(1000 * limit) : limit === 0 ? 0 : 1));
    this.tick.hidden = !bound;
    this.box.classList.toggle('bound', bound || limit === 0);
    this.box.classList.toggle('past', (bound && h > limit) || limit === 0);
    this.mark.classList.toggle('placed', bound);
    this.mark.textContent = known ?
        say(bound ? 'limitMark' : 'limitBeyond', {h: msText(limit), interval: msText(interval)}) :
        say(limit === 0            ? 'limitNone' :
                limit === Infinity ? 'limitAll' :
                                     'limitUnknown');
  }
}

/** "symplectic Euler, sticky"; untranslated steppers keep their name. */
export function nameOfMethod(method: string) {
  const [name, ...options] = method.split('+');
  const known = (key: string, otherwise: string) => (key in labWords.en ? say(key) : otherwise);
  return [
    known(`method.${name}`, name.replace(/-/g, ' ').replace('euler', 'Euler')),
    ...options.map(option => known(`option.${option}`, option))
  ].join(say('comma'));
}

/** Text of a stepper in the selection; in languages other than English, its command-line name follows. */
const chosenAs = (name: string) => {
  const words = nameOfMethod(name);
  return labLanguage === 'en' || words === name ? words : [words, name].join(say('comma'));
};
