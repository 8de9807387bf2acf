// SPDX-License-Identifier: BSD-3-Clause
// The table of a dial's section: order, filter, selection.
import {accepts_text, error_text, rejects_text, time_text} from './dial_words.js';
import {html} from './dom.js';
import {choose_rows, head_cell, mark_row, scroll_to_row} from './table_parts.js';
import {fixed} from './words.js';

const compare_text = new Intl.Collator('en', {numeric: true}).compare;

function columns_of(section) {
  const reference = section.rows[0];
  const columns = [
    {key: 'name', name: 'Choice', value: (row) => row.name, text: (row) => row.name},
    {key: 'seconds', name: 'Time', number: true, value: (row) => row.seconds, text: (row) => time_text(row.seconds)},
    {key: 'speed', name: 'Speed', number: true, value: (row) => row.speed, text: (row) => fixed(row.speed, 2)},
    {key: 'accepts', name: 'False accepts', number: true, value: (row) => row.false_accept_rate ?? 0,
     text: (row) => accepts_text(row, row === reference)},
    {key: 'rejects', name: 'False rejects', number: true, value: (row) => row.false_reject_rate ?? 0,
     text: (row) => rejects_text(row, row === reference)},
  ];
  if (section.rows.some((row) => row.distances > 0 && row !== reference))
    columns.push({key: 'error', name: 'Distance error, mean and largest', number: true,
                  value: (row) => row.mean_distance_error ?? -1,
                  text: (row) => (row === reference ? '' : error_text(row, section.length_unit))});
  return columns;
}

/** Returns the table of a section. select(k) chooses row k, or none (-1); the table's mark(k) shows it. */
export function make_dial_table(section, select) {
  const columns = columns_of(section);
  let sort = null;  // {key, ascending}; null: the order of the data
  let filter = '';
  let chosen = -1;
  let shown = [];   // {k, row}: places in the section, and elements
  const head = html('tr'), body = html('tbody');
  const empty = html('p', {class: 'empty', hidden: true}, 'No choice matches the filter.');
  const box = html('div', {class: 'table-box'},
    html('table', {}, html('caption', {class: 'hidden'}, `${section.title}: choices`), html('thead', {}, head), body));

  const mark = () => {
    const place = shown.findIndex(({k}) => k === chosen);
    mark_row(shown, place);
    return place;
  };
  const draw = () => {
    head.replaceChildren(...columns.map((column) => {
      const sorted = sort?.key === column.key;
      return head_cell(column, column.name, sort, () => {
        sort = {key: column.key, ascending: sorted ? !sort.ascending : column.key !== 'speed'};
        draw();
        head.querySelector(`[data-key="${column.key}"]`).focus();
      });
    }));
    let places = section.rows.map((_, k) => k).filter((k) => section.rows[k].name.toLowerCase().includes(filter));
    if (sort) {
      const {value} = columns.find((column) => column.key === sort.key);
      const sign = sort.ascending ? 1 : -1;
      places = places.sort((a, b) => {
        const [p, q] = [value(section.rows[a]), value(section.rows[b])];
        return sign * (typeof p === 'string' ? compare_text(p, q) : p - q) || a - b;
      });
    }
    shown = places.map((k) => {
      const data = section.rows[k];
      const cells = columns.map((column) => html('td', {class: column.number ? 'number' : 'dial-name'},
        column.key === 'name' && data.front ? html('span', {class: 'dial-star', title: 'on the Pareto front'}, '\u2605 ') : null,
        html('span', {}, column.text(data))));
      return {k, row: html('tr', {class: data.front ? 'dial-best-row' : null}, cells)};
    });
    body.replaceChildren(...shown.map(({row}) => row));
    empty.hidden = shown.length > 0;
    box.hidden = shown.length === 0;
    mark();
  };
  choose_rows(body, () => shown, {
    click: ({k}) => select(k === chosen ? -1 : k), enter: ({k}) => select(k), escape: () => select(-1),
  });
  const field = html('input', {type: 'search', placeholder: 'Part of a name', autocomplete: 'off', spellcheck: 'false',
                               oninput: () => { filter = field.value.toLowerCase(); draw(); }});
  draw();
  return {
    element: html('div', {},
      section.rows.length > 6 ? html('div', {class: 'filters'},
        html('label', {class: 'field field-wide'}, html('span', {}, 'Filter'), field)) : null, empty, box),
    mark: (k) => {
      chosen = k;
      const place = mark();
      if (place < 0) return;
      scroll_to_row(box, head, shown[place].row);
    },
  };
}
