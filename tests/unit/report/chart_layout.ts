// Lays out stored chart specs at several widths and prints errors of the layout.

import {axisOf} from '../../../report/page/chart/axes';
import {dense, distance} from '../../../report/page/chart/board';
import {layout} from '../../../report/page/chart/layout';
import {Box, boxOf, Element, Sheet} from '../../../report/page/chart/sheet';
import {ChartSpec} from '../../../report/page/chart/spec';

declare const charts: Record<string, ChartSpec>;

const complaints: string[] = [];
let names = 0, leaders = 0;

function* elementsOf(list: readonly Element[]): Generator<Element> {
  for (const each of list) {
    yield each;
    yield* elementsOf(each.children.filter((child): child is Element => typeof child !== 'string'));
  }
}

const textOf = ({children}: Element) => children.filter(child => typeof child === 'string').join('');

/** Bounding box of a text element, or null if it is slanted, because slanted boxes overlap differently. */
function boxOfText(element: Element): Box|null {
  const {x, y, transform, class: kind = ''} = element.attributes, anchor = element.attributes['text-anchor'];
  if (transform || String(kind).includes('waiting')) return null;
  const bold = /quantity|name|own/.test(String(kind));
  return boxOf(textOf(element), Number(x), Number(y), anchor as 'start' | 'middle' | 'end', bold);
}

const meet = (a: Box, b: Box) =>
    a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1;

/** Checks that everything lies inside the panel. */
function checkEdges(sheet: Sheet, complain: (words: string) => void) {
  for (const element of elementsOf(sheet.elements)) {
    const box = element.tag === 'text' ? boxOfText(element) : null;
    if (box && (box.left < -1 || box.right > sheet.width + 1 || box.top < -1 || box.bottom > sheet.height + 1))
      complain(`'${textOf(element)}' leaves the panel`);
    const place = /translate\(([-\d.]+),([-\d.]+)\)/.exec(String(element.attributes.transform ?? ''));
    if (place && !(Number(place[1]) >= 0 && Number(place[1]) <= sheet.width && Number(place[2]) <= sheet.height))
      complain('a mark leaves the panel');
    for (const number of String(element.attributes.d ?? '').match(/NaN|Infinity/g) ?? [])
      complain(`a path has ${number}`);
  }
}

/** Checks that each name is nearest to its own curve or has a leader line, and that names do not overlap. */
function checkNames(sheet: Sheet, complain: (words: string) => void) {
  sheet.names.forEach((name, i) => {
    ++names;
    for (const other of sheet.names.slice(0, i))
      if (meet(name.box, other.box)) complain(`names '${name.text}' and '${other.text}' meet`);
    if (name.leader) return void ++leaders;
    const near = (part: number) => distance(name.box, sheet.paths[part].flatMap(path => dense(path)));
    const own = near(name.part), other = Math.min(...sheet.paths.map((_, k) => (k === name.part ? Infinity : near(k))));
    if (own > other) complain(`'${name.text}' is ${own} px from its curve and ${other} px from another`);
  });
}

/** Checks that all required names and keys exist, and that no title is truncated. */
function checkWords(chart: ChartSpec, sheet: Sheet, complain: (words: string) => void) {
  const texts = [...elementsOf(sheet.elements)].filter(({tag}) => tag === 'text');
  const flat = texts.map(textOf).join(' ').replace(/\s+/g, ' ');
  const titles = texts.filter(({attributes}) => attributes.class === 'quantity').map(textOf).join(' ');
  const expect = (words: string, all = flat) => all.includes(words) || complain(`'${words}' is missing`);
  if (chart.kind === 'curves') {
    for (const part of chart.parts)
      if (part.hero) expect(part.name);
    for (const {text} of chart.key) expect(text);
    for (const guide of chart.guides ?? []) {
      const {low = -Infinity, high = Infinity} = chart[guide.axis], at = guide.at;
      if (at > low && at < high) expect(guide.text);
    }
    if (chart.x.label) expect(axisOf(chart.x, 0, 1, 1).title, titles);
    const quantity = axisOf({...chart.y, unit: ''}, 1, 0, 1).title;
    expect(quantity, titles);
  } else if (chart.kind !== 'limits') {
    expect(axisOf({...chart.x, unit: ''}, 0, 1, 1).title, titles);
  }
  if (chart.kind === 'bars')
    for (const part of chart.parts) expect(part.title);
  if (chart.kind === 'dots')
    for (const {name} of [...chart.series, ...chart.names]) name.split(' ').forEach(word => expect(word));
  if (chart.kind === 'map')
    for (const {name} of chart.panels) expect(name, `${flat} ${sheet.notes.join(' ')}`);
}

/** Checks that marks, fillings, dashes and lines mentioned in the caption are in the spec. */
function checkCaption(chart: ChartSpec, complain: (words: string) => void) {
  const caption = `${chart.finding} ${chart.caption}`;
  const series = chart.kind === 'curves' ? chart.parts.flatMap(part => part.series) : [];
  const found: [RegExp, boolean][] = [
    [/open marks/, series.some(s => s.scaled)], [/\(filled\)/, series.some(s => s.mark && !s.open)],
    [/\(open\)/, series.some(s => s.open)],
    [/a triangle creeps/, series.some(s => s.mark === 'triangle' || s.mark === 'down')],
    [/key's order/, chart.kind === 'curves' && chart.parts.filter(part => part.keyed).length > 1],
    [/\bdashed\b/, chart.kind === 'map' ? chart.panels.some(p => p.predicted.length > 1) : series.some(s => s.dash)],
    [/Hatched/, chart.kind === 'bars' && chart.parts.some(part => part.hatched)],
    [/Right of the line/, chart.kind === 'dots' && Boolean(chart.guides?.length)]
  ];
  for (const [words, there] of found)
    if (words.test(caption) && !there) complain(`the caption says ${words.source}, the spec has none`);
}

for (const [name, chart] of Object.entries(charts)) {
  checkCaption(chart, words => complaints.push(`${name}: ${words}`));
  for (const width of [326, 620, 1216]) {
    const complain = (words: string) => complaints.push(`${name} at ${width} px: ${words}`);
    const sheet = layout(chart, width);
    checkEdges(sheet, complain), checkNames(sheet, complain), checkWords(chart, sheet, complain);
  }
}
console.log(JSON.stringify({complaints, charts: Object.keys(charts).length, names, leaders}));
