export type Colour = [number, number, number];  // 0 to 1

export const heat = ['F3F0E8', 'F6D9A6', 'F3B466', 'E8853B', 'CF5246', 'A02C5D', '5F1A5C'];  // as in colour.cpp
export const purple = ['F4F2F7', 'D9CBE6', 'B28FCF', '8A55B0', '5E2A86', '3B1260'];          // differences
export const palette = ['0072B2', 'D55E00', '009E73', 'CC79A7', 'E69F00', '56B4E9', '333333'];
export const rgb =
    (hex: string) => [0, 2, 4].map(i => parseInt(hex.replace('#', '').slice(i, i + 2), 16) / 255) as Colour;
export const mixed = (a: Colour, b: Colour, part: number) => a.map((v, k) => v + part * (b[k] - v)) as Colour;

/** Dark, medium and light tones of cloth. */
export const rampOf = (tint: Colour):
    Colour[] => [mixed(tint, [0, 0, 0], 0.15), mixed(tint, [1, 1, 1], 0.4), mixed(tint, [1, 1, 1], 0.84)];

/** A method's title and colour (chart_json.h). */
interface MethodLook {
  title?: string;
  colour?: string;
  engine?: string;
  rule?: string;
}
export const looksOfPage: Record<string, MethodLook> =
    JSON.parse(document.getElementById('methods-data')?.textContent ?? '{}');

/** Colours of a run: a plain one; and dark, medium and light ones for cloth. */
export interface Look {
  title?: string;
  css: string;
  plain: Colour;
  ramp: Colour[];
}

/** A method's title and colours; each engine has one tint for cloth. */
export function lookOf(method: string): Look {
  const known = looksOfPage[method], name = method === 'truth' ? 'truth' : known?.colour ?? 'grey';
  const style = getComputedStyle(document.documentElement);
  const read = (key: string) => style.getPropertyValue(`--${key}`).trim();
  const colour = read(name) || '#707880', cloth = rgb(read(`${name.replace(/2$/, '')}2`) || colour);
  return {
    title: known?.title ?? method,
    css: `var(--${name}, #707880)`,
    plain: rgb(colour),
    ramp: rampOf(method === 'truth' ? rgb('8A9099') : cloth)
  };
}

/** 256 colours of four bytes, interpolated between stops. */
export function scaleBytes(stops: string[]) {
  const bytes = new Uint8Array(4 * 256), colours = stops.map(rgb);
  for (let i = 0; i < 256; ++i) {
    const at = i / 255 * (stops.length - 1), a = Math.min(Math.floor(at), stops.length - 2);
    bytes.set([...mixed(colours[a], colours[a + 1], at - a).map(v => Math.round(255 * v)), 255], 4 * i);
  }
  return bytes;
}
