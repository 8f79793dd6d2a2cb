// Clicks on runs as a reader would, and writes observations into the page.
const hints = [];  // texts below the players

/** Contents of the open window, and whether it closes. */
async function look() {
  await until(() => document.querySelector('dialog.run :is(motion-player, .player > .none)'));
  const dialog = document.querySelector('dialog.run'), player = dialog.querySelector('motion-player');
  if (!player) {
    hints.push(dialog.querySelector('.player').textContent);
    dialog.querySelector('.close').click();
    return {drawn: 0, closed: await until(() => !document.querySelector('dialog.run'))};
  }
  await player.wake();
  player.pause();
  const {begin, end} = player;
  player.seek(begin + 0.2 * (end - begin));
  const early = lookAt(player);
  player.seek(begin + 0.8 * (end - begin));
  const late = lookAt(player), {motions} = player;
  const shown = {
    drawn: late.drawn,
    moves: early.picture !== late.picture,
    panels: player.titles.children.length,
    says: [...dialog.querySelectorAll('h3, p')].map(part => part.textContent).join(' | '),
    apart: motions.length > 1 ? Math.max(...motions[0].apartAt(0.315 * end, motions[1]).map(Math.abs)) : null
  };
  hints.push(player.querySelector('.hint').textContent);
  dialog.querySelector('.close').click();
  shown.closed = await until(() => !document.querySelector('dialog.run'));
  return shown;
}

addEventListener('load', async () => {
  for (const fold of document.querySelectorAll('.fold')) fold.open = true;
  await until(() => document.querySelectorAll('figure[data-runs]').length === 2);  // the map is folded
  for (const box of document.querySelectorAll('figure[data-runs] .drawn')) await drawn(box);
  const [chart, map] = document.querySelectorAll('figure[data-runs]');
  const seen = {windows: []}, able = Boolean(document.createElement('canvas').getContext('webgl2'));
  const click = element => element.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  try {
    if (able) {
      for (const marker of [...chart.querySelectorAll('[data-run]'), map.querySelector('[data-run]')]) {
        click(marker);
        seen.windows.push(await look());
      }
      const list = chart.querySelector('.run-list');
      list.open = true;
      await until(() => list.querySelector('select'));
      const [method, run] = list.querySelectorAll('select'), second = chart.querySelectorAll('[data-run]')[1];
      method.value = second.dataset.run.split(' ')[0];
      method.dispatchEvent(new Event('change'));
      run.value = [...run.options].find(({value}) => second.dataset.words.includes(value.split(':')[0])).value;
      click(list.querySelector('button'));
      seen.windows.push(await look());
    } else {
      click(chart.querySelector('[data-run]'));
      await until(() => !document.documentElement.classList.contains('plays'));
      click(chart.querySelector('[data-run]'));
      await until(() => !document.querySelector('dialog'));
      seen.lists = [...document.querySelectorAll('.run-list')].filter(list => list.offsetHeight > 0).length;
      seen.dialogs = document.querySelectorAll('dialog').length;
    }
  } catch (problem) {
    complaints.push(String(problem.stack));
  }
  tell({...seen, hints});
});
