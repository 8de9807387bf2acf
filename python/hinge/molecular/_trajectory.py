# SPDX-License-Identifier: BSD-3-Clause
"""Trajectory: frames of a file, one at a time or as an array."""

import os

import numpy as np

from .._core import molecular as _core
from ._molecule import Molecule


class Trajectory(_core.TrajectoryBase):
    """The conformations of a molecule in a file: DCD, XTC, NumPy, PDB, mmCIF or PQR, plain or gzipped.

    molecule: a Molecule. path: the file; its content decides the format, but PQR is known by its name. may_have_more:
    PDB and mmCIF models may have further atoms, which are left out. Frames are read when they are asked for, in the
    molecule's atoms and order.
    Iterating gives arrays of shape (n_atoms, 3), angstrom; indices and slices work as for a list. Pass a trajectory to
    Checker.collides_coordinates() and its relatives to check it in bounded memory. Raises LoadError.
    """

    def __init__(self, molecule, path, *, may_have_more=False):
        if not isinstance(molecule, Molecule):
            raise TypeError(f"molecule: a {type(molecule).__name__}, expected a Molecule")
        self._arguments = (molecule, os.path.abspath(os.fspath(path)), bool(may_have_more))
        super().__init__(*self._arguments)

    def read(self, start=None, stop=None, step=None, *, threads=1, progress=None):
        """Return frames start, start + step, ... before stop: shape (n, n_atoms, 3), angstrom."""
        frames = range(*slice(start, stop, step).indices(len(self)))
        if frames.step < 0:
            raise ValueError(f"step: {step}, expected at least 1")
        if threads < 1:
            raise ValueError(f"threads: {threads}, expected at least 1")
        return self._read(frames.start, frames.step, len(frames), threads, progress)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return self.read(k.start, k.stop, k.step)
        count = len(self)
        frame = k + count if k < 0 else k
        if not 0 <= frame < count:
            raise IndexError(f"frame {k}, expected {-count} to {count - 1}")
        return self._read(frame, 1, 1, 1, None)[0]

    def __iter__(self):
        for k in range(len(self)):
            yield self[k]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __reduce__(self):
        return _rebuild, (type(self), *self._arguments)

    def __repr__(self):
        frames = "closed" if self.closed else f"{len(self)} frames"
        return f"<Trajectory {os.path.basename(self.path)!r}: {frames} of {self._arguments[0].n_atoms} atoms>"


def _rebuild(cls, molecule, path, may_have_more):
    return cls(molecule, path, may_have_more=may_have_more)
