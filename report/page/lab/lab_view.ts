// View of the lab: picture, controls and words; lab.ts holds their behaviour.
// @ts-nocheck

import {mixed, rgb} from '../player/colours';
import {check, dropdown, make} from '../player/controls';

import {MethodKnobs, SceneKnobs} from './knobs';
import {LivePlots} from './live_plots';
import {labLanguage, say, setLabLanguage} from './words';

export const titleHeight = 26;  // CSS pixels, of methods over one another

/** The colours of a run: A and B apart in light and dark, B dashed; the truth grey. */
export function lookOfRun(letter) {
  const names = {A: ['mysim2', ''], B: ['second', '5 3'], T: ['truth', '']}, [name, dash] = names[letter];
  const style = getComputedStyle(document.querySelector('live-lab') ?? document.documentElement);
  const plain = rgb(style.getPropertyValue(`--${name}`).trim() || '#707880'),
        tint = letter === 'T' ? rgb('8A9099') : plain;
  return {
    css: `var(--${name})`,
    dash,
    plain,
    ramp: [mixed(tint, [0, 0, 0], 0.15), mixed(tint, [1, 1, 1], 0.4), mixed(tint, [1, 1, 1], 0.84)]
  };
}

export const labButton = (name, text, act, words = say(name)) => {
  const button = make(
      'button', {type: 'button', 'data-act': name, ...(text === words ? {} : {'aria-label': words, title: words})},
      text);
  button.addEventListener('click', () => act());
  return button;
};

export class LabView {
  /** `act`: what the controls call (lab.js). */
  constructor(act) {
    this.act = act;
    this.layer = make('div', {class: 'layer', tabindex: 0, role: 'group'});
    this.titles = make('div', {class: 'titles'});
    this.verdict = make('div', {class: 'verdict', role: 'alert'});
    this.dropHere = make('div', {class: 'drop'});
    this.chosen = make('span', {class: 'chosen none'});
    this.stage = make('div', {class: 'stage'}, this.layer, this.titles, this.chosen, this.verdict, this.dropHere);
    this.plots = new LivePlots();
    this.knobs = new SceneKnobs(act.numbers);
    this.verdict.hidden = this.dropHere.hidden = true;
    this.methods = [];
    this.root = make('div', {class: 'lab'});
    this.build();
  }

  /** Everything with words in it; again in another language. */
  build() {
    const {act} = this;
    this.root.lang = labLanguage;
    this.sceneChoice = make('select', {'data-act': 'scene', 'aria-label': say('scene')});
    this.sceneChoice.addEventListener('change', () => act.scene(this.sceneChoice.value));
    this.changed =
        make('span', {class: 'changed'}, say('changed'), labButton('original', say('original'), act.original));
    const language = labButton(
        'language', labLanguage === 'zh' ? 'English' : '中文', () => setLabLanguage(labLanguage === 'zh' ? 'en' : 'zh'),
        say('language'));
    language.lang = labLanguage === 'zh' ? 'en' : 'zh';
    this.close = labButton('close', '✕', act.close);
    this.question = make('p', {class: 'question'});
    const head = make(
        'header', {}, make('b', {}, say('labTitle')),
        make('label', {}, make('span', {}, say('scene')), this.sceneChoice), this.changed,
        make('span', {class: 'right'}, language, this.close));

    this.play = labButton('run', '▶', act.toggle);
    this.play.classList.add('play');
    this.clock = make('span', {class: 'clock'});
    const [speedLabel, speed] =
        dropdown(say('speed'), [0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10].map(v => [String(v), `${v} ×`]), '1');
    this.speed = speed;
    speed.addEventListener('change', () => act.speed(Number(speed.value)));
    this.progress = make('progress', {max: 1, value: 0, 'aria-label': say('time')});
    const time = make(
        'div', {class: 'time'}, this.play, labButton('step', say('step'), act.step),
        labButton('restart', say('restart'), act.restart), this.progress, this.clock, speedLabel);

    const [viewLabel, view] = dropdown(say('view'), [['over', say('over')], ['side', say('side')]], 'over');
    const [colourLabel, colour] = dropdown(
        say('colour'), [['plain', say('byMethod')], ['stretch', say('byStretch')], ['error', say('byError')]], 'plain');
    const [springLabel, springs] = check(say('springs'), false), [truthLabel, truth] = check(say('truth'), false),
                        [ledgerLabel, ledger] = check(say('ledger'), true);
    Object.assign(this, {view, colour, springs, truth, ledger, springLabel, viewLabel, ledgerLabel});
    this.scale = make('span', {class: 'bar'});
    view.addEventListener('change', () => act.look({view: view.value}));
    colour.addEventListener('change', () => act.look({colour: colour.value}));
    for (const [name, box] of Object.entries({springs, truth}))
      box.addEventListener('change', () => act.look({[name]: box.checked}));
    ledger.addEventListener('change', () => act.ledger(ledger.checked));
    this.pin = labButton('pin', say('pin'), act.pin);
    this.particle = make('span', {class: 'particle'});
    this.chosen.replaceChildren(this.particle, this.pin);
    const looks = make(
        'div', {class: 'looks'}, viewLabel, colourLabel, this.scale, springLabel, truthLabel, ledgerLabel,
        labButton('resetView', say('resetView'), act.resetView));
    this.readout = make('p', {class: 'readout'});
    this.truthWords = make('p', {class: 'readout truth', role: 'status'});

    this.second = labButton('second', say('second'), act.second);
    this.methodList = make('div', {class: 'methods'});
    const side = make(
        'div', {class: 'controls'}, make('h4', {}, say('methods')), this.methodList, this.second,
        make('h4', {}, say('numbers')), this.knobs.box);

    const file = make('input', {type: 'file', accept: '.toml,application/toml', hidden: ''});
    file.addEventListener('change', () => file.files[0] && act.file(file.files[0]).then(() => (file.value = '')));
    const door = (name, run) => labButton(name, say(name), run);
    this.said = make('p', {class: 'said', role: 'status'});
    const doors = make(
        'div', {class: 'doors'}, door('copyLink', act.copyLink), door('saveToml', act.saveToml),
        door('copyCommand', act.copyCommand), door('openToml', () => file.click()), file, this.said);
    const hint = make('p', {class: 'hint'}, matchMedia('(pointer: coarse)').matches ? say('touchHint') : say('hint'));

    this.methods = [];
    this.root.replaceChildren(
        head, this.question,
        make(
            'div', {class: 'bench'},
            make('div', {class: 'picture'}, this.stage, time, looks, this.readout, this.truthWords, this.plots.box),
            side),
        doors, hint);
    this.dropHere.textContent = say('drop');
    this.plots.name();
  }

  /** The scenes to choose from; `own` is one that the page does not have. */
  setScene(names, name, question, changed, alone) {
    const own = names.includes(name) ? [] : [name];
    this.sceneChoice.replaceChildren(...[...names, ...own].map(
        each => make('option', {value: each}, own.includes(each) ? `${each} (${say('ownScene')})` : each)));
    this.sceneChoice.value = name;
    this.question.textContent = question;
    this.changed.hidden = !changed;
    this.close.hidden = alone;
    this.layer.setAttribute('aria-label', say('pictureLabel', {scene: name}));
  }

  /** The boxes of the methods. */
  setMethods(specs, runs, steppers, scale) {
    while (this.methods.length > specs.length) this.methods.pop().box.remove();
    while (this.methods.length < specs.length) {
      const i = this.methods.length,
            knobs = new MethodKnobs('AB'[i], (spec, done) => this.act.method(i, spec, done), this.act.removeSecond);
      this.methods.push(knobs);
      this.methodList.append(knobs.box);
    }
    this.methods.forEach((knobs, i) => knobs.show(specs[i], runs[i], steppers, scale));
    this.second.hidden = specs.length > 1;
  }

  /** What is chosen of the picture. */
  setLook({view, colour, springs, truth}, count, cloth, scale, firstOrder) {
    this.view.value = view, this.colour.value = colour;
    this.springs.checked = springs, this.truth.checked = truth;
    this.viewLabel.hidden = count < 2;
    this.springLabel.hidden = !cloth;
    this.ledgerLabel.hidden = firstOrder;
    this.scale.replaceChildren(...(scale ? ['0', make('i', {class: 'scale'}), scale] : []));
  }

  setRunning(running) {
    this.play.textContent = running ? '❚❚' : '▶';
    for (const name of ['aria-label', 'title']) this.play.setAttribute(name, say(running ? 'pause' : 'run'));
  }

  setTime(time, end, byHand) {
    const t = time.toFixed(end < 3 ? 3 : 2);
    this.clock.textContent = byHand ? say('byHandTime', {t}) : say('timeOf', {t, end: Number(end.toPrecision(4))});
    this.progress.value = byHand ? 0 : Math.min(1, time / end);
    this.progress.hidden = byHand;
  }

  /** Names of the panels, with what is known of each run now; laid out by `places`. */
  setTitles(shown, places, over) {
    while (this.titles.childElementCount > shown.length) this.titles.lastChild.remove();
    shown.forEach((view, i) => {
      const box = this.titles.children[i] ??
          this.titles.appendChild(make('div', {}, make('b'), make('span'), make('span', {class: 'state'})));
      const [name, words, state] = box.children, parts = [[name, view.name], [words, view.words], [state, view.state]];
      for (const [part, text] of parts)
        if (part.textContent !== text) part.textContent = text;
      name.style.setProperty('--own', view.look.css);
      state.classList.toggle('failed', view.failed);
      const place = over ? {left: 0, top: 0, wide: 1} : places[i];
      if (place)
        Object.assign(box.style, {
          left: `${100 * place.left}%`,
          top: over ? `${titleHeight * i}px` : `${100 * place.top}%`,
          width: `${100 * place.wide}%`
        });
    });
    this.stage.classList.toggle('over', over);
  }

  setVerdict(lines) {
    const text = lines.join(' ');
    this.verdict.hidden = !lines.length;
    if (this.verdict.dataset.text === text) return;
    this.verdict.dataset.text = text;
    this.verdict.replaceChildren(make('span', {}, text), labButton('restart', say('restart'), this.act.restart));
  }

  setChosen(particle, pinned, held) {
    this.chosen.classList.toggle('none', particle === null);
    if (particle === null) return;
    this.particle.textContent = say(held ? 'held' : pinned ? 'pinnedAt' : 'particle', {i: particle});
    this.pin.textContent = say(pinned ? 'unpin' : 'pin');
    this.pin.hidden = held;
  }

  say(text, failed = false) {
    this.said.textContent = text;
    this.said.classList.toggle('failed', failed);
  }
}
