// SPDX-License-Identifier: BSD-3-Clause
// Parts that charts have in common: scales, ticks, a cursor for the keyboard.
import {html, svg} from './dom.js';
import {decimals_of, fixed, nice_step} from './words.js';

/** Returns a function that maps a number range to another one. */
export function scale(from, to, low, high) {
  const span = to - from || 1;
  return (x) => low + (x - from) / span * (high - low);
}

/** Returns round numbers between two ends. whole: whole numbers only. */
export function ticks(from, to, most, whole = false) {
  let step = nice_step(to - from, most);
  if (whole) step = Math.max(1, Math.round(step));
  const list = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; ++k) list.push(k * step);
  return {list, text: (x) => fixed(x, decimals_of(step))};
}

/** Returns the lines and numbers of the axis at the left. */
export function left_axis(y, marks, x0, x1) {
  return svg('g', {class: 'axis'}, marks.list.map((value) => [
    svg('line', {class: 'grid', x1: x0, x2: x1, y1: y(value), y2: y(value)}),
    svg('text', {x: x0 - 6, y: y(value) + 4, 'text-anchor': 'end'}, marks.text(value))]));
}

/** Returns the numbers of the axis at the bottom. */
export function bottom_axis(x, marks, y0, text = marks.text) {
  return svg('g', {class: 'axis'}, marks.list.map((value) =>
    svg('text', {x: x(value), y: y0 + 16, 'text-anchor': 'middle'}, text(value))));
}

/** Returns the name of an axis: at the bottom in the middle, or above the left end. */
export function axis_name(text, x, y, anchor = 'start') {
  return svg('text', {class: 'axis-name', x, y, 'text-anchor': anchor}, text);
}

/**
 * Lets pointer and keyboard choose cells of a picture. cells: {x, y, width, height, text, act}. Arrow keys move to the
 * nearest cell in their direction, Enter acts. say(text) shows the text of the cell.
 */
export function cell_cursor(picture, cells, say) {
  if (cells.length === 0) return;
  const ring = svg('rect', {class: 'cursor', fill: 'none', visibility: 'hidden'});
  picture.append(ring);
  picture.setAttribute('tabindex', '0');
  let at = -1;
  const put = (k) => {
    at = k;
    const {x, y, width, height, text} = cells[k];
    for (const [name, value] of Object.entries({x: x - 1, y: y - 1, width: width + 2, height: height + 2}))
      ring.setAttribute(name, value);
    ring.setAttribute('visibility', 'visible');
    say(text);
  };
  const hide = () => ring.setAttribute('visibility', 'hidden');
  const step = (dx, dy) => {
    const from = cells[at];
    let best = -1, least = Infinity;
    cells.forEach((cell, k) => {
      const along = (cell.x - from.x) * dx + (cell.y - from.y) * dy;
      const aside = Math.abs((cell.x - from.x) * dy) + Math.abs((cell.y - from.y) * dx);
      if (along > 0.5 && along + 4 * aside < least) [best, least] = [k, along + 4 * aside];
    });
    if (best >= 0) put(best);
  };
  picture.addEventListener('focus', () => { if (picture.matches(':focus-visible')) put(Math.max(0, at)); });
  picture.addEventListener('blur', hide);
  picture.addEventListener('keydown', (event) => {
    const moves = {ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowDown: [0, 1], ArrowUp: [0, -1]};
    if (moves[event.key] && at >= 0) step(...moves[event.key]);
    else if ((event.key === 'Enter' || event.key === ' ') && at >= 0) cells[at].act();
    else return;
    event.preventDefault();
  });
  const under = (event) => {
    const box = picture.getBoundingClientRect();
    const [px, py] = [event.clientX - box.left, event.clientY - box.top];
    return cells.findIndex(({x, y, width, height}) => px >= x && px < x + width + 1 && py >= y && py < y + height + 1);
  };
  picture.addEventListener('pointermove', (event) => {
    const k = under(event);
    if (k >= 0) put(k);
    else hide();
  });
  picture.addEventListener('pointerleave', hide);
  picture.addEventListener('click', (event) => {
    const k = under(event);
    if (k >= 0) cells[k].act();
  });
}

/** Returns a line of text under a chart that says what the cursor is on. */
export function chart_words(text) {
  const line = html('p', {class: 'quiet chart-words', 'aria-live': 'polite'}, text);
  return {line, say: (words) => { line.textContent = words; }};
}
