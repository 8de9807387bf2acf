// SPDX-License-Identifier: BSD-3-Clause
// The card with the picture: a 3D scene, or a flat one where WebGL is missing; labels and picking for both.
import {button, card, html} from './dom.js';
import {make_flat_scene} from './flat_scene.js';

const nearest_click = 14;  // pixels

function has_webgl() {
  try {
    const canvas = document.createElement('canvas');
    return Boolean(canvas.getContext('webgl2') ?? canvas.getContext('webgl'));
  } catch {
    return false;
  }
}

function make_scene(make_3d, box, report, tools) {
  if (has_webgl()) {
    try {
      return make_3d(box, report, tools);
    } catch {
      box.replaceChildren();
    }
  }
  return make_flat_scene(box, report, tools);
}

/** Calls click(x, y) for a press without a drag, and hover(x, y) or hover(null) as the mouse moves. */
function watch_pointer(box, click, hover) {
  let start = null;
  const place = (event) => {
    const {left, top} = box.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  box.addEventListener('pointerdown', (event) => {
    start = event.isPrimary ? place(event) : null;
    hover(null);
  }, true);
  box.addEventListener('pointerup', (event) => {
    const [x, y] = place(event);
    if (start && Math.hypot(x - start[0], y - start[1]) < 5) click(x, y);
    start = null;
  }, true);
  let waits = false;
  box.addEventListener('pointermove', (event) => {
    if (event.pointerType !== 'mouse' || event.buttons !== 0 || waits) return;
    waits = true;
    const [x, y] = place(event);
    requestAnimationFrame(() => {
      waits = false;
      hover(x, y);
    });
  }, true);
  box.addEventListener('pointerleave', () => hover(null));
}

function make_labels(scene, report, store, overlay) {
  const tags = ['a', 'b'].map((end) => html('span', {class: `tag-3d tag-3d-${end}`, hidden: true}));
  const tip = html('span', {class: 'tag-3d tag-tip', hidden: true});
  overlay.append(...tags, tip);
  const put = (tag, x, y) => { tag.style.transform = `translate(${Math.round(x)}px, ${Math.round(y)}px)`; };
  const place = () => {
    const pair = store.state.selected;
    const points = pair ? scene.anchors(pair) : [];
    const shown = points.map((point) => (point ? scene.project(point) : null));
    const a_is_left = !shown[0] || !shown[1] || shown[0][0] <= shown[1][0];
    tags.forEach((tag, k) => {
      const at = shown[k];
      tag.hidden = !at || at[0] < 0 || at[1] < 0 || at[0] > overlay.clientWidth || at[1] > overlay.clientHeight;
      if (tag.hidden) return;
      const label = report.labels[k === 0 ? pair.a : pair.b];
      if (tag.textContent !== label) tag.textContent = label;
      tag.classList.toggle('tag-left', (k === 0) === a_is_left);
      put(tag, ...at);
    });
  };
  const show_tip = (x, y) => {
    const text = x === null ? null : scene.hover(x, y);
    tip.hidden = !text;
    if (!text) return;
    tip.textContent = text;
    tip.classList.toggle('tag-left', x > overlay.clientWidth / 2);
    put(tip, x, y);
  };
  return {place, show_tip};
}

function picture_words(report, state) {
  const list = report.frames[state.frame]?.pairs ?? [];
  const count = list.filter((pair) => pair.collides).length;
  return `Picture of ${report.frames[state.frame].name}. Colliding pairs in it: ${count}.`;
}

/** Returns {card, scene}; the scene is null if the report has no frames. make_3d makes the scene with WebGL. */
export function make_view(store, report, make_3d) {
  const heading = report.is_robot ? 'Robot' : 'Molecule';
  if (report.frames.length === 0)
    return {card: card('view', heading, html('p', {class: 'empty'},
                                             `This report holds no ${report.frame_word[0]} to draw.`)), scene: null};
  const canvas = html('div', {class: 'canvas'});
  const overlay = html('div', {class: 'overlay', 'aria-hidden': 'true'});
  const stage = html('div', {class: 'stage-box', role: 'img'}, canvas, overlay);
  const toolbar = html('div', {class: 'toolbar', role: 'group', 'aria-label': 'Picture'});
  const hint = html('p', {class: 'quiet view-hint'});
  const whole = card('view', heading, toolbar, stage, hint,
                     report.cut ? html('p', {class: 'notice'}, report.cut) : null);
  const night = matchMedia('(prefers-color-scheme: dark)');
  let scene = null;

  const start = () => {
    let labels = null;
    scene = make_scene(make_3d, canvas, report, {store, dark: night.matches, on_change: () => labels?.place()});
    labels = make_labels(scene, report, store, overlay);
    toolbar.append(...scene.controls, button('Reset view', () => {
      store.select(null);
      scene.reset();
    }, {picture: 'reset'}));
    hint.replaceChildren(...scene.legend);
    night.addEventListener('change', () => scene.set_dark(night.matches));
    watch_pointer(canvas, (x, y) => {
      const pair = scene.pick(x, y, nearest_click);
      if (pair) store.select(pair, 'view');
    }, labels.show_tip);
    const show = (state, changes) => {
      if (!('frame' in changes) && !('selected' in changes)) return;
      stage.setAttribute('aria-label', picture_words(report, state));
      scene.show(state);
      if (changes.selected) scene.focus(changes.selected, Boolean(changes.by));
      labels.place();
    };
    store.listen(show);
    show(store.state, {frame: store.state.frame});
  };
  return {card: whole, start, get scene() { return scene; }};
}

/** Returns a group of buttons of which one is pressed. */
export function choice(label, names, chosen, choose) {
  const buttons = names.map((name, k) => button(name, () => {
    buttons.forEach((other, j) => other.setAttribute('aria-pressed', String(j === k)));
    choose(k);
  }, {pressed: k === chosen}));
  return html('div', {class: 'switch', role: 'group', 'aria-label': label}, buttons);
}

/** Returns a button that is on or off. */
export function toggle(name, on, change) {
  const control = button(name, () => {
    on = !on;
    control.setAttribute('aria-pressed', String(on));
    change(on);
  }, {pressed: on});
  return control;
}
