// SPDX-License-Identifier: BSD-3-Clause
// Reads the data of the page: numbers from base64, rows of pairs, labels.

function bytes_of(text) {
  const letters = atob(text ?? '');
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  return bytes;
}

/** Returns the little-endian numbers of a base64 text as an array of a type such as Float32Array. */
export function numbers_of(Type, text) {
  const bytes = bytes_of(text);
  return new Type(bytes.buffer, 0, Math.floor(bytes.length / Type.BYTES_PER_ELEMENT));
}

function molecule_of(raw) {
  const residues = raw.residues ?? [];
  const residue_labels = residues.map(([chain, name, number]) => `${chain ? `${chain}:` : ''}${name}${number}`);
  const of_atom = numbers_of(Uint32Array, raw.atoms.residues);
  const names = raw.atoms.names;
  return {
    residues,
    residue_labels,
    names,
    elements: raw.atoms.elements,
    of_atom,
    atom_labels: names.map((name, i) => `${residue_labels[of_atom[i]]}:${name}`),
    bonds: numbers_of(Uint32Array, raw.bonds),
    moving: numbers_of(Uint8Array, raw.moving),
    origin: raw.origin ?? [0, 0, 0],
    unit: raw.unit ?? 0.01,
    cut: raw.cut ?? null,
  };
}

function mesh_of(raw) {
  return {
    name: raw.name,
    vertices: numbers_of(Float32Array, raw.vertices),
    triangles: numbers_of(Uint32Array, raw.triangles),
    moves: raw.moves !== 0,
    pose: raw.pose ?? null,
  };
}

function robot_of(raw) {
  const links = (raw.links ?? []).map(mesh_of);
  const bodies = (raw.bodies ?? []).map(mesh_of);
  const matrix = raw.matrix ? {words: raw.matrix.words, cells: numbers_of(Uint8Array, raw.matrix.cells)} : null;
  return {links, bodies, joints: raw.joints ?? [], matrix, cut: raw.cut ?? null,
          names: [...links, ...bodies].map((part) => part.name)};
}

function pair_of(row, frame, index, robot) {
  const [a, b, distance = null, threshold = null, collides = 1] = row;
  let overlap = distance === null || threshold === null ? null : threshold - distance;
  if (!robot && typeof row[5] === 'number') overlap = row[5];
  const points = robot && row[5] && row[6] ? [row[5], row[6]] : null;
  return {frame, index, a, b, distance, threshold, overlap, collides: Boolean(collides), points};
}

function all_frames_of(raw, frames) {
  const all = raw.all_frames;
  if (all)
    return {count: all.count, collides: bytes_of(all.collides),
            pairs: all.pairs ? numbers_of(Uint32Array, all.pairs) : null, places: frames.map((frame) => frame.place)};
  return {
    count: frames.length,
    collides: Uint8Array.from(frames, (frame) => (frame.collides ? 1 : 0)),
    pairs: Uint32Array.from(frames, (frame) => frame.colliding + frame.left_out),
    places: frames.map((_, k) => k),
  };
}

/** Returns the data in the form that the parts of the page use. */
export function read_report(raw) {
  const is_robot = raw.kind === 'robot';
  const frames = (raw.frames ?? []).map((frame, k) => {
    const pairs = (frame.pairs ?? []).map((row, i) => pair_of(row, k, i, is_robot));
    return {
      place: frame.index, name: frame.name, collides: frame.collides, values: frame.values ?? null, pairs,
      colliding: pairs.reduce((sum, pair) => sum + (pair.collides ? 1 : 0), 0),
      left_out: frame.pairs_left_out ?? 0,
      coordinates: frame.coordinates ?? null, poses: frame.poses ?? null,
    };
  });
  const molecule = is_robot ? null : molecule_of(raw.molecule);
  const robot = is_robot ? robot_of(raw.robot) : null;
  return {
    raw, is_robot, frames, molecule, robot,
    labels: is_robot ? robot.names : molecule.atom_labels,
    cut: (molecule ?? robot).cut,
    all: all_frames_of(raw, frames),
    first_number: raw.first_number ?? 1,
    frame_word: raw.frame_word ?? ['frame', 'frames'],
    is_path: raw.sequence === 'path',
    left_out: raw.frames_left_out ?? 0,
  };
}

/** Returns the coordinates of a frame's atoms in angstrom, three an atom. */
export function positions_of(molecule, frame) {
  const steps = numbers_of(Int16Array, frame.coordinates);
  const positions = new Float32Array(steps.length);
  for (let k = 0; k < steps.length; ++k) positions[k] = molecule.origin[k % 3] + molecule.unit * steps[k];
  return positions;
}

const unmoved = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** Returns the pose of a link in a frame, or of a body: 12 numbers, rows of a 3x4 matrix. */
export function pose_of(robot, frame, part) {
  if (part >= robot.links.length) return robot.bodies[part - robot.links.length].pose ?? unmoved;
  frame.pose_numbers ??= numbers_of(Float32Array, frame.poses);
  const numbers = frame.pose_numbers.subarray(12 * part, 12 * part + 12);
  return numbers.length === 12 ? numbers : unmoved;
}

/** Returns a point of a part in the world. */
export function placed(pose, x, y, z) {
  return [pose[0] * x + pose[1] * y + pose[2] * z + pose[3], pose[4] * x + pose[5] * y + pose[6] * z + pose[7],
          pose[8] * x + pose[9] * y + pose[10] * z + pose[11]];
}

/** Returns the residue of a molecule's atom as text, or the name of a robot's part: what a filter in quotes matches. */
export function group_label(report, i) {
  return report.is_robot ? report.labels[i] : report.molecule.residue_labels[report.molecule.of_atom[i]];
}
