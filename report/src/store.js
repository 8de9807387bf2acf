// SPDX-License-Identifier: BSD-3-Clause
// What the user sees now: frame, selected pair, filter and order of the table. Parts of the page listen to changes.
import {group_label} from './report.js';

/** Returns the store of a report. */
export function make_store(report) {
  const listeners = [];
  const key = report.is_robot && report.frames.some((f) => f.pairs.some((p) => p.distance !== null)) ? 'distance'
            : 'overlap';
  const first = Math.max(0, report.frames.findIndex((frame) => frame.collides));
  const state = {
    frame: first, selected: null, all_frames: false, filter: '', least: null,
    sort: {key, ascending: key === 'distance'}, page: 0,
  };

  const tell = (changes) => {
    Object.assign(state, changes);
    for (const listener of listeners) listener(state, changes);
  };

  const same_pair = (frame, pair) => report.frames[frame].pairs.find((p) => p.a === pair.a && p.b === pair.b) ?? null;

  return {
    state,
    listen: (listener) => listeners.push(listener),
    /** Changes what the table shows. */
    change: (changes) => tell({page: 0, ...changes}),
    turn_page: (page) => tell({page}),
    /** Shows another frame. A selected pair stays selected if it is in that frame, too. */
    set_frame(frame) {
      if (frame === state.frame || frame < 0 || frame >= report.frames.length) return;
      const selected = state.selected ? same_pair(frame, state.selected) : null;
      tell({frame, selected, ...(state.all_frames ? {} : {page: 0})});
    },
    /** Selects a pair, and shows its frame. Null: no pair. by: the part of the page where the user chose it. */
    select(pair, by = null) {
      if (pair === null) tell({selected: null, by});
      else if (pair.frame === state.frame) tell({selected: pair, by});
      else tell({frame: pair.frame, selected: pair, by});
    },
  };
}

function terms_of(filter) {
  const terms = [];
  for (const [, quoted, plain] of filter.matchAll(/"([^"]+)"|([^\s"]+)/g))
    terms.push(quoted ? {exact: quoted.toLowerCase()} : {part: plain.toLowerCase()});
  return terms;
}

/** Returns a filter text that matches one residue, link or body. */
export function exact_filter(...labels) {
  return labels.map((label) => (label.includes('"') ? label.replaceAll('"', ' ').trim() : `"${label}"`)).join(' ');
}

function matcher(report, filter) {
  const terms = terms_of(filter);
  if (terms.length === 0) return () => true;
  const lower = new Map();
  const words_of = (i) => {
    if (!lower.has(i)) lower.set(i, [report.labels[i].toLowerCase(), group_label(report, i).toLowerCase()]);
    return lower.get(i);
  };
  return (pair) => {
    const [a, b] = [words_of(pair.a), words_of(pair.b)];
    return terms.every(({exact, part}) => (exact ? a.includes(exact) || b.includes(exact)
                                                 : a[0].includes(part) || b[0].includes(part)));
  };
}

const number_keys = new Set(['overlap', 'distance', 'threshold', 'collides', 'frame']);
const compare_text = new Intl.Collator('en', {numeric: true}).compare;

/** Returns the pairs that the table shows, in its order. */
export function listed_pairs(report, state) {
  if (report.frames.length === 0) return [];
  const all = state.all_frames ? report.frames.flatMap((frame) => frame.pairs) : report.frames[state.frame].pairs;
  const matches = matcher(report, state.filter);
  const listed = all.filter((pair) => matches(pair) &&
                                      (state.least === null || (pair.overlap !== null && pair.overlap >= state.least)));
  const {key, ascending} = state.sort;
  const sign = ascending ? 1 : -1;
  const compare = number_keys.has(key)
      ? (p, q) => {
        if (p[key] === null || q[key] === null) return (p[key] === null ? 1 : 0) - (q[key] === null ? 1 : 0);
        return sign * (Number(p[key]) - Number(q[key]));
      }
      : (p, q) => sign * compare_text(report.labels[p[key]], report.labels[q[key]]);
  return listed.sort((p, q) => compare(p, q) || p.frame - q.frame || p.index - q.index);
}
