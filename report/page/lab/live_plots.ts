// Plots over time: error, energy, residual of the energy balance.
// @ts-nocheck

import {make} from '../player/controls';
import {Plot, svg} from '../player/plot';

import {say} from './words';

/** A plot that grows; values may lie below zero. */
class LivePlot extends Plot {
  constructor(box) {
    super(box, () => {});
    this.left = 56;
    box.classList.add('live');
  }

  show(shown) {
    this.take(shown);
    // a plot without curves is not redrawn
    const words = this.known ? null : [shown.title, shown.none, this.wide].join();
    if (words !== null && words === this.words) return;
    this.words = words;
    const well = shown.series.filter(s => s.well),
          values = (well.length ? well : shown.series).flatMap(s => s.points.map(p => p[1] ?? 0));
    const least = Math.min(0, ...values);
    // powers of ten have no place for what lies below zero, and of a burst the last eight tell enough
    if (least < 0)
      Object.assign(
          this, {powers: false, low: 1.08 * least / this.size, most: 1.08 * Math.max(0, ...values) / this.size});
    else if (this.powers)
      this.low = Math.max(this.low, this.most - 8);
    this.draw();
  }

  draw() {
    super.draw();
    if (!this.title || !this.known || this.powers || !(this.low < 0)) return;
    // the line of zero, where it is not the lower edge
    const root = this.area.firstChild, foot = this.high - 22,
          y = foot - (0 - this.low) / (this.most - this.low) * (foot - 6);
    root?.append(svg('line', {class: 'base', x1: this.left, x2: this.left + this.span, y1: y, y2: y}));
  }
}

const energyKinds = {
  total: 'energyTotal',
  kinetic: 'energyKinetic',
  elastic: 'energyElastic',
  gravitational: 'energyGravitational'
};

/** The plots of a lab, below the picture. */
export class LivePlots {
  constructor() {
    this.box = make('div', {class: 'plots'});
    this.plots = [0, 1, 2].map(() => {
      const box = make('div', {class: 'plot'});
      this.box.append(box);
      return new LivePlot(box);
    });
    this.kind = 'total';
    this.choice = make('select');
    this.plots[1].box.prepend(this.choice);
    this.choice.addEventListener('change', () => (this.kind = this.choice.value, this.show(...this.shown)));
  }

  /** The names of energies, in the reader's language. */
  name() {
    this.choice.setAttribute('aria-label', say('quantity'));
    this.choice.replaceChildren(
        ...Object.entries(energyKinds).map(([value, key]) => make('option', {value}, say(key))));
    this.choice.value = this.kind;
    if (this.shown) this.show(...this.shown);
  }

  /** `runs` with samples, up to `end` (s); `none`: what is said in place of curves, {error, energy, residual}. */
  show(runs, end, time, none) {
    this.shown = [runs, end, time, none];
    const series = key =>
        runs.filter(run => run.samples.some(s => s[key] !== null && s.t > 0)).map(run => ({
                                                                                    name: run.letter,
                                                                                    css: run.look.css,
                                                                                    dash: run.look.dash,
                                                                                    well: !run.failed,
                                                                                    points: run.samples.map(
                                                                                        s => [s.t, s[key]])
                                                                                  }));
    const firstOrder = runs[0]?.sim.scene.firstOrder, [error, energy, residual] = this.plots;
    const show = (plot, shown) => (plot.show({...shown, begin: 0, end}), plot.moveHead(time));
    show(error, {title: say(runs[0]?.errorWord ?? 'error'), unit: 'm', series: series('error'), none: none.error});
    show(energy, {title: say(energyKinds[this.kind]), unit: 'J', series: series(this.kind), none: none.energy});
    energy.box.classList.add('named');
    energy.box.hidden = residual.box.hidden = Boolean(firstOrder);
    this.box.classList.toggle('single', Boolean(firstOrder));
    const percent =
        series('residual').map(s => ({...s, points: s.points.map(([t, v]) => [t, v === null ? null : 100 * v])}));
    show(residual, {title: say('residual'), unit: '%', series: percent, none: none.residual});
  }
}
