// SPDX-License-Identifier: BSD-3-Clause
// Times, shares and errors of choices as text.

const units = [[1, 's'], [1e-3, 'ms'], [1e-6, '\u00b5s'], [1e-9, 'ns']];
const dash = '\u2013';

/** Returns a number with three significant digits, without an exponent. */
function three_digits(number) {
  return number.toFixed(number >= 99.95 ? 0 : number >= 9.995 ? 1 : 2);
}

/** Returns a time with a fitting unit: "1.23 µs". */
export function time_text(seconds) {
  const [size, name] = units.find(([u]) => seconds >= u * 0.9995) ?? units.at(-1);
  return `${three_digits(seconds / size)} ${name}`;
}

function percent_number(share) {
  const percent = 100 * share;
  if (percent === 0) return '0';
  return percent.toFixed(Math.max(0, Math.min(8, 1 - Math.floor(Math.log10(percent)))));
}

/** Returns a share in percent: "0.40 %". */
export const percent_text = (share) => `${percent_number(share)} %`;

/** Returns a share with its interval: "0 (< 0.19 %)" or "0.40 % (0.20–0.71)". */
export function rate_text(rate, interval) {
  if (rate === null) return dash;
  if (rate === 0) return `0 (< ${percent_text(interval[1])})`;
  return `${percent_text(rate)} (${percent_number(interval[0])}${dash}${percent_number(interval[1])})`;
}

/** Returns the false accepts of a row, which may be excluded by the kind of the choice. */
export function accepts_text(row, is_reference) {
  if (is_reference) return 'reference';
  if (row.sound === 'exact' && row.false_accepts + row.false_rejects === 0) return 'none, exact';
  if (row.sound === 'no false accept' && row.false_accepts === 0) return 'none, encloses';
  return rate_text(row.false_accept_rate, row.false_accept_interval);
}

export function rejects_text(row, is_reference) {
  if (is_reference || (row.sound === 'exact' && row.false_accepts + row.false_rejects === 0)) return '';
  return rate_text(row.false_reject_rate, row.false_reject_interval);
}

const length_text = (length) => (length === 0 ? '0' : Number(length.toPrecision(2)).toString());

/** Returns the mean distance error of a row with its interval, in words; empty if it was not measured. */
export function mean_error_text(row, unit) {
  const interval = row.mean_distance_error_interval;
  if (!row.distances || !interval) return '';
  return `; mean distance error ${length_text(row.mean_distance_error)} ${unit} ` +
         `(${length_text(interval[0])}${dash}${length_text(interval[1])}) in ${row.distances} distances`;
}

/** Returns the mean and the largest distance error. */
export function error_text(row, unit) {
  if (!row.distances) return '';
  return `${length_text(row.mean_distance_error)}, ${length_text(row.largest_distance_error)} ${unit}`;
}
