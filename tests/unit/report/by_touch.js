// Touches a page through the browser's own protocol over a pipe, because events that a page creates itself do not show
// whether the browser would scroll. Prints the result as JSON. Arguments: the page, and a folder for the browser's
// profile.
const {spawn} = require('node:child_process');
const [page, profile] = process.argv.slice(2);

const browser = spawn('chromium', [
  '--headless=new', '--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking',
  '--disable-component-update', '--disable-sync', '--no-first-run', '--force-prefers-reduced-motion', `--user-data-dir=${profile}`,
  '--remote-debugging-pipe', 'about:blank'
], {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
const [, , , into, from] = browser.stdio, answers = new Map();
let count = 0, rest = '';
from.on('data', data => {
  const messages = (rest + data).split('\0');
  rest = messages.pop();
  for (const {id, result, error} of messages.map(text => JSON.parse(text))) {
    const answer = answers.get(id);
    answers.delete(id);
    if (answer) error ? answer.fail(new Error(error.message)) : answer.done(result);
  }
});
const call = (method, params = {}, sessionId = undefined) => new Promise((done, fail) => {
  answers.set(++count, {done, fail});
  into.write(`${JSON.stringify({id: count, method, params, sessionId})}\0`);
});
const pause = ms => new Promise(done => setTimeout(done, ms));

(async () => {
  const {targetId} = await call('Target.createTarget', {url: 'about:blank'});
  const {sessionId} = await call('Target.attachToTarget', {targetId, flatten: true});
  const own = (method, params) => call(method, params, sessionId);
  const read = async expression => {
    const {result, exceptionDetails} = await own('Runtime.evaluate', {expression, returnByValue: true, awaitPromise: true});
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  };
  const until = async expression => {
    for (let tries = 0; tries < 600; ++tries, await pause(100))
      if (await read(expression)) return;
    throw new Error(`waited in vain for ${expression}`);
  };
  /** Moves one finger between two places (CSS pixels). */
  const stroke = async ([x, y], [toX, toY]) => {
    await own('Input.dispatchTouchEvent', {type: 'touchStart', touchPoints: [{x, y}]});
    for (let i = 1; i <= 8; ++i) {
      await own('Input.dispatchTouchEvent', {type: 'touchMove', touchPoints: [{x: x + (toX - x) * i / 8, y: y + (toY - y) * i / 8}]});
      await pause(40);
    }
    await own('Input.dispatchTouchEvent', {type: 'touchEnd', touchPoints: []});
    await pause(300);
  };
  const placeOf = particle => read(`(() => {
    const lab = document.querySelector('live-lab'), box = lab.view.layer.getBoundingClientRect();
    const [x, y] = lab.stage.project([...lab.runs[0].places.subarray(${3 * particle}, ${3 * particle + 3})], lab.stage.boxes[0]);
    return [box.left + x, box.top + y];
  })()`);

  await own('Emulation.setDeviceMetricsOverride', {width: 390, height: 844, deviceScaleFactor: 1, mobile: true});
  await own('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 2});
  await own('Page.navigate', {url: `file://${page}`});
  await until(`document.querySelector('live-lab')?.dataset.state === 'ready' && Boolean(document.querySelector('live-lab').reading)`);
  await read(`document.querySelector('live-lab').setState({scene: 'cloth-hang'}).then(() => document.querySelector('live-lab .stage').scrollIntoView({block: 'center'}))`);
  await until(`Boolean(document.querySelector('live-lab').stage?.boxes?.length)`);

  const corner = 399, scrolled = () => read('[scrollX, scrollY]'), seen = {};
  const before = await placeOf(corner), stood = await scrolled();
  await stroke(before, [before[0] - 60, before[1] + 40]);
  seen.drag = {from: before, to: await placeOf(corner), byHand: await read(`document.querySelector('live-lab').reading.byHand`), scrolled: [stood, await scrolled()]};

  await read(`document.querySelector('live-lab input[type=range]').scrollIntoView({block: 'center'})`);
  const slider = `document.querySelector('live-lab input[type=range]')`, step = `document.querySelector('live-lab').methods[0].step`;
  const {left, width, y, part} = await read(`(() => {
    const range = ${slider}, box = range.getBoundingClientRect();
    return {left: box.left, width: box.width, y: box.top + box.height / 2, part: (range.value - range.min) / (range.max - range.min)};
  })()`);
  const was = await read(step), at = await scrolled();
  // the centre of the 20 px thumb stays 10 px away from the ends
  const thumb = left + 10 + (width - 20) * part;
  await stroke([thumb, y], [thumb - 60, y]);
  seen.slider = {was, is: await read(step), scrolled: [at, await scrolled()]};
  console.log(JSON.stringify(seen));
})().catch(problem => {
  console.error(problem.stack);
  process.exitCode = 1;
}).finally(() => browser.kill());
