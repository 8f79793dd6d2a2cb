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

/** Whose run a marker plays. */
const methodOf = marker => marker.dataset.run.replace(/ \d+$/, '');

/** What a marker says; page.js may have taken its title already. */
const tipOf = marker => marker.dataset.words ?? `${methodOf(marker)}, ${marker.querySelector('title').textContent}`;

/** Smallest 1, 2 or 5 times a power of ten that is not below a value. */
function roundUp(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].find(s => s * power >= value * (1 - 1e-9)) * power;
}

/** Signed numbers of 16 bits. */
const signed = numbers => new Int16Array(numbers.buffer);

/** Obstacles at some of a scene's frames. */
const spheresAt = (scene, frames) => scene.spheres.map(
    sphere => ({...sphere, centres: sphere.centres.length > 1 ? frames.map(f => sphere.centres[f]) : sphere.centres}));

/** The scene of a speed-accuracy chart with a run that came to its end beside the truth, as Stage and Controls take it. */
async function runBesideTruth(whole, method, run) {
  const at = whole.methods.findIndex(m => m.known), truth = whole.methods[at], {every, grain} = method;
  const [{motions}, apart] = await Promise.all([unpackScene(whole), unpack(run.places)]);
  const wide = 3 * whole.particles, known = motions[at].places, kept = Math.ceil(truth.frames / every);
  const ofTruth = i => known[Math.min(Math.floor(i / wide) * every, truth.frames - 1) * wide + i % wide];
  const places = Float32Array.from(signed(apart), (d, i) => ofTruth(i) + grain * d);
  const truthPlaces = Float32Array.from({length: kept * wide}, (_, i) => ofTruth(i));
  // distances from the truth, while single positions can be compared
  const metres = new Float32Array(Math.min(run.plotted.length, run.frames) * whole.particles);
  for (let p = 0; p < metres.length; ++p)
    metres[p] = Math.hypot(...[0, 1, 2].map(k => truth.unit[k] * (places[3 * p + k] - truthPlaces[3 * p + k])));
  const top = roundUp(1e3 * metres.reduce((a, b) => Math.max(a, b), 1e-6));
  const finer = top < 2e3 * truth.unit[0] * grain;  // than what is drawn
  const frames = whole.times.map((_, f) => f).filter(f => f % every === 0);
  const scene = {
    ...whole,
    times: frames.map(f => whole.times[f]),
    spheres: spheresAt(whole, frames),
    stretch: null,
    distance: finer ? null : {top, name: 'distance to the truth', label: 'mm'},
    finest: Math.hypot(1, 1, 1) / 2 * grain * truth.unit[0],
    plot: {label: 'distance to the truth / m', unit: 'm', powers: true, title: 'Distance to the truth over time'},
    methods: [
      {...method, ...run, low: truth.low, unit: truth.unit, first: true, failed: null, failure: '', reason: '', end: '', stops: Infinity},
      {...truth, frames: kept, plotted: [], first: true},
    ]
  };
  return {scene, motions: [{places, distance: metres.map(m => levels * 1e3 * m / top)}, {places: truthPlaces}]};
}

/** The same with the last pictures of a run that failed. */
async function lastPictures(whole, method, run) {
  const times = run.times.map(t => t - run.times[0]), end = times[times.length - 1];
  const scene = {
    ...whole,
    times,
    stretch: null,
    distance: null,
    speed: end / 6,
    spheres: spheresAt(
        whole, run.times.map(t => Math.max(0, whole.times.findLastIndex(frame => frame <= t)))),
    methods: [{...method, ...run, stops: end, failed: null, first: true}],
    plot: {label: 'kinetic energy / J', unit: 'J', powers: true, title: 'Kinetic energy over the last pictures'},
    finest: run.unit[0],
    caption: `The last ${run.frames} pictures of the run, from ${Number(run.times[0].toPrecision(3))} s on.`
  };
  return {scene, motions: [{places: await unpack(run.places)}]};
}

/** The scene of a map with the last pictures of a cell's run that its particles are still in. */
async function lastMoments(set, method, place, outcome) {
  const wide = 3 * set.stage.particles, {cells, low, unit} = method;
  const [row, frames, apart, end, larger, metres, ended] = cells[place];
  const [rests, shapes, paths] = await Promise.all(['rests', 'shapes', 'paths'].map(name => unpack(method[name])));
  let shape = 0, path = 0;
  for (const before of cells.slice(0, place))
    if (before) shape += before[5].length * wide, path += before[5].length * before[1];
  const departures = new Float32Array(frames * wide);
  metres.forEach((metre, k) => {
    const of = signed(shapes).subarray(shape + k * wide, shape + (k + 1) * wide);
    const sizes = signed(paths).subarray(path + k * frames, path + (k + 1) * frames);
    for (let f = 0; f < frames; ++f)
      for (let i = 0; i < wide; ++i) departures[f * wide + i] += metre * sizes[f] * of[i];
  });
  const places = departures.map((d, i) => low[i % 3] + unit[i % 3] * rests[row * wide + i % wide] + larger * d);
  const largest = f => departures.subarray(f * wide, (f + 1) * wide).reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  const times = Array.from({length: frames}, (_, f) => f * apart), sizes = times.map((_, f) => largest(f));
  const left = ended > 0;  // what comes after these pictures is too far out to be seen
  const powers = Math.max(...sizes) > 100 * Math.max(...sizes.slice(0, Math.ceil(frames / 3)));  // it grows
  const scene = {
    ...set.stage,
    times,
    speed: times[frames - 1] / 6,
    plot: {label: 'departure from rest / m', unit: 'm', powers, title: 'Largest departure from rest'},
    methods: [{
      ...method,
      low: [0, 0, 0],
      unit: [1, 1, 1],
      frames,
      stops: times[frames - 1],
      end: '',
      failed: null,
      failure: outcome === 'holds' ? '' : outcome,
      reason: left ? 'the pictures before it left the frame' : 'the last moments before',
      first: true,
      plotted: powers ? sizes.map(size => (size > 0 ? Math.log10(size) : null)) : sizes
    }],
    caption: (left ? `${frames} pictures up to ${Number(end.toPrecision(3))} s, when the run leaves the frame; it ended at ` +
                       `${Number(ended.toPrecision(3))} s. `
                 : `The last ${frames} pictures of the run, up to ${Number(end.toPrecision(3))} s. `) +
        (larger > 1 ? `Departures from rest are drawn ${short(larger)} times as large as they are.` :
                      'Departures are drawn in true size.')
  };
  return {scene, motions: [{places}]};
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
  const whole = () => JSON.parse(document.getElementById(set.scene).querySelector('script.motion').textContent);
  const given = !run ? null :
      method.cells   ? await lastMoments(set, method, place, lines[0]) :
      run.times      ? await lastPictures(whole(), method, run) :
                       await runBesideTruth(whole(), method, run);
  const player = make('motion-player');
  if (given) {
    player.given = given;
    box.append(make('figure', {class: 'render'}, make('div', {class: 'stage'})), player);
  } else {
    box.append(make(
        'p', {},
        method ? 'It ended before there was a second picture of it to show.' :
                 'The runs of this method are too large for the page; the command run plays them.'));
  }
  if (run?.call)
    box.append(make(
        'p', {class: 'hint'}, 'The same run: ',
        make('code', {}, `./crosscheck run ${set.scene} --method ${method.name} ${run.call}`)));
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
}

/** Below a figure: its runs as a list, made when it is asked for. */
function listRuns(figure) {
  const list = make('details', {class: 'run-list'}, make('summary', {}, 'Play a run: click on it in the figure, or choose'));
  list.addEventListener('toggle', () => {
    if (list.querySelector('select')) return;
    const markers = [...figure.querySelectorAll('[data-run]')], groups = new Map();
    markers.forEach((marker, i) => {
      const name = methodOf(marker), words = tipOf(marker).split('\n');
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
