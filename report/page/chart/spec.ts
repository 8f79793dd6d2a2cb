// Chart specs from C++ (report/figures/chart_json.h).

export type Pair = [number, number];

export type AxisSpec = {
  label: string,
  unit?: string,
  log?: boolean,
  low?: number,
  high?: number
};

export type MarkName = 'circle'|'square'|'diamond'|'triangle'|'down'|'pentagon'|'plus'|'cross'|'star';

/** gnuplot's shapes; open marks are hollow. */
export type MarkSpec = {
  mark?: MarkName,
  open?: boolean
};

/** Tooltip of a mark, and the run that it plays. */
export type Tip = {
  words?: string,
  run?: string
};

export type Named = {
  name: string,
  method?: string
};

type Info = {
  name: string,
  title: string,
  finding?: string,
  caption?: string
};

export interface SeriesSpec extends MarkSpec {
  title: string;
  line?: boolean;
  dash?: string;  // dashes and gaps, in line widths
  few?: boolean;  // true: few marks, to distinguish lines
  points: Pair[];
  scaled?: number[];  // 1: the time is scaled, and the mark is open
  tips?: Tip[];
}

export type FailureSpec = MarkSpec&Tip&{x: number, kind: string};

export interface PartSpec extends Named {
  colour: string;   // name in style.css, or #RRGGBB
  hero?: boolean;   // coloured and labelled; others are grey until the reader points at them
  keyed?: boolean;  // true: named in the key
  series: SeriesSpec[];
  failures: FailureSpec[];
}

export interface GuideSpec {
  axis: 'x'|'y';
  at: number;
  text: string;
  kind?: 'guide'|'floor';  // floor: error bar of the truth
}

export interface CurvesSpec extends Info {
  kind: 'curves';
  x: AxisSpec;
  y: AxisSpec;
  parts: PartSpec[];
  key: (MarkSpec&{text: string, line?: boolean})[];
  pareto?: Pair[];
  window?: number;  // shaded beyond x
  categories?: [number, string][];
  guides?: GuideSpec[];
  flat?: boolean;
  take?: {x: number, y: number, name: string, more: string};
}

export interface BarsSpec extends Info {
  kind: 'bars';
  x: AxisSpec;
  names: Named[];
  parts: {title: string, colour: string, hatched: boolean, height: number[]}[];
}

export interface DotsSpec extends Info {
  kind: 'dots';
  x: AxisSpec;
  names: Named[];
  headings: [number, string][];
  series: (Named&MarkSpec&{colour: string, dots: ([number, number, number]|null)[]})[];
  guides?: GuideSpec[];
}

export interface MapSpec extends Info {
  kind: 'map';
  x: AxisSpec;
  y: AxisSpec;
  kinds: {title: string, colour: string}[];
  panels: (Named&{cells: [number, number, number, string, string][], predicted: Pair[], measured: Pair[]})[];
}

export interface LimitsSpec extends Info {
  kind: 'limits';
  columns: string;
  scenes: [string, number][];
  rows: (Named&{
    colour: string,
    held: number,
    open: boolean,
    words: string,
    marks: [number, number, number|null, string][],
    measured: string,
    predicted: string
  })[];
}

export type ChartSpec = CurvesSpec|BarsSpec|DotsSpec|MapSpec|LimitsSpec;
