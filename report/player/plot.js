// A quantity of all methods over time, with a play head; a click or a drag in it moves the head.

// the page names no address, not even that of a name space
const vectorSpace = (() => {
  const holder = document.createElement('div');
  holder.innerHTML = '<svg></svg>';
  return holder.firstChild.namespaceURI;
})();

const svg = (name, attributes = {}, ...children) => {
  const element = document.createElementNS(vectorSpace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};

/** Round numbers between low and high, about `count` of them. */
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find(s => s * power >= rough * 0.999) * power;
  const list = [];
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
function powerTicks(low, high, count) {
  const step = Math.max(1, Math.ceil((high - low) / count)), list = [];
  for (let n = Math.ceil(low / step) * step; n <= high; n += step) {
    const digits = String(Math.abs(n)).split('').map(d => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]).join('');
    list.push({value: n, text: `10${n < 0 ? '⁻' : ''}${digits}`});
  }
  return list;
}

class Plot {
  /**
   * `series`: {values, colour, dash, well, failure} of each method; with `powers` the values are exponents of ten.
   * `seek` is called with a time in s.
   */
  constructor(box, {label, times, series, title, powers}, seek) {
    Object.assign(this, {box, label, times, series, title, powers, high: 168});
    this.range();
    const at = event => {
      const {left} = box.getBoundingClientRect();
      seek((event.clientX - left - this.left) / (this.wide - this.left - this.right) * times[times.length - 1]);
    };
    box.addEventListener('pointerdown', event => (box.setPointerCapture(event.pointerId), at(event)));
    box.addEventListener('pointermove', event => event.buttons && at(event));
    new ResizeObserver(() => this.draw()).observe(box);
  }

  /** From the runs that went well, so that one that failed leaves the others their shape. */
  range() {
    const well = this.series.filter(s => s.well);
    const all = (well.length ? well : this.series).flatMap(s => s.values).filter(v => v !== null);
    const low = Math.min(...all), high = Math.max(...all), room = 0.06 * (high - low) || 0.05 * Math.abs(high) || 1;
    Object.assign(this, {low: low - room, most: high + room});
    if (!all.length) Object.assign(this, {low: 0, most: 1});
    // at least one whole power is in sight
    else if (this.powers) Object.assign(this, {low: Math.min(this.low, Math.floor(low)), most: Math.max(this.most, Math.ceil(high))});
  }

  draw(shown = this.shown) {
    this.shown = shown;
    this.wide = this.box.clientWidth;
    if (!this.wide) return;
    const end = this.times[this.times.length - 1], yTicks = (this.powers ? powerTicks : ticks)(this.low, this.most, 4);
    this.left = 14 + 7.2 * Math.max(...yTicks.map(t => t.text.length)) + 16;
    this.right = 10;
    const top = 8, foot = this.high - 36;
    const x = t => this.left + t / end * (this.wide - this.left - this.right);
    const y = v => foot - (v - this.low) / (this.most - this.low) * (foot - top);
    this.x = x;
    const root = svg('svg', {width: this.wide, height: this.high, role: 'img', 'aria-label': this.title});
    for (const {value, text} of yTicks)
      root.append(
          svg('line', {class: 'grid', x1: this.left, x2: this.wide - this.right, y1: y(value), y2: y(value)}),
          svg('text', {x: this.left - 6, y: y(value) + 4, 'text-anchor': 'end'}, text));
    for (const {value, text} of ticks(0, end, Math.max(3, Math.min(10, this.wide / 110))))
      root.append(
          svg('line', {class: 'grid', x1: x(value), x2: x(value), y1: top, y2: foot}),
          svg('text', {x: x(value), y: foot + 15, 'text-anchor': 'middle'}, text));
    root.append(
        svg('text', {x: (this.left + this.wide - this.right) / 2, y: this.high - 4, 'text-anchor': 'middle'}, 't / s'),
        svg('text', {transform: `translate(12 ${(top + foot) / 2}) rotate(-90)`, 'text-anchor': 'middle'}, this.label));
    // what a failed run did beyond the range is cut off at the frame
    const inside = svg(
        'svg', {x: 0, y: top, width: this.wide, height: foot - top, viewBox: `0 ${top} ${this.wide} ${foot - top}`});
    this.series.forEach((s, i) => {
      if (shown && !shown.includes(i)) return;
      const points = s.values.map(
          (v, f) =>
              (v === null ? '' : `${x(this.times[f]).toFixed(1)},${Math.max(-1e4, Math.min(1e4, y(v))).toFixed(1)}`));
      inside.append(
          svg('polyline',
              {points: points.join(' '), class: 'curve', style: `--own: ${s.colour}`, 'stroke-dasharray': s.dash}));
      if (s.failure === null) return;
      const at = `${x(Math.min(end, s.failure))} ${
          Math.max(top + 6, Math.min(foot - 6, y(s.values[s.values.length - 1] ?? this.most)))}`;
      inside.append(svg(
          'path',
          {class: 'curve cross', d: 'M-5-5L5 5M-5 5L5-5', transform: `translate(${at})`, style: `--own: ${s.colour}`}));
    });
    this.head = svg('line', {class: 'head', y1: top, y2: foot});
    root.append(
        inside, svg('path', {class: 'axes', d: `M${this.left} ${top}V${foot}H${this.wide - this.right}`}), this.head);
    this.box.replaceChildren(root);
    this.moveHead(this.time ?? 0);
  }

  moveHead(time) {
    this.time = time;
    if (this.head)
      for (const end of ['x1', 'x2']) this.head.setAttribute(end, this.x(time));
  }
}
