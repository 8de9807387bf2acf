// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together.
import {card, html} from './dom.js';
import {make_facts, make_footer, make_header} from './header.js';
import {make_frames_bar} from './frames_bar.js';
import {make_frames_chart} from './frames_chart.js';
import {make_histogram} from './histogram.js';
import {no_data, read_data, ready} from './page_data.js';
import {read_report} from './report.js';
import {make_store} from './store.js';
import {make_table} from './table.js';
import {make_view} from './view.js';
import {capital} from './words.js';

/** Fills the page. make_scene draws in 3D; make_chart returns the card that only molecules or only robots have. */
export function start(make_scene, make_chart) {
  const page = document.getElementById('page');
  const raw = read_data();
  if (!raw) {
    page.append(no_data());
    return ready();
  }
  const report = read_report(raw);
  const store = make_store(report);
  document.title = `${raw.title}: ${raw.verdict?.text ?? ''}`;
  const view = make_view(store, report, make_scene);
  const chart = make_frames_chart(store, report);
  const frames = report.frames.length > 0 || chart
    ? card('frames', report.is_path ? 'Path' : capital(report.frame_word[1]),
           report.frames.length > 0 ? make_frames_bar(store, report) : null, chart)
    : null;
  page.append(make_header(raw), html('main', {class: 'columns'},
    html('div', {class: 'stage'}, view.card, frames ?? ''),
    html('div', {class: 'facts'}, ...[make_table(store, report), make_histogram(store, report),
                                      make_chart(store, report), ...make_facts(raw)].filter(Boolean))),
    make_footer(raw));
  view.start?.();
  window.hingeReport = {
    data: raw, report, state: store.state,
    select: (i) => store.select(report.frames[store.state.frame].pairs[i] ?? null),
    setFrame: store.set_frame,
    cameraPosition: () => view.scene?.camera() ?? null,
    screenPosition: (i) => {
      const ends = view.scene.anchors(report.frames[store.state.frame].pairs[i]).map(view.scene.project);
      return [(ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2];
    },
  };
  ready();
}
