// SPDX-License-Identifier: BSD-3-Clause
// Makes dist/molecule.html, dist/robot.html and dist/dial.html: program, style and licences in one file each. The tools put their data
// at @HINGE_REPORT_DATA@. Also writes THIRD-PARTY.txt. Argument: the folder to write to (default: this one).
import {createHash} from 'node:crypto';
import {mkdirSync, readdirSync, readFileSync, writeFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build, transform} from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const out = resolve(process.argv[2] ?? here);
const data_place = '@HINGE_REPORT_DATA@';
const most_bytes = 880_000;

const read = (...path) => readFileSync(join(here, ...path), 'utf8');
const hash_of = (text) => `sha256-${createHash('sha256').update(text).digest('base64')}`;

function check_ascii(text, name) {
  const found = /[^\t\n\x20-\x7e]/.exec(text);
  if (found) throw new Error(`${name}: character ${JSON.stringify(found[0])} at ${found.index} is not ASCII`);
}

async function bundle(page) {
  const {outputFiles: [script], metafile} = await build({
    entryPoints: [join(here, 'src', `${page}.js`)], absWorkingDir: here, bundle: true, minify: true, write: false,
    format: 'iife', target: 'es2022', charset: 'ascii', legalComments: 'none', metafile: true, logLevel: 'warning',
    loader: {'.vert': 'text', '.frag': 'text'}, logOverride: {'direct-eval': 'silent'},
  });
  return {script: script.text.trim(), inputs: Object.keys(metafile.inputs)};
}

/** Returns the folders of the packages that files belong to. A package may lie inside another one. */
function packages_of(inputs) {
  const folders = inputs.map((file) => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]).filter(Boolean);
  return [...new Set(folders)].sort();
}

function licence_of(folder) {
  const {name, version, license} = JSON.parse(read(folder, 'package.json'));
  const file = readdirSync(join(here, folder)).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${folder} has no licence file`);
  const text = read(folder, file).replaceAll('\r', '').replaceAll('\t', '    ').replace(/[ \t]+$/gm, '').trim();
  return `${name} ${version} (${license})\n\n${text}\n`;
}

const line = `\n${'-'.repeat(78)}\n`;

const licences_of = (inputs) => packages_of(inputs).map(licence_of).join(line);

/** Returns a text as HTML with ASCII characters only. */
function markup_of(text) {
  return text.replace(/[<>&]|[^\n\x20-\x7e]/gu, (letter) => `&#${letter.codePointAt(0)};`);
}

function fill(template, values) {
  return template.replace(/@([A-Z_]+)@/g, (_, name) => {
    if (!(name in values)) throw new Error(`page.html: nothing is known of @${name}@`);
    return values[name];
  });
}

const style = (await transform(read('src', 'page.css'), {loader: 'css', minify: true, charset: 'ascii'})).code.trim();
const all_inputs = new Set();
mkdirSync(join(out, 'dist'), {recursive: true});
for (const page of ['molecule', 'robot', 'dial']) {
  const {script, inputs} = await bundle(page);
  inputs.forEach((input) => all_inputs.add(input));
  const text = fill(read('src', 'page.html'), {
    SCRIPT: script, SCRIPT_HASH: hash_of(script), STYLE: style, STYLE_HASH: hash_of(style),
    LICENCES: markup_of(licences_of(inputs)), DATA_PLACE: data_place,
  });
  check_ascii(text, page);
  if (text.split(data_place).length !== 2) throw new Error(`${page}: ${data_place} must occur once`);
  if (text.length > most_bytes) throw new Error(`${page}: ${text.length} bytes, more than ${most_bytes}`);
  writeFileSync(join(out, 'dist', `${page}.html`), text);
  console.log(`dist/${page}.html: ${text.length} bytes`);
}
writeFileSync(join(out, 'THIRD-PARTY.txt'),
              `Software of others inside dist/*.html, with its licences.\n${line}${licences_of([...all_inputs])}`);
