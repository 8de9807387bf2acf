// SPDX-License-Identifier: BSD-3-Clause
// The table of pairs: order, filter, pages, selection.
import {button, card, html} from './dom.js';
import {listed_pairs} from './store.js';
import {choose_rows, head_cell, mark_row, scroll_to_row} from './table_parts.js';
import {capital, counted, fixed, pair_words, whole} from './words.js';

const rows_a_page = 100;

/** Returns the unit of the lengths in the table: factor, decimals and name. */
export function length_unit(report) {
  if (!report.is_robot) return {factor: 1, decimals: 2, name: '\u00c5'};
  const largest = report.frames.reduce((most, frame) => frame.pairs.reduce(
    (m, pair) => Math.max(m, Math.abs(pair.distance ?? 0), Math.abs(pair.threshold ?? 0)), most), 0);
  return largest < 1 ? {factor: 1000, decimals: 1, name: 'mm'} : {factor: 1, decimals: 4, name: 'm'};
}

function columns_of(report) {
  const pairs = report.frames.flatMap((frame) => frame.pairs);
  const known = (key) => pairs.some((pair) => pair[key] !== null);
  const unit = length_unit(report);
  const length = (key, name) => ({key, name, unit: unit.name, number: true,
    text: (pair) => (pair[key] === null ? '\u2013' : fixed(pair[key] * unit.factor, unit.decimals))});
  const part = report.is_robot ? (report.robot.bodies.length > 0 ? 'Link or body' : 'Link') : 'Atom';
  const label = (key, place) => ({key, name: `${part} ${place}`, text: (pair) => report.labels[pair[key]]});
  const mixed = pairs.some((pair) => pair.collides) && pairs.some((pair) => !pair.collides);
  const columns = [label('a', 1), label('b', 2)];
  if (known('overlap') && !(report.is_robot && pairs.every((pair) => !pair.threshold)))
    columns.push(length('overlap', 'Overlap'));
  if (known('distance')) columns.push(length('distance', 'Distance'));
  if (known('threshold') && pairs.some((pair) => pair.threshold)) columns.push(length('threshold', 'Threshold'));
  if (mixed)
    columns.push({key: 'collides', name: 'Collides', text: (pair) => (pair.collides ? 'yes' : 'no')});
  const frame = {key: 'frame', name: capital(report.frame_word[0]), text: (pair) => report.frames[pair.frame].name};
  return {columns, with_frame: [frame, ...columns]};
}

function make_filters(store, report) {
  const [one] = report.frame_word;
  const unit = length_unit(report);
  const text = html('input', {type: 'search', id: 'filter', placeholder: report.is_robot ? 'Name of a link' : 'A:LYS48',
                              autocomplete: 'off', spellcheck: 'false', 'aria-keyshortcuts': '/',
                              oninput: () => store.change({filter: text.value})});
  const least = html('input', {type: 'number', id: 'least', step: report.is_robot ? 1 : 0.1, inputmode: 'decimal',
    oninput: () => store.change({least: least.value === '' ? null : Number(least.value) / unit.factor})});
  const has_overlap = report.frames.some((f) => f.pairs.some((p) => p.overlap !== null)) &&
                      !(report.is_robot && report.frames.every((f) => f.pairs.every((p) => !p.threshold)));
  const scopes = [false, true].map((all) => button(all ? 'All shown' : `This ${one}`,
    () => store.change({all_frames: all}), {pressed: store.state.all_frames === all}));
  document.addEventListener('keydown', (event) => {
    const typing = event.target.closest?.('input, select, textarea');
    if (event.key !== '/' || typing || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    text.focus();
  });
  const clear = button('Clear', () => {
    store.change({filter: '', least: null});
    text.focus();
  }, {title: 'Show all pairs again'});
  const show = (state) => {
    if (text.value !== state.filter) text.value = state.filter;
    if (state.least === null) { if (document.activeElement !== least || least.value !== '') least.value = ''; }
    else if (Number(least.value) / unit.factor !== state.least)
      least.value = String(Number((state.least * unit.factor).toFixed(3)));
    clear.hidden = state.filter === '' && state.least === null;
    scopes.forEach((scope, k) => scope.setAttribute('aria-pressed', String(state.all_frames === (k === 1))));
  };
  store.listen(show);
  show(store.state);
  return html('div', {class: 'filters'},
    report.frames.length > 1 ? html('div', {class: 'switch', role: 'group', 'aria-label': 'Rows of the table'}, scopes)
                             : null,
    html('label', {class: 'field field-wide', for: 'filter'}, html('span', {}, 'Filter'), text),
    has_overlap ? html('label', {class: 'field', for: 'least'},
                       html('span', {}, `Least overlap, ${unit.name}`), least) : null,
    clear);
}

/** Returns the card with the table. */
export function make_table(store, report) {
  const {columns, with_frame} = columns_of(report);
  const largest = report.frames.reduce((most, f) => f.pairs.reduce((m, p) => Math.max(m, p.overlap ?? 0), most), 0);
  const head = html('tr');
  const body = html('tbody');
  const status = html('p', {class: 'quiet table-status', role: 'status'});
  const empty = html('p', {class: 'empty'});
  const left_out = html('p', {class: 'quiet'});
  const table = html('table', {}, html('caption', {class: 'hidden'}, 'Pairs, most severe first'),
                     html('thead', {}, head), body);
  const box = html('div', {class: 'table-box'}, table);
  const pager = html('div', {class: 'pager'});
  let rows = [];

  const draw_head = (state) => {
    const focused = head.contains(document.activeElement) ? document.activeElement.dataset.key : null;
    head.replaceChildren(...(state.all_frames ? with_frame : columns).map((column) => {
      const name = column.unit ? `${column.name}, ${column.unit}` : column.name;
      const sorted = state.sort.key === column.key;
      return head_cell(column, name, state.sort, () => store.change({sort: {
        key: column.key, ascending: sorted ? !state.sort.ascending : !(column.key === 'overlap')}}));
    }));
    if (focused) head.querySelector(`[data-key="${focused}"]`)?.focus();
  };

  const mark = (state) => {
    const chosen = rows.findIndex(({pair}) => pair === state.selected);
    mark_row(rows, chosen);
    return chosen;
  };

  const draw_rows = (state, listed) => {
    const pages = Math.max(1, Math.ceil(listed.length / rows_a_page));
    const page = Math.min(state.page, pages - 1);
    const from = page * rows_a_page;
    rows = listed.slice(from, from + rows_a_page).map((pair) => {
      const cells = (state.all_frames ? with_frame : columns).map((column) => {
        const text = column.text(pair);
        const cell = html('td', {class: column.number ? 'number' : 'label', title: column.number ? null : text},
                          html('span', {}, text));
        if (column.key === 'overlap' && largest > 0) {
          cell.classList.add('bar');
          cell.style.setProperty('--part', String(Math.max(0, Math.min(1, (pair.overlap ?? 0) / largest))));
        }
        return cell;
      });
      return {pair, row: html('tr', {class: pair.collides ? null : 'near'}, cells)};
    });
    body.replaceChildren(...rows.map(({row}) => row));
    pager.replaceChildren();
    if (pages > 1)
      pager.append(button('Previous rows', () => store.turn_page(Math.max(0, page - 1))),
                   html('span', {class: 'quiet'}, `Page ${page + 1} of ${whole(pages)}`),
                   button('Next rows', () => store.turn_page(Math.min(pages - 1, page + 1))));
    status.textContent = pages > 1
      ? `Rows ${whole(from + 1)} to ${whole(from + rows.length)} of ${whole(listed.length)}`
      : counted(listed.length, pair_words);
  };

  const draw_words = (state, listed) => {
    const shown = state.all_frames ? report.frames : report.frames.slice(state.frame, state.frame + 1);
    const more = shown.reduce((sum, frame) => sum + frame.left_out, 0);
    left_out.textContent = `${counted(more, ['further pair is', 'further pairs are'])} not in this file.`;
    left_out.hidden = more === 0;
    const filtered = state.filter !== '' || state.least !== null;
    empty.hidden = listed.length > 0;
    box.hidden = listed.length === 0;
    status.hidden = listed.length === 0;
    const here = state.all_frames ? `the shown ${report.frame_word[1]}` : `this ${report.frame_word[0]}`;
    if (filtered) empty.textContent = `No pair of ${here} matches the filter.`;
    else if (shown.some((frame) => frame.collides)) empty.textContent = `The pairs of ${here} were not listed.`;
    else empty.textContent = report.frames.length > 0 ? `No pair of ${here} collides.` : 'This report lists no pairs.';
  };

  const show_page_of = (state, listed) => {
    const place = listed.indexOf(state.selected);
    if (place >= 0) state.page = Math.floor(place / rows_a_page);
  };

  const update = (state, changes) => {
    const only_selected = 'selected' in changes && !('frame' in changes);
    const listed = listed_pairs(report, state);
    if (state.selected && !('page' in changes && !('frame' in changes))) show_page_of(state, listed);
    const on_page = rows.some(({pair}) => pair === state.selected);
    if (!(only_selected && (state.selected === null || on_page))) {
      const had_focus = body.contains(document.activeElement);
      draw_head(state);
      draw_rows(state, listed);
      draw_words(state, listed);
      mark(state);
      if (had_focus) body.querySelector('tr[tabindex="0"]')?.focus({preventScroll: true});
    }
    const chosen = mark(state);
    if (chosen >= 0 && changes.selected) {
      scroll_to_row(box, head, rows[chosen].row);
      if (changes.by === 'view') box.scrollIntoView({block: 'nearest'});
    }
  };

  choose_rows(body, () => rows, {
    click: ({pair}) => store.select(pair === store.state.selected ? null : pair, 'table'),
    enter: ({pair}) => store.select(pair, 'table'),
    escape: () => store.select(null, 'table'),
  });

  store.listen(update);
  update(store.state, {frame: store.state.frame});
  const filters = report.frames.some((frame) => frame.pairs.length > 0) ? make_filters(store, report) : null;
  return card('pairs', 'Pairs', filters, status, empty, box, pager, left_out);
}
