// Links to the lab from charts.

import {parts, runOf, runsOf} from '../player/motion';

import {openLab} from './lab';
import {sceneText} from './lab_runs';
import {numberAt, numbersOf, tomlNumber, withNumbers, withoutSection} from './scene_text';

type LabState = Parameters<typeof openLab>[0];

/** True if the lab can run a method with its options. */
const isOfLab = (method: string) =>
    Boolean(document.getElementById('lab-module')) && /^mysim\/[a-z0-9-]+(\+(events|sticky|linear))*$/.test(method);

/** Scene of a map's cell: `value` is the stiffness, relative to the scene's own, or the drag rate. */
function textOfCell(toml: string, kind: string, value: number, step: number) {
  let text = `${withoutSection(toml, 'drag').trimEnd()}\n\n[drag]\ngamma = ${tomlNumber(value)}  # 1/s\n`;
  if (kind === 'stiffness') {
    const lines = toml.split('\n');
    for (const {path, value: own, line, begin, end} of numbersOf(toml))
      if (/(^|\.)stiffness(\.|$)/.test(path))
        lines[line] = lines[line].slice(0, begin) + tomlNumber(Number((Number(own) * value).toPrecision(6))) +
            lines[line].slice(end);
    text = lines.join('\n');
  }
  // the sampling interval must contain an integer number of steps; otherwise the step would be shortened
  const samples = numberAt(text, 'time.samples'), interval = numberAt(text, 'time.duration') / samples;
  const duration = samples * Math.max(1, Math.ceil(interval / step)) * step;
  return withNumbers(text, {'time.duration': duration, 'time.step': step});
}

/** The lab's state for a mark of a figure; null if the lab cannot run the mark's method. */
export function labStateOf(key: string, marker: HTMLElement): LabState|null {
  const {run: chosen = '', step, value} = marker.dataset, {method} = parts(chosen), set = runsOf(key);
  if (!set || !isOfLab(method)) return null;
  if (set.stage) {
    const {scene, toml} = set.stage, kind = key.endsWith('-drag-map') ? 'drag' : 'stiffness';
    if (!toml || !step) return null;
    const text = textOfCell(toml, kind, Number(value), Number(step));
    return {scene, method, step: Number(step), tolerance: undefined, experiment: undefined, toml: text};
  }
  return sceneText(set.scene) ? labStateOfRun(set.scene, chosen) : null;
}

/** The lab's state for a run; null if the page does not contain the run. */
export function labStateOfRun(scene: string, key: string): LabState|null {
  const found = runOf({scene}, key);
  if (!found) return null;
  const {file: {method}, run: {step, tolerance}} = found;
  return {scene, method, step, tolerance, experiment: undefined};
}
