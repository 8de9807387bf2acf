# SPDX-License-Identifier: BSD-3-Clause
from collections.abc import Sequence
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import molecular as molecular, robotics as robotics

__version__: str
instruction_set: str

__all__ = [
    "Checker",
    "ConfigurationError",
    "Error",
    "LoadError",
    "Model",
    "ModelError",
    "instruction_set",
    "molecular",
    "robotics",
]

class Error(Exception): ...
class LoadError(Error): ...
class ModelError(Error, ValueError): ...
class ConfigurationError(Error, ValueError): ...

class _Callback(Protocol):
    def __call__(self, done: int, total: int, /) -> object: ...

class _Bar(Protocol):
    n: Any
    def update(self, n: int, /) -> object: ...

_Progress = _Callback | _Bar | None
_Joint = Literal["fixed", "revolute", "prismatic"]

class Model:
    def __init__(
        self,
        parents: ArrayLike,
        joints: _Joint | Sequence[_Joint] = "revolute",
        *,
        axes: ArrayLike | None = None,
        points: ArrayLike | None = None,
        origins: ArrayLike | None = None,
        names: Sequence[str] | None = None,
    ) -> None: ...
    def add_points(self, links: ArrayLike, points: ArrayLike) -> NDArray[np.int64]: ...
    def add_spheres(self, links: ArrayLike, centers: ArrayLike, radii: ArrayLike) -> NDArray[np.int64]: ...
    def add_capsules(self, links: ArrayLike, a: ArrayLike, b: ArrayLike, radii: ArrayLike) -> NDArray[np.int64]: ...
    def add_triangles(self, links: ArrayLike, corners: ArrayLike) -> NDArray[np.int64]: ...
    @property
    def n_links(self) -> int: ...
    @property
    def n_primitives(self) -> int: ...
    @property
    def n_joints(self) -> int: ...
    @property
    def kind(self) -> Literal["point", "sphere", "capsule", "triangle"] | None: ...
    @property
    def links(self) -> NDArray[np.int64]: ...
    @property
    def corners(self) -> NDArray[np.float64]: ...
    @property
    def radii(self) -> NDArray[np.float64]: ...

class Checker:
    def __init__(
        self,
        model: Model,
        threshold: ArrayLike = 0.0,
        *,
        types: ArrayLike | None = None,
        exclude: ArrayLike = (),
        groups: ArrayLike | None = None,
        admitted: ArrayLike | None = None,
        free: ArrayLike | None = None,
        engine: Literal["simd", "lazy", "brute"] = "simd",
        threads: int = 1,
    ) -> None: ...
    # bool for one configuration, booleans of shape (n,) for several
    def collides(self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None) -> Any: ...
    def pairs(
        self, q: ArrayLike, *, within: float = 0.0, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.void]: ...
    def closest(
        self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.void]: ...
    def link_poses(
        self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.float64]: ...
    @property
    def dof(self) -> int: ...
    @property
    def threads(self) -> int: ...
    @property
    def model(self) -> Model: ...
    @property
    def constant_contacts(self) -> NDArray[np.void]: ...
