// Charts of the page, drawn from the numbers that stand in it (chart_json.h): curves over two axes, stacked bars, dots
// with intervals, maps of cells. Names stand at the ends of curves; the methods in question have a colour, the others
// are grey until they are pointed at.
// @ts-nocheck

import {chartParts} from './chart_parts';
export const charts = (() => {
  'use strict';

  const {
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
  } = chartParts;

  // Curves.

  /** A chart whose y is a length, as one in % of the motion. */
  const inPercent = chart => {
    const part = length => 100 * length / chart.motion, inside = points => points.map(([x, y]) => [x, part(y)]);
    return {
      ...chart,
      x: {
        ...chart.x,
        more: chart.duration ? [', and how many times faster than real time', ', times real time', ''] : []
      },
      y: {
        ...chart.y,
        unit: '%',
        apart: 24,
        low: chart.y.low == null ? null : part(chart.y.low),
        high: null,
        more: [`, in % of the motion (${nice(chart.motion, 'm')}) and in mm`, ', % of the motion', ', %']
      },
      series: chart.series.map(s => ({...s, points: inside(s.points)})),
      pareto: inside(chart.pareto ?? []),
      floor: chart.floor && {...chart.floor, y: part(chart.floor.y)},
      take: chart.take && { ...chart.take, y: part(chart.take.y) }
    };
  };

  const curves = (root, given, methods, width) => {
    const chart = given.motion ? inPercent(given) : given;
    const slanted = chart.categories?.some(([, text]) => widthOf(text) > 0.75 * width / chart.categories.length);
    const height = slanted ? 420 :
        chart.flat         ? Math.min(300, Math.max(210, 0.55 * width)) :
                             Math.min(540, Math.max(330, 0.62 * width));
    const looks = looksOf(chart.series, methods), all = [], xs = [], ys = [];
    for (const s of chart.series)
      for (const [px, py] of s.points) xs.push(px), ys.push(py);
    // early failures are stated but do not stretch the axis
    const soonest = chart.motion && xs.length ? Math.min(...xs) / (width < 600 ? 3 : 12) : -Infinity;
    for (const f of chart.failures ?? []) xs.push(Math.max(f.x, soonest));
    if (chart.critical) xs.push(chart.critical.x / 1.2);
    if (chart.floor && !(chart.y.low > chart.floor.y)) ys.push(chart.floor.y);
    const xRange = rangeOf(chart.x, xs), yRange = rangeOf(chart.y, ys.length ? ys : [0.1, 1]);
    const probe = scale(chart.y, yRange, height, 0);
    const left = 10 + Math.max(...probe.ticks.map(tick => widthOf(tickText(chart.y, tick))));
    const ending = Math.max(
        0, ...chart.series.map((s, i) => (looks[i].hero && s.points.length ? widthOf(looks[i].text, true) : 0)));
    const failing = (chart.failures ?? []).length > 0;
    const top = 26 + (failing ? 22 : 0), bottom = height - (slanted ? 110 : chart.duration ? 60 : 42);
    const right = width - (chart.categories ? 20 : Math.min(ending + 18, (chart.flat ? 0.34 : 0.24) * width, 170));
    const frame = {left, right, top, bottom, width, height, slanted};
    const x = scale(chart.x, xRange, left, right), y = scale(chart.y, yRange, bottom, top);
    const inside = ([px, py]) => [Math.max(left, Math.min(right, x.at(px))), Math.max(top, Math.min(bottom, y.at(py)))];
    root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.setAttribute('height', height);
    const places = new Places(width, height);
    places.keep(0, bottom + 1, width, height - bottom);  // the axis and its texts
    places.keep(0, 0, width, 18);
    places.keep(0, top, left - 2, bottom - top);
    if (chart.window) {
      const from = x.at(chart.window.x);
      root.append(
          svg('rect', {class: 'beyond', x: from, y: top, width: Math.max(0, right - from), height: bottom - top}));
      const at = places.take(chart.window.text, [[from + 6, top + 14], [right - 6, top + 14, 'end']]);
      if (at) root.append(label(chart.window.text, at, {class: 'halo soft'}));
    }
    if (chart.critical)
      root.append(svg(
          'rect',
          {class: 'beyond', x: left, y: top, width: Math.max(0, x.at(chart.critical.x) - left), height: bottom - top}));
    axes(root, chart, x, y, frame);
    if (chart.critical) critical(root, chart.critical, x, frame, places);
    for (const guide of chart.guides ?? []) {
      const place = guide.axis === 'x' ? x.at(guide.at) : y.at(guide.at);
      if (guide.axis === 'x' ? place < left || place > right : place < top || place > bottom) continue;
      root.append(
          svg('line',
              guide.axis === 'x' ? {class: 'guide', x1: place, x2: place, y1: top, y2: bottom} :
                                   {class: 'guide', x1: left, x2: right, y1: place, y2: place}));
      const at = places.take(
          guide.text,
          guide.axis === 'x' ? [[place + 5, bottom - 6], [place - 5, bottom - 6, 'end'], [place + 5, top + 26]] :
                               [[left + 4, place - 4], [right - 4, place - 4, 'end']]);
      if (at) root.append(label(guide.text, at, {class: 'halo soft'}));
    }
    if (chart.floor && chart.floor.y >= yRange[0]) {
      const at = y.at(chart.floor.y);
      root.append(svg('line', {class: 'floor', x1: left, x2: right, y1: at, y2: at}));
      const place =
          places.take(chart.floor.text, [[left + 4, at - 5], [right - 4, at - 5, 'end'], [left + 4, at + 14]]);
      if (place) root.append(label(chart.floor.text, place, {class: 'halo soft'}));
    }
    if (chart.pareto?.length) {
      const stairs = [];
      // down to the axis, not along it
      const far = chart.pareto.findIndex(([, py]) => py < yRange[0]);
      chart.pareto.slice(0, far < 0 ? undefined : far + 1).map(inside).forEach(([px, py], i) => {
        if (i) stairs.push([px, stairs[stairs.length - 1][1]]);
        stairs.push([px, py]);
      });
      root.append(svg('path', {class: 'pareto', d: pathOf(stairs)}));
    }
    const below = ([, py]) => py < yRange[0] * (1 - 1e-9);
    // the grey ones beneath
    const order = chart.series.map((_, i) => i).sort((a, b) => looks[a].hero - looks[b].hero);
    for (const i of order) {
      const s = chart.series[i], look = looks[i];
      if (!s.points.length) continue;
      const group = svg('g', {
        class: look.hero ? 'series hero' : 'series',
        style: `--own: ${look.colour}; --lit: ${look.own ?? look.colour}`
      });
      if (s.method) group.dataset.method = s.method;
      const at = s.points.map(inside);
      if (s.line !== false)
        group.append(svg(
            'path', {class: s.beside ? 'line dashed' : 'line', d: pathOf(at.filter((_, k) => !below(s.points[k])))}));
      if (s.marks !== false)
        at.forEach(
            (place, k) => group.append(
                below(s.points[k]) ?
                    mark('down', look.hero ? 4 : 3.5, [place[0], bottom - 4], look, s.tips?.[k], !s.open?.[k]) :
                    mark(look.mark, look.hero ? 4 : 3, place, look, s.tips?.[k], !s.open?.[k])));
      if (s.marks !== false) at.forEach(([px, py]) => places.keep(px - 4, py - 4, 8, 8));
      root.append(group);
      const seen = at.filter((_, k) => !below(s.points[k])),
            ends = seen.length ? seen : at;  // names are those of what is seen
      all.push({i, group, places: at, end: ends[ends.length - 1], first: ends[0]});
    }
    nameTogether(all.filter(one => looks[one.i].hero), looks);
    if (chart.motion)
      for (const tick of y.ticks.filter(tick => [0.1, 1, 10].includes(tick))) {
        const length = nice(chart.motion * tick / 100, 'm'), at = places.take(length, [
          [left + 5, y.at(tick) - 5], [right - 4, y.at(tick) - 5, 'end'], [right - 4, y.at(tick) + 14, 'end']
        ]);
        const shaded = chart.critical && at?.[0] < x.at(chart.critical.x);
        if (at) root.append(label(length, at, {class: 'halo soft', style: shaded ? '--back: var(--panel)' : ''}));
      }
    if (chart.take) take(root, chart, looks, [x.at(chart.take.x), y.at(chart.take.y)], places);
    // crosses stand above the frame at the cost that they had
    if (failing) {
      let end = left;
      for (const f of chart.failures) {
        const known = methods[f.method], colour = known?.hero ? `var(--${known.colour})` : 'var(--grey)';
        const px = Math.max(left, Math.min(right, x.at(f.x))), cross = mark('cross', 4, [px, top - 10], {colour}, f);
        places.keep(px - 4, top - 14, 8, 8);
        if (f.method) cross.dataset.method = f.method;
        root.append(cross);
        end = Math.max(end, x.at(f.x));
      }
      const word = chart.failures.length === 1 ? '1 run failed' : `${chart.failures.length} runs failed`;
      const place = places.take(word, [[Math.min(end + 10, width - widthOf(word) - 4), top - 6], [left, top - 6]]);
      if (place) root.append(label(word, place, {class: 'halo soft'}));
    }
    // along a bare line the end is the place; lines with marks are near their names anywhere
    const spotsOf = each => chart.series[each.i].marks === false ?
        besideEnd(each.end) :
        [...around(each.end, width - 20), ...around(each.first, width - 20)];
    for (const each of all.filter(one => one.names)) {
      const [px, py] = each.end;
      each.at = places.take(each.names, [...spotsOf(each), [px - 4, py - 6, 'end'], [px - 4, py + 15, 'end']], true);
      for (const one of each.at ? [] : each.over) one.beneath = false;  // no room for all: each for itself
    }
    for (const hero of [true, false])
      for (const each of all.filter(one => looks[one.i].hero === hero)) {
        const look = looks[each.i];
        const at =
            each.at ?? (!each.beneath && (hero || width >= 500) ? places.take(look.text, spotsOf(each), hero) : null);
        const text = label(
            each.at ? each.names : look.text,
            at ?? [Math.min(each.end[0] + 9, width - widthOf(look.text)), each.end[1] + 4],
            {class: at ? 'halo name' : 'halo name waiting'});
        each.group.append(text);
      }
    const runs = chart.series.flatMap(s => (s.marks === false ? [] : s.points)), low = runs.filter(below).length;
    const early = (chart.failures ?? []).filter(f => f.x < xRange[0]).length, beyond = [];
    if (low)
      beyond.push(`${low} of ${runs.length} runs are nearer than ${nice(yRange[0], '%')}: triangles on the axis.`);
    if (early)
      beyond.push(`${early} of ${
          chart.failures.length} failed runs ended sooner than the axis begins: crosses at its left end.`);
    if (chart.motion) return beyond.join(' ');
  };

  /** Of curves that lie on each other, within the width of a line, the one on top is to bear the names of all. */
  const nameTogether = (curves, looks) => {
    const lieTogether = (one, other) => one.places.length === other.places.length &&
        one.places.every(([x, y], k) => Math.hypot(x - other.places[k][0], y - other.places[k][1]) < 1.5);
    curves.forEach((top, k) => {
      top.over = curves.slice(0, k).filter(one => lieTogether(one, top));
      if (!top.over.length) return;
      for (const one of top.over) one.beneath = true, delete one.names;
      top.names = [top, ...top.over].map(one => looks[one.i].text).join(' and ');
    });
  };

  /** The critical step of the rule to take, and the shade in which no step of it holds. */
  const critical = (root, {x: at, name, beyond}, x, {left, top, bottom}, places) => {
    const px = x.at(at), long = widthOf(name);
    root.append(
        svg('line', {class: 'critical', x1: px, x2: px, y1: top, y2: bottom}),
        svg('text',
            {transform: `translate(${px - 5},${bottom - 8}) rotate(-90)`, class: 'halo', style: '--back: var(--panel)'},
            name));
    places.keep(px - 18, bottom - 12 - long, 22, long + 8);
    const lines = wrapped(beyond, px - left - 26),
          spot = px - left < 90 ?
        null :
        places.take(lines, [0.5, 0.7, 0.35, 0.2].map(part => [left + 6, top + part * (bottom - top)]));
    if (spot)
      lines.forEach(
          (line, k) => root.append(label(line, [spot[0], spot[1] + lineHeight * k], {style: '--back: var(--panel)'})));
  };

  /** A ring around the run to take, with its words. */
  const take = (root, chart, looks, [px, py], places) => {
    const near = (a, b) => Math.abs(a - b) <= 1e-4 * Math.abs(b);
    const of = chart.series.findIndex(s => s.points.some(([x, y]) => near(x, chart.take.x) && near(y, chart.take.y)));
    const colour = looks[of]?.own ?? looks[of]?.colour ?? 'var(--ink)', lines = [chart.take.name, chart.take.more];
    const group =
        svg('g', {class: 'take', style: `--lit: ${colour}`}, svg('circle', {class: 'ring', cx: px, cy: py, r: 9}));
    places.keep(px - 10, py - 10, 20, 20);
    const spots =
        [-16, 4, 18, -32, 34, -48, 50, -64, 66, 84].flatMap(dy => [[px + 15, py + dy], [px - 15, py + dy, 'end']]);
    const at = places.take(lines, spots, true) ?? spots[2].slice(0, 2);
    group.append(
        label(lines[0], at, {class: 'halo bold', style: `fill: ${colour}`}),
        label(lines[1], [at[0], at[1] + lineHeight], {style: `fill: ${colour}`}));
    root.append(group);
  };

  // Bars: what came in to the left of zero, where it went to the right.

  const bars = (root, chart, methods, width) => {
    const rows = chart.names.length, high = 24, top = 34,
          height = top + rows * high + 44 + 20 * Math.ceil(chart.parts.length / 3);
    const left = Math.min(0.36 * width, 12 + Math.max(...chart.names.map(name => widthOf(name)))), right = width - 16;
    const sums = chart.names.map(
        (_, k) => chart.parts.reduce(
            ([low, up], part) => [low + Math.min(0, part.height[k]), up + Math.max(0, part.height[k])], [0, 0]));
    const x = linear(Math.min(0, ...sums.map(s => s[0])), Math.max(...sums.map(s => s[1])), left, right),
          bottom = top + rows * high;
    root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.setAttribute('height', height);
    for (const tick of x.ticks)
      root.append(
          svg('line', {class: 'grid', x1: x.at(tick), x2: x.at(tick), y1: top, y2: bottom}),
          svg('text', {x: x.at(tick), y: bottom + 18, 'text-anchor': 'middle'}, nice(tick)));
    const title = titleOf(chart.x);
    title.setAttribute('x', left), title.setAttribute('y', 14);
    root.append(title);
    chart.names.forEach((name, k) => {
      const row = svg('g', {class: 'series hero'});
      if (methods[name]) row.dataset.method = name;
      const y = top + k * high;
      row.append(
          svg('text', {
            x: left - 8,
            y: y + high / 2 + 4,
            'text-anchor': 'end',
            style: methods[name] ? `fill: var(--${methods[name].colour})` : ''
          },
              methods[name]?.title ?? name));
      let low = 0, up = 0;
      for (const part of chart.parts) {
        const value = part.height[k], from = value < 0 ? low + value : up;
        if (value < 0)
          low += value;
        else
          up += value;
        if (!value) continue;
        const box = svg('rect', {
          x: x.at(from),
          y: y + 3,
          width: Math.max(0.5, x.at(from + Math.abs(value)) - x.at(from)),
          height: high - 6,
          class: part.hatched ? 'bar hatched' : 'bar',
          style: `--own: ${part.colour}`
        });
        box.dataset.words = `${name}\n${part.title}: ${nice(value, chart.x.unit)}`;
        row.append(box);
      }
      root.append(row);
    });
    root.append(svg('line', {class: 'base', x1: x.at(0), x2: x.at(0), y1: top, y2: bottom}));
    const third = (width - 16) / 3;
    chart.parts.forEach((part, k) => {
      const px = 4 + third * (k % 3), py = bottom + 40 + 20 * Math.floor(k / 3);
      root.append(
          svg('rect', {
            x: px,
            y: py - 10,
            width: 12,
            height: 12,
            class: part.hatched ? 'bar hatched' : 'bar',
            style: `--own: ${part.colour}`
          }),
          svg('text', {x: px + 18, y: py}, part.title));
    });
  };

  // Dots with intervals over a logarithmic axis: a line for each name.

  const dots = (root, chart, methods, width) => {
    const high = 22, headings = new Map(chart.headings ?? []), top = 34;
    const rows = chart.names.length + headings.size, bottom = top + rows * high;
    const looks = looksOf(chart.series.map(s => ({...s, hero: true})), methods);
    const values = chart.series.flatMap(s => s.dots.filter(Boolean).flatMap(d => [d[1], d[2]]));
    const left =
              Math.min(0.4 * width, 12 + Math.max(...chart.names.map(name => widthOf(methods[name]?.title ?? name)))),
          right = width - 16;
    const x = logarithmic(Math.min(...values) / 1.3, Math.max(...values) * 1.3, left, right), height = bottom + 44 + 20;
    root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.setAttribute('height', height);
    let end = -Infinity;
    for (const tick of x.ticks) {
      root.append(svg('line', {class: 'grid', x1: x.at(tick), x2: x.at(tick), y1: top, y2: bottom}));
      const text = tickText(chart.x, tick), half = widthOf(text) / 2;
      if (x.at(tick) - half < end + 8) continue;
      end = x.at(tick) + half;
      root.append(svg('text', {x: x.at(tick), y: bottom + 18, 'text-anchor': 'middle'}, text));
    }
    const title = titleOf(chart.x);
    title.setAttribute('x', 0), title.setAttribute('y', 14);
    root.append(title);
    let y = top;
    chart.names.forEach((name, k) => {
      if (headings.has(k)) root.append(svg('text', {x: 0, y: y + 15, class: 'quantity'}, headings.get(k))), y += high;
      root.append(
          svg('line', {class: 'grid', x1: left, x2: right, y1: y + high / 2, y2: y + high / 2}),
          svg('text', {x: left - 8, y: y + high / 2 + 4, 'text-anchor': 'end'}, methods[name]?.title ?? name));
      chart.series.forEach((s, j) => {
        const dot = s.dots[k];
        if (!dot) return;
        const [value, low, up] = dot;
        const group = svg('g', {class: 'series hero', style: `--own: ${looks[j].colour}; --lit: ${looks[j].colour}`});
        if (s.method ?? methods[name]) group.dataset.method = s.method ?? name;
        group.append(
            svg('line', {class: 'whisker', x1: x.at(low), x2: x.at(up), y1: y + high / 2, y2: y + high / 2}),
            mark(
                looks[j].mark, 4.5, [x.at(value), y + high / 2], looks[j],
                {words: `${name}\n${looks[j].text}: ${nice(value, chart.x.unit)}`}));
        root.append(group);
      });
      y += high;
    });
    let px = 4;
    chart.series.forEach((s, j) => {
      root.append(
          mark(looks[j].mark, 4.5, [px + 6, bottom + 40], looks[j]),
          svg('text', {x: px + 18, y: bottom + 44}, looks[j].text));
      px += 34 + widthOf(looks[j].text);
    });
  };

  // Maps: what became of each run over two logarithmic axes, in panels that share them.

  const map = (root, chart, methods, width) => {
    const columns = Math.max(1, Math.min(3, Math.floor(width / 300), chart.panels.length));
    const rows = Math.ceil(chart.panels.length / columns), wide = width / columns, high = Math.min(300, 0.8 * wide);
    const key = 24, height = rows * (high + 64) + key + 4;
    const cells = chart.panels.flatMap(p => p.cells);
    const apart = values => {
      const sorted = [...new Set(values.map(v => Math.round(1e6 * Math.log(v)) / 1e6))].sort((a, b) => a - b);
      let least = Infinity;
      for (let i = 1; i < sorted.length; ++i) least = Math.min(least, sorted[i] - sorted[i - 1]);
      return [
        Math.exp(sorted[0]), Math.exp(sorted[sorted.length - 1]), Number.isFinite(least) ? Math.exp(least / 2) : 1.1
      ];
    };
    root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.setAttribute('height', height);
    // the panels share their axes, and each has cells of its own size
    const sides = chart.panels.map(panel => [0, 1].map(i => apart(panel.cells.map(c => c[i]))));
    const ends = i =>
        [Math.min(...sides.map(side => side[i][0] / side[i][2])),
         Math.max(...sides.map(side => side[i][1] * side[i][2]))];
    chart.panels.forEach((panel, k) => {
      const left = (k % columns) * wide + 62, right = (k % columns + 1) * wide - 12,
            top = Math.floor(k / columns) * (high + 64) + 44, bottom = top + high - 20;
      const x = logarithmic(...ends(0), left, right), y = logarithmic(...ends(1), bottom, top),
            [[, , ownX], [, , ownY]] = sides[k];
      const group = svg('g', {class: 'series hero'});
      if (methods[panel.title]) group.dataset.method = panel.title;
      group.append(svg('text', {x: left, y: top - 8, class: 'quantity'}, methods[panel.title]?.title ?? panel.title));
      if (k % columns === 0) {
        const title = titleOf(chart.y);
        title.setAttribute('x', 0), title.setAttribute('y', top - 26);
        group.append(title);
      }
      panel.cells.forEach(([cx, cy, kind, words, run]) => {
        const box = svg('rect', {
          x: x.at(cx / ownX),
          width: x.at(cx * ownX) - x.at(cx / ownX) + 0.2,
          y: y.at(cy * ownY),
          height: y.at(cy / ownY) - y.at(cy * ownY) + 0.2,
          class: 'cell',
          style: `--own: ${chart.kinds[kind].colour}`
        });
        if (words) box.dataset.words = words;
        if (run) Object.assign(box.dataset, {run, step: cx, value: cy});
        group.append(box);
      });
      const frame = {x: left, y: top, width: right - left, height: bottom - top};
      if (panel.predicted.length > 1)  // an image of its own clips the line at the panel
        group.append(
            svg('svg', {...frame, viewBox: Object.values(frame).join(' ')},
                svg('path', {class: 'predicted', d: pathOf(panel.predicted.map(([px, py]) => [x.at(px), y.at(py)]))})));
      for (const [px, py] of panel.measured)
        group.append(svg('circle', {class: 'measured', cx: x.at(px), cy: y.at(py), r: 3}));
      for (const tick of y.ticks)
        group.append(svg('text', {x: left - 6, y: y.at(tick) + 4, 'text-anchor': 'end'}, tickText(chart.y, tick)));
      let end = -Infinity;
      for (const tick of x.ticks) {
        const text = tickText(chart.x, tick), half = widthOf(text) / 2;
        if (x.at(tick) - half < end + 6) continue;
        end = x.at(tick) + half;
        group.append(svg('text', {x: x.at(tick), y: bottom + 16, 'text-anchor': 'middle'}, text));
      }
      root.append(group);
    });
    const title = titleOf(chart.x);
    title.setAttribute('x', width / 2), title.setAttribute('y', rows * (high + 64) - 2),
        title.setAttribute('text-anchor', 'middle');
    root.append(title);
    let px = 4;
    const occurring = new Set(cells.map(([, , kind]) => kind));
    for (const kind of chart.kinds.filter((_, k) => occurring.has(k))) {
      root.append(
          svg('rect', {x: px, y: height - 15, width: 12, height: 12, class: 'cell', style: `--own: ${kind.colour}`}),
          svg('text', {x: px + 18, y: height - 4}, kind.title));
      px += 36 + widthOf(kind.title);
    }
  };

  // Limits of steps in h omega: a bar for each method up to where it holds, a mark for each scene, a tick for theory.

  const limits = (root, chart, methods, width) => {
    const narrow = width < 620, high = narrow ? 46 : 32, tall = narrow ? 11 : 14, rows = chart.rows.length,
          top = narrow ? 44 : 52, bottom = top + rows * high;
    const names = chart.names.map(name => methods[name]?.title ?? name);
    const left = narrow ? 4 : 14 + Math.max(...names.map(name => widthOf(name, true)));
    const right = width - (narrow ? 126 : 170), columns = [width - (narrow ? 62 : 84), width - 2];
    const closed = chart.rows.filter(row => !row.open).flatMap(row => [row.held, ...row.marks.map(m => m[1])]);
    const x = linear(0, 1.34 * Math.max(...closed, 1e-9), left, right);
    const keyLines = [], key = [...chart.scenes.map(([name, omega]) => `${name}, ω = ${nice(omega)} rad/s`), 'theory'];
    for (const [k, text] of key.entries()) {
      const wide = widthOf(text) + 34, line = keyLines[keyLines.length - 1];
      if (line && line.end + wide < width)
        line.items.push([k, line.end, text]), line.end += wide;
      else
        keyLines.push({end: wide, items: [[k, 0, text]]});
    }
    const height = bottom + 50 + 20 * keyLines.length;
    root.setAttribute('viewBox', `0 0 ${width} ${height}`);
    root.setAttribute('height', height);
    const title = fitting(
        narrow ? width : columns[0] - 120, ['Largest stable step', ', measured beside theory'],
        ['Largest stable step', '']);
    title.setAttribute('y', 14);
    const heading = (text, at, y, attributes) => svg('text', {x: at, y, 'text-anchor': 'end', ...attributes}, text);
    root.append(
        title, heading('measured', columns[0], narrow ? 34 : 38, {class: 'soft'}),
        heading('theory', columns[1], narrow ? 34 : 38, {class: 'soft'}));
    root.append(
        heading(narrow ? 'ms' : `on ${chart.columns}, in ms`, columns[1], narrow ? 14 : 18, {class: 'quantity'}));
    for (const tick of x.ticks)
      root.append(
          svg('line', {class: 'grid', x1: x.at(tick), x2: x.at(tick), y1: top - 4, y2: bottom}),
          svg('text', {x: x.at(tick), y: bottom + 16, 'text-anchor': tick === 0 && narrow ? 'start' : 'middle'},
              nice(tick)));
    chart.rows.forEach((row, k) => {
      const name = chart.names[k], look = methods[name] ?? {colour: 'outside', mark: 'triangle'},
            group = svg('g', {
              class: look.hero ? 'series hero' : 'series',
              style: `--own: var(--${look.colour}); --lit: var(--${look.colour})`
            });
      if (methods[name]) group.dataset.method = name;
      const line = top + high * k, y = line + (narrow ? 32 : high / 2), end = row.open ? right - 10 : x.at(row.held);
      group.append(svg('path', {
        class: 'held',
        d: `M${left},${y - 7}H${end}${row.open ? `V${y - 11}L${right},${y}L${end},${y + 11}V${y + 7}` : `V${y + 7}`}H${
            left}z`
      }));
      group.append(
          narrow ? svg('text', {x: left + 3, y: line + 15, class: look.hero ? 'own bold' : 'own'}, names[k]) :
                   svg('text', {x: left - 10, y: y + 4, 'text-anchor': 'end', class: look.hero ? 'own bold' : 'own'},
                       names[k]));
      row.marks.forEach(([scene, measured, predicted, words], i) => {
        if (predicted != null)
          group.append(
              svg('line', {class: 'theory', x1: x.at(predicted), x2: x.at(predicted), y1: y - tall, y2: y + tall}));
        group.append(mark(
            sceneMarks[scene % 4], 3.4,
            [x.at(measured), y + (row.marks.length < 2 ? 0 : (tall + 4) * (i / (row.marks.length - 1) - 0.5))],
            {colour: `var(--${look.colour})`}, {words}));
      });
      const far = Math.max(row.held, ...row.marks.map(m => Math.max(m[1], m[2] ?? 0)));
      // beside the bar, in it, or on narrow screens behind the name
      const first = left + widthOf(names[k], look.hero) + 12,
            words = narrow && first + widthOf(row.words) > width ? row.words.split(';')[0] : row.words;
      const wide = widthOf(words), inside = row.open || x.at(far) + 12 + wide > right,
            spot = narrow ? [first, line + 15] :
          inside          ? [left + 10, y + 4] :
                            [x.at(far) + 10, y + 4];
      if (!row.open || chart.rows[k - 1]?.words !== row.words)
        group.append(label(words, spot, {class: inside || narrow ? 'soft' : 'halo soft'}));
      const short = text => (narrow && Number(text) ? Number(text).toPrecision(text.length > 7 ? 3 : 4) : text),
            bold = look.hero ? {class: 'bold'} : {};
      if (row.measured)
        group.append(
            heading(short(row.measured), columns[0], y + 4, bold),
            heading(short(row.predicted), columns[1], y + 4, bold));
      else
        group.append(heading('not searched', columns[1], y + 4, {class: 'soft'}));
      root.append(group);
    });
    const axis = fitting(right - left, ['h ω', ', time step times the fastest frequency'], ['h ω', '']);
    axis.setAttribute('x', (left + right) / 2), axis.setAttribute('y', bottom + 36),
        axis.setAttribute('text-anchor', 'middle');
    root.append(svg('line', {class: 'base', x1: left, x2: left, y1: top - 4, y2: bottom}), axis);
    keyLines.forEach(({items}, l) => {
      for (const [k, px, text] of items) {
        const y = bottom + 58 + 20 * l;
        root.append(
            k < chart.scenes.length ? mark(sceneMarks[k % 4], 4, [px + 7, y - 4], {colour: 'var(--ink)'}) :
                                      svg('line', {class: 'theory', x1: px + 7, x2: px + 7, y1: y - 12, y2: y + 4}),
            svg('text', {x: px + 17, y}, text));
      }
    });
  };

  const kinds = {curves, bars, dots, map, limits};

  /** Arrows step from mark to mark; up and down to the next curve. The page says what a mark is, and Enter plays it. */
  const walk = event => {
    const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
    if (!step) return;
    event.preventDefault();
    const marks = [...event.currentTarget.querySelectorAll('[data-words]')],
          here = marks.indexOf(document.activeElement);
    if (!marks.length) return;
    const curve = k => marks[k]?.closest('.series'),
          from = here < 0 ? Math.max(0, marks.findIndex(each => each.closest('.hero'))) - step : here;
    let next = from + step;
    if (here >= 0 && event.key.match(/Up|Down/))
      while (marks[next] && curve(next) === curve(here)) next += step;
    next = (next + marks.length) % marks.length;
    marks[next].setAttribute('tabindex', -1);
    marks[next].focus({preventScroll: true});
  };

  /** Draws a chart into its figure, as wide as that is. */
  const draw = (box, chart, methods) => {
    const width = Math.max(300, Math.round(box.clientWidth || 600));
    if (box.drawnWidth === width) return;
    if (!box.drawnWidth) box.addEventListener('keydown', walk);
    box.drawnWidth = width;
    const root = svg('svg', {
      class: 'chart',
      width,
      role: 'group',
      tabindex: 0,
      'aria-label': `${chart.title}. ${chart.finding ?? ''}`,
      'font-size': letters
    });
    const outside = kinds[chart.kind](root, chart, methods, width);
    box.replaceChildren(root);
    if (outside) box.append(Object.assign(document.createElement('p'), {className: 'outside', textContent: outside}));
  };

  return {draw, nice};
})();
