// Reads and changes numbers in a scene's text (TOML), preserving comments and order.

import {norm, Places} from '../player/vectors';

/** A number, or a list of three. */
export type Value = number|number[];
/** Numbers to change: {path: value}. */
export type Changes = Record<string, Value>;
/** A method with a step (s) or, for adaptive steppers, a tolerance. */
export interface MethodSpec {
  method: string;
  step?: number;
  tolerance?: number;
}

interface NumberEntry {
  path: string;  // "grid.stiffness.bend"
  section: string;
  value: Value;
  line: number;
  begin: number;  // columns at which the value begins and ends
  end: number;
  out: boolean;  // true: the line is commented out
}

/** Marks a number that must be positive but was set to zero: its line is commented out, and can be restored. */
const leftOutMark = '# left out: ';

/** All numbers in a text. Skips strings, inline tables and multi-line lists. */
export function numbersOf(toml: string) {
  const found: NumberEntry[] = [];
  let section = '';
  toml.split('\n').forEach((whole, line) => {
    const out = whole.startsWith(leftOutMark), shift = out ? leftOutMark.length : 0, text = whole.slice(shift);
    const head = /^\s*\[\[?\s*([\w.-]+)\s*\]\]?/.exec(text);
    if (head) return void (section = head[1]);
    const entry = /^(\s*([\w.-]+)\s*=\s*)([-+]?[\d.][\d_.eE+-]*|\[[^\]]*\])/.exec(text);
    if (!entry) return;
    const [, before, key, written] = entry;
    const list = written.startsWith('[') ? written.slice(1, -1).split(',').map(Number) : null;
    const value = list ?? Number(written.replace(/_/g, ''));
    if (Array.isArray(value) ? value.length !== 3 || value.some(Number.isNaN) : Number.isNaN(value)) return;
    const begin = shift + before.length;
    found.push(
        {path: section ? `${section}.${key}` : key, section, value, line, begin, end: begin + written.length, out});
  });
  return found;
}

/** The shortest text that restores the same double. */
export const tomlNumber = (value: Value): string => Array.isArray(value) ? `[${value.map(tomlNumber).join(', ')}]` :
    Object.is(value, -0) ? '-0.0' :
                           String(value);

/** First value at a path; 0 if its line is commented out, undefined if there is no value. */
export function valueAt(toml: string, path: string): Value|undefined {
  const entry = numbersOf(toml).find(e => e.path === path);
  return entry && (entry.out ? (Array.isArray(entry.value) ? entry.value.map(() => 0) : 0) : entry.value);
}

/** First value at a path, as a number: the norm if it is a list, 0 if there is no value. */
export function numberAt(toml: string, path: string) {
  const value = valueAt(toml, path) ?? 0;
  return Array.isArray(value) ? norm(value) : value;
}

/** Effect of setting a number to zero: its line or its whole section is commented out, or the zero is written. */
const zeroOf = (path: string) =>
    (/^(grid\.(stiffness\.(shear|bend)|bending|dashpot)|spring\.dashpot)$/.test(path) ? 'line' :
         /^drag\./.test(path)                                                         ? 'section' :
                                                                                        'number');

/** Changes a number in every table that has its path; there may be several [[sphere]] or [[spring]]. */
function withNumber(toml: string, path: string, value: Value) {
  const lines = toml.split('\n'), zero = zeroOf(path), gone = value === 0 && zero !== 'number';
  const leave = (line: string) => (line.startsWith(leftOutMark) ? line : leftOutMark + line);
  const bring = (line: string) => (line.startsWith(leftOutMark) ? line.slice(leftOutMark.length) : line);
  for (const {path: own, section, line, begin, end} of numbersOf(toml)) {
    if (own !== path) continue;
    if (!gone)
      lines[line] = bring(lines[line].slice(0, begin) + tomlNumber(value) + lines[line].slice(end));
    else if (zero === 'line')
      lines[line] = leave(lines[line]);
    if (zero !== 'section') continue;
    // a section extends to the next line with a section's name
    let first = line, last = line;
    const isHead = (text: string) => /^\s*\[/.test(bring(text));
    while (first > 0 && !isHead(lines[first])) --first;
    while (last + 1 < lines.length && !isHead(lines[last + 1])) ++last;
    for (let i = first; i <= last; ++i)
      if (bring(lines[i]).trim() && section) lines[i] = gone ? leave(lines[i]) : bring(lines[i]);
  }
  return lines.join('\n');
}

export const withNumbers = (toml: string, changes: Changes) =>
    Object.entries(changes).reduce((text, [path, value]) => withNumber(text, path, value), toml);

/** Changes between two texts; null if they differ in more than numbers. */
export function changesBetween(from: string, to: string) {
  const changes: Changes = {};
  for (const path of new Set(numbersOf(from).map(e => e.path))) {
    const before = valueAt(from, path), after = valueAt(to, path);
    if (before !== undefined && after !== undefined && tomlNumber(before) !== tomlNumber(after)) changes[path] = after;
  }
  return withNumbers(from, changes) === to ? changes : null;
}

export function withMethod(toml: string, {method, step = 0, tolerance}: MethodSpec) {
  const text = toml.replace(/^(\s*method\s*=\s*)"[^"]*"/m, (_, before) => `${before}"${method}"`);
  return tolerance ? text : withNumber(text, 'time.step', step);
}

/** A string of the scene, such as "question"; empty if the scene has no such string. */
export const textAt = (toml: string, key: string) =>
    new RegExp(`^\\s*${key}\\s*=\\s*"((?:[^"\\\\]|\\\\.)*)"`, 'm').exec(toml)?.[1] ?? '';

/** The step (s) with `count` steps between two samples, rounded up to as few digits as possible, at least three. */
export function stepOf(interval: number, count: number) {
  const exact = interval / count;
  for (let digits = 3; digits < 16; ++digits) {
    const unit = 10 ** (Math.floor(Math.log10(exact)) - digits + 1);
    const step = Number((Math.ceil(exact / unit * (1 - 1e-12)) * unit).toPrecision(digits));
    if (Math.ceil(interval / step * (1 - 1e-9)) === count) return step;
  }
  return exact;
}

function startSection(x: Places, v: Places) {
  const list = (values: Places) => {
    const lines: string[] = [];
    for (let i = 0; i < values.length; i += 3)
      lines.push(`  ${[...values.slice(i, i + 3)].map(tomlNumber).join(', ')},`);
    return `[\n${lines.join('\n')}\n]`;
  };
  return `[start]\npositions = ${list(x)}\n${v.length ? `velocities = ${list(v)}\n` : ''}`;
}

export interface Start {
  positions: Places;
  velocities: Places;
  centres: Places;
}

/** Replaces the initial state, the pins, and the spheres' initial positions. */
export function withStart(toml: string, pins: Int32Array, {positions: x, velocities: v, centres}: Start) {
  const pinned = `particles = [${[...pins].join(', ')}]`;
  let text = /^\[pins\]/m.test(toml) ?
      toml.replace(/(^\[pins\][^[]*?)particles\s*=\s*\[[^\]]*\]/m, (_, before) => before + pinned) :
      pins.length ? `${toml.trimEnd()}\n\n[pins]\n${pinned}\n` :
                    toml;
  if (!pins.length) text = withoutSection(withoutSection(text, 'pins.motion'), 'pins');
  let sphere = 0;
  text = text.replace(/^(\s*centre\s*=\s*)\[[^\]]*\]/gm, (whole, before) => {
    const at = 3 * sphere++;
    return at < centres.length ? `${before}[${[...centres.slice(at, at + 3)].map(tomlNumber).join(', ')}]` : whole;
  });
  return `${text.trimEnd()}\n\n${startSection(x, v)}`;
}

export function withoutSection(toml: string, name: string) {
  let inside = false;
  return toml.split('\n')
      .filter(line => {
        const head = /^\s*\[\[?\s*([\w.-]+)\s*\]/.exec(line);
        if (head) inside = head[1] === name;
        return !inside;
      })
      .join('\n');
}
