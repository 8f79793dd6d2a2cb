// The controls below the pictures: play, slider, choices, the list of methods and the plot.
// @ts-nocheck

import {lookOf, looksOfPage} from './colours';
import {failureOf, keysOf, parts, runOf} from './motion';
import {Plot} from './plot';

export const make = (name, attributes = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};

export const dropdown = (label, options, chosen) => {
  const select = make(
      'select', {'aria-label': label},
      ...options.map(([value, text]) => make('option', value === chosen ? {value, selected: ''} : {value}, text)));
  return [make('label', {}, `${label} `, select), select];
};

export const check = (label, on) => {
  const box = make('input', {type: 'checkbox'});
  box.checked = on;
  return [make('label', {}, box, ` ${label}`), box];
};

/** Seconds with as many digits as a frame needs. */
const seconds = (time, end) => time.toFixed(end < 3 ? 3 : 2);

/** A value with three digits. */
export const short = value => {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-3 ? size.toExponential(1).replace('e+', 'e') :
      size >= 100                         ? size.toFixed(0) :
                                            size.toPrecision(3);
  return (value < 0 ? '−' : '') + text;
};

/** The unit that suits a length: its name and its size, m. */
export const unitOf =
    metres => [['m', 1], ['mm', 1e-3], ['µm', 1e-6], ['nm', 1e-9]].find(([, size]) => metres >= size) ?? ['m', 1];
/** A length in it. */
export const length = metres => {
  const [name, size] = metres > 0 ? unitOf(metres) : ['mm', 1e-3], value = metres / size;
  return `${value === 0 ? 0 : value < 1e-3 ? short(value) : Number(value.toPrecision(2))} ${name}`;
};

/** Smallest 1, 2 or 5 times a power of ten that is not below a value. */
export function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return Number(([1, 2, 5, 10].find(s => s * power >= value * (1 - 1e-9)) * power).toPrecision(1));
}

/** A method as engine and rule; a program goes by its own name. */
export const inTwo = method => {
  const {engine, rule} = looksOfPage[method] ?? {};
  if (engine) return [engine, rule];
  const [first, second = ''] = method.split('/');
  return [first, second.replace(/-/g, ' ')];
};

/** What was asked of a run: "980 µs", "tolerance 1e-6". */
export const settingOf = ({step, tolerance}) => {
  if (tolerance) return `tolerance ${short(tolerance)}`;
  const [unit, size] = step < 1e-3 ? ['µs', 1e-6] : step < 1 ? ['ms', 1e-3] : ['s', 1];
  return step ? `${Number((step / size).toPrecision(3))} ${unit}` : '';
};

const pointerHelp =
    'Drag to turn. With the picture in focus (click it, or Tab) the wheel zooms, arrow keys turn, + and − ' +
    'zoom, 0 resets.';

/** Two selects, method and step, among the runs of a scene; `chosen` is called with the key of a run. */
class Picker {
  constructor(letter, scene, keys, chosen) {
    Object.assign(this, {letter, scene, keys});
    const engines = new Map();
    for (const method of keys.keys()) {
      const [engine] = inTwo(method);
      engines.set(engine, [
        ...(engines.get(engine) ?? []),
        make('option', {value: method}, method === 'truth' ? 'truth' : inTwo(method).join(' '))
      ]);
    }
    this.method = make(
        'select', {'aria-label': `${letter}: method`},
        ...[...engines].map(([engine, options]) => make('optgroup', {label: engine}, ...options)));
    this.step = make('select', {'aria-label': `${letter}: step`});
    this.box = make('div', {class: `pick ${letter.toLowerCase()}`}, make('b', {}, letter), this.method, this.step);
    this.method.addEventListener('change', () => chosen(this.keys.get(this.method.value)[0]));
    this.step.addEventListener('change', () => chosen(this.step.value));
  }

  show(key) {
    const method = key === 'truth' ? key : parts(key).method;
    this.method.value = method;
    this.step.hidden = method === 'truth';
    this.step.replaceChildren(...(this.keys.get(method) ?? []).map(each => {
      const {run} = runOf(this.scene, each), own = parts(each).place === 'own', failure = failureOf(run, short);
      return make(
          'option', each === key ? {value: each, selected: ''} : {value: each},
          `${settingOf(run)}${own ? ' (own)' : ''}${failure ? `: ${failure}` : ''}`);
    }));
    this.box.style.setProperty('--own', lookOf(method).css);
    this.box.dataset.method = method;
  }
}

/** The controls of a player. `act` has the functions that they call: toggle, seek (s), speed, look, reset, pick. */
export class Controls {
  constructor(player, scene, look, act) {
    Object.assign(this, {scene, player});
    this.play = make('button', {type: 'button', class: 'play'});
    this.slider =
        make('input', {type: 'range', min: 0, max: 300, step: 1, value: 0, 'aria-label': `time in ${scene.scene}`});
    this.clock = make('span', {class: 'clock'});
    const [speedLabel, speed] = dropdown('speed', [0.1, 0.25, 0.5, 1, 2].map(v => [String(v), `${v} ×`]), '1');
    const colours = [['plain', 'engine'], ['stretch', 'stretch'], ['distance', 'distance to the truth']].filter(
        ([name]) => name === 'plain' || (name === 'stretch' ? scene.springs.rests.count : runOf(scene, 'truth')));
    const [colourLabel, colour] = dropdown('colour by', colours, look.colour);
    const [springLabel, springs] = check('springs', look.springs);
    const reset = make('button', {type: 'button', 'aria-label': `Reset view of ${scene.scene}`}, 'reset view');
    this.bar = make('span', {class: 'bar'});
    this.plots = make('div', {class: 'plots'});
    this.hint = make('p', {class: 'hint'});
    this.pickers = act.pick ?
        ['A', 'B'].map(letter => new Picker(letter, scene, keysOf(scene), key => act.pick(letter.toLowerCase(), key))) :
        [];
    this.scale = make('div', {class: 'pick apart'});
    if (act.pick)
      player.parentElement.prepend(make('div', {class: 'picks'}, ...this.pickers.map(p => p.box), this.scale));
    player.replaceChildren(
        make('div', {class: 'time'}, this.play, this.slider, this.clock),
        make(
            'div', {class: 'looks'}, speedLabel, ...(colours.length > 1 ? [colourLabel] : []), this.bar,
            ...(scene.springs.families.length ? [springLabel] : []), reset),
        this.plots, this.hint);
    this.play.addEventListener('click', act.toggle);
    this.slider.addEventListener(
        'input', () => act.seek(this.begin + this.slider.value / 300 * (this.end - this.begin)));
    Object.assign(this, {colour, springs, seek: act.seek, curves: []});
    this.addPlots(act.pick ? 3 : 0);  // their room is there before they are
    speed.addEventListener('change', () => act.speed(Number(speed.value)));
    colour.addEventListener('change', () => act.look({colour: colour.value}));
    springs.addEventListener('change', () => act.look({springs: springs.checked}));
    reset.addEventListener('click', act.reset);
  }

  setPlaying(playing) {
    this.play.textContent = playing ? '❚❚' : '▶';
    this.play.setAttribute('aria-label', `${playing ? 'Pause' : 'Play'} ${this.scene.scene}`);
  }

  /** `top`: the largest difference, m, 0 below the resolution `least` (m); null where it is not known. */
  setPicks(picks, top, least) {
    this.pickers.forEach((picker, i) => picker.show(picks[i]));
    this.scale.replaceChildren(
        make('b', {}, 'A − B'),
        ...(top > 0       ? ['0', make('i', {class: 'ramp'}), length(top)] :
                top === 0 ? [`below ${length(least)}`] :
                            []));
  }

  /** `scale`: {top, unit} of what colours mean, or null. */
  setLook(look, scale) {
    this.colour.value = look.colour, this.springs.checked = look.springs;
    this.bar.replaceChildren(...(scale ? ['0', make('i', {class: 'scale'}), scale] : []));
  }

  addPlots(count) {
    while (this.curves.length < count) {
      const box = make('div', {class: 'plot'});
      this.plots.append(box);
      this.curves.push(new Plot(box, time => this.seek(time)));
    }
  }

  /** What is drawn over time: a list as Plot takes it. */
  setPlots(list, begin, end) {
    Object.assign(this, {begin, end});
    list.forEach((each, i) => this.curves[i].show({...each, begin, end}));
  }

  setTime(time) {
    const {begin = 0, end = 1} = this, text = `${seconds(time, end - begin)} s`;
    this.slider.value = 300 * (time - begin) / (end - begin || 1);
    this.slider.setAttribute('aria-valuetext', text);
    this.clock.textContent = `${seconds(time, end - begin)} / ${seconds(end, end - begin)} s`;
    for (const curve of this.curves) curve.moveHead(time);
  }

  setHint(words) { this.hint.textContent = [words, pointerHelp].filter(Boolean).join(' '); }
}
