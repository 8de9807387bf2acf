// SPDX-License-Identifier: BSD-3-Clause
// Colours and shapes of atoms, and the colour of a clash by its overlap.
import {elementColors} from '3dmol/src/colors.ts';

const chain_colors = [0x6c93c4, 0xd3a04a, 0x6bab84, 0xa685bd, 0xcf8266, 0x57a5a8, 0xb58a9e, 0x9aa35a];
const moving_color = 0x3b7de0, fixed_color = 0xaeb6c1;
const element_colors = {N: 0x3f5fd6, O: 0xd83a3a, S: 0xd9a400, P: 0xe08420, H: 0xd8dde3};
const many_atoms = 6000;  // thin bonds are drawn as lines from here on

const weak = [0.96, 0.66, 0.14], strong = [0.83, 0.0, 0.45];

/** Returns red, green and blue of a clash. part: overlap as a part of the largest one; null: near, not colliding. */
export function clash_color(part) {
  if (part === null) return [0.45, 0.6, 0.62];
  return weak.map((low, k) => low + part * (strong[k] - low));
}

function has_cartoon_atoms(atoms) {
  const traced = new Set();
  for (const atom of atoms)
    if (!atom.hetflag && atom.atom !== 'CA' && (atom.atom === 'O' || atom.atom === 'OP2' || atom.atom === 'O2P'))
      traced.add(atom.resi);
  return atoms.some((a) => !a.hetflag && (a.atom === 'CA' || a.atom === 'P') && traced.has(a.resi));
}

/** Returns what sets the styles of 3Dmol's atoms. */
export function make_painter(report, atoms) {
  const {molecule} = report;
  const chains = [...new Set(molecule.residues.map(([chain]) => chain))];
  const base_of = (i, moving) => {
    if (moving) return molecule.moving[i] ? moving_color : fixed_color;
    return chain_colors[chains.indexOf(molecule.residues[molecule.of_atom[i]][0]) % chain_colors.length];
  };
  const has_cartoon = has_cartoon_atoms(atoms);
  const alone = atoms.map((atom) => atom.bonds.length === 0);
  const lines = atoms.length > many_atoms;

  const style_of = (i, {style}, base, in_pair, near_pair, chosen) => {
    const atom = atoms[i];
    if (style === 'spheres') return {sphere: chosen ? {color: 'gold'} : in_pair ? {color: 0xe0308a} : {}};
    const is_cartoon = style === 'cartoon' && !atom.hetflag;
    const shape = is_cartoon ? {cartoon: {color: base, arrows: true, thickness: 0.35}} : {};
    if (alone[i]) shape.sphere = {radius: atom.hetflag ? 0.35 : 0.6};
    else if (near_pair || atom.hetflag || style === 'sticks') shape.stick = {radius: near_pair ? 0.16 : 0.11};
    else if (lines) shape.line = {};
    else shape.stick = {radius: 0.055};
    if (chosen) shape.sphere = {radius: 0.5};
    return shape;
  };

  return {
    has_cartoon,
    /** Sets colour and style of all atoms. Residues of pairs have thick bonds. */
    paint(look, pairs, selected) {
      const in_pair = new Set(), residues = new Set();
      for (const pair of pairs) {
        if (!pair.collides && pair !== selected) continue;
        in_pair.add(pair.a).add(pair.b);
        residues.add(atoms[pair.a].resi).add(atoms[pair.b].resi);
      }
      const chosen = new Set(selected ? [selected.a, selected.b] : []);
      atoms.forEach((atom, i) => {
        const base = base_of(i, look.moving);
        atom.color = atom.elem === 'C' ? base
                   : element_colors[atom.elem] ?? elementColors.defaultColors[atom.elem] ?? 0x9a6fb0;
        atom.style = style_of(i, look, base, in_pair.has(i), residues.has(atom.resi), chosen.has(i));
      });
    },
    is_visible: (atom) => Boolean(atom.style.stick || atom.style.sphere || atom.style.line || atom.atom === 'CA'),
  };
}
