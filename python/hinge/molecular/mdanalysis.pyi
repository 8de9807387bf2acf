# SPDX-License-Identifier: BSD-3-Clause
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import Checker, Molecule, _HasAtoms

__all__ = ["ClashAnalysis"]

class _Results(Protocol):
    collides: NDArray[np.bool_]
    pairs: NDArray[np.void]
    residues: NDArray[np.void]

class ClashAnalysis:
    molecule: Molecule
    checker: Checker
    results: _Results
    def __init__(
        self, atoms: _HasAtoms, *, decimals: int | None = None, verbose: bool = False, **options: object
    ) -> None: ...
    def run(
        self,
        start: int | None = None,
        stop: int | None = None,
        step: int | None = None,
        frames: ArrayLike | None = None,
        verbose: bool | None = None,
    ) -> ClashAnalysis: ...
