# SPDX-License-Identifier: BSD-3-Clause
import os
from collections.abc import Sequence
from typing import Any, Literal, Protocol, overload

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
    "Motion",
    "Report",
    "instruction_set",
    "molecular",
    "report",
    "robotics",
]

class Error(Exception): ...
class LoadError(Error): ...
class ModelError(Error, ValueError): ...
class ConfigurationError(Error, ValueError): ...

class _Callback(Protocol):
    def __call__(self, done: int, total: int, /) -> object: ...

class _Bar(Protocol):
    @property
    def n(self) -> float: ...
    def update(self, n: int, /) -> object: ...

_Path = str | os.PathLike[str]
_Progress = _Callback | _Bar | None
# Of an array, a type checker does not know the number of dimensions: the answer is one value for one configuration, and
# an array for several. For lists, it is known.
_One = Sequence[float]
_Several = Sequence[Sequence[float]]
_Booleans = NDArray[np.bool_] | Any
_Numbers = NDArray[np.float64] | Any
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

class Motion:
    waypoints: NDArray[np.float64]
    reached: bool
    length: float
    straight: float
    remaining: float
    opening: float
    motions: int
    stopped: bool
    start_rmsd: float
    end_rmsd: float
    def __init__(
        self,
        waypoints: NDArray[np.float64],
        reached: bool,
        length: float,
        straight: float,
        remaining: float,
        opening: float,
        motions: int,
        stopped: bool,
        start_rmsd: float = 0.0,
        end_rmsd: float = 0.0,
    ) -> None: ...
    def steps(self, step: float) -> NDArray[np.float64]: ...

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
    @overload
    def collides(
        self, q: _One, *, threads: int | None = None, progress: _Progress = None
    ) -> bool: ...
    @overload
    def collides(
        self, q: _Several, *, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.bool_]: ...
    @overload
    def collides(
        self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None
    ) -> _Booleans: ...
    def pairs(
        self, q: ArrayLike, *, within: float = 0.0, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.void]: ...
    def closest(
        self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.void]: ...
    def link_poses(
        self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.float64]: ...
    def certify(
        self,
        a: ArrayLike,
        b: ArrayLike,
        *,
        smallest_step: float = ...,
        resolution: float | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.void]: ...
    @overload
    def collides_with(
        self,
        other: Checker,
        q: _One,
        q_other: _One,
        *,
        exclude: ArrayLike = (),
        admitted: ArrayLike | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> bool: ...
    @overload
    def collides_with(
        self,
        other: Checker,
        q: _Several,
        q_other: _Several,
        *,
        exclude: ArrayLike = (),
        admitted: ArrayLike | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.bool_]: ...
    @overload
    def collides_with(
        self,
        other: Checker,
        q: ArrayLike,
        q_other: ArrayLike,
        *,
        exclude: ArrayLike = (),
        admitted: ArrayLike | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Booleans: ...
    def pairs_with(
        self,
        other: Checker,
        q: ArrayLike,
        q_other: ArrayLike,
        *,
        within: float = 0.0,
        exclude: ArrayLike = (),
        admitted: ArrayLike | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.void]: ...
    def closest_with(
        self,
        other: Checker,
        q: ArrayLike,
        q_other: ArrayLike,
        *,
        exclude: ArrayLike = (),
        admitted: ArrayLike | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.void]: ...
    @property
    def engine(self) -> str: ...
    @property
    def dof(self) -> int: ...
    @property
    def threads(self) -> int: ...
    @property
    def model(self) -> Model: ...
    @property
    def constant_contacts(self) -> NDArray[np.void]: ...

class Report:
    html: str
    def __init__(self, html: str) -> None: ...
    def save(self, file: _Path) -> None: ...

def report(
    checker: molecular.Checker | robotics.Checker,
    q: ArrayLike | Motion | None = None,
    file: _Path | None = None,
    *,
    coordinates: ArrayLike | molecular.Trajectory | None = None,
    within: float = 0.0,
    path: bool = False,
    names: Sequence[str] | None = None,
    title: str | None = None,
    matrix: robotics.CollisionMatrix | None = None,
    threads: int | None = None,
) -> Report: ...
