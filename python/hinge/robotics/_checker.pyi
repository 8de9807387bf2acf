# SPDX-License-Identifier: BSD-3-Clause
import dataclasses
from collections.abc import Iterable, Mapping
from typing import Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import Motion, _Booleans, _Numbers, _One, _Progress, _Several
from ._environment import Environment
from ._matrix import CollisionMatrix
from ._robot import Robot
from ._shapes import Shape

_Against = Literal["all", "self", "environment"]
_Engine = Literal["simd", "lazy", "brute"]
_Tier = Literal["mesh", "hull", "capsule", "spheres"]
_Floats = NDArray[np.float64]
_Rows = NDArray[np.void]
_Names = list[tuple[str, str]]

@dataclasses.dataclass(frozen=True)
class PathAnswer:
    verdict: str
    segment: int
    parameter: float
    half_width: float
    configuration: _Floats | None
    pairs: _Names
    states: int
    @property
    def is_free(self) -> bool: ...

@dataclasses.dataclass(frozen=True)
class Relaxation:
    q: _Floats
    is_free: bool | _Booleans
    distance: float | _Floats
    tries: int | NDArray[np.int64]

class Checker:
    def __init__(
        self,
        robot: Robot,
        *,
        clearance: float = 0.0,
        pair_clearances: Mapping[tuple[str, str], float] | None = None,
        environment: Environment | None = None,
        disable: Iterable[tuple[str, str]] | CollisionMatrix = (),
        tiers: _Tier | Mapping[str, _Tier] | None = None,
        base: ArrayLike | None = None,
        engine: _Engine = "simd",
        threads: int = 1,
    ) -> None: ...
    @property
    def robot(self) -> Robot: ...
    @property
    def environment(self) -> Environment | None: ...
    @environment.setter
    def environment(self, environment: Environment | None) -> None: ...
    @property
    def base(self) -> _Floats: ...
    @base.setter
    def base(self, pose: ArrayLike | None) -> None: ...
    @property
    def names(self) -> NDArray[np.str_]: ...
    @property
    def dof(self) -> int: ...
    @property
    def threads(self) -> int: ...
    @property
    def clearance(self) -> float: ...
    @property
    def engine(self) -> str: ...
    @property
    def tested_pairs(self) -> _Names: ...
    @property
    def open_links(self) -> _Names: ...
    @overload
    def collides(
        self, q: _One, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> bool: ...
    @overload
    def collides(
        self, q: _Several, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.bool_]: ...
    @overload
    def collides(
        self, q: ArrayLike, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> _Booleans: ...
    def colliding_links(self, q: ArrayLike, *, against: _Against = "all") -> _Names: ...
    def named(self, rows: _Rows) -> _Names: ...
    def pairs(
        self,
        q: ArrayLike,
        *,
        within: float = 0.0,
        against: _Against = "all",
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Rows: ...
    def distances(
        self,
        q: ArrayLike,
        *,
        within: float,
        against: _Against = "all",
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Rows: ...
    def clearances(
        self,
        q: ArrayLike,
        *,
        influence: float,
        against: _Against = "all",
        threads: int | None = None,
        progress: _Progress = None,
    ) -> tuple[_Rows, _Floats]: ...
    def closest(
        self, q: ArrayLike, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> _Rows: ...
    @overload
    def distance(
        self, q: _One, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> float: ...
    @overload
    def distance(
        self, q: _Several, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> _Floats: ...
    @overload
    def distance(
        self, q: ArrayLike, *, against: _Against = "all", threads: int | None = None, progress: _Progress = None
    ) -> _Numbers: ...
    def triangle_pairs(self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None) -> _Rows: ...
    def contained(self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None) -> _Rows: ...
    def link_poses(self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None) -> _Floats: ...
    def calibrate(self, q: ArrayLike) -> None: ...
    def relax(
        self,
        q: ArrayLike,
        *,
        tries: int = 20000,
        seed: int = 1,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> Relaxation: ...
    def plan(
        self,
        start: ArrayLike,
        end: ArrayLike,
        *,
        tries: int = 100_000,
        seed: int = 1,
        seconds: float | None = None,
    ) -> Motion: ...
    def certify(
        self,
        a: ArrayLike,
        b: ArrayLike,
        *,
        smallest_step: float = ...,
        resolution: float | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Rows: ...
    def check_path(
        self,
        waypoints: ArrayLike,
        *,
        smallest_step: float = ...,
        resolution: float | None = None,
        progress: _Progress = None,
    ) -> PathAnswer: ...
    def attach(
        self,
        link: str,
        body: str | Shape,
        pose: ArrayLike | None = None,
        *,
        may_touch: str | Iterable[str] | None = None,
        name: str | None = None,
    ) -> str: ...
    def detach(self, body: str, q: ArrayLike | None = None, *, remove: bool = False) -> None: ...
    def allow(self, a: str, b: str) -> None: ...
    @overload
    def collides_with(
        self,
        other: Checker,
        q: _One,
        q_other: _One,
        *,
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
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Rows: ...
    def closest_with(
        self,
        other: Checker,
        q: ArrayLike,
        q_other: ArrayLike,
        *,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Rows: ...
