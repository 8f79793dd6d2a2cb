// Axes of all charts: one unit and number format each, and titles that are never cut off.

import {format} from 'd3-format';
import {scaleLinear, scaleLog} from 'd3-scale';

import {Anchor, Element, element, label, lineHeight, rounded, widthOf, wrapped} from './sheet';
import {AxisSpec} from './spec';

const digits = '⁰¹²³⁴⁵⁶⁷⁸⁹';
const superscript = (power: number) =>
    (power < 0 ? '⁻' : '') + String(Math.abs(power)).replace(/\d/g, digit => digits[Number(digit)]);
const short = format('.3~r'), long = format('.6~r'), grouped = format(',.6~r');
const signed = (text: string) => text.replace('-', '−');

/** 2.5 × 10⁻⁷, or 10⁻⁷. */
function inPowers(value: number): string {
  if (value === 0) return '0';
  const power = Math.floor(Math.log10(Math.abs(value)) + 1e-9), front = short(value / 10 ** power);
  return signed(front === '1' ? `10${superscript(power)}` : `${front} × 10${superscript(power)}`);
}

const prefixes: [string, number][] = [['', 1], ['m', 1e-3], ['µ', 1e-6], ['n', 1e-9], ['p', 1e-12]];
const scalable = ['s', 'm', 'J', 'N'];  // units to which prefixes for small values apply

/** Value with its unit, at most three digits: "1.5 ms", "30 %", "10⁻⁷". */
export function nice(value: number, unit = ''): string {
  const size = Math.abs(value), small = size > 0 && scalable.includes(unit);
  const [prefix, factor] = (small && prefixes.find(([, f]) => size >= 0.9995 * f)) || ['', 1];
  const scaled = value / factor, plain = scaled === 0 || (Math.abs(scaled) >= 1e-4 && Math.abs(scaled) < 1e5);
  return `${plain ? signed(short(scaled)) : inPowers(scaled)}${unit && ` ${prefix}${unit}`}`;
}

export interface Tick {
  place: number;  // px
  text: string;
}

export interface Axis {
  at: (value: number) => number;  // px
  value: (place: number) => number;
  ticks: Tick[];
  title: string;
  unit: string;
  size: number;  // in the unit of the spec
  low: number;
  high: number;
}

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Name and size of a unit in which an axis is readable. */
function unitOf({unit = '', log}: AxisSpec, low: number, high: number): [string, number] {
  if (!scalable.includes(unit)) return [unit, 1];
  const most = Math.max(Math.abs(low), Math.abs(high));
  const found = prefixes.find(([, f]) => most >= 0.99 * f && (!log || (low >= 0.9e-3 * f && high < 1e5 * f)));
  return found ? [found[0] + unit, found[1]] : [unit, 1];
}

/** True if the values can be written without powers of ten. */
const isPlain = (values: number[]) => values.every(v => v === 0 || (Math.abs(v) >= 0.9e-3 && Math.abs(v) < 1e6));

/** Round values from low to high, about one per `apart` px. */
function valuesOf(log: boolean, low: number, high: number, length: number, apart: number): number[] {
  const count = Math.max(2, Math.floor(length / apart));
  if (!log) return scaleLinear().domain([low, high]).ticks(count);
  const all = scaleLog().domain([low, high]).ticks(60), powerOf = (tick: number) => Math.floor(Math.log10(tick) + 1e-9);
  const few = [[1, 2, 5], [1, 3], [1]].map(
      fronts => all.filter(tick => fronts.includes(Number((tick / 10 ** powerOf(tick)).toPrecision(3)))));
  const ticks = few.find((list, k) => list.length <= count && (k === 2 || isPlain(list))) ?? few[2],
        every = Math.ceil(ticks.length / count);
  const kept = ticks.filter(tick => every < 2 || powerOf(tick) % every === 0);
  return kept.length > 1 ? kept : scaleLinear().domain([low, high]).ticks(Math.min(count, 4)).filter(tick => tick > 0);
}

/** An axis between two positions (px), with ticks about `apart` px from each other. */
export function axisOf(spec: AxisSpec, from: number, to: number, apart: number): Axis {
  let low = spec.low ?? 0, high = spec.high ?? 1;
  if (!(high > low)) low = spec.log ? low / 2 : low - 1, high = spec.log ? 2 * high : high + 1;
  const log = Boolean(spec.log), scale = (log ? scaleLog() : scaleLinear()).domain([low, high]).range([from, to]);
  const [unit, size] = unitOf(spec, low, high);
  const values = valuesOf(log, low / size, high / size, Math.abs(to - from), apart);
  const plain = isPlain(values);
  const text = (v: number) => signed(
      !plain                 ? inPowers(v) :
          Math.abs(v) >= 1e4 ? grouped(v).replace(/,/g, '\u202f') :
                               long(v));
  const quantity = spec.label === 't' ? 'Time' : capital(spec.label);
  return {
    at: value => scale(log ? Math.max(value, 1e-300) : value),
    value: place => scale.invert(place),
    ticks: values.map(value => ({place: scale(value * size), text: text(value)})),
    unit,
    size,
    title: unit && unit !== '1' ? `${quantity}, ${unit}` : quantity,
    low,
    high
  };
}

export const widthOfTicks = (axis: Axis) => Math.max(0, ...axis.ticks.map(tick => widthOf(tick.text)));


export interface Frame {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

/** A wrapped title in bold, with its first baseline at y. */
export function titleOf(text: string, x: number, y: number, width: number, anchor: Anchor = 'start'): Element[] {
  return wrapped(text, width, true).map((line, k) => label(line, x, y + lineHeight * k, anchor, {class: 'quantity'}));
}
export const linesOfTitle = (text: string, width: number) => wrapped(text, width, true).length;

/** Writes the title of a horizontal axis, centred if there is space. Returns the y below the title. */
export function titleBelow(elements: Element[], text: string, {left, right}: Frame, y: number, width: number): number {
  const half = Math.min(width, widthOf(text, true)) / 2,
        middle = Math.max(half, Math.min((left + right) / 2, width - half));
  if (text) elements.push(...titleOf(text, middle, y, width, 'middle'));
  return y + 6 + lineHeight * (text ? linesOfTitle(text, width) - 1 : -1);
}

export const uprightTicks = (axis: Axis, {left, right}: Frame, grid = true): Element[] => axis.ticks.flatMap(
    tick =>
        [...(grid ?
                 [element(
                     'line', {class: 'grid', x1: left, x2: right, y1: rounded(tick.place), y2: rounded(tick.place)})] :
                 []),
         label(tick.text, left - 6, tick.place + 4, 'end')]);

/** Labels of a horizontal axis, without overlaps, and grid lines if `grid` is true. */
export function levelTicks(axis: Axis, {top, bottom}: Frame, width: number, grid = false): Element[] {
  let end = -Infinity;
  const elements: Element[] = [];
  for (const {place, text} of axis.ticks) {
    const half = widthOf(text) / 2, middle = Math.max(half, Math.min(place, width - half));
    elements.push(element('line', {
      class: grid ? 'grid' : 'base',
      x1: rounded(place),
      x2: rounded(place),
      y1: grid ? top : bottom,
      y2: grid ? bottom : bottom + 5
    }));
    if (middle - half < end + 8) continue;
    end = middle + half;
    elements.push(label(text, middle, bottom + 18, 'middle'));
  }
  return elements;
}

/** Names of categories below an axis, slanted if there is too little space. `high`: height of the names. */
export function categoryTicks(
    categories: readonly[number, string][], axis: Axis, {left, right, bottom}: Frame,
    width: number): {elements: Element[], high: number} {
  const widest = Math.max(...categories.map(([, text]) => widthOf(text)));
  const level = categories.length < 2 || widest + 8 < (right - left) / categories.length;
  const elements = categories.flatMap(([value, text]) => {
    const x = rounded(axis.at(value)), half = widthOf(text) / 2;
    return [
      element('line', {class: 'base', x1: x, x2: x, y1: bottom, y2: bottom + 5}),
      level ? label(text, Math.max(half, Math.min(x, width - half)), bottom + 18, 'middle') :
              label(text, x + 3, bottom + 14, 'end', {transform: `rotate(-40 ${x + 3} ${bottom + 14})`})
    ];
  });
  return {elements, high: level ? 22 : 16 + 0.65 * widest};
}
