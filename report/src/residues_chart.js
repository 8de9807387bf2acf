// SPDX-License-Identifier: BSD-3-Clause
// The strip of residues: how many colliding pairs each one takes part in, chain by chain.
import {cell_cursor, chart_words} from './axes.js';
import {card, html, on_width, svg} from './dom.js';
import {exact_filter} from './store.js';
import {counted, pair_words, shortened, whole} from './words.js';

const row_height = 20, cell_height = 15, left = 74, most_lines = 60;

/** Returns the number of pairs that each residue of a molecule takes part in, over the shown frames. */
function pairs_by_residue(report) {
  const counts = new Map();
  for (const frame of report.frames)
    for (const pair of frame.pairs) {
      if (!pair.collides) continue;
      const [a, b] = [report.molecule.of_atom[pair.a], report.molecule.of_atom[pair.b]];
      counts.set(a, (counts.get(a) ?? 0) + 1);
      if (b !== a) counts.set(b, (counts.get(b) ?? 0) + 1);
    }
  return counts;
}

/** Returns the words of a number of pairs that a cell of a chart stands for. */
function cell_words(label, count) {
  return `${label}: ${count === 0 ? 'no pair' : counted(count, pair_words)}`;
}

/** Returns residues by chain. Waters and ligands appear only if they take part in a pair. */
function chains_of(molecule, counts) {
  const chains = new Map();
  molecule.residues.forEach(([chain, , , hetero], residue) => {
    if (hetero && !counts.has(residue)) return;
    if (!chains.has(chain)) chains.set(chain, []);
    chains.get(chain).push(residue);
  });
  return chains;
}

function lines_of(chains, a_line) {
  const lines = [];
  for (const [chain, residues] of chains)
    for (let k = 0; k < residues.length; k += a_line) lines.push({chain, residues: residues.slice(k, k + a_line)});
  return lines;
}

/** Returns the card, or null if no residue takes part in a pair. */
export function make_residues_chart(store, report) {
  const {molecule} = report;
  const counts = pairs_by_residue(report);
  if (counts.size === 0) return null;
  const chains = chains_of(molecule, counts);
  const most = Math.max(...counts.values());
  const [worst] = [...counts].find(([, count]) => count === most);
  const usual = `${counted(counts.size, ['residue', 'residues'])} with colliding pairs in the shown ` +
                `${report.frame_word[1]}; most: ${cell_words(molecule.residue_labels[worst], most)}.`;
  const words = chart_words(usual);
  const box = html('div', {class: 'chart strip'});
  const cut = html('p', {class: 'quiet', hidden: true});
  on_width(box, (width) => {
    const a_line = Math.max(10, Math.floor((width - left - 4) / 70) * 10);
    const cell = (width - left - 4) / a_line;
    let lines = lines_of(chains, a_line);
    const all = lines.length;
    if (all > most_lines) lines = lines.filter((line) => line.residues.some((r) => counts.has(r))).slice(0, most_lines);
    cut.hidden = lines.length === all;
    cut.textContent = `${whole(lines.length)} of ${whole(all)} lines are drawn.`;
    const cells = [];
    const parts = lines.map((line, row) => {
      const y = row * row_height + 2;
      const [, , number] = molecule.residues[line.residues[0]];
      const name = `${line.chain ? `${line.chain} ` : ''}${number}`;
      return [
        svg('text', {class: 'axis-name', x: left - 8, y: y + 12, 'text-anchor': 'end'}, shortened(name, 9),
            svg('title', {}, `Chain ${line.chain}, from residue ${number}`)),
        line.residues.map((residue, k) => {
          const count = counts.get(residue) ?? 0;
          const label = molecule.residue_labels[residue];
          const text = cell_words(label, count);
          cells.push({x: left + k * cell, y, width: cell - 1, height: cell_height, text, act: () => store.change({
            filter: store.state.filter === exact_filter(label) ? '' : exact_filter(label),
            all_frames: report.frames.length > 1})});
          return svg('rect', {class: count > 0 ? 'heat' : 'cold', x: left + k * cell, y, width: cell - 1,
                              height: cell_height, rx: 2, 'fill-opacity': count > 0 ? 0.25 + 0.75 * count / most : null},
                     count > 0 ? svg('title', {}, text) : null);
        })];
    });
    const picture = svg('svg', {width, height: lines.length * row_height + 4, role: 'group',
                                'aria-label': `Residues. ${usual}`}, parts);
    cell_cursor(picture, cells, (text) => words.say(text));
    picture.addEventListener('pointerleave', () => words.say(usual));
    box.replaceChildren(picture);
  });
  return card('residues', 'Pairs by residue', box, words.line, cut,
              html('p', {class: 'quiet hint'}, 'The stronger the colour, the more colliding pairs. ' +
                                               'Choose a residue to list its pairs.'));
}
