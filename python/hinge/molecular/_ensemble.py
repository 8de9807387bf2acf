# SPDX-License-Identifier: BSD-3-Clause
"""Rigid groups of an ensemble of conformations."""

import dataclasses

import numpy as np

from .._core import molecular as _core
from ._molecule import Molecule


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class RigidGroups:
    """The result of find_rigid_groups(): sets of atoms that keep their shape, and the torsions between them.

    group_of_atom: shape (n_atoms,), the group of each atom; group 0 is the largest. segments: per group, arrays of atom
    indices; a group has several where torsions that turn lie between them. spreads: per group, the largest standard
    deviation of a distance inside it, angstrom. torsions: indices of the torsions that turn. torsion_spreads: their
    circular standard deviations, rad. held: for Molecule(held=), shape (n, 6).
    """

    group_of_atom: np.ndarray
    segments: list
    spreads: np.ndarray
    torsions: np.ndarray
    torsion_spreads: np.ndarray
    held: np.ndarray

    def __repr__(self):
        return f"<RigidGroups: groups: {len(self.segments)}, torsions between them: {len(self.torsions)}>"


def find_rigid_groups(molecule, x, *, tolerance=0.5, free="all", omega=False, progress=None):
    """Find which atoms of a molecule keep their distances in all conformations. Returns RigidGroups.

    x: conformations of shape (n, n_atoms, 3), angstrom, at least two, or a Trajectory. tolerance: largest standard
    deviation of a distance inside a group, angstrom. free, omega: torsions that may turn, as in Molecule.select().

    To use the groups: m = Molecule(source, held=groups.held); c = Checker(m, free=groups.torsions). The tool's option
    for the same is --rigid-from. Raises ModelError.
    """
    if not isinstance(molecule, Molecule):
        raise TypeError(f"molecule: a {type(molecule).__name__}, expected a Molecule")
    found = _core._find_groups(molecule, x, molecule.select(free, omega=omega), float(tolerance), progress)
    group_of_atom = np.zeros(molecule.n_atoms, np.int64)
    for number, segments in enumerate(found["segments"]):
        for segment in segments:
            group_of_atom[segment] = number
    return RigidGroups(
        group_of_atom,
        found["segments"],
        np.array(found["spreads"]),
        found["torsions"],
        found["torsion_spreads"],
        found["held"],
    )
