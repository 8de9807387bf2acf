# SPDX-License-Identifier: BSD-3-Clause
"""ClashAnalysis: clashes over a trajectory, as an analysis class of MDAnalysis. Importing it needs MDAnalysis."""

import numpy as np
from MDAnalysis.analysis.base import AnalysisBase

from ._checker import Checker
from ._molecule import Molecule

__all__ = ["ClashAnalysis"]


class ClashAnalysis(AnalysisBase):
    """Finds the pairs of atoms that clash in each frame. run(start, stop, step) as of every analysis of MDAnalysis.

    atoms: an AtomGroup or Universe. Its present frame gives the bonds. decimals: round coordinates to so many decimals
    (3 for XTC files; None for DCD files). options: rules and selections of Checker. `checker`, `molecule`: what was
    made of them; molecule.atoms["record"] are indices in the group.

    results.collides: booleans of shape (n_frames,). results.pairs: rows of Checker.pairs(), where `conformation` counts
    the frames of the run and i, j are indices in the group. results.residues: Checker.residue_clashes().
    """

    def __init__(self, atoms, *, decimals=None, verbose=False, **options):
        group = atoms.atoms
        super().__init__(group.universe.trajectory, verbose=verbose)
        self._group = group
        self._decimals = decimals
        self.molecule = Molecule.from_mdanalysis(group)
        self.checker = Checker(self.molecule, "none", **options)
        self._order = self.molecule.atoms["record"]

    def _prepare(self):
        self._found = []

    def _single_frame(self):
        x = self._group.positions[self._order].astype(np.float64)
        found = self.checker.pairs_coordinates(x, decimals=self._decimals)
        found["conformation"] = self._frame_index
        self._found.append(found)

    def _conclude(self):
        pairs = np.concatenate(self._found) if self._found else np.empty(0, self.checker.reference_collisions.dtype)
        self.results.residues = self.checker.residue_clashes(pairs)
        self.results.collides = np.bincount(pairs["conformation"], minlength=self.n_frames) > 0
        pairs["i"], pairs["j"] = self._order[pairs["i"]], self._order[pairs["j"]]
        self.results.pairs = pairs
