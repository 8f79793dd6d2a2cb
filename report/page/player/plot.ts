// A quantity of all methods over time, with a play head; a click or a drag in it moves the head.

import {make, short, unitOf} from './controls';

/** A value at a time (s); null where it is not known. */
export type Point = [number, number | null];
export interface Series {
  name: string;
  css: string;
  dash?: string;
  points: Point[];
  well: boolean;
}
/** What a plot shows: lengths in the unit that suits the largest; `none` where nothing is known. */
export interface Shown {
  title: string;
  unit: string;
  series: Series[];
  begin: number;
  end: number;
  none?: string;
}

// the name space is taken from the parser, as the page holds no address
const vectorSpace = (() => {
  const holder = document.createElement('div');
  holder.innerHTML = '<svg></svg>';
  return (holder.firstChild as Element).namespaceURI;
})();

export const svg = (name: string, attributes: Record<string, string|number> = {}, ...children: (Node|string)[]) => {
  const element = document.createElementNS(vectorSpace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
};

/** Round numbers between low and high, about `count` of them. */
function ticks(low: number, high: number, count: number) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find(s => s * power >= rough * 0.999)! * power;
  const list: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) list.push(k * step);
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return list.map(value => ({
                    value,
                    text: Math.abs(value) < 1e-12 * step ?
                        '0' :
                        (digits > 4 || step >= 1e5 ? value.toExponential(1) : value.toFixed(digits)).replace('-', '−')
                  }));
}

/** Whole powers of ten between two exponents, at most about `count` of them. */
function powerTicks(low: number, high: number, count: number) {
  const step = Math.max(1, Math.ceil((high - low) / count)), list: {value: number, text: string}[] = [];
  for (let n = Math.ceil(low / step) * step; n <= high; n += step) {
    const digits = String(Math.abs(n)).split('').map(d => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(d)]).join('');
    list.push({value: n, text: `10${n < 0 ? '⁻' : ''}${digits}`});
  }
  return list;
}

export class Plot {
  protected readonly head = make('p', {class: 'head'});
  protected readonly area = make('div', {class: 'area'});
  protected readonly high = 140;
  protected left = 44;
  protected wide = 0;
  protected span = 1;
  protected title = '';
  protected none = '';
  protected unit = '';
  protected size = 1;  // the unit in m or J
  protected series: Series[] = [];
  protected begin = 0;
  protected end = 1;
  protected low = 0;
  protected most = 1;
  protected powers = false;
  protected known = false;
  private time?: number;
  private x?: (time: number) => number;
  private cursor: Element|null = null;

  /** A box for one quantity; `seek` is called with a time in s. */
  constructor(box: HTMLElement, seek: (time: number) => void) {
    box.append(this.head, this.area);
    const at = (event: PointerEvent) => seek(
        this.begin +
        (event.clientX - this.area.getBoundingClientRect().left - this.left) / this.span * (this.end - this.begin));
    this.area.addEventListener('pointerdown', event => (this.area.setPointerCapture(event.pointerId), at(event)));
    this.area.addEventListener('pointermove', event => event.buttons && at(event));
    // kept, as asking for it while another plot has just changed makes the browser lay the page out at once
    new ResizeObserver(() => (this.wide = this.area.clientWidth, this.draw())).observe(this.area);
  }

  /**
   * Where a run grows a hundredfold the axis counts powers of ten.
   */
  show(shown: Shown) {
    this.take(shown);
    this.draw();
  }

  /** What is shown, with the range of its axis. */
  take({title, unit, series, begin, end, none = ''}: Shown) {
    const all = (of: Series[]) => of.flatMap(s => s.points.map(p => p[1])).filter((v): v is number => v !== null);
    const well = series.filter(s => s.well), values = all(well.length ? well : series), most = Math.max(...values, 0);
    const third = values.slice(0, Math.ceil(values.length / 3));
    Object.assign(
        this,
        {title, series, begin, end, none, powers: series.some(s => !s.well) && most > 100 * Math.max(...third, 0)});
    [this.unit, this.size] = unit === 'm' && !this.powers ? unitOf(most) : [unit, 1];
    this.most = 1.08 * most / this.size || 1;
    const positive = values.filter(v => v > 0);
    if (this.powers)
      Object.assign(this, {low: Math.floor(Math.log10(Math.min(...positive))), most: Math.ceil(Math.log10(most))});
    else
      this.low = 0;
    this.known = values.length > 0;
  }

  private at(value: number) { return this.powers ? Math.log10(Math.max(1e-300, value)) : value / this.size; }

  draw() {
    const wide = this.wide ||= this.area.clientWidth, {high, left, begin, end, low, most, series} = this;
    if (!wide || !this.title) return;
    const names = series.length ? 14 + 8 * series.map(s => s.name).join(', ').length : 0;
    this.span = wide - left - Math.max(12, names);
    const top = 6, foot = high - 22, x = (t: number) => left + (t - begin) / ((end - begin) || 1) * this.span;
    const y = (v: number) => foot - (v - low) / (most - low || 1) * (foot - top);
    this.x = x;
    const root = svg('svg', {width: wide, height: high, role: 'img', 'aria-label': `${this.title} over time`});
    this.area.replaceChildren(root);
    if (!this.known) {
      root.append(svg('text', {x: 4, y: 40}, this.none));
      this.cursor = null;
      return void this.moveHead(this.time ?? begin);
    }
    for (const {value, text} of (this.powers ? powerTicks : ticks)(low, most, 3))
      root.append(
          svg('line', {class: 'grid', x1: left, x2: left + this.span, y1: y(value), y2: y(value)}),
          svg('text', {x: left - 6, y: y(value) + 4, 'text-anchor': 'end'}, text));
    const last = ticks(begin, end, Math.max(2, Math.min(6, wide / 90)));
    last.forEach(
        ({value, text}, i) => root.append(svg(
            'text', {x: x(value), y: foot + 17, 'text-anchor': 'middle'}, i === last.length - 1 ? `${text} s` : text)));
    const inside =
        svg('svg', {x: 0, y: top, width: wide, height: foot - top, viewBox: `0 ${top} ${wide} ${foot - top}`});
    const ends: {name: string, css: string, x: number, y: number}[] = [];
    for (const s of series) {
      let d = '', pen = 'M';
      for (const [t, v] of s.points) {
        if (v === null)
          pen = 'M';
        else
          d += `${pen}${x(t).toFixed(1)} ${Math.max(-1e4, Math.min(1e4, y(this.at(v)))).toFixed(1)}`, pen = 'L';
      }
      const final = [...s.points].reverse().find((p): p is[number, number] => p[1] !== null);
      inside.append(svg('path', {d, class: 'curve', style: `--own: ${s.css}`, 'stroke-dasharray': s.dash ?? ''}));
      if (!final) continue;
      const spot = {
        name: s.name,
        css: s.css,
        x: x(final[0]) + 5,
        y: Math.max(top + 6, Math.min(foot, y(this.at(final[1])))) + 4
      };
      const near = ends.find(other => Math.abs(other.y - spot.y) < 13 && Math.abs(other.x - spot.x) < 30);
      if (near)
        near.name += `, ${s.name}`;
      else
        ends.push(spot);
    }
    root.append(inside, svg('path', {class: 'axes', d: `M${left} ${foot}H${left + this.span}`}));
    for (const {name, css, x: px, y: py} of ends)
      root.append(svg('text', {x: px, y: py, class: 'end', style: `fill: ${css}`}, name));
    this.cursor = svg('line', {class: 'cursor', y1: top, y2: foot});
    root.append(this.cursor);
    this.moveHead(this.time ?? begin);
  }

  /** The cursor and the values at its time. */
  moveHead(time: number) {
    this.time = time;
    if (this.cursor && this.x)
      for (const end of ['x1', 'x2']) this.cursor.setAttribute(end, String(this.x(time)));
    if (!this.title) return;
    const values = this.series.map(series => ({series, value: valueAt(series.points, time)}));
    this.head.replaceChildren(
        make('b', {}, this.title), this.known ? ` / ${this.unit}` : '',
        ...values.flatMap(
            ({series: {css, name}, value}) =>
                value === null ? [] : [make('span', {style: `color: ${css}`}, `${name} ${short(value / this.size)}`)]));
  }
}

/** Between two points of a list: linearly; null beyond it. */
function valueAt(points: Point[], time: number) {
  const next = points.findIndex(([t]) => t >= time - 1e-9);
  if (next < 0) return null;
  const [t, v] = points[next], [before, was] = points[Math.max(0, next - 1)];
  return v === null || was === null || t === before ? v : was + (time - before) / (t - before) * (v - was);
}
