// Uses the player as a reader would, and writes observations into the page.
async function use(player, seen) {
  const {scene} = player, end = scene.times[scene.times.length - 1], height = document.body.scrollHeight;
  await player.wake();
  seen.able = document.documentElement.classList.contains('plays');
  if (!seen.able) return;
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
  const asked = 12 / slider.max * end;
  seen.slider = Math.abs(player.time - asked) < 1e-9 && Math.abs(parseFloat(slider.getAttribute('aria-valuetext')) - asked) < 0.006;
  const plain = lookAt(player).picture, [, colour] = player.querySelectorAll('select');
  colour.value = 'distance';
  colour.dispatchEvent(new Event('change'));
  seen.colours = lookAt(player).picture !== plain;
  const springs = player.querySelector('.looks input');
  springs.click();
  seen.springs = lookAt(player).picture !== plain;
  springs.click();
  const before = lookAt(player).picture;
  player.box.querySelector('.layer').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}));
  seen.turns = lookAt(player).picture !== before;
  player.seek(end);
  seen.titles = player.titles.textContent;
  seen.says = player.querySelector('.hint').textContent;
  player.seek(0);
  player.play();
  seen.plays = await until(() => player.time > 0.02 * end);
  player.pause();
  seen.lines = player.querySelectorAll('.plot .curve').length;
}

addEventListener('load', async () => {
  const seen = {able: document.documentElement.classList.contains('plays')};
  const player = document.querySelector('motion-player'), poster = document.querySelector('.stage img');
  const lookAtPoster = () => {
    const {width, height} = poster.getBoundingClientRect();
    seen.poster =
        poster.naturalWidth > 0 && width > 200 && height > 50 && getComputedStyle(poster).visibility === 'visible';
    seen.height = player.getBoundingClientRect().height;
  };
  lookAtPoster();
  try {
    if (seen.able) await use(player, seen);
  } catch (problem) {
    complaints.push(String(problem.stack));
  }
  if (!seen.able) lookAtPoster();  // its first use reveals the missing WebGL
  seen.canvases = document.querySelectorAll('.stage canvas').length;
  tell(seen);
});
