// SPDX-License-Identifier: BSD-3-Clause
// The matrix of a robot's links: the kind of each pair, or how often it collides in the shown frames.
import {cell_cursor, chart_words} from './axes.js';
import {card, html, on_width, svg} from './dom.js';
import {exact_filter} from './store.js';
import {counted, shortened, whole} from './words.js';

const letters = 18, most_unused = 24;

/** Returns the class of a kind of pair, by the words that the tool uses. */
function class_of(word, k) {
  if (/not tested/i.test(word)) return 'kind-untested';
  if (/adjacent/i.test(word)) return 'kind-adjacent';
  if (/always/i.test(word)) return 'kind-always';
  if (/default/i.test(word)) return 'kind-default';
  if (/sometimes/i.test(word)) return 'kind-sometimes';
  if (/not (seen|proved)|never seen/i.test(word)) return 'kind-unseen';
  if (/never/i.test(word)) return 'kind-never';
  return `kind-other-${k % 3}`;
}

function matrix_by_kind({links, matrix}) {
  const totals = matrix.words.map(() => 0);
  for (let a = 0; a < links.length; ++a)
    for (let b = 0; b < a; ++b) totals[matrix.cells[a * links.length + b]] += 1;
  return {
    names: links.map((link) => link.name),
    look: (a, b) => {
      const kind = matrix.cells[a * links.length + b];
      return {class: class_of(matrix.words[kind], kind), words: matrix.words[kind], opacity: null};
    },
    legend: matrix.words.map((word, k) => ({word, class: class_of(word, k), total: totals[k]}))
      .filter(({total}) => total > 0),
    sentence: 'Kinds of the pairs of links.',
  };
}

function matrix_by_count(report) {
  const names = report.robot.names;
  const used = new Set(report.robot.links.length > most_unused ? [] : report.robot.links.map((_, k) => k));
  const counts = new Map();
  const key = (a, b) => Math.max(a, b) * names.length + Math.min(a, b);
  for (const frame of report.frames)
    for (const pair of frame.pairs) {
      if (!pair.collides) continue;
      used.add(pair.a).add(pair.b);
      counts.set(key(pair.a, pair.b), (counts.get(key(pair.a, pair.b)) ?? 0) + 1);
    }
  if (counts.size === 0) return null;
  const places = [...used].sort((a, b) => a - b);
  const most = Math.max(...counts.values());
  return {
    names: places.map((k) => names[k]),
    look: (a, b) => {
      const count = counts.get(key(places[a], places[b])) ?? 0;
      return {class: count > 0 ? 'heat' : 'cold', opacity: count > 0 ? 0.3 + 0.7 * count / most : null,
              words: count > 0 ? `collides in ${whole(count)} of ${counted(report.frames.length, report.frame_word)}`
                               : 'no collision'};
    },
    legend: [],
    sentence: `${counted(counts.size, ['pair collides', 'pairs collide'])} in the shown ${report.frame_word[1]}.`,
  };
}

function draw_matrix(table, width, store, report, words) {
  const n = table.names.length;
  const longest = Math.min(letters, table.names.reduce((m, name) => Math.max(m, [...name].length), 0));
  const left = Math.round(longest * 6.6) + 10;
  const size = Math.max(12, Math.min(26, (width - left - 4) / n));
  const cells = [];
  const name_class = size < 17 ? 'axis-name small' : 'axis-name';
  const parts = table.names.map((name, a) => {
    const y = a * size + 2;
    const row = [svg('text', {class: name_class, x: left - 6, y: y + size / 2 + 4, 'text-anchor': 'end'},
                     shortened(name, letters), svg('title', {}, name)),
                 svg('text', {class: name_class, 'text-anchor': 'end',
                              transform: `translate(${left + a * size + size / 2 + 4} ${n * size + 8}) rotate(-90)`},
                     shortened(name, letters), svg('title', {}, name))];
    for (let b = 0; b < n; ++b) {
      const x = left + b * size;
      if (a === b) {
        row.push(svg('rect', {class: 'kind-self', x, y, width: size - 1, height: size - 1, rx: 2}));
        continue;
      }
      const look = table.look(a, b);
      const text = `${name} and ${table.names[b]}: ${look.words}`;
      const filter = exact_filter(name, table.names[b]);
      cells.push({x, y, width: size - 1, height: size - 1, text, act: () => store.change({
        filter: store.state.filter === filter ? '' : filter, all_frames: report.frames.length > 1})});
      row.push(svg('rect', {class: look.class, x, y, width: size - 1, height: size - 1, rx: 2,
                            'fill-opacity': look.opacity}, svg('title', {}, text)));
    }
    return row;
  });
  const picture = svg('svg', {width: Math.max(width, left + n * size + 4), height: n * size + left + 4, role: 'group',
                              'aria-label': `Matrix of links. ${table.sentence}`}, parts);
  cell_cursor(picture, cells, words.say);
  picture.addEventListener('pointerleave', () => words.say(table.sentence));
  return picture;
}

/** Returns the card, or null if there is nothing to show. */
export function make_matrix_chart(store, report) {
  const table = report.robot.matrix ? matrix_by_kind(report.robot) : matrix_by_count(report);
  if (!table || table.names.length < 2) return null;
  const words = chart_words(table.sentence);
  const box = html('div', {class: 'chart matrix'});
  on_width(box, (width) => box.replaceChildren(draw_matrix(table, width, store, report, words)));
  const legend = html('ul', {class: 'legend'}, table.legend.map((entry) =>
    html('li', {}, svg('svg', {width: 14, height: 14, 'aria-hidden': 'true'},
                       svg('rect', {class: entry.class, width: 14, height: 14, rx: 3})),
         `${entry.word} (${whole(entry.total)})`)));
  return card('matrix', 'Pairs of links', box, words.line, table.legend.length > 0 ? legend : null,
              html('p', {class: 'quiet hint'}, report.robot.matrix
                ? 'Choose a cell to list its pair in the table.'
                : 'The stronger the colour, the more often the pair collides. Choose a cell to list its pairs.'));
}
