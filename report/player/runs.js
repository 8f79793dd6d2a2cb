// A click on a marker of a chart, or on a cell of a map, plays that run in a window over the page; below the figure the
// same runs stand in a list, for who has no pointer.

/** The runs that a figure plays (run_motions.h, cell_motions.h), by method; null where the page has none. */
const runsOf = (() => {
  const known = new Map();
  return key => {
    if (!known.has(key)) {
      const script = [...document.querySelectorAll('script.runs')].find(s => s.dataset.runs === key);
      const set = script ? JSON.parse(script.textContent) : null;
      if (set) set.methods = new Map(set.methods.map(method => [method.name, method]));
      known.set(key, set);
    }
    return known.get(key);
  };
})();

/** What a marker says; page.js may have taken its title already. */
const tipOf = marker => marker.dataset.words ?? marker.querySelector('title').textContent;

/** A place of a lattice from the number that wrapped at 2^16 (run_motions.h). */
const wrapped = number => ((number + 24576) & 0xffff) - 24576;

/** Smallest 1, 2 or 5 times a power of ten that is not below a value. */
function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find(s => s * power >= value * (1 - 1e-9)) * power;
}

/** The scene of a speed-accuracy chart with one of its runs beside the truth, as Stage and Desk take it. */
async function runBesideTruth(set, method, run) {
  const whole = JSON.parse(document.getElementById(set.scene).querySelector('script.motion').textContent);
  const truth = whole.methods.find(m => m.known), {every, low, unit} = method, wide = 3 * whole.particles;
  const [known, apart] = await Promise.all([unpack(truth.places), unpack(run.places)]);
  const kept = Math.ceil(truth.frames / every);
  const places = Float32Array.from(
      apart, (d, i) => wrapped(d + known[Math.min(Math.floor(i / wide) * every, truth.frames - 1) * wide + i % wide]));
  const truthPlaces = new Uint16Array(kept * wide);
  for (let f = 0; f < kept; ++f) truthPlaces.set(known.subarray(f * every * wide, (f * every + 1) * wide), f * wide);
  // distances from the truth, while single positions can be compared
  const compared = Math.min(run.plotted.length, run.frames), metres = new Float32Array(compared * whole.particles);
  for (let p = 0; p < metres.length; ++p)
    metres[p] = Math.hypot(...[0, 1, 2].map(k => unit[k] * (places[3 * p + k] - truthPlaces[3 * p + k])));
  const top = roundUp(1e3 * Math.max(1e-6, metres.reduce((a, b) => Math.max(a, b), 0)));
  const scene = {
    ...whole,
    times: whole.times.filter((_, i) => i % every === 0),
    stretch: null,
    distance: {top, name: 'distance to the truth', label: 'mm'},
    plot: {label: 'distance to the truth / m', unit: 'm', powers: true, title: 'Distance to the truth over time'},
    methods: [
      {...method, ...run, low, unit, first: true},
      {...truth, frames: kept, plotted: [], first: true},
    ]
  };
  const motions = [{places, distance: metres.map(m => levels * 1e3 * m / top)}, {places: truthPlaces}];
  return {scene, motions, call: `./crosscheck run ${set.scene} --method ${method.name} ${run.call}`};
}

/** The scene of a map with the last moments of a cell's run. */
async function lastMoments(set, method, place, outcome) {
  const wide = 3 * set.stage.particles, {cells, low, unit} = method;
  const [row, frames, apart, end, larger, metres] = cells[place];
  const [rests, shapes, paths] = await Promise.all(['rests', 'shapes', 'paths'].map(name => unpack(method[name])));
  let shape = 0, path = 0;
  for (const before of cells.slice(0, place))
    if (before) shape += before[5].length * wide, path += before[5].length * before[1];
  const signed = numbers => new Int16Array(numbers.buffer);
  const departures = new Float32Array(frames * wide);
  metres.forEach((metre, k) => {
    const of = signed(shapes).subarray(shape + k * wide, shape + (k + 1) * wide);
    const sizes = signed(paths).subarray(path + k * frames, path + (k + 1) * frames);
    for (let f = 0; f < frames; ++f)
      for (let i = 0; i < wide; ++i) departures[f * wide + i] += metre * sizes[f] * of[i];
  });
  const places = departures.map((d, i) => low[i % 3] + unit[i % 3] * rests[row * wide + i % wide] + larger * d);
  const largest = f => departures.subarray(f * wide, (f + 1) * wide).reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  const times = Array.from({length: frames}, (_, f) => f * apart);
  const scene = {
    ...set.stage,
    times,
    speed: times[frames - 1] / 6,
    plot: {label: 'departure from rest / m', unit: 'm', powers: true, title: 'Largest departure from rest'},
    methods: [{
      ...method,
      low: [0, 0, 0],
      unit: [1, 1, 1],
      frames,
      stops: times[frames - 1],
      end: '',
      failed: null,
      failure: outcome === 'holds' ? '' : outcome,
      reason: 'the last moments before',
      first: true,
      plotted: times.map((_, f) => (largest(f) > 0 ? Math.log10(largest(f)) : null))
    }],
    hint: `The last ${frames} pictures of the run, up to ${short(end)} s. ` +
        (larger > 1 ? `Departures from rest are drawn ${short(larger)} times as large as they are. ` :
                      'Departures are drawn in true size. ') +
        set.stage.hint
  };
  return {scene, motions: [{places}], call: ''};
}

/** Opens the window with a run: which, is said by its marker. */
async function playRun(key, marker) {
  const set = runsOf(key), [head, ...lines] = tipOf(marker).split('\n');
  const at = marker.dataset.run.lastIndexOf(' '), place = Number(marker.dataset.run.slice(at + 1));
  const method = set.methods.get(marker.dataset.run.slice(0, at));
  const run = method && (method.runs ?? method.cells)[place];
  const close = make('button', {type: 'button', class: 'close', 'aria-label': 'Close'}, '✕');
  const box = make('div', {class: 'player'});
  const dialog = make(
      'dialog', {class: 'run', 'aria-label': `Run: ${head}`}, close,
      make('h3', {}, `${set.scene ?? set.stage.scene}: ${head}`), make('p', {}, lines.join('; ')), box);
  document.body.append(dialog);
  const played = !run ? null :
      method.runs     ? await runBesideTruth(set, method, run) :
                        await lastMoments(set, method, place, lines[0]);
  const player = make('motion-player');
  if (played) {
    player.given = {scene: played.scene, motions: played.motions};
    box.append(make('figure', {class: 'render'}, make('div', {class: 'stage'})), player);
    if (played.call) box.append(make('p', {class: 'hint'}, 'The same run: ', make('code', {}, played.call)));
  } else {
    box.append(make('p', {}, 'It ended before there was a second picture of it to show.'));
  }
  close.addEventListener('click', () => dialog.close());
  dialog.addEventListener('click', event => event.target === dialog && dialog.close());
  dialog.addEventListener('close', () => {
    if (player.stage) player.sleep();
    dialog.remove();
    marker.focus?.();
  });
  dialog.showModal();
}

/** Below a figure: its runs as a list, made when it is asked for. */
function listRuns(figure) {
  const list = make('details', {class: 'list'}, make('summary', {}, 'Play a run: click on it in the figure, or choose'));
  list.addEventListener('toggle', () => {
    if (list.querySelector('select')) return;
    const markers = [...figure.querySelectorAll('[data-run]')], groups = new Map();
    markers.forEach((marker, i) => {
      const name = marker.dataset.run.replace(/ \d+$/, ''), words = tipOf(marker).split('\n');
      if (!groups.has(name)) groups.set(name, make('optgroup', {label: name}));
      groups.get(name).append(
          make('option', {value: i}, `${words[0].replace(`${name}, `, '')}: ${words.slice(1).join('; ')}`));
    });
    const select = make('select', {'aria-label': 'run'}, ...groups.values());
    const play = make('button', {type: 'button'}, '▶ Play');
    play.addEventListener('click', () => playRun(figure.dataset.runs, markers[select.value]));
    list.append(select, ' ', play);
  });
  figure.append(list);
}

if (plays) {
  document.addEventListener('DOMContentLoaded', () => {
    for (const figure of document.querySelectorAll('figure[data-runs]')) listRuns(figure);
  });
  document.addEventListener('click', event => {
    const marker = event.target.closest?.('[data-run]'), figure = marker?.closest('figure[data-runs]');
    if (figure) playRun(figure.dataset.runs, marker);
  });
}
