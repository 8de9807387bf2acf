// SPDX-License-Identifier: BSD-3-Clause
// Atoms of the data as 3Dmol.js takes them, with secondary structure.
import {computeSecondaryStructure} from '3dmol/src/parsers/utils/computeSecondaryStructure.ts';

const longest_hydrogen_bond = 3.2;  // angstrom, N to O

function element_name(text) {
  return text.charAt(0).toUpperCase() + text.slice(1).toLowerCase();
}

/** Returns for each residue the number of the connected piece of chain that it belongs to. */
function pieces_of(molecule) {
  const joined = new Set();
  for (let k = 0; k < molecule.bonds.length; k += 2) {
    const [r, s] = [molecule.of_atom[molecule.bonds[k]], molecule.of_atom[molecule.bonds[k + 1]]];
    if (Math.abs(r - s) === 1) joined.add(Math.max(r, s));
  }
  let piece = 0;
  return molecule.residues.map((_, residue) => (joined.has(residue) ? piece : ++piece));
}

/** Returns the atoms at the positions of one frame. A residue's number is its place in the data. */
export function make_atoms(molecule, positions) {
  const pieces = pieces_of(molecule);
  const atoms = molecule.names.map((name, i) => {
    const residue = molecule.of_atom[i];
    const [chain, residue_name, , hetero] = molecule.residues[residue];
    return {
      index: i, serial: i, atom: name, elem: element_name(molecule.elements[i]), chain: chain || '_',
      resn: residue_name, resi: residue, reschain: pieces[residue], hetflag: Boolean(hetero), ss: 'c',
      x: positions[3 * i], y: positions[3 * i + 1], z: positions[3 * i + 2], bonds: [], bondOrder: [],
    };
  });
  for (let k = 0; k < molecule.bonds.length; k += 2)
    for (const [i, j] of [[k, k + 1], [k + 1, k]]) {
      atoms[molecule.bonds[i]].bonds.push(molecule.bonds[j]);
      atoms[molecule.bonds[i]].bondOrder.push(1);
    }
  computeSecondaryStructure(atoms, longest_hydrogen_bond);
  return atoms;
}
