// Picture, controls and texts of the lab; lab.ts defines what they do.

import {Look, rampOf, rgb} from '../player/colours';
import {check, dropdown, make} from '../player/controls';
import {PanelPlace} from '../player/stage';

import {Stepper} from './engine';
import {MethodKnobs, SceneKnobs} from './knobs';
import {LabState} from './lab_link';
import {LivePlots} from './live_plots';
import {LiveRun} from './live_run';
import {Changes, MethodSpec} from './scene_text';
import {labLanguage, labWords, say, setLabLanguage} from './words';

export const titleHeight = 26;  // CSS pixels, when methods are drawn over each other

/** Colours of a run, and the dash of its curves. */
export type RunLook = Look&{dash: string};

/** Colours of A and B suit light and dark mode; B is dashed, the truth grey. */
export function lookOfRun(letter: string): RunLook {
  const name = letter === 'A' ? 'mysim2' : letter === 'B' ? 'second' : 'truth';
  const style = getComputedStyle(document.querySelector('live-lab') ?? document.documentElement);
  const plain = rgb(style.getPropertyValue(`--${name}`).trim() || '#707880');
  return {
    css: `var(--${name})`,
    dash: letter === 'B' ? '5 3' : '',
    plain,
    ramp: rampOf(letter === 'T' ? rgb('8A9099') : plain)
  };
}

export interface LabLook {
  view: 'over'|'side';
  colour: 'plain'|'stretch'|'error';
  springs: boolean;
  truth: boolean;
}

export interface LabActs {
  toggle(): void;
  step(): void;
  restart(): void;
  speed(speed: number): void;
  method(i: number, spec: MethodSpec, done: boolean): void;
  second(): void;
  removeSecond(): void;
  numbers(changes: Changes, done: boolean): void;
  scene(name: string): void;
  original(): void;
  guide(): void;
  more(): void;
  close(): void;
  look(change: LabState): void;
  pin(): void;
  resetView(): void;
  copyLink(): void;
  saveToml(): void;
  copyCommand(): void;
  file(file: File): Promise<void>;
}

/** The method in words, and its error or failure. */
export interface PanelTitle {
  name: string;
  words: string;
  state: string;
  look: RunLook;
  failed: boolean;
}

export const labButton = (name: string, text: string, act: () => void, words = say(name)): HTMLElement => {
  const named: Record<string, string> = text === words ? {} : {'aria-label': words, title: words};
  const button: HTMLElement = make('button', {type: 'button', 'data-act': name, ...named}, text);
  button.addEventListener('click', () => act());
  return button;
};

const selectOf = (words: string, options: [string, string][], chosen: string, changed: (value: string) => void):
    [HTMLElement, HTMLSelectElement] => {
      const [label, select] = dropdown(words, options, chosen);
      select.addEventListener('change', () => changed(select.value));
      return [label, select];
    };
const checkOf = (words: string, on: boolean, changed: (on: boolean) => void): [HTMLElement, HTMLInputElement] => {
  const [label, box] = check(words, on);
  box.addEventListener('change', () => changed(box.checked));
  return [label, box];
};

export class LabView {
  readonly root: HTMLElement = make('div', {class: 'lab'});
  readonly layer: HTMLElement = make('div', {class: 'layer', tabindex: 0, role: 'group'});
  readonly verdict: HTMLElement = make('div', {class: 'verdict', role: 'alert', hidden: ''});
  readonly dropHere: HTMLElement = make('div', {class: 'drop', hidden: ''});
  readonly plots = new LivePlots();
  readonly knobs: SceneKnobs;
  readonly stage: HTMLElement;
  private readonly titles: HTMLElement = make('div', {class: 'titles'});
  private readonly chosen: HTMLElement = make('span', {class: 'chosen none'});
  private readonly prompt: HTMLElement = make('p', {class: 'prompt'});
  private readonly otherPlots: HTMLDetailsElement = make('details', {class: 'other-plots'});
  private methods: MethodKnobs[] = [];
  // made again for another language
  sceneChoice!: HTMLSelectElement;
  particle!: HTMLElement;
  pin!: HTMLElement;
  said!: HTMLElement;
  readout!: HTMLElement;
  truthWords!: HTMLElement;
  speed!: HTMLSelectElement;
  private changed!: HTMLElement;
  private close!: HTMLElement;
  private question!: HTMLElement;
  private play!: HTMLElement;
  private clock!: HTMLElement;
  private progress!: HTMLProgressElement;
  private viewChoice!: [HTMLElement, HTMLSelectElement];
  private colour!: HTMLSelectElement;
  private springs!: [HTMLElement, HTMLInputElement];
  private truth!: HTMLInputElement;
  private scale!: HTMLElement;
  private second!: HTMLElement;
  private methodList!: HTMLElement;

  constructor(private readonly act: LabActs) {
    this.stage = make('div', {class: 'stage'}, this.layer, this.titles, this.chosen, this.dropHere);
    this.knobs = new SceneKnobs((changes, done) => act.numbers(changes, done));
    this.build();
  }

  /** Builds everything that contains text, also after a change of language. */
  build() {
    const {act} = this, button = (name: string, run: () => void) => labButton(name, say(name), run);
    this.sceneChoice = make('select', {'data-act': 'scene', 'aria-label': say('scene')});
    this.sceneChoice.addEventListener('change', () => act.scene(this.sceneChoice.value));
    this.changed = make('span', {class: 'changed'}, say('changed'), button('original', () => act.original()));
    const other = labLanguage === 'zh' ? 'en' : 'zh';
    const label = labWords[other].language;
    const language = labButton('language', other === 'en' ? 'English' : '中文', () => setLabLanguage(other), label);
    language.lang = other;
    this.close = labButton('close', '✕', () => act.close());
    this.question = make('p', {class: 'question'});
    const head = make(
        'header', {}, make('b', {}, say('labTitle')),
        make('label', {}, make('span', {}, say('scene')), this.sceneChoice), this.changed,
        make('span', {class: 'right'}, button('guide', () => act.guide()), language, this.close));

    this.play = labButton('run', '▶', () => act.toggle());
    this.play.classList.add('play');
    this.clock = make('span', {class: 'clock'});
    const speeds = [0.02, 0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10].map((v): [string, string] => [String(v), `${v} ×`]);
    const [speedLabel, speed] = selectOf(say('speed'), speeds, '1', value => act.speed(Number(value)));
    this.speed = speed;
    this.progress = make('progress', {max: 1, value: 0, 'aria-label': say('time')});
    const time = make(
        'div', {class: 'time'}, this.play, button('step', () => act.step()), button('restart', () => act.restart()),
        this.progress, this.clock, speedLabel, button('wholeLab', () => act.more()));

    this.viewChoice = selectOf(
        say('view'), [['over', say('over')], ['side', say('side')]], 'over',
        view => act.look({view: view as LabLook['view']}));
    const colours: [string, string][] =
        [['plain', say('byMethod')], ['stretch', say('byStretch')], ['error', say('byError')]];
    const [colourLabel, colour] =
        selectOf(say('colour'), colours, 'plain', value => act.look({colour: value as LabLook['colour']}));
    this.springs = checkOf(say('springs'), false, springs => act.look({springs}));
    const [truthLabel, truth] = checkOf(say('truth'), false, on => act.look({truth: on}));
    Object.assign(this, {colour, truth});
    this.scale = make('span', {class: 'bar'});
    this.pin = button('pin', () => act.pin());
    this.particle = make('span', {class: 'particle'});
    this.chosen.replaceChildren(this.particle, this.pin);
    const looks = make(
        'div', {class: 'looks'}, this.viewChoice[0], colourLabel, this.scale, this.springs[0], truthLabel,
        button('resetView', () => act.resetView()));
    this.readout = make('p', {class: 'readout'});
    this.truthWords = make('p', {class: 'readout truth', role: 'status'});
    const line = make('div', {class: 'line'}, this.verdict, this.prompt);

    this.second = button('second', () => act.second());
    this.methodList = make('div', {class: 'methods'});
    const side = make(
        'div', {class: 'controls'}, make('h4', {}, say('methods')), this.methodList, this.second,
        make('h4', {}, say('numbers')), this.knobs.box);

    const file: HTMLInputElement = make('input', {type: 'file', accept: '.toml,application/toml', hidden: ''});
    file.addEventListener('change', () => {
      const [chosen] = file.files ?? [];
      if (chosen) act.file(chosen).then(() => (file.value = ''));
    });
    this.said = make('p', {class: 'said', role: 'status'});
    const doors = make(
        'div', {class: 'doors'}, button('copyLink', () => act.copyLink()), button('saveToml', () => act.saveToml()),
        button('copyCommand', () => act.copyCommand()), button('openToml', () => file.click()), file, this.said);
    const hint = make('p', {class: 'hint'}, say(matchMedia('(pointer: coarse)').matches ? 'touchHint' : 'hint'));

    const {plots} = this;
    this.methods = [];
    this.root.replaceChildren(
        head, this.question,
        make(
            'div', {class: 'bench'},
            make(
                'div', {class: 'picture'}, this.stage, line, time, looks, this.readout, this.truthWords, plots.box,
                this.otherPlots),
            side),
        doors, hint);
    this.dropHere.textContent = say('drop');
    const [error, , residual] = plots.plots.map(plot => plot.box);
    this.otherPlots.replaceChildren(
        make('summary', {}, say('otherPlots')), make('div', {class: 'plots'}, error, residual));
    this.plots.name();
  }

  /** Lists the scenes; a scene that the page does not have is marked as the reader's own. */
  setScene(names: string[], name: string, question: string, changed: boolean, alone: boolean) {
    const own = names.includes(name) ? [] : [name];
    this.sceneChoice.replaceChildren(...[...names, ...own].map(
        each => make('option', {value: each}, own.includes(each) ? `${each} (${say('ownScene')})` : each)));
    this.sceneChoice.value = name;
    this.question.textContent = question;
    this.changed.hidden = !changed;
    this.close.hidden = alone;
    this.layer.setAttribute('aria-label', say('pictureLabel', {scene: name}));
  }

  setMethods(specs: MethodSpec[], runs: LiveRun[], steppers: Stepper[], scale: number|null) {
    while (this.methods.length > specs.length) this.methods.pop()?.box.remove();
    while (this.methods.length < specs.length) {
      const i = this.methods.length, {act} = this;
      const knobs = new MethodKnobs('AB'[i], (spec, done) => act.method(i, spec, done), () => act.removeSecond());
      this.methods.push(knobs);
      this.methodList.append(knobs.box);
    }
    this.methods.forEach((knobs, i) => knobs.show(specs[i], runs[i], steppers, scale));
    this.second.hidden = specs.length > 1;
    this.prompt.textContent = this.methods[0].box.matches('.bound') ? say('prompt') : '';
  }

  setLook({view, colour, springs, truth}: LabLook, count: number, cloth: boolean, scale: string, firstOrder: boolean) {
    this.viewChoice[1].value = view, this.colour.value = colour;
    this.springs[1].checked = springs, this.truth.checked = truth;
    this.viewChoice[0].hidden = count < 2;
    this.springs[0].hidden = !cloth;
    if (firstOrder) this.otherPlots.open = true;  // first-order scenes have only the error plot
    this.scale.replaceChildren(...(scale ? ['0', make('i', {class: 'scale'}), scale] : []));
  }

  setRunning(running: boolean) {
    this.play.textContent = running ? '❚❚' : '▶';
    for (const name of ['aria-label', 'title']) this.play.setAttribute(name, say(running ? 'pause' : 'run'));
  }

  setTime(time: number, end: number, byHand: boolean) {
    const t = time.toFixed(end < 3 ? 3 : 2);
    this.clock.textContent = byHand ? say('byHandTime', {t}) : say('timeOf', {t, end: Number(end.toPrecision(4))});
    this.progress.value = byHand ? 0 : Math.min(1, time / end);
    this.progress.hidden = byHand;
  }

  /** Names the panels, with the state of each run. */
  setTitles(titles: PanelTitle[], places: PanelPlace[], over: boolean) {
    while (this.titles.childElementCount > titles.length) this.titles.lastChild?.remove();
    titles.forEach((title, i) => {
      const box = (this.titles.children[i] ??
                   this.titles.appendChild(make('div', {}, make('b'), make('span'), make('span', {class: 'state'})))) as
          HTMLElement;
      const [name, words, state] = box.children as unknown as HTMLElement[], place = places[i];
      for (const [part, text] of [[name, title.name], [words, title.words], [state, title.state]] as const)
        if (part.textContent !== text) part.textContent = text;
      name.style.setProperty('--own', title.look.css);
      state.classList.toggle('failed', title.failed);
      Object.assign(
          box.style,
          over ? {left: '0', top: `${titleHeight * i}px`, width: '100%'} :
                 {left: `${100 * place.left}%`, top: `${100 * place.top}%`, width: `${100 * place.wide}%`});
    });
    this.stage.classList.toggle('over', over);
  }

  setVerdict(lines: string[]) {
    const text = lines.join(' ');
    this.verdict.hidden = !lines.length;
    this.prompt.hidden = !this.verdict.hidden;
    if (this.verdict.dataset.text === text) return;
    this.verdict.dataset.text = text;
    this.verdict.replaceChildren(
        make('span', {}, text), labButton('restart', say('restart'), () => this.act.restart()));
  }

  setChosen(particle: number|null, pinned: boolean, held: boolean) {
    this.chosen.classList.toggle('none', particle === null);
    if (particle === null) return;
    this.particle.textContent = say(held ? 'held' : pinned ? 'pinnedAt' : 'particle', {i: particle});
    this.pin.textContent = say(pinned ? 'unpin' : 'pin');
    this.pin.hidden = held;
  }

  say(text: string, failed = false) {
    this.said.textContent = text;
    this.said.classList.toggle('failed', failed);
  }
}
