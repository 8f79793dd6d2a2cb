// Makes charts, folds, scene cards, sortable tables and highlighted methods work.

import {drawChart, isDrawn} from './chart/chart';
import {listRuns} from './player/runs';
import {inflated} from './player/unpack';

/** Starts everything but the players and the lab. */
export function startPage() {
  /** Unpacks gzip in base64. */
  const unpacked = (element: HTMLElement) => inflated(element.textContent ?? '').text();
  const methods = JSON.parse(document.getElementById('methods-data')?.textContent ?? '{}');
  // the other charts are unpacked when one of them is first needed
  const openCharts = JSON.parse(document.getElementById('open-charts')?.textContent ?? '{}');
  // Contents of folds and cards may be packed; they are put back before anything is looked up in them.
  const held = document.getElementById('held');
  const putBack = held ? unpacked(held).then(text => {
    const all = JSON.parse(text);
    for (const template of document.querySelectorAll<HTMLTemplateElement>('template[data-held]'))
      template.innerHTML = all[template.dataset.held!];
    held.remove();
  }) :
                         Promise.resolve();

  const packed = document.getElementById('charts');
  let unpacking: Promise<Record<string, Parameters<typeof drawChart>[1]>>|null = null;
  const others = () => unpacking ??= packed ? unpacked(packed).then(JSON.parse) : Promise.resolve({});

  // Charts are drawn when they come near the viewport, and drawn again when its width changes.

  const draw = async (box: HTMLElement) => {
    if (!box.clientWidth) return;
    // avoid any delay, because a page that is printed while it opens would not wait for its charts
    const chart = openCharts[box.dataset.chart!] ?? (await others())[box.dataset.chart!];
    if (chart) drawChart(box, chart, methods);
  };
  const seen = new IntersectionObserver(entries => {
    for (const entry of entries)
      if (entry.isIntersecting) draw(entry.target as HTMLElement);
  }, {rootMargin: '300px'});
  const resized = new ResizeObserver(entries => {
    for (const entry of entries)
      if (isDrawn(entry.target as HTMLElement)) draw(entry.target as HTMLElement);
  });
  const watchCharts = (root: ParentNode) =>
      root.querySelectorAll<HTMLElement>('.drawn').forEach(box => (seen.observe(box), resized.observe(box)));
  addEventListener('beforeprint', () => document.querySelectorAll<HTMLElement>('.drawn').forEach(draw));

  // Tooltip of the run under the pointer; its method is highlighted everywhere.

  const tip = document.createElement('div');
  tip.className = 'tip';
  tip.setAttribute('role', 'status');
  tip.hidden = true;
  document.body.append(tip);

  const show = (marker: HTMLElement) => {
    const method = marker.dataset.run?.replace(/ \d+$/, ''), words = marker.dataset.words ?? '';
    tip.textContent = method && !words.startsWith(method) ? `${method}, ${words}` : words;
    tip.hidden = false;
    const box = marker.getBoundingClientRect();
    const left = Math.min(box.left + box.width / 2 + 12, innerWidth - tip.offsetWidth - 8);
    const above = box.top - tip.offsetHeight - 8;
    tip.style.left = `${Math.max(8, left)}px`;
    tip.style.top = `${above > 8 ? above : box.bottom + 8}px`;
  };

  let lit: string|null = null;
  const light = (method: string|null) => {
    if (method === lit) return;
    lit = method;
    for (const each of document.querySelectorAll('.lit')) each.classList.remove('lit');
    for (const each of document.querySelectorAll('svg.chart.lighting')) each.classList.remove('lighting');
    if (!method) return;
    for (const each of document.querySelectorAll(`[data-method="${CSS.escape(method)}"]`)) {
      each.classList.add('lit');
      each.closest('svg.chart')?.classList.add('lighting');
    }
  };

  const point = (event: Event) => {
    const at = event.target instanceof Element ? event.target : null;
    const marker = at?.closest<HTMLElement>('[data-words]');
    if (marker)
      show(marker);
    else
      tip.hidden = true;
    light(at?.closest<HTMLElement>('[data-method]')?.dataset.method ?? null);
  };
  document.addEventListener('pointerover', point);
  document.addEventListener('focusin', point);
  addEventListener('scroll', () => {
    tip.hidden = true;
  }, {passive: true});
  document.addEventListener('keydown', event => {
    const at = event.target as HTMLElement | null;
    if (event.key === 'Enter' && at?.dataset?.run) at.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  });

  // Tables can be sorted by a click on a column's head, filtered by a word, and saved with units in the heads.

  const units:
      Record<string, number> = {m: 1, mm: 1e-3, 'µm': 1e-6, nm: 1e-9, s: 1, ms: 1e-3, 'µs': 1e-6, 'mm/s': 1e-3, '%': 1};
  const base: Record<string, string> =
      {m: 'm', mm: 'm', 'µm': 'm', nm: 'm', s: 's', ms: 's', 'µs': 's', 'mm/s': 'm/s', '%': '%'};

  /** The number in a cell, in the base unit; null if the cell contains text. */
  const number = (text: string) => {
    const plain = text.replace(/\s×\s10([−-]?\d+)/, (_, power: string) => `e${power.replace('−', '-')}`);
    const found = /^[<±]?\s*(-?[\d.]+(?:e[+-]?\d+)?)\s*(%|[a-zµ/]*)$/.exec(plain);
    return found && (found[2] === '' || found[2] in units) ?
        {value: parseFloat(found[1]) * (units[found[2]] ?? 1), unit: base[found[2]] ?? ''} :
        null;
  };

  /** Text of an element. Without layout, as in folded content, browsers may give it only as textContent. */
  const wordsIn = (element: HTMLElement) =>
      (element.innerText || element.textContent || '').trim().replace(/\s+/g, ' ');
  const textOf = (row: HTMLTableRowElement, column: number) => (row.cells[column] ? wordsIn(row.cells[column]) : '');

  const sortBy = (table: HTMLTableElement, column: number, head: HTMLElement) => {
    const down = head.getAttribute('aria-sort') === 'ascending';
    for (const other of table.tHead!.rows[0].cells) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const rows = [...table.tBodies[0].rows].map((row, place) => {
      const text = textOf(row, column);
      return {row, place, text, value: number(text)?.value ?? null};
    });
    const order = (a: typeof rows[0], b: typeof rows[0]) => {
      if (a.value !== null && b.value !== null) return a.value - b.value;
      if (a.value !== null || b.value !== null) return a.value !== null ? -1 : 1;  // words below numbers
      return a.text.localeCompare(b.text);
    };
    rows.sort((a, b) => {
      const mixed = (a.value === null) !== (b.value === null);
      return (down && !mixed ? -order(a, b) : order(a, b)) || a.place - b.place;
    });
    table.tBodies[0].append(...rows.map(entry => entry.row));
  };

  /** A table as CSV. Columns with a common unit become numbers, with the unit in the head. */
  const csvOf = (table: HTMLTableElement) => {
    const rows = [...table.rows].filter(row => !row.hidden), head = table.tHead!.rows[0],
          body = rows.filter(row => row !== head);
    const columns = [...head.cells].map((cell, c) => {
      const cells = body.map(row => textOf(row, c)), numbers = cells.map(number);
      const known = numbers.filter((n): n is NonNullable<typeof n> => n !== null),
            unit = known.find(n => n.unit)?.unit ?? '';
      const plain = known.length > 0 &&
          cells.every(
              (text, i) => numbers[i] ? numbers[i]!.unit === unit || !numbers[i]!.value : text === '–' || text === '');
      return plain ?
          [
            wordsIn(cell).replace(/ \/ .*/, '') + (unit ? ` [${unit}]` : ''),
            ...numbers.map(n => (n ? String(Number(n.value.toPrecision(12))) : ''))
          ] :
          [wordsIn(cell), ...cells];
    });
    const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
    return columns[0].map((_, r) => columns.map(column => quoted(column[r])).join(',')).join('\n') + '\n';
  };

  const save = (table: HTMLTableElement) => {
    const part = table.closest('[id]'), link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([csvOf(table)], {type: 'text/csv'}));
    link.download = `${part ? part.id : 'crosscheck'}-table.csv`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };

  const equip = (table: HTMLTableElement) => {
    if (!table.tHead || !table.tBodies.length || table.tBodies[0].rows.length < 2 ||
        table.matches('.parity, .provenance, .changes'))
      return;
    [...table.tHead.rows[0].cells].forEach((head, column) => {
      head.tabIndex = 0;
      head.classList.add('sortable');
      head.title ||= 'sort by this column';
      head.addEventListener('click', () => sortBy(table, column, head));
      head.addEventListener('keydown', event => {
        if (event.key !== 'Enter' && event.key !== ' ') return;
        event.preventDefault();
        sortBy(table, column, head);
      });
    });
    const bar = document.createElement('div');
    bar.className = 'table-tools';
    if (table.tBodies[0].rows.length > 12) {
      const word = document.createElement('input');
      word.type = 'search';
      word.placeholder = 'only rows with …';
      word.setAttribute('aria-label', 'show only rows that contain this');
      word.addEventListener('input', () => {
        for (const row of table.tBodies[0].rows)
          row.hidden = !wordsIn(row).toLowerCase().includes(word.value.toLowerCase());
      });
      bar.append(word);
    }
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = 'save as CSV';
    button.addEventListener('click', () => save(table));
    bar.append(button);
    (table.closest('.scroll') ?? table).after(bar);
  };

  const equipAll = (root: ParentNode) => {
    watchCharts(root);
    root.querySelectorAll('table').forEach(table => equip(table));
    root.querySelectorAll<HTMLElement>('figure[data-runs]').forEach(figure => listRuns(figure));
  };

  // Folds get their content when they are first opened.

  const unfold = async (fold: HTMLElement) => {
    await putBack;
    const template = fold.querySelector<HTMLTemplateElement>(':scope > template');
    if (!template) return;
    template.replaceWith(template.content);
    equipAll(fold);
  };
  document.addEventListener(
      'toggle',
      ({target}) => target instanceof HTMLDetailsElement && target.matches('.fold') && target.open && unfold(target),
      true);

  // A card opens its scene and replaces the open one; the address contains its name for links and the back button.

  const open = document.createElement('article');
  open.className = 'open-scene';
  const show_scene = (name: string|null) => {
    const template = name && document.querySelector<HTMLTemplateElement>(`template[data-scene="${CSS.escape(name)}"]`);
    for (const card of document.querySelectorAll<HTMLElement>('.card'))
      card.classList.toggle('here', card.dataset.scene === name);
    if (!template) {
      open.remove();
      return false;
    }
    if (open.id === name && open.isConnected) return true;
    open.id = name;
    open.replaceChildren(template.content.cloneNode(true));
    document.querySelector('.cards')!.after(open);
    const poster = document.querySelector(`.card[data-scene="${CSS.escape(name)}"] img`),
          stage = open.querySelector('.stage');
    if (poster && stage && !stage.firstChild) stage.append(poster.cloneNode());
    equipAll(open);
    return true;
  };


  const choose = (button: HTMLElement) => {
    for (const each of button.parentElement!.children as HTMLCollectionOf<HTMLElement>) {
      each.setAttribute('aria-pressed', String(each === button));
      document.getElementById(each.dataset.figure ?? '')?.toggleAttribute('hidden', each !== button);
    }
  };
  document.addEventListener(
      'click', ({target}) => target instanceof HTMLElement && target.dataset.figure && choose(target));

  /** Goes to the place in the address: a scene, a fold, or a figure inside one of these. */
  const goTo = async () => {
    await putBack;
    const id = decodeURIComponent(location.hash.slice(1));
    if (id === 'scenes' || id === '') show_scene(null);
    if (show_scene(id)) return void open.scrollIntoView();
    let target = document.getElementById(id);
    if (!target)
      for (const template of document.querySelectorAll('template')) {
        if (!id || !template.content.getElementById?.(id)) continue;
        const fold = template.closest<HTMLDetailsElement>('.fold');
        if (fold)
          fold.open = true, await unfold(fold);
        else
          show_scene(template.dataset.scene ?? null);
        target = document.getElementById(id);
        break;
      }
    const hidden = target?.closest('[hidden]'),
          chooses = hidden && document.querySelector<HTMLElement>(`[data-figure="${CSS.escape(hidden.id)}"]`);
    if (chooses) choose(chooses);
    if (target instanceof HTMLDetailsElement && target.matches('.fold')) target.open = true, await unfold(target);
    target?.scrollIntoView();
  };
  addEventListener('hashchange', goTo);


  const ways = [...document.querySelectorAll<HTMLAnchorElement>('nav a[href^="#"]:not(.name)')];
  const sections = ways.map(way => document.getElementById(way.hash.slice(1)));
  const mark = () => {
    const passed = sections.map(section => section !== null && section.getBoundingClientRect().top < 120);
    const here = passed.lastIndexOf(true);
    ways.forEach((way, i) => way.classList.toggle('here', i === here));
  };
  addEventListener('scroll', mark, {passive: true});

  equipAll(document);
  if (location.hash) goTo();
}
