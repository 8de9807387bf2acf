// SPDX-License-Identifier: BSD-3-Clause
// Geometry that scenes have in common: main axes of points, edges of meshes, the bonds to draw, the pair at a pixel.

/** Returns the main axes of points (x, y, z in a row): three unit vectors, the longest extent first, right-handed. */
export function main_axes(points) {
  const n = points.length / 3;
  const mean = [0, 0, 0];
  for (let k = 0; k < points.length; ++k) mean[k % 3] += points[k] / n;
  const m = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  for (let k = 0; k < n; ++k)
    for (let i = 0; i < 3; ++i)
      for (let j = 0; j < 3; ++j) m[i][j] += (points[3 * k + i] - mean[i]) * (points[3 * k + j] - mean[j]) / n;
  const v = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  for (let sweep = 0; sweep < 12; ++sweep)
    for (const [p, q] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(m[p][q]) < 1e-12) continue;
      const angle = 0.5 * Math.atan2(2 * m[p][q], m[q][q] - m[p][p]);
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (const rows of [m, v])
        for (const row of rows) [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
      [m[p], m[q]] = [m[p].map((x, k) => c * x - s * m[q][k]), m[q].map((x, k) => s * m[p][k] + c * x)];
    }
  const order = [0, 1, 2].sort((a, b) => m[b][b] - m[a][a]);
  const [x, y] = order.map((k) => v.map((row) => row[k]));
  return [x, y, [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]]];
}

/** Returns the quaternion [x, y, z, w] of the rotation whose matrix has these rows. */
export function quaternion_of([a, b, c]) {
  const trace = a[0] + b[1] + c[2];
  if (trace > 0) {
    const s = 2 * Math.sqrt(trace + 1);
    return [(c[1] - b[2]) / s, (a[2] - c[0]) / s, (b[0] - a[1]) / s, s / 4];
  }
  if (a[0] > b[1] && a[0] > c[2]) {
    const s = 2 * Math.sqrt(1 + a[0] - b[1] - c[2]);
    return [s / 4, (a[1] + b[0]) / s, (a[2] + c[0]) / s, (c[1] - b[2]) / s];
  }
  if (b[1] > c[2]) {
    const s = 2 * Math.sqrt(1 + b[1] - a[0] - c[2]);
    return [(a[1] + b[0]) / s, s / 4, (b[2] + c[1]) / s, (a[2] - c[0]) / s];
  }
  const s = 2 * Math.sqrt(1 + c[2] - a[0] - b[1]);
  return [(a[2] + c[0]) / s, (b[2] + c[1]) / s, s / 4, (b[0] - a[1]) / s];
}

/** Returns the pair that is nearest to a pixel and nearer than `within` pixels, or null. place(pair) returns its pixel. */
export function nearest_pair(pairs, place, px, py, within) {
  let best = null, least = within;
  for (const pair of pairs) {
    const [x, y] = place(pair);
    const gap = Math.hypot(x - px, y - py);
    if (gap < least) [best, least] = [pair, gap];
  }
  return best;
}

/** Returns the atoms of the trace: CA of amino acids, P of nucleotides. */
export function trace_of(molecule) {
  const atoms = [];
  molecule.names.forEach((name, i) => {
    const hetero = molecule.residues[molecule.of_atom[i]][3];
    const element = molecule.elements[i].toUpperCase();
    if (!hetero && ((name === 'CA' && element === 'C') || (name === 'P' && element === 'P'))) atoms.push(i);
  });
  return atoms;
}

const farthest_step = 8;  // angstrom, of consecutive atoms of a trace

/** Returns pairs of consecutive atoms of the trace that are near each other. */
export function trace_lines(molecule, positions) {
  const lines = [];
  const trace = trace_of(molecule);
  for (let k = 1; k < trace.length; ++k) {
    const [i, j] = [trace[k - 1], trace[k]];
    const chain = (atom) => molecule.residues[molecule.of_atom[atom]][0];
    const gap = Math.hypot(...[0, 1, 2].map((c) => positions[3 * i + c] - positions[3 * j + c]));
    if (chain(i) === chain(j) && gap < farthest_step) lines.push([i, j]);
  }
  return lines;
}

const sharp = Math.cos(Math.PI / 6);

function face_normals({vertices, triangles}) {
  const normals = new Float32Array(triangles.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [triangles[t], triangles[t + 1], triangles[t + 2]].map((k) => vertices.subarray(3 * k, 3 * k + 3));
    const u = [b[0] - a[0], b[1] - a[1], b[2] - a[2]], w = [c[0] - a[0], c[1] - a[1], c[2] - a[2]];
    const n = [u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2], u[0] * w[1] - u[1] * w[0]];
    const length = Math.hypot(...n) || 1;
    normals.set(n.map((x) => x / length), t);
  }
  return normals;
}

/** Returns the vertices of the triangles one after the other, and normals that are smooth except at sharp edges. */
export function creased(mesh) {
  const {vertices, triangles} = mesh;
  const faces = face_normals(mesh);
  const around = Array.from({length: vertices.length / 3}, () => []);
  triangles.forEach((vertex, k) => around[vertex].push(k - k % 3));
  const positions = new Float32Array(3 * triangles.length), normals = new Float32Array(3 * triangles.length);
  triangles.forEach((vertex, k) => {
    const t = k - k % 3;
    const sum = [0, 0, 0];
    for (const other of around[vertex]) {
      const along = faces[t] * faces[other] + faces[t + 1] * faces[other + 1] + faces[t + 2] * faces[other + 2];
      if (along > sharp) for (let c = 0; c < 3; ++c) sum[c] += faces[other + c];
    }
    const length = Math.hypot(...sum) || 1;
    for (let c = 0; c < 3; ++c) {
      positions[3 * k + c] = vertices[3 * vertex + c];
      normals[3 * k + c] = sum[c] / length;
    }
  });
  return {positions, normals};
}

/** Returns the sharp and open edges of a mesh as pairs of vertices. */
export function sharp_edges(mesh) {
  const faces = face_normals(mesh);
  const seen = new Map();
  const {triangles} = mesh;
  const count = mesh.vertices.length / 3;
  for (let k = 0; k < triangles.length; ++k) {
    const [i, j] = [triangles[k], triangles[k % 3 === 2 ? k - 2 : k + 1]];
    const key = Math.min(i, j) * count + Math.max(i, j);
    const t = k - k % 3;
    const before = seen.get(key);
    if (!before) seen.set(key, {ends: [i, j], t, drawn: true});
    else
      before.drawn = faces[t] * faces[before.t] + faces[t + 1] * faces[before.t + 1] +
                     faces[t + 2] * faces[before.t + 2] < sharp;
  }
  return [...seen.values()].filter((edge) => edge.drawn).map((edge) => edge.ends);
}
