// Parts shared by all kinds of charts (chart.ts): numbers as text, scales, colours and marks of methods, placement of
// labels, axes.
// @ts-nocheck
export const chartParts = (() => {
  'use strict';

  const svgNames = 'http://www.w3.org/2000/svg';
  /** An SVG element with attributes and children. */
  const svg = (tag, attributes = {}, ...children) => {
    const element = document.createElementNS(svgNames, tag);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  };

  const ruler = document.createElement('canvas').getContext('2d');
  const letters = 12.5, lineHeight = 15;  // px, of charts
  /** Width of a text in px. */
  const widthOf = (text, bold = false) => {
    ruler.font = `${bold ? 'bold ' : ''}${letters}px "Liberation Sans", Arial, Helvetica, sans-serif`;
    return ruler.measureText(text).width;
  };

  // Numbers.

  const superscript = number => String(number).replace(/[-\d]/g, sign => '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'['-0123456789'.indexOf(sign)]);
  const prefixes = {'-12': 'p', '-9': 'n', '-6': 'µ', '-3': 'm', 0: '', 3: 'k', 6: 'M', 9: 'G'};

  /** A value with its unit, three digits at most: "1.5 ms", "30 %", "10⁻⁷". */
  const nice = (value, unit = '') => {
    if (value === 0) return unit && unit !== '1' ? `0 ${unit}` : '0';
    const size = Math.abs(value), rounded = Number(value.toPrecision(3));
    if (size < 1e-12 || unit === '%' || unit === '1' || !unit || /[^a-zA-Z]/.test(unit)) {
      const tail = unit && unit !== '1' ? ` ${unit}` : '';
      if (size >= 1e-4 && size < 1e5) return `${rounded}${tail}`;
      const power = Math.floor(Math.log10(size) + 1e-9), front = Number((value / 10 ** power).toPrecision(3));
      return `${front === 1 ? '' : `${front} × `}10${superscript(power)}${tail}`;
    }
    const step =
        Math.max(-12, Math.min(unit === 's' || unit === 'm' ? 0 : 9, 3 * Math.floor(Math.log10(size) / 3 + 1e-9)));
    return `${Number((value / 10 ** step).toPrecision(3))} ${prefixes[step]}${unit}`;
  };

  // Scales: a value's place in px, and ticks.

  const linear = (low, high, from, to) => {
    const span = high - low || 1, rough = span / Math.max(2, Math.abs(to - from) / 80);
    const power = 10 ** Math.floor(Math.log10(rough)), step = [1, 2, 5, 10].find(k => k * power >= rough) * power;
    const ticks = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * span; ++k)
      ticks.push(Number((k * step).toPrecision(12)));
    return {at: value => from + (to - from) * (value - low) / span, ticks, low, high};
  };

  const logarithmic = (low, high, from, to, apart = 46) => {
    const a = Math.log10(low), b = Math.log10(high), decades = b - a;
    const room = Math.abs(to - from) / apart, every = Math.max(1, Math.ceil(decades / room));
    const fronts = decades < 1.5 ? [1, 2, 5] : decades < 3 && room > 2 * decades ? [1, 3] : [1];
    const ticks = [];
    for (let k = Math.floor(a); k <= Math.ceil(b); ++k)
      if (k % every === 0)
        for (const front of fronts) {
          const tick = Number(`${front}e${k}`);
          if (tick >= low * (1 - 1e-9) && tick <= high * (1 + 1e-9)) ticks.push(tick);
        }
    if (ticks.length < 2) ticks.splice(0, 2, Number(low.toPrecision(2)), Number(high.toPrecision(2)));
    return {at: value => from + (to - from) * (Math.log10(value) - a) / decades, ticks, low, high};
  };

  const scale = (axis, [low, high], from, to) => (axis.log ? logarithmic : linear)(low, high, from, to, axis.apart);

  /** Both ends of an axis: as given, or around the values. */
  const rangeOf = (axis, values) => {
    const seen = values.filter(v => Number.isFinite(v) && (!axis.log || v > 0));
    let low = axis.low ?? Math.min(...seen), high = axis.high ?? Math.max(...seen);
    if (axis.log) {
      if (axis.low == null) low /= 1.4;
      if (axis.high == null) high *= 1.4;
      if (!(high > low)) low /= 2, high *= 2;
    } else {
      if (axis.low == null && low > 0 && low < 0.4 * high) low = 0;
      const room = high > low ? 0.04 * (high - low) : Math.abs(high) || 1;
      if (axis.high == null) high += room;
      if (axis.low == null && low !== 0) low -= room;
    }
    return [low, high];
  };

  // Looks: the colour of a method is that of its family, everywhere.

  const marks = {
    circle: r => `M${- r},0a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${- 2 * r},0`,
    square: r => `M${- r},${- r}h${2 * r}v${2 * r}h${- 2 * r}z`,
    diamond: r => `M0,${- 1.3 * r}L${1.3 * r},0L0,${1.3 * r}L${- 1.3 * r},0z`,
    triangle: r => `M0,${- 1.2 * r}L${1.15 * r},${0.9 * r}H${- 1.15 * r}z`,
    down: r => `M0,${1.2 * r}L${1.15 * r},${- 0.9 * r}H${- 1.15 * r}z`,
    cross: r => `M${- r},${- r}L${r},${r}M${- r},${r}L${r},${- r}`
  };
  const others =
      ['var(--mysim)', 'var(--bullet)', 'var(--outside)', 'var(--difference)', 'var(--mysim2)', 'var(--bullet2)'];
  const otherMarks = ['circle', 'square', 'triangle', 'diamond'],
        sceneMarks = ['circle', 'square', 'diamond', 'triangle'];

  /** Looks of the series of a chart: {colour, mark, hero, text} for each. */
  const looksOf = (series, methods) => {
    let free = 0;
    const few = series.filter(s => s.line !== false).length <= 4;
    return series.map(s => {
      const known = methods[s.method];
      if (s.beside) return {colour: 'var(--soft)', mark: 'circle', hero: true, text: s.name};
      if (!known) return {colour: others[free % 6], mark: otherMarks[free++ % 4], hero: true, text: s.name};
      const hero = s.hero ?? (known.hero || few);
      return {
        colour: hero ? `var(--${known.colour})` : 'var(--grey)',
        own: `var(--${known.colour})`,
        mark: known.mark,
        hero,
        text: s.name === s.method ? known.title : s.name
      };
    });
  };

  // Labels: each finds a place that no other has, or waits until it is pointed at.

  class Places {
    constructor(width, height) { Object.assign(this, {width, height, taken: []}); }
    free(box) {
      return box.left >= 0 && box.left + box.width <= this.width && box.top >= 0 &&
          box.top + box.height <= this.height &&
          !this.taken.some(
              other => box.left < other.left + other.width && other.left < box.left + box.width &&
                  box.top < other.top + other.height && other.top < box.top + box.height);
    }
    /**
     * The first of the places (left, baseline) at which the text, or lines of text, is free; null where there is none.
     */
    take(text, places, bold) {
      const lines = [text].flat(), width = Math.max(...lines.map(line => widthOf(line, bold)));
      for (const [x, y, anchor] of places) {
        const left = anchor === 'end' ? x - width : anchor === 'middle' ? x - width / 2 : x;
        const box = {
          left: left - 2,
          top: y - letters + 1,
          width: width + 4,
          height: letters + 2 + lineHeight * (lines.length - 1)
        };
        if (!this.free(box)) continue;
        this.taken.push(box);
        return [left, y];
      }
      return null;
    }
    keep(left, top, width, height) { this.taken.push({left, top, width, height}); }
  }

  const label = (text, [x, y], attributes = {}) => svg('text', {x, y, class: 'halo', ...attributes}, text);

  /** Words in lines that are no wider. */
  const wrapped = (text, width) => {
    const lines = [];
    for (const word of text.split(' ')) {
      const longer = lines.length ? `${lines[lines.length - 1]} ${word}` : word;
      if (lines.length && widthOf(longer) <= width)
        lines[lines.length - 1] = longer;
      else
        lines.push(word);
    }
    return lines;
  };

  /** Places for the name of a point: beside it, then above and below, further and further. */
  const around = ([x, y], width) => {
    const places = [];
    for (const away of [0, 13, -13, 26, -26, 39, -39]) places.push([x + 9, y + 4 + away]);
    for (const away of [-10, 19]) places.push([x, y + away, 'middle']);
    for (const away of [0, 13, -13, 26, -26, 39, -39, 52]) places.push([x - 9, y + 4 + away, 'end']);
    return places.filter(([left]) => left < width);
  };

  /** Places right of the end of a line, further and further up and down. */
  const besideEnd = ([x, y]) => Array.from({length: 17}, (_, k) => [x + 9, y + 4 + 7 * (k % 2 ? -(k + 1) : k)]);

  // Axes.

  /** A quantity in bold and what else is said of it: the first of these [bold, plain] that is no wider. */
  const fitting = (width, ...texts) => {
    const [bold, plain] =
        texts.find(([quantity, more]) => widthOf(quantity, true) + widthOf(more) <= width) ?? texts[texts.length - 1];
    return svg('text', {class: 'axis'}, svg('tspan', {class: 'quantity'}, bold), svg('tspan', {}, plain));
  };

  const titleOf = (axis, width = Infinity) => {
    const unit = axis.unit && axis.unit !== '1' && !['s', 'm', '%'].includes(axis.unit) ? `, ${axis.unit}` : '';
    const quantity = axis.label === 't' ? 'Time' : axis.label.charAt(0).toUpperCase() + axis.label.slice(1);
    return fitting(width, ...[...(axis.more ?? []), ''].map(more => [quantity, more || unit]));
  };

  const tickText = (axis, value) => nice(value, ['s', 'm', '%'].includes(axis.unit) ? axis.unit : '');

  /** Grid lines and tick texts below and at the left; the title of y stands above it, that of x below it. */
  const axes = (root, chart, x, y, frame) => {
    const {left, right, top, bottom} = frame;
    for (const tick of y.ticks) {
      const bold = chart.motion && [0.1, 1, 10].includes(tick);
      root.append(
          svg('line', {class: bold ? 'measure' : 'grid', x1: left, x2: right, y1: y.at(tick), y2: y.at(tick)}),
          svg('text', {x: left - 6, y: y.at(tick) + 4, 'text-anchor': 'end', class: bold ? 'bold' : ''},
              tickText(chart.y, tick)));
    }
    root.append(svg('line', {class: 'base', x1: left, x2: right, y1: bottom, y2: bottom}));
    let end = -Infinity;
    const ticks = chart.categories ?? x.ticks.map(tick => [tick, tickText(chart.x, tick)]);
    for (const [tick, text] of ticks) {
      const at = x.at(tick), half = widthOf(text) / 2;
      if (at - half < end + 8 && !chart.categories) continue;
      end = at + half;
      root.append(
          svg('line', {class: 'base', x1: at, x2: at, y1: bottom, y2: bottom + 5}),
          svg('text',
              frame.slanted ?
                  {x: at, y: bottom + 14, 'text-anchor': 'end', transform: `rotate(-35 ${at} ${bottom + 14})`} :
                  {x: Math.min(at, frame.width - half), y: bottom + 18, 'text-anchor': 'middle'},
              text));
      if (chart.duration)
        root.append(
            svg('text', {x: at, y: bottom + 34, 'text-anchor': 'middle', class: 'soft'},
                `${Number((chart.duration / tick).toPrecision(1)).toLocaleString('en').replaceAll(',', '\u202f')} ×`));
    }
    const yTitle = titleOf(chart.y, frame.width), xTitle = titleOf(chart.x, frame.width - 4);
    yTitle.setAttribute('x', 0), yTitle.setAttribute('y', 13);
    const half = Math.min(
        frame.width / 2, (widthOf(xTitle.firstChild.textContent, true) + widthOf(xTitle.lastChild.textContent)) / 2);
    xTitle.setAttribute('x', Math.max(half, Math.min((left + right) / 2, frame.width - half))),
        xTitle.setAttribute('y', frame.height - 4);
    xTitle.setAttribute('text-anchor', 'middle');
    root.append(yTitle, xTitle);
  };

  /** A mark that says what its run is, and plays it where there is one. */
  const mark = (shape, size, [x, y], look, tip, filled = true) => {
    const path = svg('path', {
      d: marks[shape](size),
      transform: `translate(${x.toFixed(1)},${y.toFixed(1)})`,
      class: shape === 'cross' ? 'mark cross' :
          filled               ? 'mark' :
                                 'mark open',
      style: `--own: ${look.colour}`
    });
    if (tip?.words) path.dataset.words = tip.words, path.setAttribute('aria-label', tip.words);
    if (tip?.run) path.dataset.run = tip.run;
    return path;
  };

  /** Thinned to what a screen shows: the places of a line, at most one in a third of a px. */
  const pathOf = places => {
    let text = '', last = null;
    for (const [x, y] of places) {
      if (last && Math.abs(x - last[0]) < 0.3 && Math.abs(y - last[1]) < 0.3) continue;
      text += `${text ? 'L' : 'M'}${x.toFixed(1)},${y.toFixed(1)}`;
      last = [x, y];
    }
    return text;
  };

  return {
    svg,
    letters,
    lineHeight,
    widthOf,
    nice,
    linear,
    logarithmic,
    scale,
    rangeOf,
    marks,
    sceneMarks,
    looksOf,
    Places,
    label,
    wrapped,
    around,
    besideEnd,
    fitting,
    titleOf,
    tickText,
    axes,
    mark,
    pathOf
  };
})();
