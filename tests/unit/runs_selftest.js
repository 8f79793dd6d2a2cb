// Clicks on runs as a reader would and writes what it saw into the page, for the test that reads the page back.
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

/** What the open window shows, and that it closes. */
async function look() {
  await until(() => document.querySelector('dialog.run motion-player'));
  const dialog = document.querySelector('dialog.run'), player = dialog.querySelector('motion-player');
  await player.wake();
  player.pause();
  const {times} = player.scene, end = times[times.length - 1];
  player.seek(0.2 * end);
  const early = lookAt(player);
  player.seek(0.8 * end);
  const late = lookAt(player), motions = player.stage.panels.map(panel => panel.motion);
  const shown = {
    drawn: late.drawn,
    moves: early.picture !== late.picture,
    panels: player.titles.children.length,
    says: [...dialog.querySelectorAll('h3, p, .methods')].map(part => part.textContent).join(' | '),
    apart: motions.length > 1 ? Math.hypot(...motions[0].place(9, 3).map((x, k) => x - motions[1].place(9, 3)[k])) : null
  };
  dialog.querySelector('.close').click();
  shown.closed = await until(() => !document.querySelector('dialog.run'));
  return shown;
}

addEventListener('load', async () => {
  const [chart, map] = document.querySelectorAll('figure[data-runs]');
  const seen = {windows: [], lists: document.querySelectorAll('.run-list').length};
  const click = element => element.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  try {
    if (seen.lists) {
      for (const marker of [...chart.querySelectorAll('[data-run]'), map.querySelector('[data-run]')]) {
        click(marker);
        seen.windows.push(await look());
      }
      const list = chart.querySelector('.run-list');
      list.open = true;
      await until(() => list.querySelector('select'));
      list.querySelector('select').value = '1';
      click(list.querySelector('button'));
      seen.windows.push(await look());
    } else {
      click(chart.querySelector('[data-run]'));
    }
  } catch (problem) {
    complaints.push(String(problem.stack));
  }
  seen.complaints = complaints;
  const out = document.createElement('script');
  out.type = 'application/json';
  out.id = 'seen';
  out.textContent = JSON.stringify(seen);
  document.body.append(out);
});
