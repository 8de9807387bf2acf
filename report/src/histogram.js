// SPDX-License-Identifier: BSD-3-Clause
// The chart of overlaps of a molecule's pairs, or of distances of a robot's pairs.
import {axis_name, bottom_axis, cell_cursor, chart_words, left_axis, scale, ticks} from './axes.js';
import {card, html, on_width, svg} from './dom.js';
import {length_unit} from './table.js';
import {counted, decimals_of, fixed, nice_step, pair_words} from './words.js';

const height = 180, left = 44, right = 12, top = 22, bottom = 38;

function bins_of(values) {
  const low = values[0], high = values[values.length - 1];
  const step = nice_step(high - low || Math.abs(high) || 1, 24);
  const first = Math.floor(low / step + 1e-9);
  const bins = Array.from({length: Math.floor(high / step + 1e-9) - first + 1},
                          (_, k) => ({from: (first + k) * step, to: (first + k + 1) * step, count: 0}));
  for (const value of values) bins[Math.min(bins.length - 1, Math.floor(value / step + 1e-9) - first)].count += 1;
  return {bins, step};
}

/** Returns the card, or null if there are no numbers. */
export function make_histogram(store, report) {
  const key = report.is_robot ? 'distance' : 'overlap';
  const unit = length_unit(report);
  const values = report.frames.flatMap((frame) => frame.pairs)
    .filter((pair) => pair[key] !== null && (report.is_robot || pair.collides)).map((pair) => pair[key] * unit.factor);
  values.sort((a, b) => a - b);
  if (values.length < 2 || (report.is_robot && values[values.length - 1] === 0)) return null;
  const {bins, step} = bins_of(values);
  const number = (x) => fixed(x, decimals_of(step));
  const [low, high] = [values[0], values[values.length - 1]].map((x) => fixed(x, unit.decimals));
  const median = fixed(values[Math.floor(values.length / 2)], unit.decimals);
  const usual = `${counted(values.length, pair_words)} of the shown ${report.frame_word[1]}: ${low} to ${high} ` +
                `${unit.name}, median ${median} ${unit.name}.`;
  const words = chart_words(usual);
  const box = html('div', {class: 'chart'});
  on_width(box, (width) => {
    const y0 = height - bottom;
    const x = scale(bins[0].from, bins[bins.length - 1].to, left, width - right);
    const most = bins.reduce((m, bin) => Math.max(m, bin.count), 1);
    const y = scale(0, most, y0, top);
    const cells = bins.map((bin) => ({
      x: x(bin.from) + 1, y: top, width: x(bin.to) - x(bin.from) - 2, height: y0 - top,
      text: `${number(bin.from)} to ${number(bin.to)} ${unit.name}: ${counted(bin.count, pair_words)}`,
      act: () => (report.is_robot ? store.change({all_frames: true, sort: {key, ascending: true}})
                                  : store.change({all_frames: report.frames.length > 1, least: bin.from})),
    }));
    const picture = svg('svg', {width, height, role: 'group', 'aria-label': `Histogram. ${usual}`},
      left_axis(y, ticks(0, most, 4, true), left, width - right),
      bins.map((bin, k) => svg('rect', {class: 'bin', x: cells[k].x, width: Math.max(1, cells[k].width), y: y(bin.count),
                                        height: y0 - y(bin.count)}, svg('title', {}, cells[k].text))),
      bottom_axis(x, ticks(bins[0].from, bins[bins.length - 1].to, Math.max(2, width / 80)), y0),
      axis_name('pairs', left, 12),
      axis_name(`${report.is_robot ? 'Distance' : 'Overlap'}, ${unit.name}`, (left + width - right) / 2, height - 4,
                'middle'));
    cell_cursor(picture, cells, (text) => words.say(text));
    picture.addEventListener('pointerleave', () => words.say(usual));
    box.replaceChildren(picture);
  });
  return card('histogram', report.is_robot ? 'Distances' : 'Overlaps', box, words.line,
              report.is_robot ? null : html('p', {class: 'quiet hint'},
                'Overlap is the sum of the two radii minus the distance. Choose a bar to list the pairs from there on.'));
}
