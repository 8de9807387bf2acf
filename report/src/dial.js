// SPDX-License-Identifier: BSD-3-Clause
// The page of a dial: what each choice costs and gets wrong.
import {make_dial_chart} from './dial_chart.js';
import {make_dial_table} from './dial_table.js';
import {mean_error_text, percent_text} from './dial_words.js';
import {card, html} from './dom.js';
import {copied_line, make_facts, make_footer, make_header} from './header.js';
import {no_data, read_data, ready} from './page_data.js';
import {counted, fixed, whole} from './words.js';

const options_line = (options) => copied_line(options, 'Copy the options');

function make_recommendation({options, check}) {
  if (!options) return null;
  const words = check ? `Checked on fresh questions, ${check.population}: ${fixed(check.speed, 2)} times faster, ` +
    `${whole(check.false_accepts)} false accepts in ${whole(check.colliding)}, ` +
    `${whole(check.false_rejects)} false rejects in ${whole(check.free)}.` : '';
  return card('recommendation', 'Options to paste', options_line(options), html('p', {class: 'quiet'}, words));
}

function make_section(section, place, chosen) {
  const detail = html('div', {class: 'dial-detail', hidden: true});
  const select = (k) => {
    chart.mark(k);
    table.mark(k);
    chosen[place] = k;
    const row = section.rows[k];
    detail.hidden = !row;
    if (!row) return;
    detail.replaceChildren(
      html('p', {}, html('strong', {}, row.name), `, ${counted(row.count, section.unit)} asked: ` +
           `${whole(row.colliding)} collide, ${whole(row.free)} are free; ${whole(row.false_accepts)} false accepts, ` +
           `${whole(row.false_rejects)} false rejects${mean_error_text(row, section.length_unit)}.`),
      row.options ? options_line(row.options) : '');
  };
  const chart = make_dial_chart(section, select);
  const table = make_dial_table(section, select);
  const [reference] = section.rows;
  const all = reference.colliding + reference.free;
  const element = card(`section-${place}`, section.title,
    html('p', {class: 'quiet'}, `${counted(reference.count, section.unit)}, ${section.population}` +
         (all > 0 ? `; ${percent_text(reference.colliding / all)} collide.` : '.')),
    chart.element, table.element, detail,
    (section.notes ?? []).length > 0 ? html('ul', {class: 'quiet dial-notes'},
                                            section.notes.map((note) => html('li', {}, note))) : null);
  return {element, select};
}

function make_requirements(list) {
  if (list.length === 0) return null;
  return card('requires', 'What the scene requires', html('ul', {class: 'dial-list'}, list.map(({text, options, items}) =>
    html('li', {}, html('p', {}, text),
      items.length > 0 ? html('details', {}, html('summary', {}, counted(items.length, ['entry', 'entries'])),
                              html('p', {class: 'quiet'}, items.join('; '))) : null,
      options ? options_line(options) : null))));
}

function make_extremes(extremes) {
  if (!extremes) return null;
  return card('extremes', 'Extremes',
    html('div', {class: 'table-box'}, html('table', {},
      html('thead', {}, html('tr', {}, extremes.columns.map((name) => html('th', {scope: 'col', class: 'plain'}, name)))),
      html('tbody', {}, extremes.rows.map((row) => html('tr', {}, row.map((text) => html('td', {}, text))))))),
    html('ul', {class: 'quiet dial-notes'}, extremes.notes.map((note) => html('li', {}, note))));
}

function start() {
  const page = document.getElementById('page');
  const raw = read_data();
  if (!raw) {
    page.append(no_data());
    return ready();
  }
  document.title = `${raw.title}: ${raw.verdict?.text ?? ''}`;
  const {dial} = raw;
  const chosen = [];
  const sections = dial.sections.map((section, place) => make_section(section, place, chosen));
  page.append(make_header(raw), html('main', {class: 'dial'},
    ...[make_recommendation(dial.recommendation), ...sections.map(({element}) => element), make_requirements(dial.requires),
        make_extremes(dial.extremes), ...make_facts(raw)].filter(Boolean)), make_footer(raw));
  window.hingeReport = {data: raw, chosen, select: (place, k) => sections[place].select(k)};
  ready();
}

start();
