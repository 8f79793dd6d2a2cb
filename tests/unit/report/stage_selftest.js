// Shared by tests of the player in a browser: complaints, waiting, inspection of the stage, and output. Load it before
// the script that uses it.
const complaints = [];
addEventListener('error', event => complaints.push(event.message));
addEventListener('unhandledrejection', event => complaints.push(String(event.reason)));
const consoleError = console.error;
console.error = (...words) => (complaints.push(words.join(' ')), consoleError(...words));

// with a virtual clock, a headless browser draws no frames
window.requestAnimationFrame = callback => setTimeout(() => callback(performance.now()), 16);

// A virtual clock jumps to its end when only other threads have work, such as unpacking or drawing. Therefore a timer
// runs every 4 virtual ms, and takes about 1 ms of real time, until the page has reported.
let spun = 0;
const metronome = setInterval(() => {
  for (let i = 0; i < 1e6; ++i) spun = (spun + i) | 0;
}, 4);

/** Waits until the condition holds, for at most ten seconds of the page's clock. */
async function until(condition) {
  const begun = performance.now();
  while (!condition() && performance.now() - begun < 1e4) await new Promise(done => setTimeout(done, 20));
  return Boolean(condition());
}

/** Waits until a chart is drawn. A headless browser does not always report visible elements. In that case the charts
 * are drawn as for printing. */
async function drawn(box) {
  const there = () => box.querySelector('svg');
  box.scrollIntoView();
  for (let i = 0; i < 20 && !there(); ++i) {
    box.style.outlineOffset = `${i % 2}px`;  // changes to the page request frames
    await new Promise(done => setTimeout(done, 20));
  }
  if (!there()) dispatchEvent(new Event('beforeprint'));
  return until(there);
}

/** The current stage: its pixels as text, and the fraction of them that is not background. */
function lookAt(player) {
  player.draw();
  const {canvas} = player.stage, copy = document.createElement('canvas');
  Object.assign(copy, {width: canvas.width, height: canvas.height});
  const paper = copy.getContext('2d');
  paper.drawImage(canvas, 0, 0);
  const {data} = paper.getImageData(0, 0, copy.width, copy.height);
  let drawn = 0;
  for (let i = 0; i < data.length; i += 4)
    drawn += Math.abs(data[i] - data[0]) + Math.abs(data[i + 1] - data[1]) + Math.abs(data[i + 2] - data[2]) > 30;
  return {picture: copy.toDataURL(), drawn: drawn / (copy.width * copy.height)};
}

/** Writes the observations into the page. */
function tell(seen) {
  clearInterval(metronome);
  seen.complaints = complaints;
  const out = document.createElement('script');
  out.type = 'application/json';
  out.id = 'seen';
  out.textContent = JSON.stringify(seen);
  document.body.append(out);
}
