# SPDX-License-Identifier: BSD-3-Clause
"""What hinge.report() shows of a molecule."""

import numpy as np

from .._report import counted, packed
from ._trajectory import Trajectory

_MOST_ATOMS = 20_000  # more are slow to draw
_MOST_ROWS = 1000  # pairs of one conformation
_AMINO_ACID, _NUCLEOTIDE, _OTHER = 0, 1, 3  # residue kinds of the compiled part


class MoleculePage:
    """The data of docs/reference/report.md."""

    kind = "molecule"
    frame_word = "conformation"
    length_unit = "Å"

    def __init__(self, checker, q, coordinates, within, threads):
        self._checker, self._within, self._threads = checker, within, threads
        self._molecule = checker.molecule
        self.title = self._molecule.name
        self._q, self._x = q, coordinates
        if coordinates is not None and not isinstance(coordinates, Trajectory):
            self._x = np.asarray(coordinates, np.float64)
            self._x = self._x[None] if self._x.ndim == 2 else self._x
        self.count = len(q if coordinates is None else self._x)

    def _pairs(self, first, last, within):
        if self._x is None:
            return self._checker.pairs(self._q[first:last], within=within, threads=self._threads)
        return self._checker.pairs_coordinates(self._positions(first, last), within=within, threads=self._threads)

    def _positions(self, first, last):
        if self._x is None:
            return self._checker.positions(self._q[first:last], threads=self._threads)
        return self._x.read(first, last) if isinstance(self._x, Trajectory) else self._x[first:last]

    def count_pairs(self, first, last):
        """Number of colliding pairs of each conformation, shape (last - first,)."""
        return np.bincount(self._pairs(first, last, 0.0)["conformation"], minlength=last - first)

    def question(self):
        """What was asked, in words."""
        checker, molecule = self._checker, self._molecule
        radii = f"{checker.radii} radii"
        rule = f"d < {checker.rho} * ({radii})" if checker.rho else f"{checker.rules} ({radii})"
        rule += f", pairs at least {counted(checker.min_bonds, 'bond')} apart"
        rule += f", hydrogen-bond rule {'on' if checker.hydrogen_bonds else 'off'}"
        if checker.options["exempt_reference"]:
            rule += ", reference collisions exempt"
        free = checker.options["free"]
        free = free if isinstance(free, str) else f"{len(free)} chosen"
        words = [
            (
                "Molecule",
                f"{counted(molecule.n_atoms, 'atom')}, {counted(molecule.n_residues, 'residue')}, "
                f"{counted(molecule.n_chains, 'chain')}, {counted(len(molecule.bonds), 'bond')}",
            ),
            ("Free", f"{free}: {checker.dof} DOF, {counted(checker.n_rigid_groups, 'rigid group')}"),
            ("A pair collides if", rule),
            ("In the file", _collide(len(checker.reference_collisions))),
        ]
        constant = len(checker.constant_contacts)
        if constant and self._x is None:
            text = f"{_collide(constant)} whatever the free torsions are; the table does not list them"
            words.append(("Constant contacts", text))
        return words

    def files(self):
        """Paths of the inputs."""
        sources = [self._molecule.source]
        if isinstance(self._x, Trajectory):
            sources.append(self._x.path)
        return [source for source in sources if isinstance(source, str)]

    def notes(self):
        """One sentence each."""
        return list(dict.fromkeys([*self._molecule.notes, *self._checker.notes]))

    def data(self, shown, names):
        """The members frames and molecule."""
        frames = [(self._positions(k, k + 1)[0], self._pairs(k, k + 1, self._within)) for k in shown]
        atoms, residues = self._molecule.atoms, self._molecule.atoms["residue"]
        subset, cut = self._subset([pairs for _, pairs in frames])
        place = np.full(len(atoms), -1)
        place[subset] = np.arange(len(subset))
        low = np.min([x[subset].min(axis=0) for x, _ in frames], axis=0)
        high = np.max([x[subset].max(axis=0) for x, _ in frames], axis=0)
        origin, unit = 0.5 * (low + high), max(0.01, 0.5 * float((high - low).max()) / 32767)
        bonds = place[np.stack([self._molecule.bonds["i"], self._molecule.bonds["j"]], axis=1)]
        first_atoms = np.unique(residues, return_index=True)[1]
        kinds = self._molecule._residue_kinds()
        molecule = {
            "residues": [
                [
                    str(atoms["chain"][a]) or "_",
                    str(atoms["residue_name"][a]),
                    f"{atoms['residue_number'][a]}{atoms['insertion_code'][a]}",
                    int(kinds[residues[a]] == _OTHER),
                ]
                for a in first_atoms
            ],
            "atoms": {
                "names": atoms["name"][subset].tolist(),
                "elements": atoms["element"][subset].tolist(),
                "residues": packed(residues[subset], "u4"),
            },
            "bonds": packed(bonds[(bonds >= 0).all(axis=1)], "u4"),
            "moving": packed(self._checker.rigid_groups[subset] != 0, "u1"),
            "origin": origin.tolist(),
            "unit": unit,
            "cut": cut,
        }
        out = []
        for k, name, (x, pairs) in zip(shown, names, frames):
            steps = (x[subset] - origin) / unit
            rows = self._rows(pairs, place)
            out.append(
                {
                    "index": k,
                    "name": name,
                    "collides": bool(pairs["collides"].any()),
                    "coordinates": packed(np.copysign(np.floor(np.abs(steps) + 0.5), steps), "i2"),
                    "values": None,
                    "pairs": rows,
                    "pairs_left_out": len(pairs) - len(rows),
                }
            )
        return {"frames": out, "molecule": molecule}

    def _rows(self, pairs, place):
        """Rows of the table, the most severe first."""
        pairs = pairs[(place[pairs["i"]] >= 0) & (place[pairs["j"]] >= 0)]
        pairs = pairs[np.argsort(pairs["distance"] - pairs["threshold"], kind="stable")][:_MOST_ROWS]
        overlaps = self._checker.overlaps(np.ascontiguousarray(pairs))
        return [
            [int(i), int(j), round(float(d), 3), round(float(m), 3), int(collides), round(float(overlap), 3)]
            for i, j, d, m, collides, overlap in zip(
                place[pairs["i"]], place[pairs["j"]], pairs["distance"], pairs["threshold"], pairs["collides"], overlaps
            )
        ]

    def _subset(self, pairs_of_frames):
        """Indices of the atoms to show, and a sentence about those that are left out."""
        atoms = self._molecule.atoms
        if len(atoms) <= _MOST_ATOMS:
            return np.arange(len(atoms)), None
        kinds = self._molecule._residue_kinds()[atoms["residue"]]
        names = atoms["name"]
        trace = ((kinds == _AMINO_ACID) & (names == "CA")) | ((kinds == _NUCLEOTIDE) & (names == "P"))
        stride = int(trace.sum()) // (_MOST_ATOMS // 2) + 1  # half of the atoms go to residues with collisions
        shown = np.zeros(len(atoms), bool)
        shown[np.flatnonzero(trace)[::stride]] = True
        residues = atoms["residue"]  # ascending
        ends = np.searchsorted(residues, np.arange(self._molecule.n_residues + 1))
        count = int(shown.sum())
        for i, j in (pair for pairs in pairs_of_frames for pair in zip(pairs["i"], pairs["j"])):
            if count >= _MOST_ATOMS:
                break
            for residue in residues[[i, j]]:
                whole = shown[ends[residue] : ends[residue + 1]]
                count += int((~whole).sum())
                whole[:] = True
        every = "every" if stride == 1 else f"one in {stride}"
        sentence = (
            f"{count} of {counted(len(atoms), 'atom')} are shown: {every} CA and P atom, and residues with "
            "colliding pairs"
        )
        return np.flatnonzero(shown), sentence


def _collide(count):
    return f"{count} pair collides" if count == 1 else f"{count} pairs collide"
