// Error, energy and residual of the energy balance over time.

import {make} from '../player/controls';
import {Plot, Point, Series} from '../player/plot';

import {say} from './words';

const energyKinds = {
  total: 'energyTotal',
  kinetic: 'energyKinetic',
  elastic: 'energyElastic',
  gravitational: 'energyGravitational'
};
type Quantity = 'error'|'residual'|keyof typeof energyKinds;

interface PlottedRun {
  letter: string;
  look: {css: string, dash?: string};
  failed?: unknown;
  errorWord?: string;
  sim: {scene: {firstOrder?: boolean}};
  samples: ({t: number}&Record<Quantity, number|null>)[];
}

type Absent = Record<'error'|'energy'|'residual', string>;

export class LivePlots {
  readonly box = make('div', {class: 'plots'});
  private readonly choice = document.createElement('select');
  readonly plots = [0, 1, 2].map(() => {
    const box = make('div', {class: 'plot live'});
    this.box.append(box);
    return new Plot(box);
  });
  private shown: [PlottedRun[], number, number, Absent]|null = null;

  constructor() {
    this.plots[1].box.prepend(this.choice);
    this.choice.addEventListener('change', () => this.shown && this.show(...this.shown));
  }

  name() {
    const kind = this.choice.value || 'total';
    this.choice.setAttribute('aria-label', say('quantity'));
    this.choice.replaceChildren(
        ...Object.entries(energyKinds).map(([value, key]) => make('option', {value}, say(key))));
    this.choice.value = kind;
    if (this.shown) this.show(...this.shown);
  }

  /** Shows samples of `runs` up to `end` (s); `none`: texts instead of curves. */
  show(runs: PlottedRun[], end: number, time: number, none: Absent) {
    this.shown = [runs, end, time, none];
    const kind = (this.choice.value || 'total') as keyof typeof energyKinds, [error, energy, residual] = this.plots;
    const series = (key: Quantity, factor = 1): Series[] =>
        runs.filter(run => run.samples.some(s => s[key] !== null && s.t > 0)).map(({letter, look, failed, samples}) => {
          const value = (v: number|null) => (v === null ? null : factor * v);
          return {name: letter, ...look, well: !failed, points: samples.map((s): Point => [s.t, value(s[key])])};
        });
    const show = (plot: Plot, title: string, unit: string, curves: Series[], words: string) => {
      plot.show({title, unit, series: curves, begin: 0, end, none: words});
      plot.moveHead(time);
    };
    show(error, say(runs[0]?.errorWord ?? 'error'), 'm', series('error'), none.error);
    show(energy, say(energyKinds[kind]), 'J', series(kind), none.energy);
    show(residual, say('residual'), '%', series('residual', 100), none.residual);
    const firstOrder = Boolean(runs[0]?.sim.scene.firstOrder);
    energy.box.classList.add('named');
    energy.box.hidden = residual.box.hidden = firstOrder;
    this.box.classList.toggle('single', firstOrder);
  }
}
