// Plays the run of a chart's marker or a map's cell in a window over the page. A list below the figure offers the same
// runs to readers without a pointer.

import {labStateOf, labStateOfRun} from '../lab/doors';
import {openLab} from '../lab/lab';
import {labLanguage, say} from '../lab/words';

import {dropdown, make, short} from './controls';
import {cellOf, parts, runsOf} from './motion';
import {MotionPlayer, plays} from './player';

/** Tooltip of a marker, beginning with the method. */
const tipOf = ({dataset: {run = '', words = ''}}: HTMLElement) => {
  const {method} = parts(run);
  return words.startsWith(method) ? words : `${method}, ${words}`;
};

/** Plays a marker's run next to the truth; for a map's cell, only its last picture. */
async function playRun(key: string, marker: HTMLElement) {
  const set = runsOf(key), [head, ...lines] = tipOf(marker).split('\n'), chosen = marker.dataset.run ?? '';
  if (!set) return;
  const {method, place} = parts(chosen);
  const file = set.methods.get(method), {stage} = set, scene = stage?.scene ?? set.scene;
  const cell = stage && file ? await cellOf(stage, file, Number(place)) : null;
  const run = file?.runs[Number(place)], shown = stage ? cell : run;
  const close = make('button', {type: 'button', class: 'close', 'aria-label': 'Close'}, '✕');
  const box = make('div', {class: 'player'});
  const dialog = make(
      'dialog', {class: 'run', 'aria-label': `Run: ${head}`}, close, make('h3', {}, `${scene}: ${head}`),
      make('p', {}, lines.join('; ')), box);
  document.body.append(dialog);
  const player = document.createElement('motion-player') as MotionPlayer;
  if (shown && !stage) Object.assign(player.dataset, {scene, a: chosen, b: 'truth'});
  if (shown) {
    const caption = `The last picture of the run in which it is in view, at ${short(cell?.end ?? 0)} s.`;
    if (cell && stage) player.given = {scene: stage, motion: cell, caption};
    box.append(make('figure', {class: 'render'}, make('div', {class: 'stage'})), player);
  } else {
    box.append(make(
        'p', {class: 'none'},
        file ? 'The run ended before its first picture.' :
               'The runs of this method are too large for the page; crosscheck run computes them.'));
  }
  const state = labStateOf(key, marker);
  if (state) {
    const door = make('button', {type: 'button', class: 'to-lab', lang: labLanguage}, say('openInLab'));
    door.addEventListener('click', () => (shut(), openLab(state)));
    box.append(make('p', {class: 'door'}, door));
  }
  if (run && !stage)
    box.append(make(
        'p', {class: 'hint'}, 'The same run: ',
        make(
            'code', {},
            `crosscheck run ${scene} --method ${method} ${
                run.tolerance ? `--tol ${run.tolerance}` : `--step ${run.step}`}`)));
  const shut = () => {
    if (!dialog.isConnected) return;
    if (player.stage) player.sleep();
    dialog.close();
    dialog.remove();
  };
  close.addEventListener('click', shut);
  dialog.addEventListener('click', event => event.target === dialog && shut());
  dialog.addEventListener('close', shut);  // by Escape
  dialog.showModal();
  if (shown) await player.wake();  // plays even with reduced motion, because the reader asked for it
}

/** Lists a figure's runs by method, by a map's row, and by setting. The list is built when first opened. */
export function listRuns(figure: HTMLElement) {
  if (!plays) return;
  const list = make('details', {class: 'run-list'}, make('summary', {}, 'Play a run'));
  list.addEventListener('toggle', () => {
    const markers = [...figure.querySelectorAll<HTMLElement>('[data-run]')];
    if (list.querySelector('select') || markers.length === 0) return;  // the second case: the figure is not drawn yet
    const ways = markers.map(marker => {
      const {method} = parts(marker.dataset.run!), [head, outcome = ''] = tipOf(marker).split('\n');
      const [asked, ...row] = head.replace(`${method}, `, '').split(', ');
      return [method, ...row, `${asked}: ${outcome}`];
    });
    const chosen =
        ways[0].map((_, level) => dropdown(['method', ...ways[0].length > 2 ? ['row'] : [], 'run'][level], []));
    const fits = (way: string[], levels: number) =>
        way.every((part, level) => level >= levels || part === chosen[level][1].value);
    const fill = (level: number) => {
      if (level === chosen.length) return;
      const texts = new Set(ways.filter(way => fits(way, level)).map(way => way[level]));
      chosen[level][1].replaceChildren(...[...texts].map(text => make('option', {}, text)));
      fill(level + 1);
    };
    chosen.forEach(([, select], level) => select.addEventListener('change', () => fill(level + 1)));
    fill(0);
    const play = make('button', {type: 'button'}, '▶ Play');
    play.addEventListener(
        'click', () => playRun(figure.dataset.runs!, markers[ways.findIndex(way => fits(way, way.length))]));
    list.append(...chosen.flatMap(([label]) => [label, ' ']), play);
  });
  figure.append(list);
}

/** Puts a run of the table into A or B, plays it, or opens it in the lab. */
async function choose(button: HTMLElement) {
  const {key = ''} = button.parentElement!.dataset;
  if (button.dataset.as === 'lab') {
    const state = labStateOfRun(button.closest('table')!.dataset.scene!, key);
    return state && openLab(state);
  }
  const player = button.closest('article, section')!.querySelector<MotionPlayer>('motion-player[data-a]');
  if (!player?.picks) return;
  await player.pick({[button.dataset.as === 'b' ? 'b' : 'a']: key});
  if (button.dataset.as !== 'play') return;
  player.box.scrollIntoView({block: 'nearest'});
  player.seek(player.begin);
  player.play();
}

export function startRuns() {
  if (!plays) return;
  document.addEventListener('click', event => {
    if (!plays) return;
    const target = event.target as Element, marker = target.closest?.<HTMLElement>('[data-run]');
    const figure = marker?.closest<HTMLElement>('figure[data-runs]');
    if (marker && figure) playRun(figure.dataset.runs!, marker);
    const button = target.closest?.<HTMLElement>('.choose button');
    if (button) choose(button);
  });
}
