# SPDX-License-Identifier: BSD-3-Clause
"""Proteins, nucleic acids and ligands as mechanisms of torsions. Lengths are in angstrom, angles in radians.

    import hinge.molecular as hm
    m = hm.Molecule("1ubq.pdb")
    c = hm.Checker(m, free="A:30-40", exempt_reference=True)
    q = c.sample(10_000, seed=1, sigma=0.09)     # shape (n, dof)
    c.collides(q).mean()                         # share that collides
    c.pairs(q[:10])                              # which atoms

A configuration holds one value per degree of freedom: rotations in rad relative to the file's coordinates, then, for
placed parts, slides in angstrom and rotations in rad.
"""

from .._core import molecular as _core
from ._checker import Checker, CoordinateFit, Relaxation, Walk
from ._ensemble import RigidGroups, find_rigid_groups
from ._molecule import Molecule
from ._trajectory import Trajectory

OtherAtoms = _core.OtherAtoms
installed_dictionary = _core.installed_dictionary
pair_dtype = _core.pair_dtype
superpose = _core.superpose

__all__ = [
    "Checker",
    "CoordinateFit",
    "Molecule",
    "OtherAtoms",
    "Relaxation",
    "RigidGroups",
    "Trajectory",
    "Walk",
    "find_rigid_groups",
    "installed_dictionary",
    "pair_dtype",
    "superpose",
]

for _public in (Checker, CoordinateFit, Molecule, Relaxation, RigidGroups, Trajectory, Walk, find_rigid_groups):
    _public.__module__ = __name__
del _public
