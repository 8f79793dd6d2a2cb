// A click on a marker of a chart, or on a cell of a map, plays that run in a window over the page; below the figure the
// same runs stand in a list, for who has no pointer.
// @ts-nocheck

import {cellOf, parts, runsOf} from './motion';
import {dropdown, make, short} from './controls';
import {labStateOf} from '../lab/computed_runs';
import {openLab} from '../lab/lab';
import {opened} from './unpack';
import {plays} from './player';
import {say} from '../lab/words';

/** What a marker says: whose run it is first. */
const tipOf = ({dataset}) => {
  const {method} = parts(dataset.run);
  return dataset.words.startsWith(method) ? dataset.words : `${method}, ${dataset.words}`;
};

/** What the window of a map's cell says of its pictures. */
function captionOf({frames, times, left, larger}) {
  const end = short(times[times.length - 1]);
  return (left ? `${frames} pictures up to ${end} s, when the run leaves the frame; it ended at ${short(left)} s. ` :
                 `The last ${frames} pictures of the run, up to ${end} s. `) +
      (larger ? `Departures from rest are drawn ${short(larger)} times as large as they are.` :
                'Departures are drawn in true size.');
}

/** Opens the window with the run of a marker: beside the truth, or a cell's alone. */
async function playRun(key, marker) {
  const file = runsOf(key), [head, ...lines] = tipOf(marker).split('\n'), {method, place} = parts(marker.dataset.run);
  const set = file.sets.get(method), scene = file.scene ?? file.stage.scene;
  if (set && file.stage) await opened(set, 3 * file.stage.particles);
  let run = set?.runs[Number(place)], motion = null, problem = null;
  if (run && file.stage) {
    motion = await cellOf(file.stage, set, run).catch(({message}) => void (problem = message));
    if (problem) run = null;
  }
  const close = make('button', {type: 'button', class: 'close', 'aria-label': 'Close'}, '✕');
  const box = make('div', {class: 'player'});
  const dialog = make(
      'dialog', {class: 'run', 'aria-label': `Run: ${head}`}, close, make('h3', {}, `${scene}: ${head}`),
      make('p', {}, lines.join('; ')), box);
  document.body.append(dialog);
  const player = make(
      'motion-player', run && file.scene ? {'data-scene': scene, 'data-a': marker.dataset.run, 'data-b': 'truth'} : {});
  if (run) {
    if (file.stage) player.given = {scene: file.stage, motion, caption: captionOf(run)};
    box.append(make('figure', {class: 'render'}, make('div', {class: 'stage'})), player);
  } else {
    box.append(make(
        'p', {class: 'none'},
        problem ??
            (set ? 'It ended before there was a second picture of it to show.' :
                   'The runs of this method are too large for the page; the command run plays them.')));
  }
  const state = labStateOf(key, marker);
  if (state) {
    const door = make('button', {type: 'button', class: 'to-lab'}, say('openInLab'));
    door.addEventListener('click', () => (shut(), openLab(state)));
    box.append(make('p', {class: 'door'}, door));
  }
  if (run && file.scene)
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
  if (run) await player.wake();  // also where nothing moves by itself: who clicks wants to see it
}

/**
 * Below a figure the choice of one of its runs: by method, on a map by row, by what the run was asked; made when it is
 * opened first.
 */
export function listRuns(figure) {
  if (!plays) return;
  const list = make('details', {class: 'run-list'}, make('summary', {}, 'Play a run'));
  list.addEventListener('toggle', () => {
    const markers = [...figure.querySelectorAll('[data-run]')];
    if (list.querySelector('select') || markers.length === 0) return;  // a figure is drawn when it comes into sight
    const ways = markers.map(marker => {
      const {method} = parts(marker.dataset.run), [head, outcome = ''] = tipOf(marker).split('\n');
      const [asked, ...row] = head.replace(`${method}, `, '').split(', ');
      return [method, ...row, `${asked}: ${outcome}`];
    });
    const chosen =
        ways[0].map((_, level) => dropdown(['method', ...ways[0].length > 2 ? ['row'] : [], 'run'][level], []));
    const fits = (way, levels) => way.every((part, level) => level >= levels || part === chosen[level][1].value);
    const fill = level => {
      if (level === chosen.length) return;
      const texts = new Set(ways.filter(way => fits(way, level)).map(way => way[level]));
      chosen[level][1].replaceChildren(...[...texts].map(text => make('option', {}, text)));
      fill(level + 1);
    };
    chosen.forEach(([, select], level) => select.addEventListener('change', () => fill(level + 1)));
    fill(0);
    const play = make('button', {type: 'button'}, '▶ Play');
    play.addEventListener(
        'click', () => playRun(figure.dataset.runs, markers[ways.findIndex(way => fits(way, way.length))]));
    list.append(...chosen.flatMap(([label]) => [label, ' ']), play);
  });
  figure.append(list);
}

/** A button of the table of runs: puts its run into A or B, plays it, or opens it in the lab. */
async function choose(button) {
  const {key} = button.parentElement.dataset;
  if (button.dataset.as === 'lab') {
    const scene = button.closest('table').dataset.scene, {method, place} = parts(key), own = place === 'own';
    const run = runsOf(`${scene}-${own ? 'engines' : 'speed-accuracy'}`).sets.get(method).runs[own ? 0 : Number(place)];
    return openLab({scene, method, step: run.step, tolerance: run.tolerance});
  }
  const player = button.closest('article, section').querySelector('motion-player[data-a]');
  if (!player?.picks) return;
  await player.pick({[button.dataset.as === 'b' ? 'b' : 'a']: key});
  if (button.dataset.as !== 'play') return;
  player.box.scrollIntoView({block: 'nearest'});
  player.seek(player.begin);
  player.play();
}

/** Lets a click on a marker, a cell or a button of the table of runs play its run. */
export function startRuns() {
  if (!plays) return;
  document.addEventListener('click', event => {
    if (!plays) return;
    const marker = event.target.closest?.('[data-run]'), figure = marker?.closest('figure[data-runs]');
    if (figure) playRun(figure.dataset.runs, marker);
    const button = event.target.closest?.('.choose button');
    if (button) choose(button);
  });
}
