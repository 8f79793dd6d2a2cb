// Completes every step of the guided experiments, and checks all texts on the way. Frames are produced by calls, a
// tenth of a second apart, without drawing.

const labGuideTest = (() => {
  const guide = () => document.querySelector('lab-guide');
  const pause = ms => new Promise(done => setTimeout(done, ms));
  const byKey = key => guide().querySelector(`[data-key="${key}"]`);

  async function until(holds, what, act = () => pause(5)) {
    for (let tries = 0; tries < 4000; ++tries) {
      const value = holds();
      if (value) return value;
      await act();
    }
    const {t, running, ended, verdict, toml} = document.querySelector('live-lab').reading;
    throw new Error(`waited in vain for ${what}: ${JSON.stringify({t, running, ended, verdict, seen: guide().seen, phase: guide().phase, acting: guide().acting})} ${toml} ${guide().innerText}`);
  }

  /** Patterns that must not occur in visible text: keys, unfilled placeholders, invalid numbers. */
  const raw = /\{\w+\}|\b[a-z]+(-[a-z]+)*\.[a-z]+\.[a-z]+\b|\bguide\.|\bundefined\b|\bnull\b|\bNaN\b|Infinity|\[object/;

  /** A lab whose frames are produced by calls. Without a picture, it has no stage. */
  async function quickLab(picture) {
    const lab = document.querySelector('live-lab');
    await until(() => lab.dataset.state === 'ready' && lab.reading, 'the lab');
    lab.querySelector('[data-act=guide]').click();
    let now = performance.now();
    lab.wake = () => {};
    lab.draw = () => false;
    lab.watchDrawing = () => {};
    if (!picture) {
      const none = () => {};
      lab.sleep(), lab.stage = {show: none, setPins: none, sees: () => true, size: 1};
      lab.setStage = none;
    }
    lab.nextFrame = async () => {
      lab.frame(now += 100);
      await pause(0);
    };
    return lab;
  }

  /** Runs all experiments in a language, with right or wrong guesses, and with or without a picture. */
  async function run(language, guessRight, picture) {
    const lines = [], seen = {lines, steps: [], longest: 0};
    const check = (holds, ...words) => holds || lines.push(words.join(' '));
    const lab = await quickLab(picture);
    if (language !== labLanguage) lab.querySelector('[data-act=language]').click();
    check(labLanguage === language && guide().lang === language, 'the language is', labLanguage);

    /** Checks the texts that the guide shows. */
    const read = (where, selector) => {
      for (const part of guide().querySelectorAll(selector)) {
        const text = part.textContent.trim();
        check(text.length > 0, where, selector, 'is empty');
        check(!raw.test(text), where, selector, 'says', text);
        // Chinese text has Chinese characters, unless it consists of numbers and formulas
        check(language === 'zh' ? /[\u4e00-\u9fff]/.test(text) : !/[\u3000-\u9fff\uff00-\uffef]/.test(text), where, selector, 'is in another language:', text);
        if (language !== 'en') continue;
        for (const sentence of text.split(/[.?!;](?:\s|$)/)) {
          const count = sentence.split(/\s+/).filter(word => /[A-Za-z]{2}/.test(word)).length;
          seen.longest = Math.max(seen.longest, count);
          check(count <= 25, where, 'has a sentence of', count, 'words:', sentence);
        }
      }
    };

    read('list', 'h3, p, .entry b, .entry span');
    check(guide().querySelectorAll('.entry').length === labExperiments.length + 1, 'the list has', guide().querySelectorAll('.entry').length, 'entries');
    byKey(labExperiments[0].name).click();
    for (const experiment of labExperiments)
      for (const [number, step] of experiment.steps.entries()) {
        const where = `${experiment.name}.${step.name}`, here = () => guide().dataset.experiment === experiment.name && guide().dataset.step === step.name;
        await until(() => here() && guide().dataset.phase === 'ask' && guide().seen.before && !guide().setting, `the question of ${where}`);
        check(lab.reading.t === 0 && !lab.reading.running, where, 'runs before the guess');
        read(where, 'h3, .asked, legend, .guess, label');
        check(!guide().querySelector('.task, .why'), where, 'tells before the guess');
        if (step.guess) {
          const form = guide().querySelector('form');
          form.querySelector('input').value = guessRight ? String(Number(step.guess.read(readingOf(lab)).toPrecision(3))) : '123';
          form.requestSubmit();
        } else {
          const choices = [...guide().querySelectorAll('[data-choice]')];
          check(choices.length === step.choices.length && new Set(choices.map(c => c.textContent)).size === choices.length, where, 'has the choices', choices.map(c => c.textContent));
          choices.find(c => (c.dataset.choice === step.right) === guessRight).click();
        }
        await until(() => guide().dataset.phase === 'try' && !guide().setting, `the task of ${where}`);
        read(where, '.task h4, .task p, .task button');
        const fresh = guideProgress.of(experiment, step) === undefined;
        check(fresh, where, 'is ticked before it is done');
        let heard = null;
        guide().addEventListener('step-done', event => (heard = event.detail), {once: true});
        byKey('do').click();
        let frames = 0;
        await until(() => guide().dataset.phase === 'why' && guide().querySelector('.why') && heard, `the reason of ${where}`, () => (++frames, lab.nextFrame()));
        check(heard.experiment === experiment.name && heard.step === step.name, where, 'tells of', JSON.stringify(heard));
        read(where, '.why p, .why h4');
        const tick = byKey(`tick-${number}`), outcome = guide().querySelector('.outcome').textContent;
        check(tick.classList.contains('done') && tick.textContent === '✓' && guideProgress.of(experiment, step), where, 'is not ticked');
        const right = step.guess ? 'guide.near' : 'guide.right', wrong = step.guess ? 'guide.far' : 'guide.wrong';
        const begins = say(guessRight ? right : wrong, {guess: '|', answer: '|'}).split('|')[0];
        // a number that was read before the task may have changed
        check(outcome.startsWith(begins) || (step.guess && guessRight), where, 'says of the guess:', outcome);
        if (!step.guess) check(outcome.includes(say(`${where}.${step.right}`)), where, 'gives the answer', outcome);
        check(guide().querySelectorAll('.guess.right').length === (step.guess ? 0 : 1), where, 'marks no answer as right');
        check(Boolean(guide().querySelector('.keep')) === (number + 1 === experiment.steps.length), where, 'does not say what to keep');
        seen.steps.push({where, frames, outcome, numbers: guide().querySelector('.numbers').textContent});
        byKey('next').click();
      }
    await until(() => guide().dataset.phase === 'sandbox', 'the sandbox');
    read('sandbox', 'h3, p, li');
    check(location.hash === '', 'in the sandbox the address keeps', location.hash);
    byKey('all').click();
    check(guide().querySelectorAll('.entry.done').length === labExperiments.length, 'done are', guide().querySelectorAll('.entry.done').length);
    // a completed step shows its result and can be repeated; each step has an address
    location.hash = '#experiment=cloth-bursts';
    await until(() => guide().dataset.experiment === 'cloth-bursts' && !guide().setting, 'the experiment of the address');
    await until(() => guide().dataset.phase === 'why', 'what was done');
    check(guide().dataset.phase === 'why' && guide().querySelector('.why'), 'a step that was done is', guide().dataset.phase);
    byKey('again').click();
    await until(() => guide().dataset.phase === 'ask' && guide().seen.before, 'the step again');
    check(location.hash === '#experiment=cloth-bursts', 'beside an experiment the address is', location.hash);
    byKey('all').click();
    check(location.hash === '' && guide().dataset.phase === 'list', 'the list of experiments stands at', location.hash);
    return seen;
  }

  /** Checks the table of words: every key exists in both languages, with identical placeholders. */
  function table() {
    const lines = [], places = text => [...text.matchAll(/\{\w+\}/g)].map(m => m[0]).sort().join();
    for (const key of Object.keys({...labWords.en, ...labWords.zh})) {
      const english = labWords.en[key] ?? '', chinese = labWords.zh[key] ?? '';
      if (!english.trim() || !chinese.trim()) lines.push(`${key} has not two languages`);
      if (places(english) !== places(chinese)) lines.push(`${key} fills in ${places(english)} and ${places(chinese)}`);
      const letters = /[A-Za-z]{2}/.test(english.replace(/\{\w+\}/g, ''));
      if (letters && (english === chinese || !/[\u4e00-\u9fff]/.test(chinese))) lines.push(`${key} is not in Chinese: ${chinese}`);
      if (/[\u3000-\u9fff\uff00-\uffef]/.test(english)) lines.push(`${key} is not in English: ${english}`);
    }
    for (const experiment of labExperiments)
      for (const key of ['title', 'about', 'remember', ...experiment.steps.flatMap(s => ['question', 'task', 'why', 'formula', ...s.choices ?? []].map(k => `${s.name}.${k}`))])
        if (!labWords.en[`${experiment.name}.${key}`]) lines.push(`${experiment.name}.${key} has no words`);
    return {lines, keys: Object.keys(labWords.en).length};
  }

  return {run, table};
})();
