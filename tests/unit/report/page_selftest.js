// Uses the page as a reader would, and writes observations into it. Requires stage_selftest.js.
(() => {
  const column = (table, i) => [...table.tBodies[0].rows].filter(row => !row.hidden).map(row => row.cells[i].innerText.trim().replace(/\s+/g, ' '));
  const press = (element, key) => element.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
  const pointAt = element => element.dispatchEvent(new PointerEvent('pointerover', {bubbles: true}));
  const settle = () => new Promise(done => setTimeout(done, 50));

  /** Sorts a table by pointer and keys, filters its rows by a word, and records the CSV that would be saved. */
  async function useTable(table, seen) {
    const [, size] = table.tHead.rows[0].cells, tools = table.closest('.scroll').nextElementSibling;
    size.click();
    seen.up = column(table, 1);
    press(size, 'Enter');
    seen.down = column(table, 1);
    seen.says = size.getAttribute('aria-sort');
    const word = tools.querySelector('input');
    word.value = 'PBD';
    word.dispatchEvent(new Event('input'));
    seen.kept = column(table, 0);
    const made = [], create = URL.createObjectURL, click = HTMLAnchorElement.prototype.click;
    URL.createObjectURL = blob => (made.push(blob), create.call(URL, blob));
    HTMLAnchorElement.prototype.click = () => {};  // saves no files
    tools.querySelector('button').click();
    HTMLAnchorElement.prototype.click = click;
    seen.csv = made.length ? await made[0].text() : '';
  }

  /** Properties of a drawn chart, such as font size and texts beyond its edge. */
  function lookAtChart(chart) {
    const box = chart.getBoundingClientRect(), texts = [...chart.querySelectorAll('text')].filter(text => getComputedStyle(text).visibility !== 'hidden' && getComputedStyle(text).display !== 'none' && !text.matches('.waiting'));
    const beyond = text => {
      const own = text.getBoundingClientRect();
      return own.left < box.left - 2 || own.right > box.right + 2 || own.top < box.top - 2 || own.bottom > box.bottom + 2;
    };
    const scale = box.width / chart.viewBox.baseVal.width;
    return {
      says: chart.getAttribute('aria-label'),
      height: box.height,
      unseen: [...chart.querySelectorAll('rect, path, circle, line')].filter(shape => getComputedStyle(shape).display === 'none').length,
      shapes: chart.querySelectorAll('path, rect, line').length,
      marks: chart.querySelectorAll('.mark[data-words]').length,
      cells: chart.querySelectorAll('.cell[data-words]').length,
      letters: Math.min(...texts.map(text => scale * parseFloat(getComputedStyle(text).fontSize))),
      outside: texts.filter(beyond).length,
      names: texts.filter(beyond).map(text => text.textContent)
    };
  }

  async function useCharts(seen) {
    seen.charts = {};
    for (const box of document.querySelectorAll('.chapter .drawn')) {
      if (box.closest('.open-scene, [hidden]')) continue;
      await drawn(box);
      const chart = box.querySelector('svg');
      if (chart) seen.charts[box.dataset.chart] = lookAtChart(chart);
    }
    const marker = document.querySelector('.mark[data-words="first run"]'), tip = document.querySelector('.tip');
    seen.colour = getComputedStyle(marker).fill;
    pointAt(marker);
    seen.tip = tip.hidden ? '' : tip.innerText.replace(/^.*, /, '');
    seen.lit = document.querySelectorAll('.lit').length;
    pointAt(document.body);
    seen.gone = tip.hidden;
    // arrow keys move between marks; Enter plays a run like a click
    const chart = marker.closest('svg'), said = () => (tip.hidden ? '' : tip.innerText.replace(/^.*, /, ''));
    chart.focus();
    seen.walked = [];
    for (const key of ['ArrowRight', 'ArrowRight', 'ArrowDown', 'ArrowLeft']) {
      press(document.activeElement, key);
      seen.walked.push(said());
    }
    document.activeElement.dataset.run = 'mysim/leapfrog 2';
    let played = 0;
    document.activeElement.addEventListener('click', event => (++played, event.stopPropagation()));
    press(document.activeElement, 'Enter');
    seen.played = played;
    document.activeElement.blur();
    const [first, second] = document.querySelectorAll('#speed-accuracy .choices button'), figure = button => document.getElementById(button.dataset.figure);
    second.click();
    await drawn(figure(second).querySelector('.drawn'));
    seen.chosen = [second.innerText, second.getAttribute('aria-pressed'), String(figure(first).hidden), String(Boolean(figure(second).querySelector('svg')))];
    first.click();
    seen.back = !figure(first).hidden && figure(second).hidden;
  }

  /** Chooses runs A and B as a reader would. */
  async function comparesRuns(article, player, seen) {
    const [a, , b] = article.querySelectorAll('.pick select');
    const picks = async (select, method) => {
      const picked = new Promise(done => player.addEventListener('picked', done, {once: true}));
      select.value = method;
      select.dispatchEvent(new Event('change'));
      await picked;
    };
    seen.smallCharts = article.querySelectorAll('.plot .area > svg').length;
    const cursors = () => [...article.querySelectorAll('.plot .cursor')].map(line => Number(line.getAttribute('x1')));
    player.seek(0.5);
    const before = cursors();
    player.seek(1.5);
    seen.cursor = before.length >= 2 && cursors().every((x, i) => x > before[i] + 20);
    await picks(b, 'bullet/deformable-explicit');
    await picks(a, 'bullet/deformable-explicit');
    seen.sameIsZero = player.top === 0 && article.querySelector('.pick.apart').textContent.includes('below ');
    await picks(b, 'truth');
    seen.apart = player.top > 0 && player.views.length === 3;
    seen.engines = [...a.options].map(option => option.textContent).join('|');
    await picks(a, 'exec:/tools/my engine');
    player.seek(0.2);
    const early = lookAt(player).picture;
    player.seek(1);
    seen.outsidePlays = lookAt(player).picture !== early && player.views[0].method.startsWith('exec:');
    const button = article.querySelector('.choose [data-as="a"]'), picked = new Promise(done => player.addEventListener('picked', done, {once: true}));
    button.click();
    await picked;
    seen.buttonChooses = player.picks.a === button.parentElement.dataset.key && button.getAttribute('aria-pressed') === 'true';
  }

  async function useScenes(seen) {
    const article = () => document.querySelector('article.open-scene'), card = document.querySelector('.card');
    seen.openBefore = Boolean(article());
    card.click();
    seen.opened = await until(article);
    seen.address = location.hash;
    seen.here = card.classList.contains('here');
    await drawn(article().querySelector('.drawn'));
    seen.sceneCharts = article().querySelectorAll('.drawn svg').length;
    const player = article().querySelector('motion-player');
    await player.wake();
    player.seek(0.2);
    const early = lookAt(player).picture;
    player.seek(1);
    seen.scenePlays = lookAt(player).picture !== early;
    await comparesRuns(article(), player, seen);
    seen.nodes = document.querySelectorAll('*').length;
    player.sleep();
    history.back();
    seen.closed = await until(() => !article());
    location.hash = '#chain';
    seen.again = await until(article);
    article().querySelector('header a').click();
    seen.closedByLink = await until(() => !article());
  }

  async function useHero(seen) {
    const hero = document.querySelector('.hero'), player = hero.querySelector('motion-player'), button = hero.querySelector('button');
    await settle();
    seen.still = !player.stage && hero.querySelector('img').getBoundingClientRect().height > 50;
    await player.wake();
    seen.heroPanels = player.titles.children.length;
    const slider = hero.querySelector('input');
    slider.value = 200;
    slider.dispatchEvent(new Event('input'));
    await settle();
    const early = lookAt(player).picture;
    slider.value = 700;
    slider.dispatchEvent(new Event('input'));
    await settle();
    seen.heroMoves = lookAt(player).picture !== early;
    seen.readout = hero.querySelector('.readouts').textContent;
    pointAt(hero.querySelector('.readouts [data-method]'));
    seen.litTitle = Boolean(player.titles.querySelector('.lit'));
    pointAt(document.body);
    button.click();
    await until(() => button.getAttribute('aria-label') === 'Pause');
    button.click();
    seen.heroStops = await until(() => button.getAttribute('aria-label') === 'Play');
    player.sleep();
  }

  addEventListener('load', async () => {
    const seen = {width: document.documentElement.scrollWidth - innerWidth};
    try {
      seen.words = document.body.innerText.split(/\s+/).length;
      seen.questions = document.querySelectorAll('.question').length;
      seen.background = getComputedStyle(document.body).backgroundColor;
      seen.tablesBefore = document.querySelectorAll('#speed-accuracy table').length;
      for (const fold of document.querySelectorAll('#speed-accuracy details.fold')) fold.open = true;
      await until(() => document.querySelector('#speed-accuracy table'));
      seen.templates = document.querySelectorAll('#speed-accuracy template').length;
      await useCharts(seen);
      await useTable(document.querySelector('#speed-accuracy table'), seen);
      if (document.documentElement.classList.contains('plays')) {
        await useHero(seen);
        await useScenes(seen);
      }
    } catch (problem) {
      complaints.push(String(problem.stack));
    }
    tell(seen);
  });
})();
