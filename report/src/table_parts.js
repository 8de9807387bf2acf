// SPDX-License-Identifier: BSD-3-Clause
// Parts that tables have in common: heads that sort, rows that pointer and keyboard choose.
import {html} from './dom.js';

/** Returns the head of a column. column: {key, name, number}; sort: {key, ascending}, or null. choose() sorts by it. */
export function head_cell(column, name, sort, choose) {
  const sorted = sort?.key === column.key;
  const order = sorted ? (sort.ascending ? 'ascending' : 'descending') : 'none';
  return html('th', {scope: 'col', 'aria-sort': order, class: column.number ? 'number' : null},
    html('button', {type: 'button', 'data-key': column.key, onclick: choose}, name,
         html('span', {class: 'arrow', 'aria-hidden': 'true'}, sorted && !sort.ascending ? '\u25bc' : '\u25b2')));
}

/**
 * Lets pointer and keyboard choose rows. rows(): the shown ones, each with its element in `row`. click(entry), enter(entry)
 * and escape() act; arrow keys, Home and End move the focus.
 */
export function choose_rows(body, rows, {click, enter, escape}) {
  body.addEventListener('click', (event) => {
    const entry = rows().find(({row}) => row === event.target.closest('tr'));
    if (entry) click(entry);
  });
  body.addEventListener('keydown', (event) => {
    const list = rows();
    const place = list.findIndex(({row}) => row === event.target);
    if (place < 0) return;
    const target = {ArrowDown: place + 1, ArrowUp: place - 1, Home: 0, End: list.length - 1}[event.key];
    if (event.key === 'Enter' || event.key === ' ') enter(list[place]);
    else if (event.key === 'Escape') escape();
    else if (target !== undefined) {
      list[place].row.tabIndex = -1;
      const {row} = list[Math.max(0, Math.min(list.length - 1, target))];
      row.tabIndex = 0;
      row.focus();
    } else return;
    event.preventDefault();
  });
}

/** Marks one of the rows, at `place` or none (-1), as selected. One row takes part in the order of Tab. */
export function mark_row(rows, place) {
  rows.forEach(({row}, k) => {
    row.setAttribute('aria-selected', String(k === place));
    row.tabIndex = k === Math.max(0, place) ? 0 : -1;
  });
}

/** Scrolls the box of a table so that the row is visible under the head. */
export function scroll_to_row(box, head, row) {
  const top = row.offsetTop - head.offsetHeight;
  if (top < box.scrollTop || row.offsetTop + row.offsetHeight > box.scrollTop + box.clientHeight)
    box.scrollTop = Math.max(0, top - box.clientHeight / 3);
}
