// SPDX-License-Identifier: BSD-3-Clause
// Makes elements. Text is set as text, never as markup.

const svg_space = 'http://www.w3.org/2000/svg';

function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes ?? {})) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return element;
}

/** Returns an HTML element. Attributes that start with "on" are event listeners. */
export function html(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/** Returns an SVG element. */
export function svg(tag, attributes, ...children) {
  return fill(document.createElementNS(svg_space, tag), attributes, children);
}

const icon_paths = {
  collides: 'M8 1.5h8L22.5 8v8L16 22.5H8L1.5 16V8zM8.5 8.5l7 7m0-7l-7 7',
  free: 'M12 1.8a10.2 10.2 0 1 0 0 20.4a10.2 10.2 0 1 0 0-20.4zM7 12.5l3.5 3.5L17 9',
  undecided: 'M12 2L22.5 21H1.5zM12 9v5.5m0 2.6v.6',
  previous: 'M15 5l-7 7l7 7',
  next: 'M9 5l7 7l-7 7',
  previous_colliding: 'M12 5l-7 7l7 7M20 5l-7 7l7 7',
  next_colliding: 'M4 5l7 7l-7 7M12 5l7 7l-7 7',
  play: 'M7 4.5v15l12-7.5z',
  pause: 'M7.5 5v14M16.5 5v14',
  reset: 'M4 12a8 8 0 1 0 2.5-5.8M6.5 2.5v4h4',
};

/** Returns a small picture drawn with lines. */
export function icon(name) {
  return svg('svg', {class: `icon icon-${name}`, viewBox: '0 0 24 24', 'aria-hidden': 'true', focusable: 'false'},
             svg('path', {d: icon_paths[name]}));
}

/** Returns a button with a text, or with a picture and a text for screen readers. */
export function button(text, action, {picture = null, pressed = null, title = null} = {}) {
  return html('button', {
    type: 'button',
    class: picture ? 'icon-button' : 'button',
    'aria-label': picture ? text : null,
    'aria-pressed': pressed === null ? null : String(pressed),
    title: title ?? (picture ? text : null),
    onclick: action,
  }, picture ? icon(picture) : text);
}

/** Returns a card with a heading. */
export function card(id, heading, ...children) {
  return html('section', {class: `card card-${id}`, id, 'aria-labelledby': `${id}-heading`},
              html('h2', {id: `${id}-heading`}, heading), ...children);
}

/** Calls draw(width) now and when the width of the element changes. */
export function on_width(element, draw) {
  let last = 0;
  const look = () => {
    const width = Math.floor(element.clientWidth);
    if (width === last || width === 0) return;
    last = width;
    draw(width);
  };
  new ResizeObserver(look).observe(element);
}

/** True if the user wants no animation. */
export const wants_stillness = () => matchMedia('(prefers-reduced-motion: reduce)').matches;
