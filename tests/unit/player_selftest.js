// Uses the player as a reader would and writes what it saw into the page, for the test that reads the page back.
const complaints = [];
addEventListener('error', event => complaints.push(event.message));
addEventListener('unhandledrejection', event => complaints.push(String(event.reason)));
const consoleError = console.error;
console.error = (...words) => (complaints.push(words.join(' ')), consoleError(...words));

// while its clock is virtual a browser without a window shows no frames, and asks for none
window.requestAnimationFrame = callback => setTimeout(() => callback(performance.now()), 16);

/** Waits until the condition holds, for ten seconds of the page's own clock at most. */
async function until(condition) {
  const begun = performance.now();
  while (!condition() && performance.now() - begun < 1e4) await new Promise(done => setTimeout(done, 20));
  return Boolean(condition());
}

/** The stage as it is now: its pixels, as text, and the part of them that is not background. */
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

async function use(player, seen) {
  const {scene} = player, end = scene.times[scene.times.length - 1], height = document.body.scrollHeight;
  await player.wake();
  player.pause();
  seen.jump = document.body.scrollHeight - height;
  player.seek(0.1 * end);
  const early = lookAt(player);
  player.seek(0.7 * end);
  const late = lookAt(player);
  player.seek(0.1 * end);
  Object.assign(
      seen,
      {drawn: early.drawn, moves: early.picture !== late.picture, returns: early.picture === lookAt(player).picture});
  const slider = player.querySelector('input[type=range]');
  slider.value = 12;
  slider.dispatchEvent(new Event('input'));
  seen.slider = Math.abs(player.time - scene.times[12]) < 1e-9 &&
      slider.getAttribute('aria-valuetext').startsWith(String(scene.times[12]));
  const plain = lookAt(player).picture, [, colour] = player.querySelectorAll('select');
  colour.value = 'distance';
  colour.dispatchEvent(new Event('change'));
  seen.colours = lookAt(player).picture !== plain;
  const springs = player.querySelector('.choices input');
  springs.click();
  seen.springs = lookAt(player).picture !== plain;
  springs.click();
  const before = lookAt(player).picture;
  player.box.querySelector('.layer').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}));
  seen.turns = lookAt(player).picture !== before;
  player.seek(end);
  seen.titles = player.titles.textContent;
  seen.list = player.querySelector('.methods').textContent;
  player.seek(0);
  player.play();
  seen.plays = await until(() => player.time > 0.2 * end);
  player.pause();
  seen.lines = player.querySelectorAll('.plot polyline').length;
}

addEventListener('load', async () => {
  const seen = {able: document.documentElement.classList.contains('plays')};
  const player = document.querySelector('motion-player'), poster = document.querySelector('.stage img');
  const {width, height} = poster.getBoundingClientRect();
  seen.poster =
      poster.naturalWidth > 0 && width > 200 && height > 50 && getComputedStyle(poster).visibility === 'visible';
  seen.desk = player.getBoundingClientRect().height;
  try {
    if (seen.able) await use(player, seen);
  } catch (problem) {
    complaints.push(String(problem.stack));
  }
  seen.canvases = document.querySelectorAll('.stage canvas').length;
  seen.complaints = complaints;
  const out = document.createElement('script');
  out.type = 'application/json';
  out.id = 'seen';
  out.textContent = JSON.stringify(seen);
  document.body.append(out);
});
