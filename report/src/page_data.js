// SPDX-License-Identifier: BSD-3-Clause
// The data of the page, and the sign for tests that the page is complete.
import {html} from './dom.js';

/** Returns the data, or null if the page has none that it can read. */
export function read_data() {
  try {
    const raw = JSON.parse(document.getElementById('hinge-data').textContent);
    return raw.format === 'hinge-report' && raw.format_version === 1 ? raw : null;
  } catch {
    return null;
  }
}

/** Returns the text of a page without data. */
export function no_data() {
  return html('p', {class: 'empty'}, 'This page holds no data that it can read. ' +
                                     'Make it again with the tool that wrote it.');
}

export function ready() {
  requestAnimationFrame(() => { document.documentElement.dataset.ready = 'true'; });
}
