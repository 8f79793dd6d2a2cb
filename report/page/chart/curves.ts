// Curves, points and failures over two axes, with labels at the ends of curves. At most six curves are coloured; others
// are grey until the reader points at them.

import {Axis, axisOf, categoryTicks, Frame, levelTicks, linesOfTitle, nice, titleBelow, titleOf, uprightTicks, widthOfTicks} from './axes';
import {Board, boxesAround, boxesBeside, boxOfLines, Candidate, clipped, dense, isInside, nearestOf, pushedApart} from './board';
import {Box, Element, element, group, key, KeyEntry, label, lineHeight, mark, pathOf, PlacedName, rectangle, rounded, saying, segment, Sheet, widthOf, wrapped} from './sheet';
import {CurvesSpec, GuideSpec, Pair, PartSpec, SeriesSpec} from './spec';

interface Placed {
  part: PartSpec;
  index: number;
  colour: string;
  series: {spec: SeriesSpec, points: Pair[], runs: Pair[][]}[];  // runs: sections of the line within the axes
  crosses: Pair[];
}

const strip = 11;  // px, height of a row of failures

/** Rows of the crosses. The crosses of a part share a row if there is space. */
function rowsOf(places: readonly number[][]): {rows: number[][], count: number} {
  const taken: number[][] = [];
  const free = (row: number, all: readonly number[]) =>
      all.every(x => (taken[row] ?? []).every(other => Math.abs(other - x) >= 9));
  const rows = places.map(all => {
    let row = 0;
    while (row < 5 && !free(row, all)) ++row;
    (taken[row] ??= []).push(...all);
    return all.map(() => row);
  });
  return {rows, count: taken.length};
}

class CurvesLayout {
  private readonly elements: Element[] = [];
  private readonly names: PlacedName[] = [];
  private readonly unplaced: KeyEntry[] = [];
  private readonly frame: Frame;
  private readonly x: Axis;
  private readonly y: Axis;
  private readonly parts: Placed[];
  private readonly board: Board;
  private readonly column = new Set<PartSpec>();  // parts with labels to the right of the plot
  private readonly height: number;
  private readonly marksLower: boolean;  // true: marks below the axis are drawn on the axis, as triangles

  constructor(private readonly chart: CurvesSpec, private readonly width: number, private readonly colours: Colours) {
    this.marksLower = chart.key.some(entry => entry.mark === 'down');
    const high = chart.flat ? Math.min(300, Math.max(210, 0.55 * width)) : Math.min(500, Math.max(300, 0.58 * width));
    const titles = linesOfTitle(axisOf(chart.y, 1, 0, 40).title, width);
    const above: Element[] = [], keyHigh = key(above, this.keyEntries(), 0, lineHeight * titles + 4, width);
    const upright = axisOf(chart.y, high, 0, 38), left = Math.ceil(12 + widthOfTicks(upright));
    const right = this.chooseColumn();
    // rows of crosses are placed along the top
    const level = axisOf(chart.x, left, right, 70);
    const {rows, count} = rowsOf(chart.parts.map(part => part.failures.map(f => level.at(f.x))));
    const head = lineHeight * titles + keyHigh + 8, top = head + (count ? strip * count + 8 : 4), bottom = top + high;
    this.frame = {left, right, top, bottom};
    this.x = level;
    this.y = axisOf(chart.y, bottom, top, 38);
    this.board = new Board({left: left + 2, right: width, top: top + 1, bottom: bottom - 1});
    this.parts = chart.parts.map((part, index) => this.placed(part, index, rows[index], head));
    this.elements.push(...titleOf(this.y.title, 0, 13, width), ...above);
    const below = this.drawAxes();
    this.drawParts();
    for (const guide of chart.guides ?? []) this.drawGuide(guide);
    this.drawTake();
    this.placeNames();
    this.height = below + key(this.elements, this.unplaced, 0, below, width);
  }

  sheet(): Sheet {
    const paths = this.parts.map(part => part.series.flatMap(s => s.runs)), {width, elements, names} = this;
    return {width, height: Math.ceil(this.height), elements, names, paths, notes: []};
  }

  private keyEntries(): KeyEntry[] {
    const {parts, key} = this.chart, entries: KeyEntry[] = [];
    const keyed = parts.filter(part => part.keyed && part.hero),
          others = parts.filter(part => part.keyed && !part.hero);
    for (const part of keyed) entries.push(this.entryOf(part));
    if (others.length) {
      const one = others.find(part => part.series.length)?.series[0];
      entries.push({
        text: others.length === 1 ? others[0].name : `${others.length} others`,
        sample: (x, y) => mark(one?.mark ?? 'circle', [x, y], 4, true, {}, 'var(--grey)')
      });
    }
    for (const {text, mark: name, open} of key) {
      const failed = parts.reduce((sum, part) => sum + part.failures.filter(f => f.kind === text).length, 0);
      entries.push({
        text: failed ? `${text}: ${failed} run${failed > 1 ? 's' : ''}` : text,
        sample: (x, y) => name ? mark(name, [x, y], 4, Boolean(open), {}, 'var(--soft)') :
                                 element('path', {class: 'pareto', d: `M${x - 9},${y}H${x + 9}`})
      });
    }
    return entries;
  }

  private entryOf(part: PartSpec): KeyEntry {
    const own = part.series.find(s => s.mark) ?? part.series[0], colour = this.colours(part), {dash, line} = own ?? {};
    return {
      text: part.name,
      method: part.method,
      sample: (x, y) => group(
          colour, part.method,
          ...(line ? [element('path', {class: 'line', d: `M${x - 9},${y}H${x + 9}`, ...dashes(dash)})] : []),
          ...(own?.mark                  ? [mark(own.mark, [x, y], 4, Boolean(own.open))] :
                  part.failures[0]?.mark ? [mark(part.failures[0].mark, [x, y], 4, false)] :
                                           []))
    };
  }

  /** Puts labels of curves that end at the right into a column. Returns the plot's right edge. */
  private chooseColumn(): number {
    const {chart, width} = this, bare = axisOf(chart.x, 0, 1, 70);
    const edge =
        width - (chart.categories ? 8 : Math.max(10, widthOf(bare.ticks[bare.ticks.length - 1]?.text ?? '') / 2));
    if (width < 500) return edge;
    let widest = 0;
    for (const part of chart.parts) {
      const ends = part.series.filter(s => s.line && s.points.length > 1).map(s => s.points[s.points.length - 1][0]);
      const wide = widthOf(part.name, true) + 30;
      if (!part.hero || part.keyed || !ends.some(x => bare.at(x) > 0.93) || wide > 0.36 * width) continue;
      this.column.add(part), widest = Math.max(widest, wide);
    }
    return Math.min(edge, width - widest);
  }

  private placed(part: PartSpec, index: number, rows: readonly number[], head: number): Placed {
    const {frame} = this, {left, right} = frame;
    return {
      part,
      index,
      colour: this.colours(part),
      series: part.series.map(spec => {
        const points = spec.points.map(([x, y]): Pair => [this.x.at(x), this.y.at(y)]);
        return {
          spec,
          points,
          runs: spec.line ? clipped(points, frame) : points.filter(at => isInside(at, frame)).map(at => [at])
        };
      }),
      crosses: part.failures.map(
          (f, k): Pair => [Math.max(left, Math.min(right, this.x.at(f.x))), head + 6 + strip * rows[k]])
    };
  }

  /** Returns the y below the horizontal axis and its title. */
  private drawAxes(): number {
    const {chart, frame, elements, width} = this, {left, right, top, bottom} = frame;
    if (chart.window !== undefined) {
      const from = Math.max(left, this.x.at(chart.window));
      if (from < right) elements.push(rectangle('beyond', from, top, right - from, bottom - top));
    }
    elements.push(...uprightTicks(this.y, frame), segment('base', left, bottom, right, bottom));
    let high = 22;
    if (chart.categories) {
      const ticks = categoryTicks(chart.categories, this.x, frame, width);
      elements.push(...ticks.elements);
      high = ticks.high;
    } else {
      elements.push(...levelTicks(this.x, frame, width));
    }
    return titleBelow(elements, this.x.title, frame, bottom + high + 15, width) + 4;
  }

  private drawParts() {
    const {chart, elements, board, y} = this;
    if (chart.pareto?.length) {
      const stairs: Pair[] = [];
      for (const [px, py] of chart.pareto) {
        const place: Pair = [this.x.at(px), Math.min(this.frame.bottom, y.at(py))];
        if (stairs.length) stairs.push([place[0], stairs[stairs.length - 1][1]]);
        stairs.push(place);
        if (isBelow(py, y.low)) break;  // the stairs end at the axis, and do not follow it
      }
      elements.push(element('path', {class: 'pareto', d: pathOf(stairs)}));
      board.addLine(stairs, true);
    }
    for (const hero of [false, true])
      for (const placed of [...this.parts].reverse())
        if (Boolean(placed.part.hero) === hero) this.drawPart(placed);
  }

  private drawPart({part, index, colour, series, crosses}: Placed) {
    const hero = Boolean(part.hero), {board} = this;
    const own = group(colour, part.method), {attributes, children} = own;
    attributes['data-place'] = (hero ? 0 : 1000) + index;
    if (!hero) Object.assign(attributes, {class: 'series', style: `--own: var(--grey); --lit: ${colour}`});
    for (const {spec, points, runs} of series) {
      if (spec.line && runs.some(run => run.length > 1)) {
        const d = runs.map(pathOf).join(''), [px, py] = spec.points[spec.points.length - 1];
        children.push(element('path', {class: 'line', d, ...(hero ? dashes(spec.dash) : {})}));
        if (!spec.mark || spec.few)
          children.push(element('path', {class: 'hit', d, ...saying(`${spec.title}\n${this.words(px, py)}`)}));
        for (const run of runs) board.addLine(run, !hero);
      }
      if (!spec.mark || (spec.few && !hero)) continue;
      const every = spec.few ? Math.max(1, Math.floor(points.length / 8)) : 1;
      points.forEach((place, k) => {
        if (k % every) return;
        const below = isBelow(spec.points[k][1], this.y.low);
        if (below ? !this.marksLower : !isInside(place, this.frame)) return;
        const open = spec.open || Boolean(spec.scaled?.[k]);
        const tip = spec.few ? {} : spec.tips?.[k] ?? {words: `${spec.title}\n${this.words(...spec.points[k])}`};
        const at: Pair = below ? [place[0], this.frame.bottom - 5] : place;
        children.push(mark(below ? 'down' : spec.mark ?? 'circle', at, hero ? 4 : 3, open, tip));
        if (!spec.few || hero) board.addMark(at);
      });
    }
    part.failures.forEach(
        (f, k) => children.push(mark(
            f.mark ?? 'cross', crosses[k], 3.5, false, {words: f.words ?? `${part.name}: ${f.kind}`, run: f.run})));
    this.elements.push(own);
  }

  private words(px: number, py: number) {
    const {x, y} = this.chart, time = x.label === 't' || x.label === 'time';
    return `${nice(py, y.unit)}${time ? ' at' : `, ${x.label}`} ${nice(px, x.unit)}`;
  }

  private drawGuide({axis, at, text, kind = 'guide'}: GuideSpec) {
    const {left, right, top, bottom} = this.frame, {board, elements} = this, level = axis === 'y';
    const place = rounded(level ? this.y.at(at) : this.x.at(at));
    if (level ? place < top || place > bottom + 0.5 : place < left || place > right) return;
    const ends: Pair[] = level ? [[left, place], [right, place]] : [[place, top], [place, bottom]];
    elements.push(element('path', {class: kind, d: pathOf(ends)}));
    const lines = level ? [text] : wrapped(text, Math.max(140, place - left - 12)),
          wide = Math.max(...lines.map(line => widthOf(line)));
    const boxes = Array.from({length: 10}, (_, k): Candidate[] => {
      const from = right - wide - 4 - k / 9 * (right - wide - left - 10), up = bottom - 8 - k / 10 * (bottom - top);
      const spots = level ? [[from, place - 5], [from, place + 14]] : [[place - 6 - wide, up], [place + 6, up]];
      return spots.map(([x, y]) => ({box: boxOfLines(lines, x, y - lineHeight * (lines.length - 1)), penalty: k}));
    });
    const box = board.take(boxes.flat().filter(each => each.box.left >= left && each.box.right <= right));
    board.addLine(ends, false);
    const sample = (x: number, y: number) =>
        element('path', {class: kind, d: level ? `M${x - 9},${y}H${x + 9}` : `M${x},${y - 8}V${y + 8}`});
    if (box)
      lines.forEach(
          (line, k) =>
              elements.push(label(line, box.left, box.top + 9.5 + lineHeight * k, 'start', {class: 'halo soft'})));
    else
      this.unplaced.push({text, sample});
  }

  private drawTake() {
    const {take, parts} = this.chart;
    if (!take) return;
    const near = (a: number, b: number) => Math.abs(a - b) <= 1e-3 * Math.abs(b);
    const own =
        parts.find(part => part.series.some(s => s.points.some(([x, y]) => near(x, take.x) && near(y, take.y))));
    const colour = own ? this.colours(own) : 'var(--ink)', at: Pair = [this.x.at(take.x), this.y.at(take.y)];
    const lines = [take.name, take.more], box = this.board.take(boxesAround(lines, at, true));
    const ring = (x: number, y: number, r: number) =>
        element('circle', {class: 'ring', cx: rounded(x), cy: rounded(y), r});
    const words = (box: Box) => lines.map(
        (line, k) => label(line, box.left, box.top + 9.5 + lineHeight * k, 'start', {class: k ? 'halo' : 'halo name'}));
    this.elements.push(group(
        colour, own?.method, ring(...at, 9), ...(box ? [leader([at, nearestOf(box, at)], 9), ...words(box)] : [])));
    if (!box) this.unplaced.push({text: lines.join(': '), sample: (x, y) => ring(x, y, 6)});
  }

  private placeNames() {
    const {left, right, top, bottom} = this.frame, named = this.parts.filter(({part}) => part.hero && !part.keyed);
    const pathsOf = ({series}: Placed) => series.flatMap(s => s.runs);
    const endOf = (placed: Placed) =>
        pathsOf(placed).map(path => path[path.length - 1]).reduce((a, b) => (b[0] > a[0] ? b : a), [-Infinity, 0]);
    const inColumn = (placed: Placed) => this.column.has(placed.part) && pathsOf(placed).length > 0;
    const column = named.filter(inColumn), ends = column.map(endOf);
    const heights = pushedApart(ends.map(end => end[1]), top + 6, bottom - 4, lineHeight);
    column.forEach((placed, k) => {
      const y = heights[k], text = placed.part.name, from = right + 26, end = ends[k];
      const box = {left: from, right: from + widthOf(text, true), top: y - 6, bottom: y + 6};
      const sign = placed.series.find(s => s.spec.mark)?.spec;
      this.board.add({...box, left: right + 2});
      this.addName(
          placed, {text, box, part: placed.index, leader: true},
          end[0] > left ? [end, [right + 2, end[1]], [right + 12, y]] : [],
          sign && mark(sign.mark ?? 'circle', [right + 18, y], 3.5, Boolean(sign.open)));
    });
    for (const placed of named.filter(each => !inColumn(each))) {
      const {part, index} = placed, paths = pathsOf(placed), text = part.name;
      const others =
          this.parts.filter(each => each !== placed).flatMap(each => pathsOf(each).flatMap(path => dense(path)));
      const beside = paths.length ? this.board.take(boxesBeside(text, paths.map(path => dense(path)), others)) : null;
      const end = endOf(placed), joined = !beside && paths.length && this.width >= 500;
      const box = joined ? this.board.take(boxesAround([text], end, true)) : beside;
      if (box)
        this.addName(placed, {text, box, part: index, leader: !beside}, beside ? [] : [end, nearestOf(box, end)]);
      else
        this.unplaced.push(this.entryOf(part));
    }
  }

  private addName({part, colour}: Placed, name: PlacedName, way: Pair[], sign?: Element) {
    this.names.push(name);
    this.elements.push(group(
        colour, part.method, ...(way.length ? [leader(way, way.length > 2 ? 0 : 5)] : []), ...(sign ? [sign] : []),
        label(name.text, name.box.left, (name.box.top + name.box.bottom) / 2 + 4.3, 'start', {class: 'halo name'})));
  }
}

/** A leader line that starts at a distance `gap` from its first point. */
function leader(way: readonly Pair[], gap: number): Element {
  const [[x, y], [toX, toY]] = way, length = Math.hypot(toX - x, toY - y) || 1, part = Math.min(1, gap / length);
  return element('path', {class: 'leader', d: pathOf([[x + part * (toX - x), y + part * (toY - y)], ...way.slice(1)])});
}

const dashes = (dash: string|undefined): Record<string, string> =>
    dash ? {'stroke-dasharray': dash.split(' ').map(each => rounded(0.8 * Number(each))).join(' ')} : {};

const isBelow = (y: number, low: number) => y < low - 1e-9 * Math.abs(low);

export type Colours = (part: {colour: string, method?: string}) => string;

export const curves = (chart: CurvesSpec, width: number, colours: Colours): Sheet =>
    new CurvesLayout(chart, width, colours).sheet();
