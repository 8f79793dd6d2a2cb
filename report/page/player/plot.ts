// A quantity of several runs over time. A click or drag moves the cursor.

import {bisector, extent} from 'd3-array';
import {line} from 'd3-shape';

import {Axis, axisOf, Frame, levelTicks, nice, uprightTicks, widthOfTicks} from '../chart/axes';
import {pushedApart} from '../chart/board';
import {svgOf} from '../chart/chart';
import {Element, element, label, lineHeight, rounded, widthOf} from '../chart/sheet';

import {make} from './controls';

export type Point = [number, number | null];  // s, value

export interface Series {
  name: string;
  css: string;
  dash?: string;
  points: Point[];
  well?: boolean;  // true: the run did not fail
}

export interface Shown {
  title: string;
  unit: string;
  series: Series[];
  begin: number;  // s
  end: number;
  none?: string;  // text that is shown if nothing is known
}

const high = 140, top = 6, foot = high - 22;
const at = bisector<Point>(([time]) => time);

/** Value at a time, linear between points; null outside their range. */
function valueAt(points: Point[], time: number): number|null {
  const next = at.left(points, time - 1e-9);
  if (next >= points.length) return null;
  const [t, v] = points[next], [before, was] = points[Math.max(0, next - 1)];
  return v === null || was === null || t === before ? v : was + (time - before) / (t - before) * (v - was);
}

export class Plot {
  private readonly head = make('p', {class: 'head'});
  private readonly area = make('div', {class: 'area'});
  private width = 0;
  private time = 0;
  private shown: Shown|null = null;
  private x: Axis|null = null;
  private y: Axis|null = null;
  private cursor: SVGElement|null = null;
  private words = '';  // shown instead of curves

  /** A box for one quantity; `seek` receives a time in s. */
  constructor(readonly box: HTMLElement, seek: (time: number) => void = () => {}) {
    box.append(this.head, this.area);
    const go = (event: PointerEvent) =>
        this.x && seek(this.x.value(event.clientX - this.area.getBoundingClientRect().left));
    this.area.addEventListener('pointerdown', event => (this.area.setPointerCapture(event.pointerId), go(event)));
    this.area.addEventListener('pointermove', event => event.buttons && go(event));
    // keep the width, because reading it after another plot has changed would force a layout
    new ResizeObserver(() => (this.width = this.area.clientWidth, this.draw())).observe(this.area);
  }

  show(shown: Shown) {
    this.shown = shown;
    this.draw();
  }

  /** Axis of values: linear, or logarithmic over at most 8 decades if a failed run grows a hundredfold. */
  private axisOfValues({title, unit, series}: Shown): Axis|null {
    const valuesOf = (list: Series[]) => list.flatMap(s => s.points.flatMap(([, v]) => (v === null ? [] : [v])));
    const well = series.filter(s => s.well), values = valuesOf(well.length ? well : series);
    const [least, most] = extent(values);
    if (least === undefined) return null;
    const begun = Math.max(...values.slice(0, Math.ceil(values.length / 3)), 0);
    const spec = {label: title, unit, low: 1.08 * Math.min(0, least), high: 1.08 * Math.max(0, most) || 1};
    if (least < 0 || well.length === series.length || most <= 100 * begun) return axisOf(spec, foot, top, 30);
    const positive = values.filter(v => v > 0), power = (value: number) => Math.log10(value);
    const up = 10 ** Math.ceil(power(most)), low = 10 ** Math.floor(power(Math.min(...positive)));
    return axisOf({...spec, log: true, low: Math.max(low, up / 1e8), high: up}, foot, top, 34);
  }

  private draw() {
    const {shown} = this, width = this.width ||= this.area.clientWidth;
    if (!width || !shown) return;
    const y = this.y = this.axisOfValues(shown), words = y ? '' : [shown.title, shown.none, width].join();
    if (words && words === this.words) return;
    this.words = words;
    const elements = y ? this.curves(shown, y, width) : [element('text', {x: 4, y: 40}, shown.none ?? '')];
    const root = svgOf(element(
        'svg', {width, height: high, role: 'img', 'aria-label': `${shown.title} over time`, 'font-size': 12},
        ...elements));
    this.cursor = root.querySelector('.cursor');
    this.area.replaceChildren(root);
    this.moveHead(this.time);
  }

  private curves({series, begin, end}: Shown, y: Axis, width: number): Element[] {
    const left = Math.ceil(12 + widthOfTicks(y)), names = Math.max(0, ...series.map(s => widthOf(s.name, true)));
    const frame: Frame = {left, right: width - names - 22, top, bottom: foot};
    const x = this.x = axisOf({label: 't', low: begin, high: end}, left, frame.right, 80);
    const last = x.ticks[x.ticks.length - 1];
    if (last) last.text += ' s';
    const path = line().defined(([, v]) => Number.isFinite(v));
    const places = (s: Series) => s.points.map(([t, v]): [
      number, number
    ] => [rounded(x.at(t)), v === null ? NaN : rounded(Math.max(-1e4, Math.min(1e4, y.at(v))))]);
    const drawn =
        series.map(s => ({s, d: path(places(s)) ?? '', ends: places(s).filter(([, v]) => Number.isFinite(v))}));
    const named = drawn.filter(each => each.ends.length).map(({s, ends}) => ({s, end: ends[ends.length - 1]}));
    const heights = pushedApart(named.map(({end}) => Math.max(top, Math.min(foot, end[1]))), top + 4, foot, lineHeight);
    const zero = rounded(Math.min(foot, y.at(y.low < 0 ? 0 : y.low)));
    return [
      ...uprightTicks(y, frame), ...levelTicks(x, frame, width),
      element(
          'svg', {x: 0, y: top, width, height: foot - top, viewBox: `0 ${top} ${width} ${foot - top}`},
          ...drawn.map(
              ({s, d}) =>
                  element('path', {d, class: 'curve', style: `--own: ${s.css}`, 'stroke-dasharray': s.dash ?? ''}))),
      element('path', {class: 'axes', d: `M${left} ${zero}H${frame.right}`}),
      ...named.map(
          ({s, end: [px]}, k) =>
              label(s.name, px + 6, heights[k] + 4, 'start', {class: 'end', style: `fill: ${s.css}`})),
      element('line', {class: 'cursor', y1: top, y2: foot})
    ];
  }

  moveHead(time: number) {
    this.time = time;
    const {shown, cursor, x, y} = this;
    if (!shown) return;
    if (cursor && x)
      for (const end of ['x1', 'x2']) cursor.setAttribute(end, String(x.at(time)));
    const values = shown.series.flatMap(s => {
      const value = valueAt(s.points, time);
      return value === null || !y ? [] :
                                    [make('span', {style: `color: ${s.css}`}, `${s.name} ${nice(value / y.size)}`)];
    });
    this.head.replaceChildren(make('b', {}, shown.title), y && y.unit ? `in ${y.unit}` : '', ...values);
  }
}
