// What stands below the pictures: play, slider, choices, the list of methods and the plot.

const make = (name, attributes = {}, ...children) => {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
};

const choice = (label, options, chosen) => {
  const select = make(
      'select', {'aria-label': label},
      ...options.map(([value, text]) => make('option', value === chosen ? {value, selected: ''} : {value}, text)));
  return [make('label', {}, `${label} `, select), select];
};

const check = (label, on) => {
  const box = make('input', {type: 'checkbox'});
  box.checked = on;
  return [make('label', {}, box, ` ${label}`), box];
};

/** Seconds with as many digits as a frame needs. */
const seconds = (time, end) => time.toFixed(end < 3 ? 3 : 2);

/** A value with three digits. */
const short = value => {
  if (value === 0) return '0';
  const size = Math.abs(value);
  const text = size >= 1e5 || size < 1e-3 ? size.toExponential(1).replace('e+', 'e') :
      size >= 100                         ? size.toFixed(0) :
                                            size.toPrecision(3);
  return (value < 0 ? '−' : '') + text;
};

/** A length in the unit that suits it. */
const length = metres => {
  for (const [unit, size] of [['m', 1], ['mm', 1e-3], ['µm', 1e-6], ['nm', 1e-9]])
    if (metres >= size) return `${Number((metres / size).toPrecision(2))} ${unit}`;
  return `${short(metres)} m`;
};

const pointerHelp = 'Drag to turn. With the picture in focus (click it, or Tab) the wheel zooms, arrow keys turn, + and − ' +
    'zoom, 0 resets.';

class Controls {
  /** `act` has what the controls call: toggle, seek (s), speed, look, reset. */
  constructor(box, scene, look, act) {
    Object.assign(this, {
      scene,
      end: scene.times[scene.times.length - 1],
      largest: Math.max(...scene.methods.flatMap(method => method.plotted.map(Math.abs)))
    });
    const {methods} = scene;
    this.play = make('button', {type: 'button', class: 'play'});
    this.slider = make('input', {
      type: 'range',
      min: 0,
      max: scene.times.length - 1,
      step: 1,
      value: 0,
      'aria-label': `time in ${scene.scene}`
    });
    this.clock = make('span', {class: 'clock'});
    const usual = scene.speed ?? 1, speeds = [0.1, 0.25, 0.5, 1, 2].map(part => part * usual);
    const [speedLabel, speed] = choice('Speed', speeds.map(v => [String(v), `${Number(v.toPrecision(2))} ×`]), String(usual));
    const colours = [['plain', 'method']];
    if (scene.stretch) colours.push(['stretch', 'stretch']);
    if (scene.distance) colours.push(['distance', scene.distance.name]);
    const [colourLabel, colour] = choice('Colour', colours, look.colour);
    const [springLabel, springs] = check('Springs', look.springs);
    const reset = make('button', {type: 'button', 'aria-label': `Reset view of ${scene.scene}`}, 'Reset view');
    this.bar = make('div', {class: 'bar'});
    this.list = make('ul', {class: 'methods'});
    this.values = methods.map((method, i) => this.row(method, i, look, act));
    const plot = make('div', {class: 'plot'});
    box.replaceChildren(
        make('div', {class: 'time'}, this.play, this.slider, this.clock),
        make(
            'div', {class: 'choices'}, speedLabel, colourLabel, ...(scene.springs.families.length ? [springLabel] : []),
            reset, this.bar),
        this.list, plot, 
        make('p', {class: 'hint'}, [
          scene.caption, pointerHelp, scene.finest && `Places are drawn to within ${length(scene.finest)}.`
        ].filter(Boolean).join(' ')));
    this.play.addEventListener('click', act.toggle);
    this.slider.addEventListener('input', () => act.seek(scene.times[this.slider.value]));
    Object.assign(this, {colour, springs});
    speed.addEventListener('change', () => act.speed(Number(speed.value)));
    colour.addEventListener('change', () => act.look({colour: colour.value}));
    springs.addEventListener('change', () => act.look({springs: springs.checked}));
    reset.addEventListener('click', act.reset);
    this.plot = new Plot(
        plot, {
          label: scene.plot.label,
          title: scene.plot.title,
          powers: scene.plot.powers,
          times: scene.times,
          series: methods.map(
              m => ({values: m.plotted, colour: m.colour, dash: m.dash, well: !m.failure, failure: m.failed}))
        },
        act.seek);
  }

  /** A method of the list: whether it is shown, its line in the plot, its value, and what became of it. */
  row(method, i, look, act) {
    const [label, box] = check('', look.shown.includes(i));
    const line = svg(
        'svg', {width: 34, height: 10, 'aria-hidden': 'true'},
        svg('path', {d: 'M1 5H33', class: 'curve', style: `--own: ${method.colour}`, 'stroke-dasharray': method.dash}));
    const value = make('span', {class: 'value'});
    label.append(line, make('b', {}, method.name));
    this.list.append(make(
        'li', {}, label, value,
        ...(method.note ? [make('details', {}, make('summary', {}, 'different law'), method.note)] : []),
        ...(method.failure ? [make('span', {class: 'failed'}, `${method.failure}: ${method.reason}`)] : [])));
    box.addEventListener('change', () => {
      const shown = this.list.querySelectorAll('input');
      // at least one stays
      if (![...shown].some(each => each.checked)) box.checked = true;
      act.look({shown: [...shown].flatMap((each, k) => (each.checked ? [k] : []))});
    });
    return value;
  }

  setPlaying(playing) {
    this.play.textContent = playing ? '❚❚ Pause' : '▶ Play';
    this.play.setAttribute('aria-label', `${playing ? 'Pause' : 'Play'} ${this.scene.scene}`);
  }

  setLook(look) {
    this.colour.value = look.colour, this.springs.checked = look.springs;
    const {scene} = this, scale = look.colour === 'plain' ? null : scene[look.colour];
    if (scale)
      this.bar.replaceChildren('0', make('i', {class: 'scale'}), `${scale.top} ${scale.label}`);
    else if (look.springs && scene.triangles)
      this.bar.replaceChildren(...scene.springs.families.flatMap(
          ({name}, k) => [make('i', {class: 'family', style: `--own: #${palette[k]}`}), name]));
    else
      this.bar.replaceChildren();
    this.plot.draw(look.shown);
  }

  /** Shows a time (s) that lies at a frame (with fraction). */
  setTime(time, frame) {
    const {scene, end} = this, nearest = Math.round(frame);
    this.slider.value = nearest;
    const text = `${seconds(time, end)} s`;
    this.slider.setAttribute('aria-valuetext', text);
    this.clock.textContent = `${seconds(time, end)} / ${seconds(end, end)} s`;
    this.plot.moveHead(time);
    scene.methods.forEach((method, i) => {
      const {unit, powers} = scene.plot, exact = method.plotted[nearest];
      const value = exact && !powers && Math.abs(exact) < 1e-9 * this.largest ? 0 : exact;  // to rounding
      this.values[i].textContent =
          value === undefined || value === null ? '–' : unit === 'm' ? length(powers ? 10 ** value : value) :
                                                    powers ? `${short(10 ** value)} ${unit}` : `${short(value)} ${unit}`;
    });
  }
}
