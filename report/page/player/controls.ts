// Controls below the pictures: play, slider, choices, methods and plot.

import {lookOf, looksOfPage} from './colours';
import {failureOf, keysOf, parts, Run, runOf, SceneStage} from './motion';
import {Plot, Shown} from './plot';

export const make = <Name extends keyof HTMLElementTagNameMap>(
    name: Name, attributes: Record<string, string|number> = {}, ...children: (Node|string)[]) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
};

export const dropdown = (label: string, options: string[][], chosen?: string) => {
  const select = make(
      'select', {'aria-label': label},
      ...options.map(([value, text]) => make('option', value === chosen ? {value, selected: ''} : {value}, text)));
  return [make('label', {}, `${label} `, select), select] as const;
};

export const check = (label: string, on: boolean) => {
  const box = make('input', {type: 'checkbox'});
  box.checked = on;
  return [make('label', {}, box, ` ${label}`), box] as const;
};

/** Seconds, with the digits that distinguish frames. */
const seconds = (time: number, end: number) => time.toFixed(end < 3 ? 3 : 2);

/** A number with three digits. */
export const short = (value: number): string => {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-3 ? size.toExponential(1).replace('e+', 'e') :
      size >= 100                         ? size.toFixed(0) :
                                            size.toPrecision(3);
  return (value < 0 ? '−' : '') + text;
};

/** Name and size (m) of a suitable unit for a length. */
export const unitOf = (metres: number): [string, number] => {
  const units: [string, number][] = [['m', 1], ['mm', 1e-3], ['µm', 1e-6], ['nm', 1e-9]];
  return units.find(([, size]) => metres >= size) ?? units[0];
};
export const length = (metres: number) => {
  const [name, size] = metres > 0 ? unitOf(metres) : ['mm', 1e-3] as const, value = metres / size;
  return `${value === 0 ? 0 : value < 1e-3 ? short(value) : Number(value.toPrecision(2))} ${name}`;
};

/** Rounds a value up to 1, 2 or 5 times a power of ten. */
export function roundUp(value: number) {
  const power = 10 ** Math.floor(Math.log10(value));
  return Number(([1, 2, 5, 10].find(s => s * power >= value * (1 - 1e-9))! * power).toPrecision(1));
}

/** Engine and rule of a method; a program has a name instead of an engine. */
export const inTwo = (method: string) => {
  const known = looksOfPage[method];
  if (known?.engine) return [known.engine, known.rule ?? ''];
  const [first, second = ''] = method.split('/');
  return [first, second.replace(/-/g, ' ')];
};

/** "980 µs", "tolerance 1e-6" */
export const settingOf = ({step, tolerance}: Run) => {
  if (tolerance) return `tolerance ${short(tolerance)}`;
  if (!step) return '';
  const [unit, size] = step < 1e-3 ? ['µs', 1e-6] as const: step < 1 ? ['ms', 1e-3] as const: ['s', 1] as const;
  return `${Number((step / size).toPrecision(3))} ${unit}`;
};

const pointerHelp =
    'Drag to turn. With the picture in focus (click it, or Tab) the wheel zooms, arrow keys turn, + and − ' +
    'zoom, 0 resets.';

/** Chooses a run of a scene by method and step. Calls `chosen` with its key. */
class Picker {
  readonly box: HTMLElement;
  private readonly method: HTMLSelectElement;
  private readonly step: HTMLSelectElement;

  constructor(
      letter: string, private readonly scene: SceneStage, private readonly keys: Map<string, string[]>,
      chosen: (key: string) => void) {
    const engines = new Map<string, HTMLElement[]>();
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
    this.method.addEventListener('change', () => chosen(this.keys.get(this.method.value)![0]));
    this.step.addEventListener('change', () => chosen(this.step.value));
  }

  show(key: string) {
    const method = key === 'truth' ? key : parts(key).method;
    this.method.value = method;
    this.step.hidden = method === 'truth';
    this.step.replaceChildren(...(this.keys.get(method) ?? []).map(each => {
      const {run} = runOf(this.scene, each)!, own = parts(each).place === 'own', failure = failureOf(run, short);
      return make(
          'option', each === key ? {value: each, selected: ''} : {value: each},
          `${settingOf(run)}${own ? ' (own)' : ''}${failure ? `: ${failure}` : ''}`);
    }));
    this.box.style.setProperty('--own', lookOf(method).css);
    this.box.dataset.method = method;
  }
}

export interface Look {
  colour: string;
  springs: boolean;
}
export interface Acts {
  toggle: () => void;
  seek: (time: number) => void;  // s
  speed: (speed: number) => void;
  look: (change: Partial<Look>) => void;
  reset: () => void;
  pick?: (letter: 'a'|'b', key: string) => void;
}

export class Controls {
  private readonly play = make('button', {type: 'button', class: 'play'});
  private readonly clock = make('span', {class: 'clock'});
  private readonly slider: HTMLInputElement;
  private readonly colour: HTMLSelectElement;
  private readonly springs: HTMLInputElement;
  private readonly bar = make('span', {class: 'bar'});
  private readonly plots = make('div', {class: 'plots'});
  private readonly hint = make('p', {class: 'hint'});
  private readonly scale = make('div', {class: 'pick apart'});
  private readonly pickers: Picker[];
  private readonly curves: Plot[] = [];
  private begin = 0;
  private end = 1;

  constructor(player: HTMLElement, private readonly scene: SceneStage, look: Look, private readonly act: Acts) {
    this.slider =
        make('input', {type: 'range', min: 0, max: 300, step: 1, value: 0, 'aria-label': `time in ${scene.scene}`});
    const [speedLabel, speed] = dropdown('speed', [0.1, 0.25, 0.5, 1, 2].map(v => [String(v), `${v} ×`]), '1');
    const colours = [['plain', 'engine'], ['stretch', 'stretch'], ['distance', 'distance from the truth']].filter(
        ([name]) => name === 'plain' || (name === 'stretch' ? scene.springs.rests.count : runOf(scene, 'truth')));
    const [colourLabel, colour] = dropdown('colour by', colours, look.colour);
    const [springLabel, springs] = check('springs', look.springs);
    const reset = make('button', {type: 'button', 'aria-label': `Reset view of ${scene.scene}`}, 'reset view');
    const {pick} = act;
    this.pickers = pick ?
        (['a', 'b'] as const)
            .map(letter => new Picker(letter.toUpperCase(), scene, keysOf(scene), key => pick(letter, key))) :
        [];
    if (pick) player.parentElement!.prepend(make('div', {class: 'picks'}, ...this.pickers.map(p => p.box), this.scale));
    player.replaceChildren(
        make('div', {class: 'time'}, this.play, this.slider, this.clock),
        make(
            'div', {class: 'looks'}, speedLabel, ...(colours.length > 1 ? [colourLabel] : []), this.bar,
            ...(scene.springs.families.length ? [springLabel] : []), reset),
        this.plots, this.hint);
    this.play.addEventListener('click', act.toggle);
    this.slider.addEventListener(
        'input', () => act.seek(this.begin + Number(this.slider.value) / 300 * (this.end - this.begin)));
    this.colour = colour, this.springs = springs;
    this.addPlots(act.pick ? 3 : 0);  // reserves space until the plots are drawn
    speed.addEventListener('change', () => act.speed(Number(speed.value)));
    colour.addEventListener('change', () => act.look({colour: colour.value}));
    springs.addEventListener('change', () => act.look({springs: springs.checked}));
    reset.addEventListener('click', act.reset);
  }

  setPlaying(playing: boolean) {
    this.play.textContent = playing ? '❚❚' : '▶';
    this.play.setAttribute('aria-label', `${playing ? 'Pause' : 'Play'} ${this.scene.scene}`);
  }

  /** Shows the compared runs. `top`: largest difference, m; 0 below the resolution `least` (m); null if unknown. */
  setPicks(picks: string[], top: number|null, least = 0) {
    this.pickers.forEach((picker, i) => picker.show(picks[i]));
    this.scale.replaceChildren(
        make('b', {}, 'A − B'),
        ...(top           ? ['0', make('i', {class: 'ramp'}), length(top)] :
                top === 0 ? [`below ${length(least)}`] :
                            []));
  }

  /** Shows the look; `scale`: value of the last colour, or null. */
  setLook(look: Look, scale: string|null) {
    this.colour.value = look.colour, this.springs.checked = look.springs;
    this.bar.replaceChildren(...(scale ? ['0', make('i', {class: 'scale'}), scale] : []));
  }

  private addPlots(count: number) {
    while (this.curves.length < count) {
      const box = make('div', {class: 'plot'});
      this.plots.append(box);
      this.curves.push(new Plot(box, time => this.act.seek(time)));
    }
  }

  setPlots(list: Omit<Shown, 'begin'|'end'>[], begin: number, end: number) {
    this.begin = begin, this.end = end;
    list.forEach((each, i) => this.curves[i].show({...each, begin, end}));
  }

  setTime(time: number) {
    const {begin, end} = this, text = `${seconds(time, end - begin)} s`;
    this.slider.value = String(300 * (time - begin) / (end - begin || 1));
    this.slider.setAttribute('aria-valuetext', text);
    this.clock.textContent = `${seconds(time, end - begin)} / ${seconds(end, end - begin)} s`;
    for (const curve of this.curves) curve.moveHead(time);
  }

  setHint(words: string) { this.hint.textContent = [words, pointerHelp].filter(Boolean).join(' '); }
}
