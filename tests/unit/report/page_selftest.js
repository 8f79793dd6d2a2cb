// Uses the page as a reader would and writes what it saw into it, for the test that reads it back.
(() => {
  const complaints = [];
  addEventListener('error', event => complaints.push(event.message));
  const consoleError = console.error;
  console.error = (...words) => (complaints.push(words.join(' ')), consoleError(...words));

  const column = (table, i) => [...table.tBodies[0].rows].filter(row => !row.hidden).map(row => row.cells[i].innerText.trim().replace(/\s+/g, ' '));
  const press = (element, key) => element.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));

  /** Sorting by pointer and keys, cutting down to rows with a word, and what would be saved. */
  async function useTable(table, seen) {
    const [, size] = table.tHead.rows[0].cells, tools = table.closest('.scroll').nextElementSibling;
    table.closest('details').open = true;
    size.click();
    seen.up = column(table, 1);
    press(size, 'Enter');
    seen.down = column(table, 1);
    seen.says = size.getAttribute('aria-sort');
    const word = tools.querySelector('input');
    word.value = 'PBD';
    word.dispatchEvent(new Event('input'));
    seen.kept = column(table, 0);
    const made = [], create = URL.createObjectURL;
    URL.createObjectURL = blob => (made.push(blob), create.call(URL, blob));
    HTMLAnchorElement.prototype.click = () => {};  // nothing is saved on a tester's disk
    tools.querySelector('button').click();
    seen.csv = made.length ? await made[0].text() : '';
  }

  function useChart(seen) {
    const charts = [...document.querySelectorAll('figure > svg[role="img"]')];
    seen.charts = charts.length;
    seen.filter = getComputedStyle(charts[0]).filter;
    seen.named = charts.every(chart => chart.getAttribute('aria-label'));
    seen.drawn = charts.every(chart => chart.getBoundingClientRect().height > 100 && chart.querySelectorAll('path').length > 5);
    const marker = document.querySelector('use.told'), tip = document.querySelector('.tip');
    seen.markerSize = marker.getBoundingClientRect().width;
    marker.dispatchEvent(new PointerEvent('pointerover', {bubbles: true}));
    seen.tip = tip.hidden ? '' : tip.innerText;
    document.body.dispatchEvent(new PointerEvent('pointerover', {bubbles: true}));
    seen.gone = tip.hidden;
  }

  addEventListener('load', async () => {
    const seen = {complaints, height: document.documentElement.scrollWidth - innerWidth};
    seen.background = getComputedStyle(document.body).backgroundColor;
    useChart(seen);
    await useTable(document.querySelector('#chapter table'), seen);
    const out = document.createElement('script');
    Object.assign(out, {type: 'application/json', id: 'seen', textContent: JSON.stringify(seen)});
    document.body.append(out);
  });
})();
