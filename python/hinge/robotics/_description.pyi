# SPDX-License-Identifier: BSD-3-Clause
import dataclasses
from collections.abc import Sequence
from typing import Literal

from numpy.typing import ArrayLike

from ._shapes import Shape

_PlacedShape = Shape | tuple[Shape, ArrayLike | None]

@dataclasses.dataclass(frozen=True)
class Link:
    name: str
    shapes: Shape | Sequence[_PlacedShape] = ()

@dataclasses.dataclass(frozen=True)
class Mimic:
    joint: str
    multiplier: float = 1.0
    offset: float = 0.0

@dataclasses.dataclass(frozen=True, eq=False)
class Joint:
    name: str
    type: Literal["fixed", "revolute", "continuous", "prismatic"]
    parent: str
    child: str
    origin: ArrayLike | None = None
    axis: ArrayLike = ...
    lower: float = 0.0
    upper: float = 0.0
    mimic: Mimic | None = None

def link_data(link: Link | str) -> tuple[str, list[object]]: ...
def joint_data(joint: Joint) -> tuple[object, ...]: ...
