// Draws charts as SVG at the width of their figure, and makes them navigable by keyboard.

import {layout} from './layout';
import {css, Element, font, letters, widthOf} from './sheet';
import {ChartSpec} from './spec';

/** Colours of methods, from methods-data. */
export type Looks = Record<string, {colour: string}>;

const svgNames = 'http://www.w3.org/2000/svg';

export function svgOf({tag, attributes, children}: Element): SVGElement {
  const made = document.createElementNS(svgNames, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  for (const child of children) made.append(typeof child === 'string' ? child : svgOf(child));
  return made;
}

/** Left and right arrows move between marks, up and down between curves. Enter plays the mark's run. */
function walk(event: KeyboardEvent) {
  const step = ({ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1} as Record<string, number>)[event.key];
  const box = event.currentTarget;
  if (!step || !(box instanceof HTMLElement)) return;
  event.preventDefault();
  const placeOf = (mark: SVGElement) => Number(mark.closest<SVGElement>('[data-place]')?.dataset.place ?? 0);
  const marks = [...box.querySelectorAll<SVGElement>('[data-words]')].sort((a, b) => placeOf(a) - placeOf(b)),
        here = marks.findIndex(each => each === document.activeElement);
  if (!marks.length) return;
  const curve = (k: number) => marks[k]?.closest('.series');
  let next = here < 0 ? 0 : here + step;
  if (here >= 0 && /Up|Down/.test(event.key))
    while (marks[next] && curve(next) === curve(here)) next += step;
  const chosen = marks[(next + marks.length) % marks.length];
  chosen.setAttribute('tabindex', '-1');
  chosen.focus({preventScroll: true});
}

/** Compares the browser's font with Helvetica, for which layouts are computed. */
function measureFont() {
  const ruler = document.createElement('canvas').getContext('2d'), text = 'Bullet explicit, 0.125 ms';
  if (!ruler) return;
  for (const weight of ['regular', 'bold'] as const) {
    ruler.font = `${weight === 'bold' ? 'bold ' : ''}${letters}px "Liberation Sans", Arial, Helvetica, sans-serif`;
    font[weight] *= ruler.measureText(text).width / widthOf(text, weight === 'bold');
  }
}

const drawnWidths = new WeakMap<HTMLElement, number>();

export function drawChart(box: HTMLElement, chart: ChartSpec, looks: Looks) {
  const width = Math.max(300, Math.round(box.clientWidth || 600)), before = drawnWidths.get(box);
  if (before === width) return;
  if (before === undefined) box.addEventListener('keydown', walk);
  drawnWidths.set(box, width);
  measureFont();
  // the colours of user programs are chosen by the page
  const sheet = layout(chart, width, part => {
    const look = looks[part.method ?? '']?.colour ?? '';
    return css(/^outside\d/.test(look) ? look : part.colour);
  });
  const root = svgOf({
    tag: 'svg',
    attributes: {
      class: 'chart',
      viewBox: `0 0 ${width} ${sheet.height}`,
      width,
      height: sheet.height,
      role: 'group',
      tabindex: 0,
      'aria-label': `${chart.title}. ${chart.finding ?? ''}`,
      'font-size': letters
    },
    children: sheet.elements
  });
  box.replaceChildren(root, ...sheet.notes.map(text => {
    const note = document.createElement('p');
    note.className = 'note';
    note.textContent = text;
    return note;
  }));
}

export const isDrawn = (box: HTMLElement) => drawnWidths.has(box);
