// SPDX-License-Identifier: BSD-3-Clause
// The page of a dial in a real browser: pages of both tools, and data made here. Run with: node --test report/tests
import assert from 'node:assert/strict';
import {existsSync, mkdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {chromium, drawn, launch, open} from './browser.mjs';
import {arm, data, has_data, report, root, temporary, tools, ubiquitin} from './tools.mjs';

const skip = !chromium ? 'Chromium is missing' : !existsSync(join(tools, 'biocd')) ? `no tools in ${tools}` : false;
const shots = join(root, 'build', 'report-pictures');
const place = '@HINGE_REPORT_DATA@';

/** Returns a row. wrong: share of wrong verdicts. */
function row(name, seconds, wrong, more = {}) {
  const interval = wrong === null ? null : [wrong / 2, Math.min(1, wrong * 2 + 0.001)];
  return {
    kind: 'shapes', name, options: `--tier ${name}`, sound: '', count: 1000, colliding: 500, free: 500,
    seconds, seconds_interval: [seconds * 0.9, seconds * 1.1], speed: 1e-6 / seconds, speed_interval: [1, 1],
    false_accepts: 0, false_accept_rate: wrong === null ? null : 0, false_accept_interval: interval && [0, 0.002],
    false_rejects: Math.round((wrong ?? 0) * 1000), false_reject_rate: wrong, false_reject_interval: interval,
    wrong_rate: wrong, wrong_interval: interval, distances: null, mean_distance_error: null,
    largest_distance_error: null, front: false, ...more,
  };
}

function page_of(name, rows, more = {}) {
  const made = {
    format: 'hinge-report', format_version: 1, kind: 'dial', title: 'made', tool: 'robocd dial', version: '0', command: 'x',
    verdict: {state: '', text: 'keep it'}, question: [], files: [], notes: [],
    dial: {
      seed: 1, seconds: 1, limits: {false_accepts: 0, false_rejects: 0.01},
      sections: [{title: 'Configurations', unit: ['configuration', 'configurations'], population: 'uniform',
                  length_unit: 'm', notes: [], rows}],
      requires: [], recommendation: {text: 'keep it', options: '', check: null}, extremes: null, ...more,
    },
  };
  const text = JSON.stringify(made).replaceAll('<', '\\u003c');
  return temporary(`${name}.html`,
                   readFileSync(join(root, 'report', 'dist', 'dial.html'), 'utf8').replace(place, () => text));
}

const texts_of = (page, section = 0) => page.$$eval(`#section-${section} tbody tr`, (rows) =>
  rows.map((r) => [...r.cells].map((cell) => cell.textContent)));

describe('pages of dial', {skip}, () => {
  let browser;
  before(async () => {
    mkdirSync(shots, {recursive: true});
    browser = await launch();
  });
  after(() => browser?.close());

  async function checked(file, options, act) {
    const opened = await open(browser, file, options);
    await act(opened.page);
    assert.deepEqual(opened.faults, []);
    await opened.page.close();
  }

  for (const [tool, ...words] of [['biocd', ubiquitin, '--free', 'A:70-76', '--exempt-reference'],
                                  ['robocd', arm[0], '--extremes']])
    test(`${tool}: rows are those of the JSON, a point and its row select each other`, async () => {
      const {file, out} = report(`dial-${tool}`, tool, 'dial', ...words, '--time', '2', '--json');
      const json = JSON.parse(out);
      await checked(file, {}, async (page) => {
        for (const [k, section] of json.sections.entries()) {
          const rows = await texts_of(page, k);
          assert.deepEqual(rows.map(([name]) => name.replace('\u2605 ', '')), section.rows.map(({name}) => name));
          assert.deepEqual(rows.map(([, , speed]) => speed), section.rows.map(({speed}) => speed.toFixed(2)));
          assert.equal(await page.$$eval(`#section-${k} .dial-point`, (points) => points.length), section.rows.length);
        }
        const [title] = await page.$$eval('h1', (all) => all.map((h) => h.textContent));
        assert.equal(title.toLowerCase(), json.recommendation.text.toLowerCase());
        const selected = () => page.$eval('#section-0 tr[aria-selected="true"]', (r) => r.rowIndex - 1);
        await page.click('#section-0 tbody tr:nth-child(2)');
        assert.equal(await page.evaluate(() => hingeReport.chosen[0]), 1);
        assert.equal(await page.$eval('#section-0 .dial-ring', (ring) => ring.getAttribute('visibility')), 'visible');
        const point = await page.$$eval('#section-0 .dial-point .dial-mark', (marks) => {
          const {left, top, width, height} = marks[2].getBoundingClientRect();
          return [left + width / 2, top + height / 2];
        });
        await page.mouse.click(...point);
        assert.equal(await selected(), await page.evaluate(() => hingeReport.chosen[0]));
        assert.notEqual(await selected(), 1);
        const shown = await page.$eval('#section-0 .dial-detail', (detail) => detail.textContent);
        assert.ok(shown.includes(json.sections[0].rows[await selected()].name), shown);
        assert.equal((await page.$('#extremes')) !== null, json.extremes !== null);
      });
    });

  test('sorting, the filter and the keyboard', async () => {
    const file = page_of('sorted', [row('b', 3e-6, 0.2), row('a', 1e-6, 0.5, {front: true}), row('c', 2e-6, 0),
                                    ...[4, 5, 6, 7].map((k) => row(`d${k}`, k * 1e-6, 0.1))]);
    await checked(file, {}, async (page) => {
      const names = async () => (await texts_of(page)).map(([name]) => name.replace('\u2605 ', ''));
      await page.click('#section-0 [data-key="seconds"]');
      assert.deepEqual(await names(), ['a', 'c', 'b', 'd4', 'd5', 'd6', 'd7']);
      await page.click('#section-0 [data-key="speed"]');
      assert.equal((await names())[0], 'a');
      await page.type('#section-0 input', 'd');
      assert.equal((await names()).length, 4);
      await page.focus('#section-0 tbody tr');
      await page.keyboard.press('ArrowDown');
      await page.keyboard.press('Enter');
      assert.equal(await page.evaluate(() => hingeReport.data.dial.sections[0].rows[hingeReport.chosen[0]].name), 'd5');
      await page.keyboard.press('Escape');
      assert.equal(await page.evaluate(() => hingeReport.chosen[0]), -1);
    });
  });

  test('hostile names, one row, no rates, forty rows', async () => {
    const name = '</script><script>alert(1)</script> "\u00c5\'';
    await checked(page_of('one', [row(name, 1e-3, null)]), {}, async (page) => {
      assert.deepEqual(await texts_of(page), [[name, '1.00 ms', '0.00', 'reference', '']]);
    });
    const many = Array.from({length: 40}, (_, k) => row(`choice ${k}`, 1e-9 * 1.7 ** k, k % 3 === 0 ? 0 : 1 / (k + 2),
                                                        {kind: `kind ${k % 9}`, front: k % 7 === 0}));
    await checked(page_of('many', many, {
      requires: [{text: name, options: '--x', items: [name]}],
      recommendation: {text: name, options: '--tier hull', check: null},
      extremes: {columns: [name, 'b'], rows: [['1', '2']], notes: [name]},
    }), {}, async (page) => {
      assert.equal((await texts_of(page)).length, 40);
      assert.equal(await page.$eval('#requires li p', (p) => p.textContent), name);
      await drawn(page);
      await page.screenshot({path: join(shots, 'dial-many.png'), fullPage: true});
    });
  });

  test('pages of ten models open without an error', {skip: !has_data('robots', 'panda') && 'the shared data is missing'},
       async () => {
    const molecule = (file, ...words) => ['biocd', join(data, 'molecules', file), '--exempt-reference', ...words];
    const robot = (name) => ['robocd', join(data, 'robots', name, `${name}.urdf`)];
    const models = [
      molecule('paper/1vii_3frames.pdb', '--model', '1'), molecule('paper/1mbn.pdb', '--free', 'count:10'),
      molecule('paper/2axd.pdb.gz', '--free', 'count:10'), molecule('paper/1be0.cif', '--free', 'count:10'),
      molecule('adk_closed.pdb', '--free', 'count:5'),
      ...['panda', 'ur10', 'snake40', 'icub', 'allegro_hand'].map(robot),
    ];
    for (const [k, [tool, ...words]] of models.entries()) {
      const {file} = report(`ten-${k}`, tool, 'dial', ...words, '--time', '1');
      await checked(file, {}, async (page) => {
        assert.ok((await texts_of(page)).length > 5, words[0]);
        assert.equal(await page.$$eval('.dial-chart svg', (charts) => charts.length), 2);
      });
    }
  });

  for (const [tag, size] of [['phone', {width: 360, height: 740}], ['tablet', {width: 820, height: 1180}],
                             ['desk', {width: 1440, height: 900, dark: true}]])
    test(`nothing is wider than the page: ${tag}`, async () => {
      await checked(page_of('wide', [row('reference', 3e-6, 0), row('a rather long name of a choice', 1e-6, 0.04, {front: true})],
                            {recommendation: {text: 'x', options: '--tier '.repeat(60), check: null}}), size,
                    async (page) => {
        await drawn(page);
        const [inner, outer] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
        assert.ok(inner <= outer, `${inner} > ${outer}`);
        await page.screenshot({path: join(shots, `dial-${tag}.png`), fullPage: true});
      });
    });
});
