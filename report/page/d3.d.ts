// The functions of d3 that the page uses.

declare module 'd3-array' {
  export function extent(values: Iterable<number>): [number, number]|[undefined, undefined];
  export function bisector<T>(value: (each: T) => number): {left(list: readonly T[], at: number): number};
}

declare module 'd3-format' { export function format(specifier: string): (value: number) => string; }

declare module 'd3-scale' {
  export interface Scale {
    (value: number): number;
    domain(ends: [number, number]): this;
    range(ends: [number, number]): this;
    ticks(count?: number): number[];
    invert(place: number): number;
  }
  export function scaleLinear(): Scale;
  export function scaleLog(): Scale;
}

declare module 'd3-shape' {
  type Point = readonly[number, number];
  export interface SymbolType {
    readonly kind: unique symbol;
  }
  export const symbolCircle: SymbolType, symbolDiamond: SymbolType, symbolSquare: SymbolType,
      symbolTriangle: SymbolType;
  interface Symbols {
    (): string|null;
    type(type: SymbolType): this;
    size(area: number): this;
  }
  interface Line {
    (points: readonly Point[]): string|null;
    defined(test: (point: Point) => boolean): this;
  }
  export function line(): Line;
  export function symbol(): Symbols;
}
