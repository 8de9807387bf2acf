// SPDX-License-Identifier: BSD-3-Clause
// Numbers and nouns as text.

const minus = '\u2212';
const space = '\u202f';

/** Returns a number with a fixed number of decimals and a real minus sign. */
export function fixed(number, decimals) {
  const text = Math.abs(number).toFixed(decimals);
  return (number < 0 && Number(text) !== 0 ? minus : '') + text;
}

/** Returns a whole number with its digits in groups of three. */
export function whole(number) {
  return String(Math.round(number)).replace(/\B(?=(\d{3})+(?!\d))/g, space);
}

/** Returns "1 pair" or "12 pairs". */
export function counted(number, words) {
  return `${whole(number)} ${words[number === 1 ? 0 : 1]}`;
}

export const pair_words = ['pair', 'pairs'];

/** Returns the text with a capital letter in front. */
export function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}

/** Returns a step of the form 1, 2 or 5 times a power of ten, so that at most `most` steps fill the range. */
export function nice_step(range, most) {
  if (!(range > 0)) return 1;
  const rough = range / most;
  const power = 10 ** Math.floor(Math.log10(rough));
  for (const factor of [1, 2, 5, 10])
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

/** Returns the decimals that show a step exactly. */
export function decimals_of(step) {
  return Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
}

/** Returns the start of a long text with an ellipsis. */
export function shortened(text, most) {
  const letters = [...text];
  return letters.length <= most ? text : `${letters.slice(0, most - 1).join('')}\u2026`;
}
