# SPDX-License-Identifier: BSD-3-Clause
import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _Progress
from ._description import Joint, Link

_Path = str | os.PathLike[str]
_Primitives = Literal["exact", "reference"]
_Tier = Literal["mesh", "hull", "capsule", "spheres"]
_Floats = NDArray[np.float64]
_Rows = NDArray[np.void]
_Names = list[tuple[str, str]]

class Robot:
    def __init__(
        self,
        links: Iterable[Link | str],
        joints: Iterable[Joint] = (),
        *,
        name: str = "",
        primitives: _Primitives = "exact",
        tolerance: float = 1e-3,
        solid: bool = False,
    ) -> None: ...
    @classmethod
    def from_urdf(
        cls,
        urdf: _Path | bytes,
        *,
        srdf: _Path | bytes | None = None,
        package_path: _Path | Sequence[_Path] = (),
        missing_meshes: Literal["refuse", "skip"] = "refuse",
        primitives: _Primitives = "exact",
        tolerance: float = 1e-3,
        solid: bool = False,
        unknown_links: Literal["refuse", "note"] = "refuse",
        folder: _Path = ".",
    ) -> Robot: ...
    def with_tiers(
        self,
        tier: _Tier = "mesh",
        *,
        links: Mapping[str, _Tier] | None = None,
        most_spheres: int = 32,
        tolerance: float = 1e-3,
    ) -> Robot: ...
    @property
    def name(self) -> str: ...
    @property
    def dof(self) -> int: ...
    @property
    def links(self) -> _Rows: ...
    @property
    def link_names(self) -> list[str]: ...
    @property
    def joints(self) -> _Rows: ...
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def movable_joints(self) -> list[str]: ...
    @property
    def lower(self) -> _Floats: ...
    @property
    def upper(self) -> _Floats: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def groups(self) -> dict[str, list[str]]: ...
    @property
    def states(self) -> dict[str, _Floats]: ...
    def state(self, *names: str) -> _Floats: ...
    @property
    def disabled_pairs(self) -> _Names: ...
    @property
    def floating_base(self) -> str: ...
    @property
    def incomplete_links(self) -> list[str]: ...
    @property
    def has_only_spheres(self) -> bool: ...
    @property
    def spheres(self) -> _Rows: ...
    def surface(self, link: str) -> _Floats: ...
    def sample(self, n: int, seed: int = 1, *, first: int = 0, progress: _Progress = None) -> _Floats: ...
    def expand(self, q: ArrayLike) -> _Floats: ...
    def columns(self, names: Iterable[str]) -> NDArray[np.intp]: ...
    def from_columns(self, q: ArrayLike, names: Iterable[str], sizes: Iterable[int] | None = None) -> _Floats: ...
    def to_columns(self, q: ArrayLike, names: Iterable[str]) -> _Floats: ...
