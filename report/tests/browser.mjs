// SPDX-License-Identifier: BSD-3-Clause
// Opens pages in Chromium, and watches for errors and requests.
import {existsSync} from 'node:fs';
import {pathToFileURL} from 'node:url';
import puppeteer from 'puppeteer-core';

const candidates = [process.env.HINGE_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome'];
export const chromium = candidates.find((path) => path && existsSync(path));
const without_gl = ['--disable-gpu', '--disable-3d-apis'];
const with_gl = ['--enable-unsafe-swiftshader', '--use-angle=swiftshader'];

/** Starts Chromium; gl: with WebGL. The caller closes it. */
export function launch(gl = true) {
  return puppeteer.launch({executablePath: chromium, args: ['--no-sandbox', ...(gl ? with_gl : without_gl)]});
}

/** Opens a file. Returns the page, and `faults`: texts of errors, warnings and requests, which should stay empty. */
export async function open(browser, file, {width = 1280, height = 900, dark = false} = {}) {
  const page = await browser.newPage();
  const faults = [];
  page.on('console', (message) => {
    // A software renderer reports that reading pixels is slow; screenshots do that.
    if (/error|warn/.test(message.type()) && !/GPU stall|GL Driver Message/.test(message.text())) faults.push(message.text());
  });
  page.on('pageerror', (error) => faults.push(error.message));
  const own = pathToFileURL(file).href;
  page.on('request', (request) => {
    if (request.url().split('#')[0] !== own && !request.url().startsWith('data:')) faults.push(`requests ${request.url()}`);
  });
  page.on('dialog', (dialog) => {
    faults.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  await page.setViewport({width, height, isMobile: width < 600, hasTouch: width < 600});
  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: dark ? 'dark' : 'light'},
                                   {name: 'prefers-reduced-motion', value: 'reduce'}]);
  const start = performance.now();
  await page.goto(own);
  await page.waitForFunction(() => document.documentElement.dataset.ready === 'true');
  return {page, faults, milliseconds: Math.round(performance.now() - start)};
}

/** Waits until the page has drawn what changed. */
export const drawn = (page) => page.evaluate(() => new Promise((done) => {
  requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 30)));
}));

/** Returns the number of colours of the picture in the page, and the part of its pixels that differ from the corner. */
export async function look(page) {
  await drawn(page);
  const picture = await (await page.$('.canvas')).screenshot({encoding: 'base64'});
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [image.width, image.height];
    const context = canvas.getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = new Uint32Array(context.getImageData(0, 0, image.width, image.height).data.buffer);
    const corner = pixels[3 * image.width + 3];  // inside the rounded border
    return {colors: new Set(pixels).size, filled: pixels.filter((pixel) => pixel !== corner).length / pixels.length};
  }, picture);
}

/** Returns the texts of the table's rows. */
export const rows_of = (page) => page.$$eval('#pairs tbody tr', (rows) =>
  rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
