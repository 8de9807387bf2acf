// SPDX-License-Identifier: BSD-3-Clause
// The chart of pairs by frame, over all frames that were checked.
import {axis_name, bottom_axis, left_axis, scale, ticks} from './axes.js';
import {html, on_width, svg} from './dom.js';
import {capital, counted, pair_words, whole} from './words.js';

const height = 132, left = 44, right = 10, top = 24, bottom = 36;

function summary(report) {
  const {all} = report;
  let colliding = 0, most = 0, where = 0;
  for (let k = 0; k < all.count; ++k) {
    colliding += all.collides[k];
    if (all.pairs && all.pairs[k] > most) [most, where] = [all.pairs[k], k];
  }
  const words = `${whole(colliding)} of ${counted(all.count, report.frame_word)} ` +
                `${colliding === 1 ? 'collides' : 'collide'}`;
  return most > 0 ? `${words}; at most ${counted(most, pair_words)}, in ${report.frame_word[0]} ${whole(report.first_number + where)}.` : `${words}.`;
}

/** Returns bars {from, to, collides, pairs, shown}: one a frame, or one for several where there is little room. */
function bars_of(all, most) {
  const step = Math.max(1, Math.ceil(all.count / most));
  const bars = [];
  for (let from = 0; from < all.count; from += step) {
    const to = Math.min(all.count, from + step);
    let collides = 0, pairs = 0;
    for (let k = from; k < to; ++k) {
      collides |= all.collides[k];
      pairs = Math.max(pairs, all.pairs ? all.pairs[k] : all.collides[k]);
    }
    bars.push({from, to, collides, pairs, shown: false});
  }
  for (const place of all.places) {
    const bar = bars[Math.floor(place / step)];
    if (bar) bar.shown = true;
  }
  return bars;
}

function bar_title(report, bar) {
  const first = report.first_number + bar.from, last = report.first_number + bar.to - 1;
  const numbers = capital(first === last ? `${report.frame_word[0]} ${whole(first)}`
                                         : `${report.frame_word[1]} ${whole(first)} to ${whole(last)}`);
  const pairs = !report.all.pairs || !bar.collides ? ''
              : `, ${first === last ? '' : 'at most '}${counted(bar.pairs, pair_words)}`;
  return `${numbers}: ${bar.collides ? 'collides' : 'free'}${pairs}${bar.shown ? '' : '; not shown in 3D'}`;
}

/** Returns the chart, or null if there is nothing to compare. */
export function make_frames_chart(store, report) {
  const {all} = report;
  if (all.count < 2) return null;
  const words = summary(report);
  const box = html('div', {class: 'chart'});
  let mark = () => {};
  const draw = (width) => {
    const y0 = height - bottom;
    const x = scale(0, all.count, left, width - right);
    const bars = bars_of(all, Math.max(20, (width - left - right) / 3));
    const most = Math.max(1, bars.reduce((m, bar) => Math.max(m, bar.pairs), 0));
    const y = scale(0, most, y0, top);
    const gap = x(bars[0].to) - x(0) > 6 ? 2 : 0;
    const current = svg('path', {class: 'current'});
    const first = report.first_number;
    const numbers = ticks(first, first + all.count - 1, Math.max(2, width / 70), true);
    if (numbers.list[0] !== first) numbers.list.unshift(first);
    const picture = svg('svg', {width, height, role: 'img', 'aria-label': `Pairs by ${report.frame_word[0]}. ${words}`},
      all.pairs ? left_axis(y, ticks(0, most, 3, true), left, width - right) : null,
      bars.map((bar) => svg('rect', {
        class: `${bar.collides ? 'bar-collides' : 'bar-free'}${bar.shown ? '' : ' bar-unshown'}`,
        x: x(bar.from), width: Math.max(0.8, x(bar.to) - x(bar.from) - gap),
        y: bar.collides ? Math.min(y(bar.pairs), y0 - 3) : y0 - 3,
        height: bar.collides ? Math.max(3, y0 - y(bar.pairs)) : 3,
      }, svg('title', {}, bar_title(report, bar)))),
      current,
      bottom_axis((n) => x(n - first + 0.5), numbers, y0),
      axis_name(all.pairs ? 'colliding pairs' : 'collides', left, 12),
      axis_name(`${capital(report.frame_word[0])} ${report.is_path ? 'of the path, in order' : 'number'}`, (left + width - right) / 2, height - 4, 'middle'));
    picture.addEventListener('click', (event) => {
      const at = (event.clientX - picture.getBoundingClientRect().left - left) / (width - left - right) * all.count;
      const distance = (k) => Math.abs(all.places[k] + 0.5 - at);
      const nearest = all.places.reduce((best, _, k) => (distance(k) < distance(best) ? k : best), 0);
      if (all.places.length > 0) store.set_frame(nearest);
    });
    mark = () => {
      const place = all.places[store.state.frame];
      if (place === undefined) return;
      const at = x(place + 0.5);
      current.setAttribute('d', `M${at} ${top - 2}V${y0}M${at - 5} ${top - 9}h10l-5 7z`);
    };
    mark();
    box.replaceChildren(picture);
  };
  on_width(box, draw);
  store.listen((_, changes) => { if ('frame' in changes) mark(); });
  return html('div', {class: 'frames-chart'}, box, html('p', {class: 'quiet chart-words'}, words));
}
