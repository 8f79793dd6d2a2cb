// Sliders of the lab, with units: the scene's numbers, and each method's step with its predicted critical step.
// @ts-nocheck

import {check, make} from '../player/controls';
import {norm} from '../player/vectors';

import {numberAt, numbersOf, stepOf, tomlNumber} from './scene_text';
import {labLanguage, labWords, say} from './words';

/**
 * The numbers that have a slider: where they stand in the text, and how far it reaches, in parts of the scene's own
 * value.
 */
const knobTable = [
  {
    path: 'grid.stiffness',
    scales: ['structural', 'shear', 'bend'],
    word: 'stiffness',
    unit: 'N/m',
    from: 1 / 50,
    to: 50
  },
  {path: 'grid.stiffness.structural', word: 'structural', unit: 'N/m', from: 1 / 50, to: 50},
  {path: 'grid.stiffness.shear', word: 'shear', unit: 'N/m', from: 1 / 50, to: 50, zero: true},
  {path: 'grid.stiffness.bend', word: 'bend', unit: 'N/m', from: 1 / 50, to: 50, zero: true},
  {path: 'spring.stiffness', word: 'stiffness', unit: 'N/m', from: 1 / 50, to: 50},
  {path: 'grid.mass', word: 'mass', unit: 'kg', from: 1 / 10, to: 10},
  {path: 'grid.bending', word: 'bending', unit: 'N m', from: 1 / 50, to: 50, zero: true},
  {path: 'grid.dashpot', word: 'dashpot', unit: 'N s/m', from: 1 / 50, to: 50, zero: true},
  {path: 'drag.gamma', word: 'drag', unit: '1/s', from: 1 / 100, to: 10, zero: true},
  {path: 'drag.coefficient', word: 'drag', unit: 'N s/m', from: 1 / 100, to: 10, zero: true},
  {path: 'gravity.acceleration', word: 'gravity', unit: 'm/s²', to: 2, even: true},
  {path: 'wind.acceleration', word: 'wind', unit: 'm/s²', to: 4, even: true},
  {path: 'wind.gusts.variation', word: 'gusts', unit: 'm/s²', to: 4, even: true},
  {path: 'aerodynamics.velocity', word: 'airSpeed', unit: 'm/s', to: 4, even: true},
  {path: 'aerodynamics.gusts.variation', word: 'gusts', unit: 'm/s', to: 4, even: true},
  {path: 'sphere.radius', word: 'ballRadius', unit: 'm', from: 0.3, to: 1.1, even: true},
  {path: 'sphere.friction', word: 'friction', unit: '', to: 2, even: true},
  {path: 'sphere.restitution', word: 'restitution', unit: '', most: 1, even: true},
  {path: 'pins.motion.frequency', word: 'frequency', unit: 'Hz', from: 1 / 10, to: 10},
  {path: 'rotation.rate', word: 'rate', unit: 'rad/s', to: 4, even: true},
];

const knobSteps = 1000;  // positions of a slider
export const sizeOf = value => (Array.isArray(value) ? norm(value) : value);
const rounded = (value, digits = 3) => Number(value.toPrecision(digits));
let knobCount = 0;

/** A slider and a field for one number; `changed(value, done)` is called as it moves, and when it stands. */
class Slider {
  constructor({label, unit, name, changed}) {
    const id = `lab-number-${++knobCount}`;
    Object.assign(this, {unit, changed});
    this.field = make('input', {type: 'number', id, step: 'any', inputmode: 'decimal'});
    this.range = make('input', {type: 'range', min: 0, max: knobSteps, step: 1, 'aria-label': label});
    this.rail = make('div', {class: 'rail'}, this.range);
    this.box =
        make('div', {class: 'knob', 'data-knob': name}, make('label', {for: id
             }, label), make('span', {class: 'field'}, this.field, make('span', {class: 'unit'}, unit)), this.rail);
    this.range.addEventListener('input', () => this.take(this.valueAt(Number(this.range.value)), false));
    this.range.addEventListener('change', () => this.changed(this.value, true));
    this.field.addEventListener('change', () => {
      const value = Number(this.field.value);
      if (this.field.value === '' || !Number.isFinite(value) || value < 0 || (value === 0 && !this.zero && !this.even))
        return this.show(this.value);
      this.take(value, true);
    });
  }

  /** `snap` makes of a value one that can be taken. */
  reach({low, high, even, zero, snap}) {
    Object.assign(this, {low, high, even, zero, snap: snap ?? (v => rounded(v))});
  }

  valueAt(place) {
    if (this.zero && place === 0) return 0;
    const part = place / knobSteps, {low, high} = this;
    return this.snap(this.even ? low + part * (high - low) : low * (high / low) ** part);
  }

  /** Part of the way along the slider at which a value stands. */
  partOf(value) {
    const {low, high} = this;
    return Math.min(
        1,
        Math.max(
            0,
            this.even     ? (value - low) / (high - low) :
                value > 0 ? Math.log(value / low) / Math.log(high / low) :
                            0));
  }

  take(value, done) {
    this.show(value);
    this.changed(value, done);
  }

  show(value) {
    this.value = value;
    this.field.value = Number(value.toPrecision(4));
    const place = Math.round(knobSteps * this.partOf(value));
    this.range.value = this.zero && value > 0 ? Math.max(1, place) : place;
    this.range.setAttribute(
        'aria-valuetext',
        value === 0 && this.zero && !this.even ? say('leftOut') : `${Number(value.toPrecision(4))} ${this.unit}`);
    this.box.classList.toggle('out', value === 0 && Boolean(this.zero));
  }
}

/** The sliders of a scene's own numbers. `changed({path: value}, done)`. */
export class SceneKnobs {
  constructor(changed) {
    this.changed = changed;
    this.box = make('div', {class: 'knobs'});
  }

  /** Makes the sliders that the text has; `original` says how far they reach. */
  build(toml, original) {
    this.original = original;
    this.knobs = knobTable.filter(row => this.has(row, original)).map(row => {
      const own = sizeOf(numberAt(original, this.pathOf(row)));
      const slider = new Slider({
        label: say(row.word),
        unit: row.unit,
        name: row.path,
        changed: (value, done) => this.changed(this.changesOf(row, value), done)
      });
      slider.reach({
        low: row.from ? row.from * own : 0,
        high: row.most ?? Math.max(row.to * own, row.unit === '' ? 1 : 0),
        even: row.even,
        zero: row.zero || (row.even && !row.from)
      });
      return {row, slider};
    });
    this.box.replaceChildren(...this.knobs.map(k => k.slider.box));
    this.show(toml);
  }

  pathOf({path, scales}) { return scales ? `${path}.${scales[0]}` : path; }

  /** Whether the text has the number, once or everywhere the same, and not zero. */
  has(row, toml) {
    if (row.scales && row.scales.filter(k => numberAt(toml, `${row.path}.${k}`)).length < 2) return false;
    const all = numbersOf(toml).filter(e => e.path === this.pathOf(row));
    return all.length > 0 && sizeOf(all[0].value) > 0 &&
        all.every(e => tomlNumber(e.value) === tomlNumber(all[0].value));
  }

  /** What a slider's value changes in the text. */
  changesOf({path, scales}, value) {
    if (scales) {
      const was = numberAt(this.toml, `${path}.${scales[0]}`);
      return Object.fromEntries(scales.map(k => `${path}.${k}`)
                                    .filter(p => numberAt(this.toml, p))
                                    .map(p => [p, rounded(numberAt(this.toml, p) * value / was, 6)]));
    }
    const own = numberAt(this.original, path);
    return {[path]: Array.isArray(own) ? own.map(v => rounded(v * value / norm(own), 9)) : value};
  }

  show(toml) {
    this.toml = toml;
    for (const {row, slider} of this.knobs) slider.show(sizeOf(numberAt(toml, this.pathOf(row)) ?? 0));
  }
}

/** A time, s, in the unit that suits it. */
export const timeText = s => {
  const [name, size] = s < 1e-3 ? ['µs', 1e-6] : s < 1 ? ['ms', 1e-3] : ['s', 1];
  return `${Number((s / size).toPrecision(3))} ${name}`;
};

/** One method: its stepper, its step or tolerance, the predicted critical step. `changed(spec, done)`. */
export class MethodKnobs {
  constructor(letter, changed, removed) {
    Object.assign(this, {letter, changed});
    this.select = make('select', {'aria-label': say('stepperOf', {letter}), 'data-stepper': letter});
    this.remove = make('button', {type: 'button', class: 'remove', 'aria-label': say('removeSecond', {letter})}, '✕');
    [this.stickyLabel, this.sticky] = check(say('sticky'), false);
    [this.linearLabel, this.linear] = check(say('linear'), false);
    this.step = new Slider({
      label: say('stepOf', {letter}),
      unit: 'ms',
      name: `step-${letter}`,
      changed: (value, done) => this.take({step: value / 1000}, done)
    });
    this.tolerance = new Slider({
      label: say('toleranceOf', {letter}),
      unit: '',
      name: `tolerance-${letter}`,
      changed: (value, done) => this.take({tolerance: value}, done)
    });
    this.tolerance.reach({low: 1e-10, high: 1e-2, snap: v => rounded(v, 1)});
    this.tick = make('i', {class: 'tick', 'aria-hidden': 'true'});
    this.mark = make('span', {class: 'mark-words'});
    this.step.rail.append(this.tick);
    this.step.box.append(this.mark);
    this.note = make('p', {class: 'note', role: 'status'});
    this.box = make(
        'div', {class: 'method', 'data-letter': letter},
        make('div', {class: 'who'}, make('b', {}, letter), this.select, ...(letter === 'B' ? [this.remove] : [])),
        make('div', {class: 'options'}, this.stickyLabel, this.linearLabel), this.step.box, this.tolerance.box,
        this.note);
    for (const each of [this.select, this.sticky, this.linear])
      each.addEventListener('change', () => this.take({}, true));
    this.remove.addEventListener('click', removed);
  }

  /** The method as the controls say it, with a step or tolerance that was moved. */
  take(moved, done) {
    const stepper = this.steppers.find(s => s.name === this.select.value);
    const events = this.spec.method === `${stepper.name}+events` ? '+events' : '';
    const options = (this.linear.checked && stepper.linear ? '+linear' : '') +
        (this.sticky.checked && this.balls ? '+sticky' : events);
    const {step, tolerance} = {...this.spec, ...moved};
    const spec = {method: stepper.name + options, step: step || this.own};
    this.changed(stepper.adaptive ? {method: spec.method, tolerance: tolerance || 1e-6} : spec, done);
  }

  /** Shows a method beside its run; `scale`: critical step, s, by which the slider's range goes. */
  show(spec, run, steppers, scale) {
    const {scene} = run.sim, [name, ...options] = spec.method.split('+'), stepper = steppers.find(s => s.name === name);
    const interval = scene.duration / scene.samples, limit = run.limit, known = Number.isFinite(limit) && limit > 0;
    const bound = known && limit <= interval;  // no step is longer than the time between two samples
    Object.assign(this, {spec, steppers, own: scene.step, balls: scene.spheres.length});
    const usable = steppers.filter(s => !scene.firstOrder || s.firstOrder);
    if (this.select.childElementCount !== usable.length)
      this.select.replaceChildren(...usable.map(s => make('option', {value: s.name}, chosenAs(s.name))));
    this.select.value = name;
    this.sticky.checked = options.includes('sticky'), this.linear.checked = options.includes('linear');
    this.stickyLabel.hidden = !this.balls, this.linearLabel.hidden = !stepper?.linear;
    this.step.box.hidden = Boolean(stepper?.adaptive), this.tolerance.box.hidden = !stepper?.adaptive;
    const taken = !run.refusal && !stepper?.adaptive && run.sim.h && Math.abs(run.sim.h / spec.step - 1) > 0.012 ?
        say('taken', {h: timeText(run.sim.h)}) :
        '';
    this.note.textContent =
        run.refusal ? say('refused', {method: nameOfMethod(spec.method), reason: run.refusal}) : taken;
    this.note.classList.toggle('failed', Boolean(run.refusal));
    if (stepper?.adaptive) return void this.tolerance.show(spec.tolerance);
    const base = Number.isFinite(scale) && scale > 0 ? scale : 4 * scene.step;
    const high = limit === Infinity ? interval : Math.min(interval, Math.max(2.5 * base, bound ? 2.2 * limit : 0)),
          low = Math.min(base / 40, bound ? limit / 4 : Infinity, high / 10);
    this.step.reach({
      low: 1000 * Math.min(low, spec.step),
      high: 1000 * Math.max(high, spec.step),
      snap: ms => 1000 * stepOf(interval, Math.max(1, Math.round(interval / (ms / 1000))))
    });
    this.step.show(1000 * spec.step);
    const part = bound ? this.step.partOf(1000 * limit) : limit === 0 ? 0 : 1;
    this.box.style.setProperty('--at', part);
    this.tick.hidden = !bound;
    this.box.classList.toggle('bound', bound || limit === 0);
    this.box.classList.toggle('past', (bound && !run.refusal && run.sim.h > limit) || limit === 0);
    this.mark.classList.toggle('placed', bound);
    this.mark.textContent = known ?
        say(bound ? 'limitMark' : 'limitBeyond', {h: timeText(limit), interval: timeText(interval)}) :
        say(limit === 0            ? 'limitNone' :
                limit === Infinity ? 'limitAll' :
                                     'limitUnknown');
  }
}

/** A method's name in words: "symplectic Euler, sticky". A stepper without words goes by its name. */
export function nameOfMethod(method) {
  const [name, ...options] = method.split('+'), known = (key, otherwise) => (key in labWords ? say(key) : otherwise);
  return [
    known(`method.${name}`, name.replace(/-/g, ' ').replace('euler', 'Euler')),
    ...options.map(option => known(`option.${option}`, option))
  ].join(say('comma'));
}

/**
 * A stepper in the list to choose from: in words, and, where these are not English, with the name for the command
 * line.
 */
const chosenAs = name => {
  const words = nameOfMethod(name);
  return labLanguage === 'en' || words === name ? words : [words, name].join(say('comma'));
};
