// Lays out any chart, without a browser.

import {Colours, curves} from './curves';
import {map} from './map';
import {bars, dots, limits} from './rows';
import {css, Sheet} from './sheet';
import {ChartSpec} from './spec';

export function layout(chart: ChartSpec, width: number, colours: Colours = part => css(part.colour)): Sheet {
  switch (chart.kind) {
    case 'curves':
      return curves(chart, width, colours);
    case 'bars':
      return bars(chart, width);
    case 'dots':
      return dots(chart, width, colours);
    case 'map':
      return map(chart, width);
    case 'limits':
      return limits(chart, width, colours);
  }
}
