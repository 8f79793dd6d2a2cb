// What the page does beyond being read. Without it everything is still there: figures are drawings, tables are tables.
(() => {
  'use strict';

  // Tables: sorted by a click on a head, cut down to rows with a word, saved as CSV.

  const units = { m: 1, mm: 1e-3, 'µm': 1e-6, nm: 1e-9, s: 1, ms: 1e-3, 'µs': 1e-6, 'mm/s': 1e-3 };

  /// A cell as a number, in its base unit; null where it is text.
  const number = (text) => {
    const found = /^[<±]?\s*(-?[\d.]+(?:e[+-]?\d+)?)\s*(%|[a-zµ/]*)(?:\s|$)/.exec(text);
    return found ? parseFloat(found[1]) * (units[found[2]] ?? 1) : null;
  };

  /// Of what is folded away a browser knows the text, but not how it would stand there.
  const wordsIn = (element) => (element.innerText || element.textContent).trim().replace(/\s+/g, ' ');

  const textOf = (row, column) => (row.cells[column] ? wordsIn(row.cells[column]) : '');

  const sortBy = (table, column, head) => {
    const down = head.getAttribute('aria-sort') === 'ascending';
    for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const rows = [...table.tBodies[0].rows].map((row, place) => {
      const text = textOf(row, column);
      return { row, place, text, value: number(text) };
    });
    const order = (a, b) => {
      if (a.value !== null && b.value !== null) return a.value - b.value;
      if (a.value !== null || b.value !== null) return a.value !== null ? -1 : 1;  // words below numbers, always
      return a.text.localeCompare(b.text);
    };
    rows.sort((a, b) => {
      const mixed = (a.value === null) !== (b.value === null);
      return (down && !mixed ? -order(a, b) : order(a, b)) || a.place - b.place;
    });
    table.tBodies[0].append(...rows.map((entry) => entry.row));
  };

  const csvOf = (table) =>
    [...table.rows]
      .filter((row) => !row.hidden)
      .map((row) => [...row.cells].map((cell) => `"${wordsIn(cell).replaceAll('"', '""')}"`).join(','))
      .join('\n') + '\n';

  const nameOf = (table) => {
    const part = table.closest('section[id]');
    const all = [...document.querySelectorAll('main table')];
    return `${part ? part.id : 'crosscheck'}-table-${all.indexOf(table) + 1}.csv`;
  };

  const save = (table) => {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([csvOf(table)], { type: 'text/csv' }));
    link.download = nameOf(table);
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };

  const keep = (table, word) => {
    for (const row of table.tBodies[0].rows) row.hidden = !wordsIn(row).toLowerCase().includes(word.toLowerCase());
  };

  const equip = (table) => {
    if (!table.tHead || !table.tBodies.length || table.tBodies[0].rows.length < 2) return;
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      head.tabIndex = 0;
      head.classList.add('sortable');
      head.title = 'sort by this column';
      head.addEventListener('click', () => sortBy(table, column, head));
      head.addEventListener('keydown', (event) => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        sortBy(table, column, head);
      });
    });
    const bar = document.createElement('div');
    bar.className = 'table-tools';
    if (table.tBodies[0].rows.length > 6) {
      const word = document.createElement('input');
      word.type = 'search';
      word.placeholder = 'only rows with …';
      word.setAttribute('aria-label', 'show only rows that contain this');
      word.addEventListener('input', () => keep(table, word.value));
      bar.append(word);
    }
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = 'save as CSV';
    button.addEventListener('click', () => save(table));
    bar.append(button);
    (table.closest('.scroll') ?? table).after(bar);
  };

  document.querySelectorAll('main table').forEach(equip);

  // Figures: a run under the pointer says what it is.

  const tip = document.createElement('div');
  tip.className = 'tip';
  tip.setAttribute('role', 'status');
  tip.hidden = true;
  document.body.append(tip);

  /// The words of a marker: whose run it is, and its title, which the browser would show late and small.
  const wordsOf = (marker) => {
    const title = marker.querySelector('title');
    if (title) {
      const method = marker.dataset.run?.replace(/ \d+$/, '');
      marker.dataset.words = (method ? `${method}, ` : '') + title.textContent;
      marker.setAttribute('aria-label', marker.dataset.words);
      title.remove();
    }
    return marker.dataset.words;
  };

  const show = (marker) => {
    tip.textContent = wordsOf(marker);
    tip.hidden = false;
    const box = marker.getBoundingClientRect();
    const left = Math.min(box.left + box.width / 2 + 12, innerWidth - tip.offsetWidth - 8);
    const above = box.top - tip.offsetHeight - 8;
    tip.style.left = `${Math.max(8, left)}px`;
    tip.style.top = `${above > 8 ? above : box.bottom + 8}px`;
  };

  document.addEventListener('pointerover', (event) => {
    const marker = event.target.closest?.('.told, [data-run]');
    if (marker) show(marker);
    else tip.hidden = true;
  });
  addEventListener('scroll', () => { tip.hidden = true; }, { passive: true });
})();
