// SPDX-License-Identifier: BSD-3-Clause
// Pages of biocd and robocd in a real browser. Run with: node --test report/tests
import assert from 'node:assert/strict';
import {existsSync, mkdirSync, readFileSync} from 'node:fs';
import {join} from 'node:path';
import {after, before, describe, test} from 'node:test';
import {chromium, drawn, launch, look, open, rows_of} from './browser.mjs';
import {arm, data, has_data, report, root, shelf, temporary, tools, ubiquitin} from './tools.mjs';

const skip = !chromium ? 'Chromium is missing' : !existsSync(join(tools, 'biocd')) ? `no tools in ${tools}` : false;
const [urdf, srdf] = arm;
const shots = join(root, 'build', 'report-pictures');  // for people to look at
const sizes = [['phone', {width: 390, height: 844}], ['tablet', {width: 820, height: 1180}],
               ['desk', {width: 1440, height: 900}]];

const fixed = (number, decimals) => (number < 0 ? '\u2212' : '') + Math.abs(number).toFixed(decimals);
const collided = async (page) => page.$eval('.badge', (badge) => badge.textContent);

describe('pages of the tools', {skip}, () => {
  let browser, molecule, robot;
  before(async () => {
    mkdirSync(shots, {recursive: true});
    browser = await launch();
    molecule = report('molecule', 'biocd', 'sample', ubiquitin, '-n', '50', '--sigma', '3', '--seed', '1', '--json');
    robot = report('robot', 'robocd', 'check', urdf, '--srdf', srdf, '--random', '100', '--seed', '1', '--env',
                   `shelf=${shelf}`, '--mode', 'within:0.05', '--json');
  });
  after(() => browser?.close());

  async function checked(file, options, act) {
    const opened = await open(browser, file, options);
    await act(opened.page, opened);
    assert.deepEqual(opened.faults, []);
    await opened.page.close();
  }

  test('a molecule: the picture is drawn, and rows are those of the JSON', async (t) => {
    const json = JSON.parse(molecule.out);
    await checked(molecule.file, {}, async (page, {milliseconds}) => {
      t.diagnostic(`1UBQ with 50 conformations: ready after ${milliseconds} ms`);
      assert.equal(await collided(page), 'Collides');
      const {colors, filled} = await look(page);
      assert.ok(colors > 500 && filled > 0.05, `colours: ${colors}, filled: ${filled}`);
      const few = json.conformations.filter(({pairs}) => pairs.length > 3 && pairs.length <= 100).slice(0, 5);
      assert.equal(few.length, 5);
      for (const {index: k} of few) {
        await page.evaluate((frame) => hingeReport.setFrame(frame), k);
        const expected = new Map(json.conformations[k].pairs.map((pair) => [`${pair.label_i} ${pair.label_j}`, pair]));
        const rows = await rows_of(page);
        assert.equal(rows.length, expected.size);
        for (const [a, b, ...shown] of rows) {
          const {overlap, distance, threshold} = expected.get(`${a} ${b}`);  // the data has 3 decimals, a row 2
          [overlap, distance, threshold].forEach((number, column) =>
            assert.ok(Math.abs(number - Number(shown[column])) < 0.0056, `${a} ${b} ${shown}`));
        }
        const overlaps = rows.map((row) => Number(row[2]));
        assert.deepEqual(overlaps, [...overlaps].sort((a, b) => b - a));
      }
    });
  });

  test('a robot: the picture is drawn, and rows are those of the JSON', async (t) => {
    const json = JSON.parse(robot.out);
    await checked(robot.file, {}, async (page, {milliseconds}) => {
      t.diagnostic(`arm with 50 of 100 configurations: ready after ${milliseconds} ms`);
      const {colors, filled} = await look(page);
      assert.ok(colors > 100 && filled > 0.05, `colours: ${colors}, filled: ${filled}`);
      let seen = 0;
      for (const place of await page.evaluate(() => hingeReport.report.frames.map((frame) => frame.place))) {
        await page.evaluate((index) => hingeReport.setFrame(hingeReport.report.frames.findIndex((f) => f.place === index)),
                            place);
        const row = json.configurations[place];
        const expected = [...row.pairs, ...row.environment_pairs].map((pair) =>
          [pair.link1 ?? pair.link, pair.link2 ?? pair.body, fixed(1000 * pair.distance, 1)].join(' ')).sort();
        const rows = (await rows_of(page)).map(([a, b, distance]) => [a, b, distance].join(' ')).sort();
        assert.deepEqual(rows, expected);
        seen += rows.length;
      }
      assert.ok(seen > 20, `${seen} pairs`);
    });
  });

  for (const [name, frame] of [['molecule', 3], ['robot', 0]])
    test(`a ${name}: rows and picture choose each other`, async () => {
      await checked(name === 'molecule' ? molecule.file : robot.file, {}, async (page) => {
        if (name === 'molecule') await page.evaluate((k) => hingeReport.setFrame(k), frame);
        else await page.evaluate(() => hingeReport.setFrame(hingeReport.report.frames.findIndex((f) => f.colliding > 1)));
        const camera = () => page.evaluate(() => hingeReport.cameraPosition());
        const chosen = () => page.$eval('#pairs tr[aria-selected="true"]', (row) => row.rowIndex - 1).catch(() => -1);
        const whole = await camera();
        await page.click('#pairs tbody tr:nth-child(2)');
        await drawn(page);
        assert.equal(await chosen(), 1);
        assert.notDeepEqual(await camera(), whole);
        const labels = await page.$$eval('.tag-3d:not([hidden])', (tags) => tags.map((tag) => tag.textContent));
        assert.deepEqual(labels.sort(), (await rows_of(page))[1].slice(0, 2).sort());
        const [x, y] = await page.evaluate(() => hingeReport.screenPosition(hingeReport.state.selected.index));
        const near = await camera();
        await page.click('.icon-button[aria-label="Reset view"]');
        await drawn(page);
        assert.equal(await chosen(), -1);
        assert.notDeepEqual(await camera(), near);
        // The middle of the pair on the canvas, as the camera sees it now.
        const index = await page.evaluate(() => {
          const state = hingeReport.report.frames[hingeReport.state.frame];
          const all = state.pairs.map((pair, k) => [k, hingeReport.screenPosition(k)]);
          const far = ([k, [px, py]]) => Math.min(...all.filter(([j]) => j !== k)
            .map(([, [qx, qy]]) => Math.hypot(px - qx, py - qy)));
          return all.sort((p, q) => far(q) - far(p))[0][0];
        });
        const box = await (await page.$('.canvas')).boundingBox();
        const [px, py] = await page.evaluate((k) => hingeReport.screenPosition(k), index);
        await page.mouse.click(box.x + px, box.y + py);
        await drawn(page);
        assert.equal(await page.evaluate(() => hingeReport.state.selected?.index), index);
        assert.ok(Number.isFinite(x) && Number.isFinite(y));
      });
    });

  test('filter, order, charts and keyboard', async () => {
    await checked(molecule.file, {}, async (page) => {
      await page.evaluate(() => hingeReport.setFrame(5));
      const all = await rows_of(page);
      await page.keyboard.press('/');
      await page.keyboard.type(all[0][0].slice(0, 8));
      await drawn(page);
      const filtered = await rows_of(page);
      assert.ok(filtered.length >= 1 && filtered.length < all.length);
      assert.ok(filtered.every((row) => row[0].startsWith(all[0][0].slice(0, 8)) || row[1].startsWith(all[0][0].slice(0, 8))));
      await page.keyboard.press('Tab');
      await page.keyboard.type('9');
      await drawn(page);
      assert.equal((await rows_of(page)).length, 0);
      assert.match(await page.$eval('#pairs .empty', (p) => p.textContent), /No pair .* matches/);
      await page.keyboard.press('Tab');
      await page.keyboard.press('Enter');
      assert.equal((await rows_of(page)).length, all.length);
      await page.click('#pairs th:nth-child(4) button');  // by distance
      const distances = (await rows_of(page)).map((row) => Number(row[3]));
      const ascending = await page.$eval('#pairs th:nth-child(4)', (th) => th.getAttribute('aria-sort')) === 'ascending';
      assert.deepEqual(distances, [...distances].sort((a, b) => (ascending ? a - b : b - a)));
      await page.focus('#pairs tbody tr');
      await page.keyboard.press('ArrowDown');
      await page.keyboard.press('Enter');
      assert.equal(await page.$eval('#pairs tr[aria-selected="true"]', (row) => row.rowIndex), 2);
      await page.keyboard.press('Escape');
      assert.equal(await page.$('#pairs tr[aria-selected="true"]'), null);
      await page.focus('.slider');
      await page.keyboard.press('ArrowRight');
      assert.equal(await page.evaluate(() => hingeReport.state.frame), 6);
      const cell = await page.$eval('#residues .heat', (rect) => rect.querySelector('title').textContent.split(': ')[0]);
      await (await page.$('#residues .heat')).click();
      await drawn(page);
      assert.ok((await rows_of(page)).every((row) => row.some((text) => text.startsWith(`${cell}:`))));
    });
  });

  test('a path plays to its end', async () => {
    const path = report('path', 'robocd', 'plan', urdf, '--srdf', srdf, '--from', 'state:arm/home', '--to',
                        'state:arm/reach', '--env', `shelf=${shelf}`);
    await checked(path.file, {}, async (page) => {
      assert.equal(await collided(page), 'Free');
      const last = await page.evaluate(() => {
        const end = hingeReport.report.frames.length - 1;
        hingeReport.setFrame(end - 5);
        return end;
      });
      const before_play = await look(page);
      await page.select('.speed', '20');
      await page.click('[aria-label="Play"]');
      await page.waitForFunction((end) => hingeReport.state.frame === end, {timeout: 10000}, last);
      await page.waitForSelector('[aria-label="Play"]');
      assert.ok(before_play.filled > 0.03);
    });
  });

  test('a path that collides opens at its first shown collision', async () => {
    const path = report('colliding', 'robocd', 'path', urdf, '--srdf', srdf, '--from', 'state:arm/home', '--to',
                        'state:arm/reach', '--env', `shelf=${shelf}`);
    await checked(path.file, {}, async (page) => {
      const [shown, collides] = await page.evaluate(() =>
        [hingeReport.state.frame, hingeReport.report.frames.map((frame) => frame.collides)]);
      assert.ok(shown > 0);
      assert.equal(shown, collides.indexOf(true));
    });
  });

  test('a matrix of links', async () => {
    const matrix = report('matrix', 'robocd', 'matrix', urdf, '--samples', '200');
    await checked(matrix.file, {}, async (page) => {
      assert.equal(await page.$('.badge'), null);
      const links = await page.evaluate(() => hingeReport.report.robot.links.length);
      assert.equal((await page.$$('#matrix rect[class^="kind-"]')).length >= links * links, true);
    });
  });

  for (const [size, options] of sizes)
    for (const name of ['molecule', 'robot'])
      test(`${name} on a ${size}: nothing wider than the screen, buttons have names`, async () => {
        for (const dark of [false, true])
          await checked(name === 'molecule' ? molecule.file : robot.file, {...options, dark}, async (page) => {
            const [wide, screen] = await page.evaluate(() => [document.documentElement.scrollWidth, innerWidth]);
            assert.ok(wide <= screen, `${wide} > ${screen}`);
            const nameless = await page.$$eval('button', (buttons) => buttons.filter((button) =>
              !button.textContent.trim() && !button.getAttribute('aria-label')).length);
            assert.equal(nameless, 0);
            await page.evaluate(() => hingeReport.select(0));
            await drawn(page);
            await page.screenshot({path: join(shots, `${name}-${size}${dark ? '-dark' : ''}.png`)});
          });
      });

  test('names with markup, quotes and letters of other scripts stay text', async () => {
    const name = '</script><script>alert(1)</script> "\u00e9\u6f22\' <b>&amp; \u2028@SCRIPT@ $& -->';
    const escaped = name.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');
    const text = readFileSync(urdf, 'utf8').replaceAll('"forearm"', () => `"${escaped}"`);
    const page_file = report('hostile', 'robocd', 'check', temporary('hostile.urdf', text), '--random', '60', '--env',
                             `wall'"=box:0.2 2 2,xyz=0.3 0 0.3`);
    await checked(page_file.file, {}, async (page) => {
      assert.equal(await page.evaluate(() => hingeReport.report.robot.names[3]), name);
      assert.ok((await page.$$eval('#matrix title', (titles) => titles.map((title) => title.textContent))).includes(name));
      assert.equal(await page.$('#page b'), null);
    });
  });

  test('without WebGL: lines and tables', async () => {
    const plain = await launch(false);
    try {
      for (const {file} of [molecule, robot]) {
        const {page, faults} = await open(plain, file);
        assert.ok((await page.$$('.flat path')).length > 3);
        const {colors, filled} = await look(page);
        assert.ok(colors > 3 && filled > 0.005, `colours: ${colors}, filled: ${filled}`);
        await page.evaluate(() => hingeReport.setFrame(hingeReport.report.frames.findIndex((f) => f.pairs.length > 1)));
        const camera = await page.evaluate(() => hingeReport.cameraPosition());
        await page.click('#pairs tbody tr:nth-child(2)');
        await drawn(page);
        assert.notDeepEqual(await page.evaluate(() => hingeReport.cameraPosition()), camera);
        assert.deepEqual(faults.filter((text) => !/WebGL/.test(text)), []);
      }
    } finally {
      await plain.close();
    }
  });

  test('licences of the included software can be read', async () => {
    await checked(molecule.file, {}, async (page) => {
      const texts = await page.$eval('.foot pre', (pre) => pre.textContent);
      for (const word of ['3dmol', 'pako', 'upng-js', 'netcdfjs', 'iobuffer']) assert.ok(texts.includes(word), word);
    });
  });

  const molecules = ['1crn.pdb', '1hpx.pdb', '2src.pdb', '1ehz.pdb.gz', '4hhb.cif.gz', '6zu5.cif.gz', '1bna.pdb'];
  const robots = ['panda', 'ur10', 'talos', 'icub', 'pr2', 'baxter'];
  test('pages of the shared data', {skip: has_data('molecules') ? false : 'data is absent'}, async (t) => {
    const pages = [
      ...molecules.filter((name) => has_data('molecules', name)).map((name) =>
        [name, () => report(name, 'biocd', 'check', join(data, 'molecules', name))]),
      ...robots.filter((name) => has_data('robots', name, `${name}.urdf`)).map((name) => {
        const folder = join(data, 'robots', name);
        return [name, () => report(name, 'robocd', 'check', join(folder, `${name}.urdf`), '--package-path', folder,
                                   '--random', '20')];
      })];
    for (const [name, make] of pages)
      await checked(make().file, {}, async (page, {milliseconds}) => {
        t.diagnostic(`${name}: ready after ${milliseconds} ms`);
        const {colors, filled} = await look(page);
        assert.ok(colors > 50 && filled > 0.01, `${name}: colours: ${colors}, filled: ${filled}`);
      });
  });
});
