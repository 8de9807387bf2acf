# SPDX-License-Identifier: BSD-3-Clause
import os
from collections.abc import Iterator, Sequence
from typing import Literal, Protocol, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import LoadError, Motion, _Booleans, _One, _Progress, _Several

__all__ = [
    "Checker",
    "CoordinateFit",
    "Molecule",
    "OtherAtoms",
    "Relaxation",
    "RigidGroups",
    "Trajectory",
    "Walk",
    "find_rigid_groups",
    "installed_dictionary",
    "pair_dtype",
    "superpose",
]

_Path = str | os.PathLike[str]
_Source = _Path | bytes
_Part = str | NDArray[np.bool_]
_Placed = _Part | tuple[_Part] | tuple[_Part, float] | tuple[_Part, float, float]
_Between = tuple[_Part, _Part]
_Coordinates = Sequence[Sequence[float]]

class _GemmiStructure(Protocol):
    def make_mmcif_document(self) -> object: ...

class _HasAtoms(Protocol):
    @property
    def atoms(self) -> object: ...

pair_dtype: np.dtype[np.void]

class OtherAtoms(LoadError): ...

class Molecule:
    def __init__(
        self,
        source: _Source,
        *,
        with_files: _Source | Sequence[_Source] = (),
        hydrogens: Literal["keep", "drop"] = "keep",
        model: int | None = None,
        altloc: str | None = None,
        hetero: bool | Literal["none", "ligands", "waters"] = "none",
        bonds: Literal["geometry", "recorded"] = "geometry",
        components: _Path | Sequence[_Path] = (),
        dictionary: _Path | None = "installed",
        loops: str = "",
        keep_hydrogen_bonds: bool = False,
        place: _Part | Sequence[_Placed] = (),
        held: ArrayLike | None = None,
    ) -> None: ...
    @classmethod
    def from_gemmi(cls, structure: _GemmiStructure, **options: object) -> Molecule: ...
    @classmethod
    def from_mdanalysis(cls, atoms: _HasAtoms, **options: object) -> Molecule: ...
    @property
    def source(self) -> str | bytes: ...
    @property
    def options(self) -> dict[str, object]: ...
    @property
    def name(self) -> str: ...
    @property
    def n_atoms(self) -> int: ...
    @property
    def n_residues(self) -> int: ...
    @property
    def n_chains(self) -> int: ...
    @property
    def n_models(self) -> int: ...
    @property
    def n_closures(self) -> int: ...
    @property
    def n_placed(self) -> int: ...
    @property
    def has_loops(self) -> bool: ...
    @property
    def model_numbers(self) -> NDArray[np.int32]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def atoms(self) -> NDArray[np.void]: ...
    @property
    def bonds(self) -> NDArray[np.void]: ...
    @property
    def torsions(self) -> NDArray[np.void]: ...
    @property
    def coordinates(self) -> NDArray[np.float64]: ...
    @property
    def models(self) -> NDArray[np.float64]: ...
    def model(self, k: int) -> NDArray[np.float64]: ...
    def label(self, atom: int) -> str: ...
    def bond_distance(self, i: int, j: int, limit: int = 16) -> int: ...
    def select(self, free: str | ArrayLike, *, omega: bool = False) -> NDArray[np.int64]: ...
    def select_atoms(self, part: str) -> NDArray[np.bool_]: ...

class Walk:
    configurations: NDArray[np.float64]
    end: NDArray[np.float64]
    steps: int
    accepted: int
    unclosed: int
    def __init__(
        self, configurations: NDArray[np.float64], end: NDArray[np.float64], steps: int, accepted: int, unclosed: int
    ) -> None: ...

class Relaxation:
    q: NDArray[np.float64]
    collisions_before: int | NDArray[np.int64]
    collisions: int | NDArray[np.int64]
    energy_before: float | NDArray[np.float64]
    energy: float | NDArray[np.float64]
    restarts: int | NDArray[np.int64]
    def __init__(
        self,
        q: NDArray[np.float64],
        collisions_before: int | NDArray[np.int64],
        collisions: int | NDArray[np.int64],
        energy_before: float | NDArray[np.float64],
        energy: float | NDArray[np.float64],
        restarts: int | NDArray[np.int64],
    ) -> None: ...

class CoordinateFit:
    q: NDArray[np.float64]
    rmsd: float
    farthest: float
    atom: int
    atoms: NDArray[np.int64]
    x: NDArray[np.float64]
    collisions: int
    stopped: bool
    def __init__(
        self,
        q: NDArray[np.float64],
        rmsd: float,
        farthest: float,
        atom: int,
        atoms: NDArray[np.int64],
        x: NDArray[np.float64],
        collisions: int,
        stopped: bool,
    ) -> None: ...

class Trajectory:
    def __init__(self, molecule: Molecule, path: _Path, *, may_have_more: bool = False) -> None: ...
    @property
    def path(self) -> str: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def closed(self) -> bool: ...
    def number(self, k: int) -> int: ...
    def read(
        self,
        start: int | None = None,
        stop: int | None = None,
        step: int | None = None,
        *,
        threads: int = 1,
        progress: _Progress = None,
    ) -> NDArray[np.float64]: ...
    def close(self) -> None: ...
    def __len__(self) -> int: ...
    def __getitem__(self, k: int | slice) -> NDArray[np.float64]: ...
    def __iter__(self) -> Iterator[NDArray[np.float64]]: ...
    def __enter__(self) -> Trajectory: ...
    def __exit__(self, *_: object) -> None: ...

class Checker:
    def __init__(
        self,
        molecule: Molecule,
        free: str | ArrayLike | None = None,
        *,
        omega: bool = False,
        rules: Literal["auto", "biocd", "severe", "molprobity", "chimerax", "posebusters"] = "auto",
        radii: Literal["bondi", "probe", "probe-united", "amber"] | None = None,
        rho: float | None = None,
        min_bonds: int | None = None,
        hydrogen_bonds: bool | None = None,
        hydrogen_bond_allowance: float | None = None,
        exempt_reference: bool = False,
        exempt_interfaces: bool = False,
        between: _Between | Sequence[_Between] = (),
        inside: _Part | Sequence[_Part] = (),
        engine: Literal["simd", "lazy", "brute"] = "simd",
        closures: Literal["keep", "open"] = "keep",
        open_closures: Sequence[int] = (),
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
    def closest(self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None) -> NDArray[np.void]: ...
    def positions(
        self, q: ArrayLike, *, out: NDArray[np.float64] | None = None, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.float64]: ...
    def closure_residuals(
        self, q: ArrayLike, *, threads: int | None = None, progress: _Progress = None
    ) -> NDArray[np.float64]: ...
    @overload
    def collides_coordinates(
        self,
        x: _Coordinates,
        *,
        decimals: int | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> bool: ...
    @overload
    def collides_coordinates(
        self,
        x: Trajectory | Sequence[_Coordinates],
        *,
        decimals: int | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.bool_]: ...
    @overload
    def collides_coordinates(
        self,
        x: ArrayLike | Trajectory,
        *,
        decimals: int | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> _Booleans: ...
    def pairs_coordinates(
        self,
        x: ArrayLike | Trajectory,
        *,
        within: float = 0.0,
        decimals: int | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.void]: ...
    def closest_coordinates(
        self,
        x: ArrayLike | Trajectory,
        *,
        decimals: int | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.void]: ...
    def overlaps(self, pairs: NDArray[np.void]) -> NDArray[np.float64]: ...
    def residue_clashes(self, pairs: NDArray[np.void]) -> NDArray[np.void]: ...
    def sample(
        self,
        n: int,
        seed: int = 1,
        sigma: float | None = None,
        *,
        first: int = 0,
        collision_free: bool = False,
        prior: str | None = None,
        tries: int | None = None,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> NDArray[np.float64]: ...
    def unclosable(self, seed: int = 1, sigma: float | None = None) -> NDArray[np.int64]: ...
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
    def walk(
        self,
        steps: int,
        *,
        step_size: float = ...,
        changes: int = 1,
        seed: int = 1,
        every: int = 100,
        start: ArrayLike | None = None,
        progress: _Progress = None,
    ) -> Walk: ...
    def steric(
        self, q: ArrayLike, softness: float = 0.0, *, threads: int | None = None, progress: _Progress = None
    ) -> tuple[float, NDArray[np.float64]] | tuple[NDArray[np.float64], NDArray[np.float64]]: ...
    def relax(
        self,
        q: ArrayLike | None = None,
        *,
        tries: int = 1000,
        seed: int = 1,
        threads: int | None = None,
        progress: _Progress = None,
    ) -> Relaxation: ...
    def plan(
        self,
        start: ArrayLike | CoordinateFit | None,
        end: ArrayLike | CoordinateFit | None,
        *,
        tries: int = 100_000,
        seed: int = 1,
        seconds: float | None = None,
    ) -> Motion: ...
    def fit_coordinates(
        self,
        x: ArrayLike | Molecule,
        *,
        atoms: ArrayLike | None = None,
        collision_free: bool = False,
        seconds: float | None = None,
    ) -> CoordinateFit: ...
    def fit(self, x: ArrayLike | Trajectory, *, progress: _Progress = None) -> NDArray[np.float64]: ...
    @property
    def molecule(self) -> Molecule: ...
    @property
    def options(self) -> dict[str, object]: ...
    @property
    def dof(self) -> int: ...
    @property
    def dof_labels(self) -> list[str]: ...
    @property
    def threads(self) -> int: ...
    @property
    def torsion_of_dof(self) -> NDArray[np.int64]: ...
    @property
    def rigid_groups(self) -> NDArray[np.uint32]: ...
    @property
    def n_rigid_groups(self) -> int: ...
    @property
    def reference_collisions(self) -> NDArray[np.void]: ...
    @property
    def constant_contacts(self) -> NDArray[np.void]: ...
    @property
    def types(self) -> NDArray[np.uint16]: ...
    @property
    def threshold_table(self) -> NDArray[np.float64]: ...
    @property
    def type_names(self) -> list[str]: ...
    @property
    def excluded_pairs(self) -> NDArray[np.uint32]: ...
    @property
    def rules(self) -> str: ...
    @property
    def radii(self) -> str: ...
    @property
    def rho(self) -> float | None: ...
    @property
    def min_bonds(self) -> int: ...
    @property
    def hydrogen_bonds(self) -> bool: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def kept_closures(self) -> NDArray[np.int64]: ...
    @property
    def held_torsions(self) -> NDArray[np.int64]: ...

class RigidGroups:
    group_of_atom: NDArray[np.int64]
    segments: list[list[NDArray[np.uint32]]]
    spreads: NDArray[np.float64]
    torsions: NDArray[np.int64]
    torsion_spreads: NDArray[np.float64]
    held: NDArray[np.uint32]
    def __init__(
        self,
        group_of_atom: NDArray[np.int64],
        segments: list[list[NDArray[np.uint32]]],
        spreads: NDArray[np.float64],
        torsions: NDArray[np.int64],
        torsion_spreads: NDArray[np.float64],
        held: NDArray[np.uint32],
    ) -> None: ...

def find_rigid_groups(
    molecule: Molecule,
    x: ArrayLike | Trajectory,
    *,
    tolerance: float = 0.5,
    free: str | ArrayLike = "all",
    omega: bool = False,
    progress: _Progress = None,
) -> RigidGroups: ...
def installed_dictionary() -> str: ...
def superpose(moved: ArrayLike, onto: ArrayLike) -> tuple[float, float, int]: ...
