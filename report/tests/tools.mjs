// SPDX-License-Identifier: BSD-3-Clause
// Makes pages with biocd and robocd.
import {spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath} from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
export const data = join(root, '..', 'shared', 'data');
export const tools = process.env.HINGE_TOOLS_DIR ?? join(root, 'build', 'test', 'bin');
export const ubiquitin = join(root, 'molecular', 'data', '1ubq.pdb');
export const arm = ['urdf', 'srdf'].map((kind) => join(root, 'robotics', 'data', `arm.${kind}`));
export const shelf = join(root, 'robotics', 'data', 'shelf.obj');

const folder = mkdtempSync(join(tmpdir(), 'hinge-report-'));
process.on('exit', () => rmSync(folder, {recursive: true, force: true}));

/** Writes a file for a test and returns its path. */
export function temporary(name, text = null) {
  const path = join(folder, name);
  if (text !== null) writeFileSync(path, text);
  return path;
}

export const has_data = (...path) => existsSync(join(data, ...path));

/** Runs a tool with --report and returns {file, out, err}. Exit status 1 says that something collides. */
export function report(name, tool, ...words) {
  const file = temporary(`${name}.html`);
  const {status, stdout, stderr, error} = spawnSync(join(tools, tool), [...words, '--report', file],
                                                    {encoding: 'utf8', maxBuffer: 1 << 28, cwd: root});
  if (error) throw error;
  if (status > 1) throw new Error(`${tool} ${words.join(' ')}: exit status ${status}\n${stderr}`);
  return {file, out: stdout, err: stderr};
}
