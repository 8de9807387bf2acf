# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from .. import _Progress
from ._robot import Robot

_Rows = NDArray[np.void]
_Names = list[tuple[str, str]]

class CollisionMatrix:
    def __init__(
        self,
        robot: Robot,
        *,
        samples: int = 100_000,
        seed: int = 1,
        cells: int = 20_000,
        clearance: float = 0.0,
        settled: Iterable[tuple[str, str]] = (),
        progress: _Progress = None,
    ) -> None: ...
    @property
    def robot(self) -> Robot: ...
    @property
    def entries(self) -> _Rows: ...
    def disabled_pairs(self, *, disable_unseen: bool = False) -> _Names: ...
    def srdf(self, *, disable_unseen: bool = False) -> str: ...
