// A laid-out chart, before it becomes SVG. Texts are measured without a browser, so that tests can lay out charts.

import {line, symbol, symbolCircle, symbolDiamond, symbolSquare, symbolTriangle, SymbolType} from 'd3-shape';

import {MarkName, Pair, Tip} from './spec';

type Attributes = Record<string, string|number>;

export interface Element {
  tag: string;
  attributes: Attributes;
  children: (Element|string)[];
}

export const element = (tag: string, attributes: Attributes = {}, ...children: (Element|string)[]): Element =>
    ({tag, attributes, children});

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** A curve's label, next to it or joined to its end by a leader line. */
export interface PlacedName {
  text: string;
  box: Box;
  part: number;
  leader: boolean;
}

/** `names` and `paths` are for tests. */
export interface Sheet {
  width: number;
  height: number;
  elements: Element[];
  names: PlacedName[];
  paths: Pair[][][];  // by part
  notes: string[];    // sentences below the chart
}


export const letters = 12.5, lineHeight = 15;  // px

/** Widths of characters from blank to tilde in Helvetica, Arial and Liberation Sans, in 1/1000 of the font size. */
const advances =
    ('278 278 355 556 556 889 667 191 333 333 389 584 278 333 278 278 556 556 556 556 556 556 556 556 556 ' +
     '556 278 278 584 584 584 556 1015 667 667 722 722 667 611 778 722 278 500 667 556 833 722 778 667 778 ' +
     '722 667 611 722 667 944 667 667 611 278 278 278 469 556 333 556 556 500 556 556 278 556 556 222 222 ' +
     '500 222 833 556 556 556 556 333 500 278 556 500 722 500 500 500 334 260 334 584')
        .split(' ')
        .map(Number);
const narrowSigns = '⁻⁰¹²³⁴⁵⁶⁷⁸⁹°·\u202f';

/** Ratio of the browser's font widths to Helvetica's. */
export const font: Record<'regular'|'bold', number> = {
  regular: 1,
  bold: 1.07
};

export function widthOf(text: string, bold = false, size = letters): number {
  let sum = 0;
  for (const sign of text) {
    const code = sign.codePointAt(0) as number;
    sum += advances[code - 32] ?? (narrowSigns.includes(sign) ? 380 : code > 0x2e80 ? 1000 : code > 0x2180 ? 800 : 600);
  }
  return sum * size / 1000 * (bold ? font.bold : font.regular);
}

export function wrapped(text: string, width: number, bold = false): string[] {
  const lines: string[] = [];
  for (const word of text.split(' ')) {
    const longer = lines.length ? `${lines[lines.length - 1]} ${word}` : word;
    if (lines.length && widthOf(longer, bold) <= width)
      lines[lines.length - 1] = longer;
    else
      lines.push(word);
  }
  return lines;
}

export type Anchor = 'start'|'middle'|'end';

export const label = (text: string, x: number, y: number, anchor: Anchor = 'start', attributes: Attributes = {}) =>
    element('text', {x: rounded(x), y: rounded(y), 'text-anchor': anchor, ...attributes}, text);

/** Box of a text whose baseline starts at (x, y). */
export function boxOf(text: string, x: number, y: number, anchor: Anchor = 'start', bold = false): Box {
  const width = widthOf(text, bold), left = anchor === 'end' ? x - width : anchor === 'middle' ? x - width / 2 : x;
  return {left, right: left + width, top: y - 0.76 * letters, bottom: y + 0.24 * letters};
}

/** A group that is highlighted together with its method. */
export const group = (colour: string, method: string|undefined, ...children: Element[]) => element(
    'g', {class: 'series hero', style: `--own: ${colour}; --lit: ${colour}`, ...(method && {'data-method': method})},
    ...children);

export const segment = (kind: string, x1: number, y1: number, x2: number, y2: number) =>
    element('line', {class: kind, x1: rounded(x1), y1: rounded(y1), x2: rounded(x2), y2: rounded(y2)});

export const rectangle = (kind: string, x: number, y: number, width: number, height: number, more: Attributes = {}) =>
    element(
        'rect', {class: kind, x: rounded(x), y: rounded(y), width: rounded(width), height: rounded(height), ...more});

/** Attributes of an element with a tooltip. */
export const saying = (words: string|undefined): Attributes =>
    words ? {'data-words': words, 'aria-label': words, role: 'img'} : {};

export const rounded = (value: number) => Math.round(10 * value) / 10;


const drawLine = line();

/** A path; omits points closer than a third of a px to the previous one. */
export function pathOf(points: readonly Pair[]): string {
  const kept: Pair[] = [];
  for (const [x, y] of points) {
    const [lastX, lastY] = kept[kept.length - 1] ?? [Infinity, 0];
    if (Math.hypot(x - lastX, y - lastY) >= 0.3) kept.push([rounded(x), rounded(y)]);
  }
  return drawLine(kept) ?? '';
}

const filled: Partial<Record<MarkName, SymbolType>> = {
  circle: symbolCircle,
  square: symbolSquare,
  diamond: symbolDiamond,
  triangle: symbolTriangle,
  down: symbolTriangle
};

function shapeOf(name: MarkName, r: number): string {
  const type = filled[name],
        corner = (k: number) => [r * Math.sin(0.4 * k * Math.PI), -r * Math.cos(0.4 * k * Math.PI)];
  if (type) return symbol().type(type).size(Math.PI * r * r)() ?? '';
  if (name === 'pentagon') return `M${[0, 1, 2, 3, 4].map(k => corner(k).map(rounded)).join('L')}Z`;
  const x = `M${- r},${- r}L${r},${r}M${- r},${r}L${r},${- r}`, plus = `M${- r},0H${r}M0,${- r}V${r}`;
  return name === 'cross' ? x : name === 'plus' ? plus : x + plus;
}

/** A mark with a tooltip, which plays its run if it has one. */
export function mark(name: MarkName, [x, y]: Pair, r: number, open: boolean, tip: Tip = {}, colour = ''): Element {
  const kind = ['plus', 'cross', 'star'].includes(name) ? ' cross' : open ? ' open' : '';
  return element('path', {
    d: shapeOf(name, r),
    transform: `translate(${rounded(x)},${rounded(y)})${name === 'down' ? ' rotate(180)' : ''}`,
    class: `mark${kind}`,
    ...(colour && {style: `--own: ${colour}`}),
    ...saying(tip.words),
    ...(tip.run && {'data-run': tip.run})
  });
}

/** A colour of style.css, or one that becomes lighter in dark mode. */
export const css = (colour: string) =>
    colour.startsWith('#') ? `color-mix(in srgb, ${colour}, white var(--lift))` : `var(--${colour})`;


export interface KeyEntry {
  text: string;
  sample: (x: number, y: number) => Element;  // centred at (x, y), 9 px to the right of the entry's left edge
  method?: string;
}

/** Draws a key, with the centre of its first line at `top` + 8. Returns the key's height. */
export function key(
    elements: Element[], entries: readonly KeyEntry[], left: number, top: number, width: number): number {
  if (!entries.length) return 0;
  let x = left, y = top + 8;
  for (const {text, sample, method} of entries) {
    const wide = 24 + widthOf(text);
    if (x > left && x + wide > left + width) x = left, y += 19;
    const room = wrapped(text, left + width - x - 24);
    elements.push(element(
        'g', {class: 'keyed', ...(method && {'data-method': method})}, sample(x + 9, y),
        ...room.map((line, k) => label(line, x + 22, y + 4.5 + lineHeight * k))));
    x += wide + 14, y += lineHeight * (room.length - 1);
  }
  return y - top + 12;
}
