// SPDX-License-Identifier: BSD-3-Clause
// The head of the page with the verdict, and the cards with question, notes and files.
import {button, card, html, icon} from './dom.js';
import {capital, counted, whole} from './words.js';

const first_notes = 6;  // more are behind a click
const state_words = {collides: 'Collides', free: 'Free', undecided: 'Undecided'};

/** Copies a text; without clipboard access it selects the element, so that the user can copy. */
async function copy(text, element, copied) {
  try {
    await navigator.clipboard.writeText(text);
    copied('Copied');
  } catch {
    getSelection().selectAllChildren(element);
    copied(document.execCommand?.('copy') ? 'Copied' : 'Selected');
  }
}

/** Returns a line of code with a button that copies it. */
export function copied_line(text, title) {
  const code = html('code', {tabindex: '0'}, text);
  const copier = button('Copy', () => copy(text, code, (word) => {
    copier.textContent = word;
    setTimeout(() => { copier.textContent = 'Copy'; }, 1500);
  }), {title});
  copier.setAttribute('aria-live', 'polite');
  return html('div', {class: 'command'}, code, copier);
}

/** Returns the head of the page. */
export function make_header(raw) {
  const state = state_words[raw.verdict?.state] ? raw.verdict.state : null;
  const notes = (raw.notes ?? []).length;
  return html('header', {class: 'head'},
    html('div', {class: 'verdict'},
      state ? html('span', {class: `badge badge-${state}`}, icon(state), state_words[state]) : null,
      html('div', {class: 'verdict-words'},
        html('h1', {}, capital(raw.verdict?.text || state_words[state] || raw.title)),
        html('p', {class: 'source'}, html('strong', {title: raw.title}, raw.title),
             html('span', {}, [raw.tool, raw.version].filter(Boolean).join(' ')),
             notes > 0 ? html('a', {href: '#notes'}, counted(notes, ['note', 'notes'])) : null))),
    raw.command ? copied_line(raw.command, 'Copy the command') : null);
}

function make_notes(notes) {
  const list = (some) => html('ul', {}, some.map((note) => html('li', {}, note)));
  const more = notes.slice(first_notes);
  return card('notes', 'Notes', list(notes.slice(0, first_notes)),
              more.length > 0 ? html('details', {}, html('summary', {}, `${whole(more.length)} more`), list(more)) : null);
}

/** Returns the cards that say what was asked, and of which files. Empty ones are left out. */
export function make_facts(raw) {
  const cards = [];
  if (raw.question?.length > 0)
    cards.push(card('question', 'What was checked',
      html('dl', {}, raw.question.flatMap(({name, value}) => [html('dt', {}, name), html('dd', {}, value)]))));
  if (raw.notes?.length > 0)
    cards.push(make_notes(raw.notes));
  if (raw.files?.length > 0)
    cards.push(card('files', 'Files', html('ul', {class: 'files'}, raw.files.map(({name, sha256}) =>
      html('li', {}, html('strong', {}, name),
           sha256 ? html('span', {class: 'hash'}, html('abbr', {title: 'checksum of the content'}, 'SHA-256'), ' ',
                         html('code', {}, sha256)) : null)))));
  return cards;
}

/** Returns the last lines of the page. */
export function make_footer(raw) {
  const texts = document.getElementById('licences').textContent;
  return html('footer', {class: 'foot'},
    html('p', {}, `Made by ${[raw.tool?.split(' ')[0], raw.version].filter(Boolean).join(' ')} of Hinge. ` +
                  'This page is one file; it loads nothing and sends nothing.'),
    html('details', {}, html('summary', {}, 'Licences of the software in this page'), html('pre', {}, texts.trim())));
}
