// SPDX-License-Identifier: BSD-3-Clause
// The chart of a dial's section: time against wrong verdicts, with the Pareto front.
import {axis_name, cell_cursor, scale} from './axes.js';
import {html, on_width, svg} from './dom.js';
import {percent_text, rate_text, time_text} from './dial_words.js';
import {shortened} from './words.js';

const height = 300, left = 62, right = 16, top = 26, bottom = 44, zero_band = 34;
const radius = 5.5, line_height = 15;

// One mark for each kind, in the order in which kinds appear.
const marks = [
  (r) => `M0 ${-r}A${r} ${r} 0 1 0 0 ${r}A${r} ${r} 0 1 0 0 ${-r}Z`,
  (r) => `M${-r} ${-r}H${r}V${r}H${-r}Z`,
  (r) => `M0 ${-1.25 * r}L${1.15 * r} ${0.8 * r}H${-1.15 * r}Z`,
  (r) => `M0 ${-1.35 * r}L${1.35 * r} 0L0 ${1.35 * r}L${-1.35 * r} 0Z`,
  (r) => `M0 ${1.25 * r}L${1.15 * r} ${-0.8 * r}H${-1.15 * r}Z`,
  (r) => `M${-r} ${-0.4 * r}H${-0.4 * r}V${-r}H${0.4 * r}V${-0.4 * r}H${r}V${0.4 * r}H${0.4 * r}V${r}H${-0.4 * r}V${0.4 * r}H${-r}Z`,
  (r) => `M${-r} ${-r}L${r} ${r}M${-r} ${r}L${r} ${-r}`,
  (r) => `M${-1.2 * r} 0H${1.2 * r}M0 ${-1.2 * r}V${1.2 * r}`,
  (r) => `M${-1.1 * r} 0L${-0.5 * r} ${-r}H${0.5 * r}L${1.1 * r} 0L${0.5 * r} ${r}H${-0.5 * r}Z`,
];

function mark_of(kinds, kind, r) {
  return marks[kinds.indexOf(kind) % marks.length](r);
}

/** Returns the powers of ten between two numbers, and parts of them if there are few. */
function log_ticks(from, to) {
  const list = [];
  const factors = Math.log10(to / from) > 2.5 ? [1] : Math.log10(to / from) > 1.2 ? [1, 3] : [1, 2, 5];
  for (let power = Math.floor(Math.log10(from)); 10 ** power <= to; ++power)
    for (const factor of factors) {
      const value = factor * 10 ** power;
      if (value >= from * 0.999 && value <= to * 1.001) list.push(value);
    }
  return list;
}

/** Returns places of labels so that none covers another one: each is at its wanted place or below it. */
function spread(wanted) {
  let last = -Infinity;
  return wanted.map((y) => (last = Math.max(y, last + line_height)));
}

function description(row, is_reference) {
  const exact = row.sound === 'exact' && row.false_accepts + row.false_rejects === 0;
  const wrong = is_reference ? 'the reference' : exact ? 'never wrong' : `wrong ${rate_text(row.wrong_rate, row.wrong_interval)}`;
  return `${row.name}: ${time_text(row.seconds)}, ${row.speed.toFixed(2)} times the speed of the reference, ${wrong}`;
}

/** Returns the legend of the kinds. */
function make_legend(kinds) {
  const r = radius;
  return html('ul', {class: 'legend'}, kinds.map((kind) => html('li', {},
    svg('svg', {width: 18, height: 18, viewBox: '-9 -9 18 18', 'aria-hidden': 'true'},
        svg('path', {class: 'dial-mark', d: mark_of(kinds, kind, r)})), kind)));
}

/** Returns the chart of a section. select(k) chooses row k; the chart's mark(k) shows it. */
export function make_dial_chart(section, select) {
  const {rows} = section;
  const kinds = [...new Set(rows.map((row) => row.kind))];
  const say_line = html('p', {class: 'quiet chart-words', 'aria-live': 'polite'});
  const hint = 'Time and share of wrong verdicts. The line joins the choices that no other one beats in both.';
  say_line.textContent = hint;
  const box = html('div', {class: 'chart dial-chart'});
  let chosen = -1;
  let mark = () => {};
  const wrong_of = (row) => row.wrong_rate ?? 0;
  const draw = (width) => {
    const x1 = width - right, y0 = height - bottom;
    const times = rows.flatMap((row) => [row.seconds, ...row.seconds_interval]);
    const t0 = Math.min(...times) / 1.25, t1 = Math.max(...times) * 1.25;
    const shares = rows.flatMap((row) => [row.wrong_rate, row.wrong_interval?.[1]]).filter((share) => share > 0);
    const s0 = Math.min(0.01, ...shares) / 1.5, s1 = 1;
    const log_x = scale(Math.log10(t0), Math.log10(t1), left, x1);
    const x = (seconds) => log_x(Math.log10(seconds));
    const log_y = scale(Math.log10(s0), Math.log10(s1), y0 - zero_band, top);
    const zero = y0 - zero_band / 2;
    const y = (share) => (share > 0 ? Math.min(y0 - zero_band, log_y(Math.log10(share))) : zero);
    const points = rows.map((row) => [x(row.seconds), y(wrong_of(row))]);
    const front = rows.map((_, k) => k).filter((k) => rows[k].front).sort((a, b) => rows[a].seconds - rows[b].seconds);
    const steps = front.map((k, n) => {
      const [px, py] = points[k];
      return n === 0 ? `M${px} ${py}` : `H${px}V${py}`;
    }).join('');
    const by_height = [...front].sort((a, b) => points[a][1] - points[b][1]);
    const places = spread(by_height.map((k) => points[k][1] - 9));
    const letters = Math.max(10, Math.floor(width / 22));
    const labels = by_height.map((k, n) => {
      const [px] = points[k];
      const at_end = px > left + (x1 - left) / 2;
      return svg('text', {class: 'dial-label', x: px + (at_end ? -9 : 9), y: places[n],
                          'text-anchor': at_end ? 'end' : 'start'}, shortened(rows[k].name, letters));
    });
    const ring = svg('circle', {class: 'dial-ring', r: radius + 5, visibility: 'hidden'});
    const time_marks = log_ticks(t0, t1).filter((_, k, all) => all.length <= width / 60 || k % 2 === 0);
    const picture = svg('svg', {width, height, role: 'img', 'aria-label': `${section.title}. ${hint}`},
      svg('g', {class: 'axis'}, log_ticks(s0, s1).map((share) => [
        svg('line', {class: 'grid', x1: left, x2: x1, y1: y(share), y2: y(share)}),
        svg('text', {x: left - 6, y: y(share) + 4, 'text-anchor': 'end'}, percent_text(share).replace(/\.0 %$/, ' %'))])),
      svg('rect', {class: 'dial-zero cold', x: left, y: y0 - zero_band, width: x1 - left, height: zero_band}),
      svg('text', {x: left - 6, y: zero + 4, 'text-anchor': 'end'}, 'none'),
      svg('g', {class: 'axis'}, time_marks.map((seconds) =>
        svg('text', {x: x(seconds), y: y0 + 16, 'text-anchor': 'middle'}, time_text(seconds).replace(/\.0+ /, ' ')))),
      axis_name('wrong verdicts', 2, 12), axis_name(`time of a ${section.unit[0]}`, (left + x1) / 2, height - 8, 'middle'),
      svg('path', {class: 'dial-front', d: steps}),
      rows.map((row, k) => {
        const [px, py] = points[k];
        const [low, high] = row.wrong_interval ?? [0, 0];
        return svg('g', {class: row.front ? 'dial-point dial-best' : 'dial-point'},
          // A choice that made no error may make some: up to the end of the interval.
          high > 0 && wrong_of(row) === 0 && row.sound !== 'exact'
            ? svg('line', {class: 'dial-whisker dial-unseen', x1: px, x2: px, y1: py, y2: y(high)}) : null,
          high > 0 && wrong_of(row) > 0 ? svg('line', {class: 'dial-whisker', x1: px, x2: px, y1: y(low), y2: y(high)}) : null,
          svg('line', {class: 'dial-whisker', x1: x(row.seconds_interval[0]), x2: x(row.seconds_interval[1]), y1: py, y2: py}),
          svg('path', {class: 'dial-mark', transform: `translate(${px} ${py})`, d: mark_of(kinds, row.kind, radius)}));
      }),
      labels, ring);
    mark = () => {
      ring.setAttribute('visibility', chosen >= 0 ? 'visible' : 'hidden');
      if (chosen >= 0) {
        ring.setAttribute('cx', points[chosen][0]);
        ring.setAttribute('cy', points[chosen][1]);
      }
    };
    mark();
    const reach = radius + 4;
    cell_cursor(picture, points.map(([px, py], k) => ({
      x: px - reach, y: py - reach, width: 2 * reach, height: 2 * reach, text: description(rows[k], k === 0),
      act: () => select(k),
    })), (words) => { say_line.textContent = words; });
    box.replaceChildren(picture);
  };
  on_width(box, draw);
  return {
    element: html('div', {}, box, make_legend(kinds), say_line),
    mark: (k) => {
      chosen = k;
      say_line.textContent = k >= 0 ? description(rows[k], k === 0) : hint;
      mark();
    },
  };
}
