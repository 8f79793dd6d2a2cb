// Runs the animation at the top of a cloth's page and writes its observations into the page. Requires
// stage_selftest.js.
addEventListener('load', async () => {
  const seen = {};
  try {
    const hero = document.querySelector('.hero'), player = hero.querySelector('motion-player'), slider = hero.querySelector('input');
    await player.wake();
    const poster = () => !hero.querySelector('canvas') && hero.querySelector('img').getBoundingClientRect().height > 50;
    seen.able = Boolean(player.stage);
    if (!seen.able) return tell({...seen, poster: poster(), button: hero.querySelector('button').textContent});
    const at = async part => {
      slider.value = 1000 * part;
      slider.dispatchEvent(new Event('input'));
      await new Promise(done => setTimeout(done, 50));
      return lookAt(player);
    };
    const early = await at(0.05), late = await at(0.4), again = await at(0.05);
    Object.assign(seen, {drawn: early.drawn, moves: early.picture !== late.picture, returns: early.picture === again.picture});
    player.box.querySelector('.layer').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowLeft'}));
    seen.turns = lookAt(player).picture !== again.picture;
    seen.panels = player.titles.children.length;
    player.sleep();
    seen.poster = poster();
  } catch (problem) {
    complaints.push(String(problem.stack));
  }
  tell(seen);
});
