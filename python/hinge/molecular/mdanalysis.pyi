# SPDX-License-Identifier: BSD-3-Clause
from typing import Any

from . import Checker, Molecule

__all__ = ["ClashAnalysis"]

class ClashAnalysis:
    molecule: Molecule
    checker: Checker
    results: Any
    def __init__(self, atoms: Any, *, decimals: int | None = None, verbose: bool = False, **options: Any) -> None: ...
    def run(
        self,
        start: int | None = None,
        stop: int | None = None,
        step: int | None = None,
        frames: Any = None,
        verbose: bool | None = None,
    ) -> ClashAnalysis: ...
