// The lab in use: sliders, blow-ups, dragging, export and keys. Each function returns its observations. Calls advance
// the runs, and frames are drawn only where required, so that nothing depends on the frame rate.

const labUse = (() => {
  const theLab = () => document.querySelector('live-lab');
  const button = name => theLab().querySelector(`[data-act=${name}]`);
  const knobOf = name => theLab().querySelector(`[data-knob="${name}"]`);
  const pause = ms => new Promise(done => setTimeout(done, ms));
  const say3 = value => (Number.isFinite(value) ? value.toPrecision(3) : String(value));

  async function until(holds, what) {
    for (let waited = 0; waited < 20000; waited += 10) {
      const value = holds();
      if (value) return value;
      await pause(10);
    }
    throw new Error(`waited in vain for ${what ?? holds}`);
  }

  /** Waits for the next frame of the browser, after which the lab has drawn. */
  const frame = () => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)));

  /** Failures found by a test, one line each. */
  class Complaints {
    lines = [];
    checked = 0;
    check(holds, ...words) {
      ++this.checked;
      if (!holds) this.lines.push(words.join(' '));
      return holds;
    }
  }

  async function opened(state, drawn = true) {
    const lab = theLab();
    if (!drawn) lab.draw = () => false;
    await lab.setState(state);
    await until(() => lab.dataset.state === 'ready' && lab.reading?.scene === state.scene, `${state.scene} to be open`);
    return lab;
  }

  /** Moves a slider to a position between 0 and 1 as a pointer or an arrow key does: input, then change. */
  function slide(knob, part) {
    const range = knob.querySelector('input[type=range]');
    range.value = Number(range.min) + part * (range.max - range.min);
    for (const name of ['input', 'change']) range.dispatchEvent(new Event(name, {bubbles: true}));
  }

  function type(knob, text) {
    const field = knob.querySelector('input[type=number]');
    field.value = text;
    field.dispatchEvent(new Event('change', {bubbles: true}));
  }

  function choose(select, value) {
    select.value = value;
    select.dispatchEvent(new Event('change', {bubbles: true}));
  }

  /** Advances a run by `count` steps and returns its fingerprint. */
  function steps(sim, count) {
    if (count > 0) sim.call('advance', Infinity, count);
    sim.outcome = null;
    return sim.fingerprint();
  }

  /** Time (s) stated in a text. */
  function timeIn(words) {
    const [, value, unit] = /([\d.]+(?:e-?\d+)?) (µs|ms|s)\b/.exec(words) ?? [];
    return value === undefined ? NaN : Number(value) * {µs: 1e-6, ms: 1e-3, s: 1}[unit];
  }


  /** Keys at which two scene texts differ, as "section.key" or "section". Independent of the lab's parser. */
  function differences(from, to) {
    const a = from.split('\n'), b = to.split('\n'), places = new Set();
    if (a.length !== b.length) return ['the number of lines'];
    let section = '';
    a.forEach((line, i) => {
      const head = /^\s*\[\[?\s*([\w.-]+)/.exec(line), key = /^\s*([\w.-]+)\s*=/.exec(line);
      if (head) section = head[1];
      if (line !== b[i]) places.add(head || !key ? section : section ? `${section}.${key[1]}` : key[1]);
    });
    return [...places];
  }

  /** True if a slider may change this key. A drag of 0 removes its whole section. */
  const belongs = (place, name) => place === name || place.startsWith(`${name}.`) || (/^drag\./.test(name) && /^drag\b/.test(place));

  /** Moves every slider of these scenes to both ends and back. */
  async function sliders(scenes) {
    const all = new Complaints();
    let moved = 0;
    for (const scene of scenes) {
      const lab = await opened({scene}, false), shipped = sceneText(scene);
      const names = [...lab.querySelectorAll('.controls [data-knob]')].filter(k => !k.hidden).map(k => k.dataset.knob);
      all.check(names.includes('step-A') || names.includes('tolerance-A'), scene, 'has no slider of the step');
      for (const name of names) {
        const ofMethod = /-A$/.test(name), own = Number(knobOf(name).querySelector('input[type=number]').value);
        for (const [part, words] of [[0, 'low'], [1, 'high'], [null, 'back']]) {
          lab.advance(2.5 * lab.runs[0].sim.scene.step);
          const well = (holds, ...why) => all.check(holds, scene, name, words, ...why), before = lab.toml;
          part === null ? type(knobOf(name), own) : slide(knobOf(name), part);
          ++moved;
          const {reading} = lab, [run] = lab.runs, places = differences(shipped, lab.toml);
          well(lab.good === lab.toml && !run.refusal && !run.fault, 'is not taken:', run.refusal, run.fault, lab.view.said.textContent);
          if (lab.view.said.classList.contains('failed')) {
            // a ball must not reach a particle's initial position
            well(name === 'sphere.radius' && part === 1 && lab.toml === before && /sphere/.test(lab.view.said.textContent), 'is refused:', lab.view.said.textContent);
            well(Number(knobOf(name).querySelector('input[type=number]').value) === numberAt(before, name), 'shows a number that was refused');
            lab.view.say('');
            continue;
          }
          well(reading.t === 0 && run.sim.steps === 0 && run.sim.t === 0, 'does not start again');
          well(places.every(place => !ofMethod && belongs(place, name)), 'changes', places);
          if (ofMethod) well(part === null || run.sim.h <= lab.methods[0].step * (1 + 1e-9), 'takes a longer step');
          else if (part !== null) well(places.length > 0, 'changes nothing');
          if (part === null && !ofMethod) {
            const now = numberAt(lab.toml, valueAt(lab.toml, name) === undefined ? `${name}.structural` : name);
            well(Math.abs(now / own - 1) < 1e-2, 'comes back to', now, 'for', own);
          }
          lab.advance(2.5 * (run.sim.h || run.sim.scene.step));
          well(!run.fault && lab.reading.t > 0, 'does not run:', run.fault);
        }
        if (lab.toml !== shipped) button('original').click();
        await until(() => lab.toml === shipped, `${scene} as it is shipped`);
      }
    }
    const lab = await opened({scene: scenes[0], methods: [{method: 'dopri5'}]}, false), tolerances = [];
    for (const part of [0, 1]) {
      slide(knobOf('tolerance-A'), part);
      tolerances.push(lab.methods[0].tolerance);
      lab.advance(0.01);
      all.check(!lab.runs[0].refusal && lab.runs[0].sim.steps > 0 && lab.toml === sceneText(scenes[0]), 'dopri5 does not run:', lab.runs[0].refusal);
    }
    all.check(tolerances[0] === 1e-10 && tolerances[1] === 1e-2, 'the tolerances are', tolerances);
    // a moving slider takes effect soon
    const knob = lab.querySelector('.knobs .knob'), range = knob.querySelector('input[type=range]');
    const before = lab.good;
    range.value = Number(range.value) + 50;
    range.dispatchEvent(new Event('input', {bubbles: true}));
    await until(() => lab.good !== before && lab.good === lab.toml, 'the slider that moves');
    return {...all, moved};
  }

  /** Checks the text at the step's slider for every stepper, and its mark as the stiffness of all springs changes. */
  async function marks(scenes) {
    const all = new Complaints(), words = {}, refused = [];
    for (const scene of scenes) {
      const lab = await opened({scene}, false), select = () => lab.querySelector('select[data-stepper="A"]');
      words[scene] = {};
      for (const {value} of [...select().options]) {
        choose(select(), value);
        const [run] = lab.runs, note = lab.querySelector('.method .note').textContent;
        all.check(lab.methods[0].method === value && run.spec.method === value && lab.view.said.textContent === '', scene, value, 'is not chosen:', lab.view.said.textContent);
        all.check(run.refusal ? note.includes(run.refusal) : !/cannot run/.test(note), scene, value, 'says', note, 'as', run.refusal);
        if (run.refusal) {
          refused.push(`${scene} ${value}`);
          button('run').click();
          lab.advance(0.1);
          all.check(lab.reading.t === 0 || lab.reading.ended, scene, value, 'runs though it is refused');
          lab.pause();
        }
        if (lab.lab.steppers.find(s => s.name === value).adaptive) continue;
        words[scene][value] = lab.querySelector('.mark-words').textContent;
      }
      if (![...select().options].some(option => option.value === 'leapfrog')) continue;  // first order
      choose(select(), 'leapfrog');
      const said = () => timeIn(lab.querySelector('.mark-words').textContent);
      const knob = ['grid.stiffness', 'spring.stiffness'].map(knobOf).find(Boolean), limit = lab.reading?.limitA;
      if (!knob || !Number.isFinite(limit)) continue;
      if (/^bending/m.test(lab.toml)) continue;  // the rigidity, which this slider does not change, also limits the
                                                 // step
      const name = knob.dataset.knob, own = Number(knob.querySelector('input[type=number]').value), before = said();
      const at = () => Number(lab.querySelector('.method').style.getPropertyValue('--at'));
      const bound = () => lab.querySelector('.method').classList.contains('bound'), place = bound() && at();
      type(knobOf(name), own / 4);
      all.check(Math.abs(said() / before - 2) < 0.02, scene, 'the mark goes from', before, 'to', said());
      all.check(Math.abs(lab.reading.limitA / limit - 2) < 0.02, scene, 'the limit goes from', limit, 'to', lab.reading.limitA);
      if (bound() && place !== false) all.check(at() !== place, scene, 'the mark stays at', place);
    }
    // an address may name a method that does not support the scene
    for (const [scene, method] of refused.slice(-1).map(words => words.split(' '))) {
      const lab = await opened({scene, methods: [{method}]}, false), [run] = lab.runs;
      all.check(run.refusal && lab.querySelector('.method .note').textContent.includes(run.refusal), scene, method, 'is not refused when it is opened');
      choose(lab.querySelector('select[data-stepper="A"]'), lab.runs[0].sim.scene.method);
      lab.advance(0.05);
      all.check(!lab.runs[0].refusal && lab.reading.t > 0, scene, 'does not run after a refusal');
    }
    return {...all, words, refused};
  }


  /**
   * A scene for each rule. `above` and `below` are fractions of the rule's critical step. For explicit Euler this step
   * is gamma / omega^2, or 1.3 µs on a shipped cloth (2.4 million steps), and above it vibrations grow by only
   * gamma / 2 per second. Explicit Euler therefore gets a cloth at the sliders' limits: 50 times softer, with ten times
   * the drag. So does the trapezoidal rule, which also grows slowly. Without drag, both rules are unstable at every
   * step. With a single sample only the last step is shortened.
   */
  const gentle = /^(explicit-euler|trapezoidal)$/;
  const softened = k => ({'grid.stiffness.structural': k, 'grid.stiffness.shear': k, 'grid.stiffness.bend': k, 'drag.gamma': 40});
  const burstScenes = {
    'cloth-hang': rule => (gentle.test(rule) ? softened(4) : {}),
    flag: rule => (gentle.test(rule) ? softened(4) : {}),
    spring: () => ({'time.duration': 60})
  };
  /** Just above the limit, RK4 and Suzuki's rule amplify only the fastest vibrations, which wind and wrinkles damp. */
  const partsOf = rule => (gentle.test(rule) ? {above: 2.5, below: 0.9} : /^(rk4|suzuki4)$/.test(rule) ? {above: 1.2, below: 0.96} : {above: 1.06, below: 0.96});

  async function bursts() {
    const all = new Complaints(), tried = [], engine = await labModule();
    const explicit = engine.steppers.filter(s => !s.adaptive && !s.hard && s.evaluations > 0);
    for (const [scene, method] of Object.keys(burstScenes).flatMap(scene => explicit.map(s => [scene, s.name]))) {
      const changes = {'time.samples': 1, ...burstScenes[scene](method)}, {above, below} = partsOf(method);
      const lab = await opened({scene, changes, methods: [{method}]}, false), limit = lab.reading.limitA, {duration} = lab.runs[0].sim.scene;
      const well = (holds, ...why) => all.check(holds, scene, method, ...why);
      well(limit >= 0 && Number.isFinite(limit), 'has the critical step', limit);
      const runAt = async step => {
        await lab.setState({methods: [{method, step}]});
        const [run] = lab.runs;
        well(!run.refusal, 'is refused:', run.refusal);
        well(Math.abs(run.sim.h / step - 1) < 0.03, 'takes', run.sim.h, 'for', step);
        while (!run.ended) run.advance(lab.end, Infinity);
        lab.judge();
        return run;
      };
      const step = limit > 0 ? above * limit : 100 * lab.runs[0].sim.scene.step, run = await runAt(step), row = {method, above: run.sim.h / limit, at: run.time};
      well(run.failed && run.time < duration, 'holds at', step, 's,', above, 'of its critical step', limit);
      well(lab.dataset.verdict === run.verdict && run.verdict !== 'ok', 'is judged', lab.dataset.verdict);
      // there may be no mode for the single spring, which swings by more than a tenth of its length
      const {growth} = run.sim, most = growth && Math.max(...growth.map(Math.abs)), shown = growth || scene !== 'spring';
      if (shown) well(growth && growth.length === run.places.length && most > 0.5 && most <= 1 + 1e-12 && lab.growth?.letter === 'A', 'has no mode that grows');
      well(isFinite3(run.places), 'leaves no picture');
      const {verdict} = lab.view;
      well(!verdict.hidden && verdict.textContent.includes(say('growth')) === Boolean(shown) && /failed at/.test(verdict.textContent), 'says', verdict.textContent);
      if (limit > 0) well(verdict.textContent.includes(`${Number((run.sim.h / limit).toPrecision(3))} × the predicted critical step`), 'says', verdict.textContent);
      verdict.querySelector('[data-act=restart]').click();
      const [again] = lab.runs;
      well(lab.reading.t === 0 && !again.ended && lab.dataset.verdict === 'ok' && !lab.growth && verdict.hidden, 'does not start again');
      for (let i = 0; i < 3; ++i) again.advance(again.time + 1.5 * again.sim.h, Infinity);  // one step per call
      well(again.sim.steps >= 3 && !again.fault, 'does not run again');
      if (limit > 0) {
        const held = await runAt(below * limit);
        row.below = held.sim.h / limit;
        well(!held.failed && Math.abs(held.time - duration) < 1e-6, 'fails at', held.time, 's below its critical step:', held.reason);
        well(lab.dataset.verdict === 'ok' && !lab.growth, 'is judged', lab.dataset.verdict);
      }
      tried.push(row);
    }
    return {...all, tried};
  }

  /** Runs above the critical step (by the given factors) in real frames. Returns the longest computing times per frame (ms). */
  async function burstsInFrames(scene, tried = {leapfrog: 1.5, rk4: 1.5, suzuki4: 1.5, 'symplectic-euler': 1.5}) {
    const all = new Complaints(), spent = [];
    const lab = await opened({scene});
    for (const name of ['advance', 'sample', 'judge']) {
      const act = lab[name];
      lab[name] = function(...given) {
        const begin = performance.now(), outer = this.within;
        this.within = true;
        const result = act.apply(this, given);
        this.within = outer;
        if (!outer) spent.push(performance.now() - begin);
        return result;
      };
    }
    for (const [method, part] of Object.entries(tried)) {
      await lab.setState({scene, methods: [{method}]});
      await lab.setState({methods: [{method, step: part * lab.reading.limitA}], running: true});
      await until(() => lab.dataset.verdict !== 'ok' && !lab.reading.running, `${method} to burst`);
      all.check(lab.reading.ended, method, 'goes on');
      button('restart').click();
      all.check(lab.reading.t === 0 && lab.dataset.verdict === 'ok', method, 'does not start again');
    }
    spent.sort((x, y) => y - x);
    return {...all, frames: spent.length, longest: spent.slice(0, 5)};
  }


  /** Position of a particle of the first run on the screen. */
  function placeOf(particle) {
    const lab = theLab(), [x, y] = lab.stage.project(lab.runs[0].places.subarray(3 * particle, 3 * particle + 3), lab.stage.boxes[0]);
    const box = lab.view.layer.getBoundingClientRect();
    return {clientX: box.left + x, clientY: box.top + y};
  }

  /** Dispatches a pointer event on the picture. Without a device the pointer cannot be captured. */
  function pointer(name, place, pointerType = 'mouse') {
    const {layer} = theLab().view;
    layer.setPointerCapture = () => {};
    layer.dispatchEvent(new PointerEvent(name, {pointerId: 7, pointerType, button: 0, bubbles: true, cancelable: true, ...place}));
  }
  const moved = ({clientX, clientY}, across, down) => ({clientX: clientX + across, clientY: clientY + down});
  const apart = (a, b) => Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY);

  function key(name, target = theLab().view.layer) {
    const event = new KeyboardEvent('keydown', {key: name, bubbles: true, cancelable: true});
    target.dispatchEvent(event);
    return event.defaultPrevented;
  }

  /** Drags a particle by some pixels. The hand continues to hold it unless `letGo` is set. */
  async function drag(particle, across, down, letGo = true, type = 'mouse') {
    const lab = theLab();
    await frame();
    const from = placeOf(particle), to = moved(from, across, down);
    pointer('pointerdown', from, type);
    pointer('pointermove', moved(from, 0.5 * across, 0.5 * down), type);
    await until(() => !lab.waiting, 'the hand');
    pointer('pointermove', to, type);
    await until(() => !lab.waiting, 'the hand');
    await frame();
    if (letGo) pointer('pointerup', to, type);
    return to;
  }

  /** Drags, pins and releases particles by a pointer, in a scene whose corner is free. */
  async function handByPointer(scene, particle) {
    const all = new Complaints(), check = all.check.bind(all), errors = [], lab = await opened({scene});
    const pins = () => [...lab.runs[0].sim.scene.pins], words = () => lab.view.particle.textContent, {layer} = lab.view;
    const runOn = time => {
      const end = lab.clock + time;
      lab.frameTime = 4000;  // ms; enough for the truth and its error bar
      for (let i = 0; i < 200 && lab.clock < end - 1e-9; ++i) lab.advance(end - lab.clock);
    };
    runOn(0.2);
    check(!lab.reading.byHand && lab.runs[0].sim.t > 0.19, 'is by hand before the hand came');
    const shipped = lab.runs[0].sim.scene.pins.length;
    await until(() => (lab.sample(), lab.runs[0].samples.some(s => s.error > 0)), 'the error before the hand');
    for (const type of ['mouse', 'touch']) {
      const before = lab.clock, to = await drag(particle, type === 'mouse' ? 50 : -50, -30, false, type), [run] = lab.runs;
      check(apart(placeOf(particle), to) < 2, type, 'holds the particle', apart(placeOf(particle), to), 'pixels off');
      check(lab.reading.byHand && run.sim.byHand, type, 'is not by hand');
      check(run.sim.t < 0.02 && Math.abs(lab.reading.t - before) < 0.02 && Math.abs(run.time - before) < 0.02, type, 'clocks', run.sim.t, lab.reading.t);
      check(words() === say('held', {i: particle}) && lab.view.pin.hidden, type, 'says', words());
      check(lab.reading.chosen === particle, type, 'has not chosen', lab.reading.chosen);
      check(lab.dataset.running === undefined, type, 'runs though motion is unwanted');
      check(pins().length === shipped + 1, type, 'pins', pins());
      const held = [...run.places.subarray(3 * particle, 3 * particle + 3)];
      runOn(0.05);
      check(held.every((v, k) => v === run.places[3 * particle + k]), type, 'moves what it holds');
      check(lab.reading.error === null, type, 'has a truth');
      pointer('pointerup', to, type);
      check(words() === say('particle', {i: particle}) && !lab.hand.held, type, 'says after it let go', words());
      check(pins().length === shipped, type, 'leaves pins', pins());
      const free = lab.runs[0];
      runOn(0.1);
      check(held.some((v, k) => v !== free.places[3 * particle + k]), type, 'does not let go');
      await until(() => (lab.sample(), lab.reading.error > 0), 'the error after the hand');
      lab.showNow(true);
      check(lab.truth?.known && lab.view.truthWords.textContent.startsWith(say('truthByHand', {stepper: nameOfMethod(lab.truth.spec.method), h: '…'}).split('…')[0]), type, 'says', lab.view.truthWords.textContent);
      // an independent run with an eighth of the step, from the state at the release
      const last = free.samples[free.samples.length - 1], own = lab.lab.open(free.sim.sceneText());
      own.start({stepper: 'suzuki4', step: free.sim.h / 8, observe: false});
      own.advance(free.sim.t);
      const error = rmsDistance(own.positions, free.places);
      check(last.t === free.time && Math.abs(own.t - free.sim.t) < 1e-9 && Math.abs(last.error / error - 1) < 0.05, type, 'has the error', last.error, 'for', error);
      check(last.bar !== null && last.bar < 0.2 * last.error, type, 'has the error bar', last.bar);
      own.close();
      errors.push(error);
    }
    // a click selects a particle, a double click pins or releases it
    await frame();
    const other = particle - 1, place = placeOf(other);
    pointer('pointerdown', place);
    pointer('pointerup', place);
    check(lab.reading.chosen === other, 'a click chooses', lab.reading.chosen, 'for', other);
    const {runs: [before]} = lab.reading, at = [...before.places.subarray(3 * other, 3 * other + 3)];
    layer.dispatchEvent(new MouseEvent('dblclick', {...place, bubbles: true}));
    check(pins().includes(other) && words() === say('pinnedAt', {i: other}) && button('pin').textContent === say('unpin'), 'a double click pins', pins(), words());
    runOn(0.05);
    check(at.every((v, k) => v === lab.runs[0].places[3 * other + k]), 'a pin moves');
    button('pin').click();
    check(!pins().includes(other) && button('pin').textContent === say('pin'), 'a button lets go', pins());
    runOn(0.05);
    check(at.some((v, k) => v !== lab.runs[0].places[3 * other + k]), 'a pin stays though it was let go');
    // dragging the background rotates the view; restart resets everything
    await frame();
    const {yaw} = lab.orbit, box = layer.getBoundingClientRect(), corner = {clientX: box.left + 4, clientY: box.bottom - 4};
    pointer('pointerdown', corner);
    pointer('pointermove', moved(corner, 50, 0));
    pointer('pointerup', moved(corner, 50, 0));
    check(Math.abs(lab.orbit.yaw - yaw) > 0.1, 'the background does not turn');
    button('restart').click();
    check(!lab.reading.byHand && lab.reading.t === 0 && lab.runs[0].sim.t === 0 && pins().length === shipped, 'restart keeps what the hand did');
    return {...all, errors};
  }

  /** Tests all keys of the picture. */
  async function keysOfPicture(scene) {
    const all = new Complaints(), check = all.check.bind(all), lab = await opened({scene}), {orbit} = lab, [run] = lab.runs;
    const pins = () => [...lab.runs[0].sim.scene.pins], start = {yaw: orbit.yaw, pitch: orbit.pitch, zoom: orbit.zoom};
    lab.view.layer.focus();
    check(document.activeElement === lab.view.layer, 'the picture takes no focus');
    for (const [name, what, grows] of [['ArrowLeft', 'yaw', false], ['ArrowRight', 'yaw', true], ['ArrowUp', 'pitch', true], ['ArrowDown', 'pitch', false]]) {
      const was = orbit[what];
      check(key(name) && (grows ? orbit[what] > was : orbit[what] < was), name, 'turns', was, orbit[what]);
    }
    for (const name of ['+', '=', '-']) {
      const was = orbit.zoom;
      check(key(name) && orbit.zoom !== was, name, 'does not zoom');
    }
    key('ArrowLeft');
    check(key('0') && Object.keys(start).every(k => Math.abs(orbit[k] - start[k]) < 1e-9), '0 does not reset the view');
    const count = run.places.length / 3;
    check(key('p') && lab.reading.chosen === count - 1, 'p chooses', lab.reading.chosen);
    check(key('n') && lab.reading.chosen === 0, 'n chooses', lab.reading.chosen);
    for (let i = 0; i < 2; ++i) key('p');
    const particle = lab.reading.chosen;
    check(particle === count - 2, 'p chooses', particle);
    const place = () => [...lab.runs[0].places.subarray(3 * particle, 3 * particle + 3)];
    for (const [to, back] of [['l', 'j'], ['i', 'k'], ['o', 'u']]) {
      const from = place(), go = async name => {
        check(key(name), name, 'is not taken');
        await until(() => !lab.waiting, name);
        return place();
      };
      const there = await go(to), again = await go(back), size = 0.03 * lab.stage.size;
      check(Math.abs(Math.hypot(...there.map((v, k) => v - from[k])) / size - 1) < 0.01, to, 'moves by', Math.hypot(...there.map((v, k) => v - from[k])));
      check(Math.hypot(...again.map((v, k) => v - from[k])) < 1e-9, back, 'does not move back');
    }
    check(lab.reading.byHand && lab.hand.held?.particle === particle && pins().includes(particle), 'keys do not hold the particle');
    check(key('Escape') && !lab.hand.held && !pins().includes(particle) && lab.reading.chosen === particle, 'Escape does not let go');
    check(key('x') && pins().includes(particle), 'x does not pin');
    check(key('x') && !pins().includes(particle), 'x does not let go');
    check(key('Escape') && lab.reading.chosen === null, 'Escape does not choose nothing');
    check(!key('Escape'), 'Escape with nothing chosen is kept from the page');
    check(!key('Tab') && !key('Enter') && !key('q'), 'keys are kept from the page');
    key('n'), key('i');
    await until(() => !lab.waiting, 'i');
    lab.view.layer.blur();
    check(!lab.hand.held, 'the hand holds though the focus is elsewhere');
    lab.view.layer.focus();
    check(key('r') && lab.reading.t === 0 && !lab.reading.byHand, 'r does not start again');
    check(key('s') && lab.runs[0].sim.steps === 1 && !lab.reading.running, 's takes', lab.runs[0].sim.steps, 'steps');
    check(key('s') && lab.runs[0].sim.steps === 2, 's takes', lab.runs[0].sim.steps, 'steps');
    check(key(' ') && lab.reading.running && lab.dataset.running === '', 'space does not run');
    await until(() => lab.reading.t > 0.02, 'the run');
    check(key(' ') && !lab.reading.running, 'space does not pause');
    return all;
  }


  /** Text and name of the file that a button saves. */
  async function saved(act) {
    const {createObjectURL} = URL, {click} = HTMLAnchorElement.prototype, files = [];
    URL.createObjectURL = file => (files.push(file), 'blob:none');
    HTMLAnchorElement.prototype.click = function() { files.name = this.download; };
    act();
    Object.assign(URL, {createObjectURL}), HTMLAnchorElement.prototype.click = click;
    return {text: await files[0]?.text(), name: files.name};
  }

  const countedSteps = 120;

  /** Exports the present state in every way, continues, and restores it from its link and its file. */
  async function roundTrip(all, name) {
    const lab = theLab(), check = (holds, ...why) => all.check(holds, name, ...why), [run] = lab.runs, {sim} = run;
    lab.link = null;
    button('copyLink').click();
    const link = await until(() => lab.link, 'the link');
    const file = await saved(() => button('saveToml').click());
    check(file.text === lab.tomlNow && /\.toml$/.test(file.name), 'saves', file.name);
    lab.view.say('');
    button('copyCommand').click();
    const command = await until(() => /crosscheck run .*/.exec(lab.view.said.textContent)?.[0], 'the command line');
    const {method, step, scene} = {...lab.methods[0], scene: lab.reading.scene};
    check(sim.steps < countedSteps, 'is', sim.steps, 'steps on');
    const fingerprint = steps(sim, countedSteps - sim.steps);
    // restore the state from the address
    await lab.setState({scene: 'pendulum', methods: [{method: 'rk4', step: 0.01}]});
    check(lab.reading.scene === 'pendulum', 'does not go elsewhere');
    location.hash = link.split('#')[1];
    await until(() => lab.reading.scene === scene, 'the scene of the link');
    await pause(0);
    const [restored] = lab.runs;
    check(lab.methods[0].method === method && lab.methods[0].step === step, 'comes back with', JSON.stringify(lab.methods));
    check(!restored.refusal && lab.reading.t === 0, 'comes back refused:', restored.refusal);
    const again = restored.refusal ? '' : steps(restored.sim, countedSteps);
    check(again === fingerprint, 'comes back to', again, 'for', fingerprint);
    // restore it from the file
    await lab.acts.file(new File([file.text], 'saved.toml'));
    check(lab.reading.scene === 'saved' && lab.methods[0].method === method, 'is opened as', lab.reading.scene, JSON.stringify(lab.methods), lab.view.said.textContent);
    const opened = lab.runs[0].refusal ? lab.runs[0].refusal : steps(lab.runs[0].sim, countedSteps);
    check(opened === fingerprint, 'is opened as', opened, 'for', fingerprint);
    return {name, command, method, step, steps: countedSteps, fingerprint, link: link.length, text: file.text};
  }

  /** Saves changed scenes with some methods. */
  async function changedScenes() {
    const all = new Complaints(), saves = [], keep = async name => saves.push(await roundTrip(all, name));
    const runOn = count => steps(theLab().runs[0].sim, count);
    await opened({scene: 'cloth-hang', changes: {'grid.stiffness.bend': 0, 'grid.mass': 0.4, 'drag.gamma': 0}, methods: [{method: 'rk4', step: 8e-4}]});
    runOn(7);
    await keep('changed scene');
    await opened({scene: 'chain', changes: {'spring.stiffness': 300}, methods: [{method: 'symplectic-euler', step: 0.0013}]});
    await keep('changed chain');
    await opened({scene: 'circle', changes: {'rotation.rate': 2.5}, methods: [{method: 'trapezoidal', step: 0.03}]});
    await keep('circle');
    return {...all, saves};
  }

  /** Saves states that were changed by hand. */
  async function changedByHand() {
    const all = new Complaints(), saves = [], keep = async name => saves.push(await roundTrip(all, name));
    const runOn = count => steps(theLab().runs[0].sim, count);
    const lab = await opened({scene: 'cloth-hang', methods: [{method: 'leapfrog', step: 7e-4}]});
    runOn(90);
    lab.clock = lab.runs[0].time, lab.runs[0].keepPlaces();
    lab.hand.choose(210), button('pin').click();
    runOn(11);
    lab.runs[0].keepPlaces();
    await drag(399, -40, -30);
    runOn(13);
    all.check(lab.byHand && [...lab.runs[0].sim.scene.pins].join() === '0,19,210', 'the pins are', lab.runs[0].sim.scene.pins.join());
    await keep('drag and pin');
    // export while a particle is held
    await opened({scene: 'cloth-hang'});
    runOn(30);
    lab.runs[0].keepPlaces();
    await drag(390, 30, -20, false);
    runOn(5);
    await keep('held');
    await opened({scene: 'cloth-carried'});
    runOn(700);
    lab.runs[0].keepPlaces();
    await drag(255, 25, -35);
    runOn(9);
    await keep('moving ball');
    await opened({scene: 'cloth-hang', methods: [{method: 'suzuki4', step: 9e-4}]});
    runOn(40);
    for (const corner of [0, 19]) lab.hand.choose(corner), button('pin').click();
    all.check(lab.runs[0].sim.scene.pins.length === 0, 'pins are left:', lab.runs[0].sim.scene.pins);
    runOn(17);
    await keep('no pins');
    await opened({scene: 'cloth-swing'});
    runOn(300);
    lab.hand.choose(19), button('pin').click();
    runOn(6);
    await keep('moving pin');
    return {...all, saves};
  }

  /** State of a page opened by an address. */
  async function byAddress() {
    const lab = theLab(), guide = () => document.querySelector('lab-guide');
    await until(() => lab.dataset.state === 'ready' && lab.reading, 'the lab of the address');
    await pause(200);
    const {scene, t, running} = lab.reading, [{method, step}] = lab.methods;
    return {scene, t, running, method, step, stiffness: numberAt(lab.toml, 'spring.stiffness'), experiment: guide()?.dataset.experiment, phase: guide()?.dataset.phase};
  }

  /** Drops a file on the lab. */
  async function drop(name, text) {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], name));
    for (const type of ['dragenter', 'dragover', 'drop']) theLab().dispatchEvent(new DragEvent(type, {dataTransfer, bubbles: true, cancelable: true}));
  }

  /** Drops files: a user's scene, and texts that are not scenes. */
  async function drops() {
    const all = new Complaints(), lab = await opened({scene: 'spring'}), shipped = sceneText('spring'), said = [];
    const line = shipped.split('\n').findIndex(text => /^mass/.test(text)) + 1, broken = {
      'wrong number': shipped.replace(/^mass = .*$/m, 'mass = -1'),
      'no number': shipped.replace(/^mass = .*$/m, 'mass = "heavy"'),
      'no key': shipped.replace(/^mass = .*$/m, 'mas = 1'),
      'no TOML': shipped.replace(/^mass = .*$/m, 'mass = = 1'),
      'no scene': 'question = "?"\n',
      'no text': '\u0000\u0001',
    };
    lab.advance(0.1);
    for (const [name, text] of Object.entries(broken)) {
      lab.view.say('');
      await drop('mine.toml', text);
      const words = await until(() => lab.view.said.textContent, `what the lab says of ${name}`);
      said.push(words);
      all.check(lab.reading.scene === 'spring' && lab.toml === shipped && lab.view.sceneChoice.value === 'spring', name, 'is taken:', lab.reading.scene);
      all.check(lab.view.said.classList.contains('failed') && words.startsWith(say('sceneRefused', {reason: ''}).trim().slice(0, 12)), name, 'says', words);
      if (name.endsWith('number')) all.check(words.includes(`lab.toml:${line}: `) && words.includes('particle[0].mass'), name, 'says', words, 'for line', line);
      if (name === 'no TOML') all.check(words.includes(`lab.toml:${line}`), name, 'says', words);
      if (name === 'no key') all.check(/mas\b/.test(words), name, 'says', words);
      all.check(lab.view.dropHere.hidden, name, 'leaves the sign to drop there');
      const [run] = lab.runs;
      run.advance(lab.clock + 0.05, 1000);
      all.check(!run.fault && !run.refusal && run.sim.steps > 0, name, 'ends the run');
    }
    await drop('mine.toml', shipped.replace(/^stiffness = .*$/m, 'stiffness = 40'));
    await until(() => lab.reading.scene === 'mine', 'the scene of the file');
    all.check(lab.view.said.textContent === '' && knobOf('spring.stiffness').querySelector('input[type=number]').value === '40', 'a good file says', lab.view.said.textContent);
    all.check(lab.view.sceneChoice.selectedOptions[0].textContent.includes(say('ownScene')), 'the scene is called', lab.view.sceneChoice.selectedOptions[0].textContent);
    choose(lab.view.sceneChoice, 'spring');
    await until(() => lab.reading.scene === 'spring' && lab.toml === shipped, 'the shipped scene again');
    return {...all, said};
  }


  /** Reads the message of a page that cannot open the lab. */
  async function unavailable() {
    const lab = theLab();
    await until(() => lab.dataset.state === 'unavailable', 'the lab to give up');
    const seen = {missing: lab.dataset.missing, words: lab.innerText, high: lab.getBoundingClientRect().height, reading: lab.reading === null};
    setLabLanguage('zh');
    seen.chinese = lab.innerText;
    setLabLanguage('en');
    await lab.setState({scene: 'spring'});
    await openLab({scene: 'spring'});
    return {...seen, still: lab.dataset.state, controls: lab.querySelectorAll('canvas, input, select').length};
  }

  /** Checks a page without the module: the element of the lab is empty, and nothing opens. */
  async function absent() {
    await openLab({scene: 'spring'});
    return {state: theLab().dataset.state, children: theLab().childElementCount, dialogs: document.querySelectorAll('dialog').length};
  }

  /** Checks the picture with only the step's slider, far down a page. */
  async function part() {
    const all = new Complaints(), lab = theLab(), shown = name => [...lab.querySelectorAll(name)].some(each => each.checkVisibility());
    await pause(300);
    all.check(lab.dataset.state === 'closed' && lab.childElementCount === 0, 'is', lab.dataset.state, 'out of sight');
    lab.scrollIntoView();
    await until(() => lab.dataset.state === 'ready' && lab.reading, 'the part to open');
    all.check(shown('canvas') && shown('[data-knob=step-A] input[type=range]') && shown('[data-act=run]'), 'lacks picture, slider or button');
    all.check(!shown('[data-act=copyLink]') && !shown('[data-act=scene]') && !shown('.knobs'), 'shows more than the step');
    slide(knobOf('step-A'), 1);
    button('run').click();
    await until(() => lab.dataset.verdict !== 'ok', 'the burst');
    all.check(shown('.verdict') && !lab.reading.running, 'does not say that it burst');
    button('wholeLab').click();
    all.check(shown('[data-act=copyLink]') && shown('[data-act=scene]') && !shown('[data-act=wholeLab]'), 'does not become the whole lab');
    return all;
  }

  /** With reduced motion nothing moves before the user presses run. */
  async function reducedMotion() {
    const all = new Complaints(), lab = await opened({scene: 'cloth-hang'});
    all.check(stillWanted.matches, 'the browser does not ask for less motion');
    let draws = 0;
    const {draw} = lab;
    lab.draw = function() { return ++draws, draw.call(this); };
    for (let i = 0; i < 5; ++i) await frame();
    const places = [...lab.runs[0].places];
    draws = 0;
    for (let i = 0; i < 20; ++i) await frame();
    all.check(draws === 0, 'the picture is drawn', draws, 'times');
    choose(lab.view.sceneChoice, 'spring');
    await until(() => lab.reading.scene === 'spring', 'the scene');
    choose(lab.view.sceneChoice, 'cloth-hang');
    await until(() => lab.reading.scene === 'cloth-hang', 'the scene');
    for (let i = 0; i < 10; ++i) await frame();
    all.check(lab.reading.t === 0 && !lab.reading.running && lab.dataset.running === undefined && lab.runs[0].sim.steps === 0, 'it runs at', lab.reading.t);
    all.check(places.every((v, i) => v === lab.runs[0].places[i]), 'particles move');
    all.check(![...document.querySelectorAll('live-lab *')].some(each => each.getAnimations().some(a => a.playState === 'running')), 'something is animated');
    button('run').click();
    await until(() => lab.reading.t > 0.05, 'the run');
    all.check(lab.dataset.running === '' && draws > 0, 'it does not run');
    button('run').click();
    const {t} = lab.reading;
    for (let i = 0; i < 5; ++i) await frame();
    all.check(lab.reading.t === t && !lab.reading.running, 'it does not pause');
    return all;
  }

  /** The circle is drawn before anything runs, with the particle on it. Another rate changes the path. */
  async function courseFromTheStart() {
    const all = new Complaints(), lab = await opened({scene: 'circle'}), {stage} = lab, course = () => lab.stage.course;
    const points = () => Array.from({length: course().count + 1}, (_, i) => [...course().table.data.subarray(4 * i, 4 * i + 3)]);
    all.check(lab.reading.t === 0 && course().count > 500, 'has a course of', course().count);
    // the tolerance allows for single precision
    all.check(points().every(point => Math.abs(Math.hypot(...point) - 1) < 1e-6), 'leaves the circle');
    all.check(points()[0].every((v, k) => v === Math.fround(lab.runs[0].places[k])), 'does not begin at the particle');
    lab.draw();
    const paper = make('canvas', {width: stage.canvas.width, height: stage.canvas.height}).getContext('2d');
    paper.drawImage(stage.canvas, 0, 0);
    const ratio = stage.canvas.width / stage.canvas.clientWidth;
    const darkness = place => {
      const [x, y] = stage.project(place, stage.boxes[0]), {data} = paper.getImageData(Math.round(ratio * x) - 2, Math.round(ratio * y) - 2, 5, 5);
      let least = 765;
      for (let i = 0; i < data.length; i += 4) least = Math.min(least, data[i] + data[i + 1] + data[i + 2]);
      return least;
    };
    const ground = darkness([0, 0, 0]);
    for (const angle of [1, 2, 3, 4, 5]) all.check(darkness([Math.cos(angle), Math.sin(angle), 0]) < ground - 100, 'no circle is drawn at', angle);
    slide(knobOf('rotation.rate'), 0);
    await until(() => course().count > 0 && points().every(([x]) => x > 0.9), 'the course of a point that stands');
    await lab.setState({scene: 'cloth-hang'});
    await until(() => lab.reading.scene === 'cloth-hang', 'the cloth');
    all.check(course().count === 0, 'a cloth has a course');
    return all;
  }

  /** Drags while the lab runs and draws coarsely, as it does if drawing is slow. */
  async function dragsCoarsely(scene, particle) {
    const all = new Complaints(), check = all.check.bind(all), lab = await opened({scene}), fine = lab.stage;
    // pretends slow frames
    lab.play();
    await until(() => lab.playing && lab.reading.t > 0, 'the run');
    for (let i = 0; i < 40 && lab.stage === fine; ++i) lab.watchDrawing(100, 1);
    check(lab.stage !== fine && lab.stage?.coarse && lab.drawsSlowly, 'is not coarse');
    await until(() => lab.stage.boxes?.length && lab.stage.canvas.width < 0.8 * lab.stage.canvas.clientWidth, 'fewer pixels');
    check(lab.playing, 'does not run any more');
    for (const type of ['mouse', 'touch']) {
      const to = await drag(particle, type === 'mouse' ? 40 : -40, -30, false, type), [run] = lab.runs;
      check(lab.hand.held?.particle === particle && lab.reading.byHand, type, 'does not hold the particle');
      // the particle follows a moving camera a frame later
      await until(() => apart(placeOf(particle), to) < 3, `${type}: the particle under the pointer`);
      const {t} = lab.reading;
      await until(() => lab.reading.t > t + 0.02, `${type}: time passes while the hand holds`);
      await until(() => apart(placeOf(particle), to) < 3, `${type}: the particle under the pointer again`);
      check(!run.failed, type, 'fails');
      pointer('pointerup', to, type);
      check(!lab.hand.held && lab.stage.coarse && lab.playing, type, 'after it let go');
      const free = lab.runs[0], held = [...free.places.subarray(3 * particle, 3 * particle + 3)];
      await until(() => held.some((v, k) => v !== free.places[3 * particle + k]), `${type}: the particle falls`);
    }
    lab.pause();
    await frame();
    check(lab.stage.canvas.width >= 0.99 * lab.stage.canvas.clientWidth, 'stands with fewer pixels', lab.stage.canvas.width, lab.stage.canvas.clientWidth);
    return all;
  }

  /** Lists Chinese names of steppers, next to their names for the command line. */
  async function chineseNames() {
    const all = new Complaints(), lab = await opened({scene: 'cloth-hang'});
    setLabLanguage('zh');
    const shown = Object.fromEntries([...lab.querySelectorAll('[data-stepper=A] option')].map(each => [each.value, each.textContent]));
    for (const [name, words] of Object.entries(shown)) all.check(words.includes(name), words, 'does not say', name);
    for (const [name, words] of Object.entries({'explicit-euler': '显式欧拉', 'leapfrog': '蛙跳', 'implicit-midpoint': '隐式中点', 'rk4': '四阶龙格-库塔'}))
      all.check(shown[name].startsWith(words), name, 'is called', shown[name]);
    all.check(nameOfMethod('leapfrog+sticky') === '蛙跳，粘性球' && nameOfMethod('newcomer-euler') === 'newcomer Euler', nameOfMethod('leapfrog+sticky'), nameOfMethod('newcomer-euler'));
    setLabLanguage('en');
    all.check(nameOfMethod('symplectic-euler+sticky') === 'symplectic Euler, sticky', nameOfMethod('symplectic-euler+sticky'));
    return {...all, names: shown};
  }

  /**
   * Controls in the order of the Tab key. A page cannot press Tab, so this follows the browser's rule: elements that
   * accept focus, are visible and have no negative tabindex, in document order, since no tabindex is above zero.
   */
  async function tabOrder(state) {
    const all = new Complaints(), lab = await opened(state);
    await frame();
    const candidates = [...lab.querySelectorAll('*')], shown = each => each.checkVisibility({checkVisibilityCSS: true}) && each.getClientRects().length > 0;
    all.check(candidates.every(each => each.tabIndex <= 0), 'some tabindex is above zero');
    const stops = candidates.filter(each => {
      if (each.tabIndex < 0 || each.disabled || !shown(each)) return false;
      document.activeElement.blur();
      each.focus({preventScroll: true});
      return document.activeElement === each;
    });
    // all controls are focusable
    for (const each of lab.querySelectorAll('button, input, select, a[href], textarea, [onclick], [role=button]'))
      if (shown(each) && !each.disabled) all.check(stops.includes(each), each.outerHTML.slice(0, 120), 'is not reached');
    for (const each of stops) {
      const name = each.getAttribute('aria-label') ?? (each.labels?.[0]?.textContent || each.textContent);
      all.check(name.trim().length > 0, each.outerHTML.slice(0, 120), 'has no name');
    }
    const nameOf = each => each.dataset.act ?? each.dataset.stepper ?? (each.classList.contains('layer') ? 'picture' : each.closest('[data-knob]') ? `${each.closest('[data-knob]').dataset.knob} ${each.type}` : each.closest('label')?.textContent.trim() || (each.getAttribute('aria-label') ?? each.textContent.trim()));
    return {...all, stops: stops.map(nameOf)};
  }

  return {
    theLab, button, knobOf, pause, until, frame, Complaints, opened, slide, type, choose, steps, timeIn, say3,
    sliders, marks, bursts, burstsInFrames, handByPointer, keysOfPicture,
    changedScenes, changedByHand, byAddress, drops, unavailable, absent, part, reducedMotion, tabOrder, courseFromTheStart, dragsCoarsely, chineseNames
  };
})();
