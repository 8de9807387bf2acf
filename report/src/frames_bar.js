// SPDX-License-Identifier: BSD-3-Clause
// The slider, the buttons and the caption that choose the frame.
import {button, html, icon} from './dom.js';
import {capital, counted, fixed, pair_words, whole} from './words.js';

/** Returns what is known of a frame: "collides, 5 pairs". */
export function frame_verdict(frame) {
  const pairs = frame.colliding + frame.left_out;
  if (!frame.collides) return 'free';
  return pairs > 0 ? `collides, ${counted(pairs, pair_words)}` : 'collides';
}

function shown_sentence(report) {
  if (report.left_out <= 0) return null;
  const total = report.left_out + report.frames.length;
  const which = report.raw.frames_text || whole(report.frames.length);
  return `${capital(counted(total, report.frame_word))} were checked. This page shows ${which} in 3D and in the table.`;
}

function joint_values(report) {
  if (!report.is_robot || report.robot.joints.length === 0) return null;
  const list = html('dl', {class: 'joints'});
  const details = html('details', {class: 'joint-values'}, html('summary', {}, 'Joint values'), list);
  return {details, show(frame) {
    details.hidden = !frame.values;
    list.replaceChildren(...(frame.values ?? []).map((value, k) => {
      const {name = `joint ${k + 1}`, unit = ''} = report.robot.joints[k] ?? {};
      const degrees = unit === 'rad' ? ` (${fixed(value * 180 / Math.PI, 1)}\u00b0)` : '';
      return html('div', {}, html('dt', {title: name}, name), html('dd', {}, `${fixed(value, 4)} ${unit}${degrees}`));
    }));
  }};
}

function player(store, report) {
  const [one] = report.frame_word;
  let timer = null;
  const speed = html('select', {'aria-label': 'Speed', class: 'speed'},
    [['2', '2 a second'], ['5', '5 a second'], ['10', '10 a second'], ['20', '20 a second']].map(([value, text]) =>
      html('option', {value, selected: value === '10'}, text)));
  const stop = () => {
    clearTimeout(timer);
    timer = null;
    play.replaceChildren(icon('play'));
    play.setAttribute('aria-label', 'Play');
    play.title = `Show one ${one} after the other`;
  };
  const step = () => {
    if (store.state.frame === report.frames.length - 1) return stop();
    store.set_frame(store.state.frame + 1);
    timer = setTimeout(step, 1000 / Number(speed.value));
  };
  const play = button('Play', () => {
    if (timer !== null) return stop();
    if (store.state.frame === report.frames.length - 1) store.set_frame(0);
    play.replaceChildren(icon('pause'));
    play.setAttribute('aria-label', 'Pause');
    play.title = 'Pause';
    timer = setTimeout(step, 1000 / Number(speed.value));
  }, {picture: 'play'});
  return {play, speed};
}

/** Returns the bar. With one frame it has a caption only. */
export function make_frames_bar(store, report) {
  const {frames} = report;
  const [one, many] = report.frame_word;
  const caption = html('p', {class: 'frame-caption', 'aria-live': 'polite'});
  const slider = html('input', {type: 'range', min: 0, max: frames.length - 1, step: 1, class: 'slider',
                                'aria-label': `Shown ${one}`, oninput: () => store.set_frame(Number(slider.value))});
  const next_colliding = (from, step) => {
    for (let k = from + step; k >= 0 && k < frames.length; k += step)
      if (frames[k].collides) return k;
    return -1;
  };
  const go = (name, picture, target) => {
    const control = button(name, () => {
      if (control.getAttribute('aria-disabled') !== 'true') store.set_frame(target());
    }, {picture});
    return {control, target};
  };
  const moves = [
    go(`Previous colliding ${one}`, 'previous_colliding', () => next_colliding(store.state.frame, -1)),
    go(`Previous ${one}`, 'previous', () => store.state.frame - 1),
    go(`Next ${one}`, 'next', () => (store.state.frame + 1 < frames.length ? store.state.frame + 1 : -1)),
    go(`Next colliding ${one}`, 'next_colliding', () => next_colliding(store.state.frame, 1)),
  ];
  const joints = joint_values(report);
  const show = () => {
    const frame = frames[store.state.frame];
    const verdict = frame_verdict(frame);
    caption.replaceChildren(
      html('strong', {title: frame.name}, frame.name),
      html('span', {class: frame.collides ? 'tag tag-collides' : 'tag tag-free'}, verdict),
      ...(frames.length > 1 ? [html('span', {class: 'quiet'}, `${store.state.frame + 1} of ${whole(frames.length)}` +
                                                              (report.left_out > 0 ? ' shown' : ''))] : []));
    slider.value = store.state.frame;
    slider.setAttribute('aria-valuetext', `${frame.name}, ${verdict}`);
    for (const {control, target} of moves) control.setAttribute('aria-disabled', String(target() < 0));
    joints?.show(frame);
  };
  store.listen((_, changes) => { if ('frame' in changes) show(); });
  show();
  const controls = html('div', {class: 'frame-controls'});
  if (frames.length > 1) {
    const {play, speed} = report.is_path ? player(store, report) : {};
    controls.append(...moves.slice(0, 2).map((m) => m.control), ...(play ? [play] : []), slider,
                    ...moves.slice(2).map((m) => m.control), ...(speed ? [speed] : []));
  }
  const sentence = shown_sentence(report);
  return html('div', {class: 'frames-bar', role: 'group', 'aria-label': capital(many)}, caption,
              frames.length > 1 ? controls : null, sentence ? html('p', {class: 'quiet'}, sentence) : null,
              joints?.details);
}
