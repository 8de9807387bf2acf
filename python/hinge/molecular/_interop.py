# SPDX-License-Identifier: BSD-3-Clause
"""Structures of gemmi and MDAnalysis as the text of a file."""

import numpy as np

_COLUMNS = (
    "group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id label_entity_id label_seq_id "
    "pdbx_PDB_ins_code Cartn_x Cartn_y Cartn_z occupancy B_iso_or_equiv auth_seq_id auth_asym_id pdbx_PDB_model_num"
).split()


def text_of_gemmi(structure):
    """The mmCIF text of a gemmi.Structure."""
    if not hasattr(structure, "make_mmcif_document"):
        raise TypeError(f"structure: a {type(structure).__name__}, expected a gemmi.Structure")
    copy = structure.clone()
    copy.setup_entities()
    return copy.make_mmcif_document().as_string().encode()


def _quoted(text):
    """A name as mmCIF writes it; names of atoms may hold apostrophes."""
    text = str(text).strip()
    return f'"{text}"' if text else "."


def _column(atoms, name, default):
    """A column of an AtomGroup, or the default where the topology lacks it."""
    try:
        return getattr(atoms, name)
    except AttributeError:  # MDAnalysis.NoDataError is one
        return np.full(len(atoms), default, dtype=object)


def _element(atom_name, residue_name):
    """The element that an atom name implies, as in PDB files without the column."""
    letters = "".join(c for c in atom_name if c.isalpha())
    ions = {"NA", "CL", "MG", "ZN", "FE", "CA", "MN", "CU", "NI", "CO", "BR"}
    if atom_name.upper() in ions and residue_name.upper().startswith(atom_name.upper()):
        return atom_name.capitalize()
    return letters[:1].upper() or "X"


def text_of_mdanalysis(atoms):
    """The mmCIF text of an AtomGroup or Universe at its present frame."""
    if not hasattr(atoms, "atoms") or not hasattr(atoms.atoms, "positions"):
        raise TypeError(f"atoms: a {type(atoms).__name__}, expected an AtomGroup or a Universe of MDAnalysis")
    group = atoms.atoms
    if len(group) == 0:
        raise ValueError("atoms: 0 atoms, expected at least one")
    names = _column(group, "names", "X")
    residues = _column(group, "resnames", "UNK")
    chains = _column(group, "chainIDs", "")
    segments = _column(group, "segids", "")
    codes = _column(group, "icodes", "")
    altlocs = _column(group, "altLocs", "")
    occupancies = _column(group, "occupancies", 1.0)
    b_factors = _column(group, "tempfactors", 0.0)
    numbers = _column(group, "resids", 1)
    elements = _column(group, "elements", "")
    lines = ["data_mdanalysis", "loop_", *(f"_atom_site.{column}" for column in _COLUMNS)]
    for k, x in enumerate(group.positions):
        chain = _quoted(chains[k] if str(chains[k]).strip() else segments[k])
        chain = '"A"' if chain == "." else chain
        element = str(elements[k]).strip() or _element(str(names[k]), str(residues[k]))
        code = str(codes[k]).strip() or "?"
        place = " ".join(np.format_float_positional(c, unique=True, trim="0") for c in x)
        lines.append(
            f"ATOM {k + 1} {element} {_quoted(names[k])} {_quoted(altlocs[k])} {_quoted(residues[k])} {chain} ? . "
            f"{code} {place} {float(occupancies[k]):.6g} {float(b_factors[k]):.6g} "
            f"{int(numbers[k])} {chain} 1"
        )
    return ("\n".join(lines) + "\n").encode()
