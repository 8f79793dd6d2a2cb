// Charts with a line per name: stacked bars, dots with intervals, largest stable steps.

import {Axis, axisOf, Frame, levelTicks, nice, titleBelow} from './axes';
import {Colours} from './curves';
import {css, Element, element, group, key, KeyEntry, label, lineHeight, mark, rectangle, rounded, saying, segment, Sheet, widthOf, wrapped} from './sheet';
import {AxisSpec, BarsSpec, DotsSpec, LimitsSpec, MarkName, Named} from './spec';

const sheetOf = (width: number, height: number, elements: Element[]): Sheet =>
    ({width, height: Math.ceil(height), elements, names: [], paths: [], notes: []});

interface Rows {
  elements: Element[];
  axis: Axis;
  frame: Frame;
  below: number;  // y below the axis' title
}

/** Names to the left of lines of height `high`, and an axis below. */
function rowsOf(
    names: readonly Named[], lines: number, high: number, spec: AxisSpec, above: number, width: number): Rows {
  const widest = Math.max(...names.map(({name}) => widthOf(name)));
  const left = Math.ceil(Math.min(0.42 * width, 12 + widest)), right = width - 14, top = above + 6;
  const frame = {left, right, top, bottom: top + lines * high}, axis = axisOf(spec, left, right, 64);
  const elements = levelTicks(axis, frame, width, true);
  return {elements, axis, frame, below: titleBelow(elements, axis.title, frame, frame.bottom + 37, width)};
}

/** Long names take two lines. */
function nameOf({name}: Named, left: number, y: number): Element[] {
  const lines = wrapped(name, left - 10);
  return lines.map((line, k) => label(line, left - 8, y + 4 + lineHeight * (k - (lines.length - 1) / 2), 'end'));
}

/** Bars with supplied energy to the left of zero, and the uses of energy to the right. */
export function bars(chart: BarsSpec, width: number): Sheet {
  const sums = chart.names.map(
      (_, k) => chart.parts.reduce(
          ([low, up], {height}) => [low + Math.min(0, height[k]), up + Math.max(0, height[k])], [0, 0]));
  const low = Math.min(0, ...sums.map(s => s[0])), up = Math.max(0, ...sums.map(s => s[1])), room = 0.02 * (up - low);
  const box = (part: BarsSpec['parts'][0], k: number, x: number, y: number, wide: number, tall: number, words = '') => {
    const fill = part.hatched ? `; fill: url(#hatch-${chart.name}-${k})` : '';
    return rectangle(
        'bar', x, y, Math.max(0.5, wide), tall, {style: `--own: ${css(part.colour)}${fill}`, ...saying(words)});
  };
  const entries: KeyEntry[] =
      chart.parts.map((part, k) => ({text: part.title, sample: (x, y) => box(part, k, x - 6, y - 6, 12, 12)}));
  const above: Element[] = [], keyHigh = key(above, entries, 0, 0, width), high = 24;
  const {elements, axis, frame, below} =
      rowsOf(chart.names, chart.names.length, high, {...chart.x, low: low - room, high: up + room}, keyHigh, width);
  chart.parts.forEach((part, k) => {
    if (!part.hatched) return;
    const stripe = element('path', {d: 'M0,0V6', stroke: css(part.colour), 'stroke-width': 3.5});
    const units = {patternUnits: 'userSpaceOnUse', patternTransform: 'rotate(45)'};
    elements.push(element('pattern', {id: `hatch-${chart.name}-${k}`, width: 5, height: 6, ...units}, stripe));
  });
  chart.names.forEach((name, k) => {
    const y = frame.top + k * high, row = group('', name.method, ...nameOf(name, frame.left, y + high / 2));
    let down = 0, top = 0;
    chart.parts.forEach((part, p) => {
      const value = part.height[k], from = value < 0 ? down + value : top;
      if (!value) return;
      if (value < 0)
        down += value;
      else
        top += value;
      row.children.push(
          box(part, p, axis.at(from), y + 3, axis.at(from + Math.abs(value)) - axis.at(from), high - 6,
              `${name.name}\n${part.title}: ${nice(value, chart.x.unit)}`));
    });
    elements.push(row);
  });
  elements.push(segment('base', axis.at(0), frame.top, axis.at(0), frame.bottom));
  return sheetOf(width, below, [...above, ...elements]);
}

export function dots(chart: DotsSpec, width: number, colours: Colours): Sheet {
  const ends = chart.series.flatMap(s => s.dots.flatMap(dot => (dot ? [dot[1], dot[2]] : [])));
  const all = [...ends, ...(chart.guides ?? []).map(guide => guide.at)];
  const entries: KeyEntry[] =
      chart.series.map(s => ({
                         text: s.name,
                         method: s.method,
                         sample: (x, y) => mark(s.mark ?? 'circle', [x, y], 4.5, Boolean(s.open), {}, colours(s))
                       }));
  const above: Element[] = [], keyHigh = key(above, entries, 0, 0, width), high = 22,
               headings = new Map(chart.headings);
  const guided = chart.guides?.length ? 16 : 0;
  const {elements, axis, frame, below} = rowsOf(
      chart.names, chart.names.length + headings.size, high,
      {...chart.x, low: Math.min(...all) / 1.3, high: Math.max(...all) * 1.3}, keyHigh + guided, width);
  for (const {at, text} of chart.guides ?? []) {
    const x = axis.at(at);
    elements.push(
        segment('measure', x, frame.top - 12, x, frame.bottom),
        label(`${text} →`, Math.min(x + 6, width - widthOf(`${text} →`)), frame.top - 4, 'start', {class: 'soft'}));
  }
  let y = frame.top;
  chart.names.forEach((name, k) => {
    const heading = headings.get(k);
    if (heading) elements.push(label(heading, 0, y + 15, 'start', {class: 'quantity'})), y += high;
    elements.push(
        segment('grid', frame.left, y + high / 2, frame.right, y + high / 2),
        ...nameOf(name, frame.left, y + high / 2));
    chart.series.forEach((s, j) => {
      const dot = s.dots[k];
      if (!dot) return;
      const [value, low, up] = dot,
                         at = y + high / 2 + (chart.series.length > 1 ? 6 * (j / (chart.series.length - 1) - 0.5) : 0);
      const method = s.method ?? name.method, words = `${name.name}\n${s.name}: ${nice(value, chart.x.unit)}`;
      elements.push(group(
          colours(s), method, segment('whisker', axis.at(low), at, axis.at(up), at),
          mark(s.mark ?? 'circle', [axis.at(value), at], 4.5, Boolean(s.open), {words})));
    });
    y += high;
  });
  return sheetOf(width, below, [...above, ...elements]);
}

const sceneMarks: MarkName[] = ['circle', 'square', 'diamond', 'triangle'];

/** Chart with a bar per method up to its largest stable h ω, a mark per scene, and a line for theory. */
export function limits(chart: LimitsSpec, width: number, colours: Colours): Sheet {
  const narrow = width < 620, high = narrow ? 46 : 32, tall = narrow ? 11 : 14,
        columns = [width - (narrow ? 62 : 84), width - 2];
  const widest = Math.max(...chart.rows.map(({name}) => widthOf(name, true)));
  const entries: KeyEntry[] =
      chart.scenes.map(([name, omega], k) => ({
                         text: `${name}, ω = ${nice(omega)} rad/s`,
                         sample: (x, y) => mark(sceneMarks[k % 4], [x, y], 4, false, {}, 'var(--ink)')
                       }));
  entries.push({text: 'theory', sample: (x, y) => segment('theory', x, y - 8, x, y + 8)});
  const above: Element[] = [], keyHigh = key(above, entries, 0, 0, width);
  const top = keyHigh + (narrow ? 40 : 46), bottom = top + chart.rows.length * high, left = narrow ? 4 : 14 + widest;
  const right = width - (narrow ? 126 : 170), frame = {left, right, top: top - 4, bottom};
  const closed = chart.rows.filter(row => !row.open).flatMap(row => [row.held, ...row.marks.map(m => m[1])]);
  const axis = axisOf(
      {label: 'time step × fastest angular frequency, h ω', low: 0, high: 1.34 * Math.max(...closed, 1e-9)}, left,
      right, 70);
  const heading = (text: string, x: number, y: number, kind = 'soft') => label(text, x, y, 'end', {class: kind});
  const elements = [
    ...above, ...levelTicks(axis, frame, width, true),
    heading(`on ${chart.columns}, ms`, columns[1], top - (narrow ? 24 : 28), 'quantity'),
    heading('measured', columns[0], top - 9), heading('theory', columns[1], top - 9)
  ];
  chart.rows.forEach((row, k) => {
    const colour = colours(row), line = top + high * k, y = line + (narrow ? 32 : high / 2);
    const own = group(colour, row.method);
    const end = rounded(row.open ? right - 10 : axis.at(row.held)),
          add = (...each: Element[]) => own.children.push(...each);
    add(element('path', {
      class: 'held',
      d: `M${left},${y - 7}H${end}${row.open ? `V${y - 11}L${right},${y}L${end},${y + 11}V${y + 7}` : `V${y + 7}`}H${
          left}z`
    }));
    add(narrow ? label(row.name, left + 3, line + 15, 'start', {class: 'own'}) :
                 label(row.name, left - 10, y + 4, 'end', {class: 'own'}));
    row.marks.forEach(([scene, measured, predicted, words], i) => {
      if (predicted !== null) {
        const x = axis.at(predicted);
        add(segment('theory', x, y - tall, x, y + tall));
      }
      const shift = row.marks.length < 2 ? 0 : (tall + 4) * (i / (row.marks.length - 1) - 0.5);
      add(mark(sceneMarks[scene % 4], [axis.at(measured), y + shift], 3.4, false, {words}));
    });
    // the words are next to the bar, inside it, or, on narrow screens, after the name
    const far = axis.at(Math.max(row.held, ...row.marks.map(m => Math.max(m[1], m[2] ?? 0)))),
          first = left + widthOf(row.name, true) + 12;
    const words = narrow && first + widthOf(row.words) > width ? row.words.split(';')[0] : row.words;
    const inside = row.open || far + 12 + widthOf(words) > right;
    const [px, py] = narrow ? [first, line + 15] : [inside ? left + 10 : far + 10, y + 4];
    if (!row.open || chart.rows[k - 1]?.words !== row.words)
      add(label(words, px, py, 'start', {class: inside || narrow ? 'soft' : 'halo soft'}));
    const brief = (text: string) => (narrow && Number(text) ? Number(text).toPrecision(text.length > 7 ? 3 : 4) : text);
    if (row.measured)
      add(heading(brief(row.measured), columns[0], y + 4, ''), heading(brief(row.predicted), columns[1], y + 4, ''));
    else
      add(heading('not searched', columns[1], y + 4));
    elements.push(own);
  });
  elements.push(segment('base', left, top - 4, left, bottom));
  return sheetOf(width, titleBelow(elements, axis.title, frame, bottom + 36, width), elements);
}
