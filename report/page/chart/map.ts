// Maps: a cell per run over two logarithmic axes, in panels with common axes. The predicted limit is a line, the
// measured one is dots.

import {axisOf, Frame, levelTicks, linesOfTitle, titleOf, uprightTicks, widthOfTicks} from './axes';
import {clipped} from './board';
import {Element, element, group, key, KeyEntry, label, lineHeight, pathOf, rectangle, rounded, saying, Sheet} from './sheet';
import {AxisSpec, MapSpec, Pair} from './spec';

/** Minimum, maximum, and half the smallest distance between neighbours on a logarithmic scale, as a factor. */
function spanOf(values: readonly number[]): [number, number, number] {
  const sorted = [...new Set(values.map(v => Math.round(1e6 * Math.log(v)) / 1e6))].sort((a, b) => a - b);
  let least = Infinity;
  for (let i = 1; i < sorted.length; ++i) least = Math.min(least, sorted[i] - sorted[i - 1]);
  return [Math.exp(sorted[0]), Math.exp(sorted[sorted.length - 1]), Number.isFinite(least) ? Math.exp(least / 2) : 1.1];
}

export function map(chart: MapSpec, width: number): Sheet {
  // panels of a single colour are described in a sentence instead of drawn
  const plain = chart.panels.filter(panel => new Set(panel.cells.map(c => c[2])).size === 1), {kinds} = chart;
  const panels =
      plain.length < chart.panels.length ? chart.panels.filter(panel => !plain.includes(panel)) : chart.panels;
  const elements: Element[] = [], notes = panels === chart.panels ? [] : kinds.flatMap(({title}, k) => {
    const names = plain.filter(panel => panel.cells[0][2] === k).map(panel => panel.name);
    return names.length ? [`${names.join(', ')}: ${title} in every run.`] : [];
  });
  const columns = Math.max(1, Math.min(3, Math.floor(width / 280), panels.length)),
        rows = Math.ceil(panels.length / columns);
  // the panels share axes, but their cells differ in size
  const spans = panels.map(panel => [spanOf(panel.cells.map(c => c[0])), spanOf(panel.cells.map(c => c[1]))]);
  const whole = (spec: AxisSpec, i: number): AxisSpec => ({
    ...spec,
    low: Math.min(...spans.map(span => span[i][0] / span[i][2])),
    high: Math.max(...spans.map(span => span[i][1] * span[i][2]))
  });
  const xSpec = whole(chart.x, 0), ySpec = whole(chart.y, 1),
        occurring = new Set(panels.flatMap(panel => panel.cells.map(c => c[2])));
  const square = (colour: string): KeyEntry['sample'] => (x, y) =>
      rectangle('cell', x - 6, y - 6, 12, 12, {style: `--own: ${colour}`});
  const entries: KeyEntry[] =
      kinds.map((kind, k) => ({text: kind.title, sample: square(kind.colour), k})).filter(({k}) => occurring.has(k));
  if (panels.some(panel => panel.predicted.length > 1))
    entries.push({
      text: 'predicted limit',
      sample: (x, y) => element('path', {class: 'predicted', d: `M${x - 9},${y}H${x + 9}`})
    });
  if (panels.some(panel => panel.measured.length))
    entries.push(
        {text: 'measured limit', sample: (x, y) => element('circle', {class: 'measured', cx: x, cy: y, r: 3})});
  const probe = axisOf(ySpec, 200, 0, 34), margin = Math.ceil(14 + widthOfTicks(probe)), gap = 14, head = 22;
  const wide = (width - margin - 10 + gap) / columns - gap, high = Math.min(260, 0.72 * wide);
  let top = lineHeight * linesOfTitle(probe.title, width) + 4;
  elements.push(...titleOf(probe.title, 0, 13, width));
  top += key(elements, entries, 0, top, width);
  const foot = 20, step = head + high + foot + 6;
  panels.forEach((panel, k) => {
    const column = k % columns, left = margin + column * (wide + gap),
          from = top + Math.floor(k / columns) * step + head;
    const frame: Frame = {left, right: left + wide, top: from, bottom: from + high};
    const x = axisOf(xSpec, left, frame.right, 70), y = axisOf(ySpec, frame.bottom, from, 34),
          [[, , ownX], [, , ownY]] = spans[k];
    const own = group('', panel.method, label(panel.name, left, from - 7, 'start', {class: 'quantity'}));
    for (const [cx, cy, kind, words, run] of panel.cells) {
      const [near, far, up, down] = [x.at(cx / ownX), x.at(cx * ownX), y.at(cy * ownY), y.at(cy / ownY)];
      own.children.push(rectangle('cell', near, up, far - near + 0.2, down - up + 0.2, {
        style: `--own: ${kinds[kind].colour}`,
        ...saying(words),
        ...(run && {'data-run': run, 'data-step': cx, 'data-value': cy})
      }));
    }
    for (const run of clipped(panel.predicted.map(([px, py]): Pair => [x.at(px), y.at(py)]), frame))
      own.children.push(element('path', {class: 'predicted', d: pathOf(run)}));
    for (const [px, py] of panel.measured)
      own.children.push(element('circle', {class: 'measured', cx: rounded(x.at(px)), cy: rounded(y.at(py)), r: 3}));
    if (!column) own.children.push(...uprightTicks(y, frame, false));
    if (k + columns >= panels.length) own.children.push(...levelTicks(x, frame, width));
    elements.push(own);
  });
  const bottom = top + rows * step, title = axisOf(xSpec, 0, width, 70).title;
  elements.push(...titleOf(title, width / 2, bottom + 10, width, 'middle'));
  return {
    width,
    height: Math.ceil(bottom + 6 + lineHeight * linesOfTitle(title, width)),
    elements,
    names: [],
    paths: [],
    notes
  };
}
