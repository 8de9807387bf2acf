# SPDX-License-Identifier: BSD-3-Clause
"""Checker: clash rules and free torsions of a molecule, and what is asked about conformations."""

import dataclasses
import operator
import warnings

import numpy as np

from .. import ModelError
from .._core import molecular as _core
from .._paths import named_verdicts, path_options
from .._planning import Motion, seconds_of
from ._molecule import Molecule, one_of, residues_of


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Walk:
    """The result of Checker.walk().

    configurations: the states after every `every`-th step, shape (n, dof), rad. end: the last state, shape (dof,).
    steps, accepted: numbers of moves. unclosed: moves rejected because the cycles did not close.
    """

    configurations: np.ndarray
    end: np.ndarray
    steps: int
    accepted: int
    unclosed: int

    def __repr__(self):
        return f"<Walk: accepted: {self.accepted} of {self.steps}, configurations: {len(self.configurations)}>"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Relaxation:
    """The result of Checker.relax(), for one configuration or for n of them (arrays of shape (n,)).

    q: the relaxed configurations, shape as given. collisions_before, collisions: numbers of pairs that collide at the
    start and at q. energy_before, energy: steric(..., 0) there, square angstrom. restarts: random restarts that were
    made.
    """

    q: np.ndarray
    collisions_before: "int | np.ndarray"
    collisions: "int | np.ndarray"
    energy_before: "float | np.ndarray"
    energy: "float | np.ndarray"
    restarts: "int | np.ndarray"

    def __repr__(self):
        if self.q.ndim == 1:
            return f"<Relaxation: collisions: {self.collisions_before} before, {self.collisions} left>"
        return f"<Relaxation: free: {np.count_nonzero(self.collisions == 0)} of {len(self.q)}>"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class CoordinateFit:
    """The result of Checker.fit_coordinates().

    q: the configuration, shape (dof,), rad and angstrom. rmsd: root mean square distance of the matched atoms from the
    given coordinates after superposition, angstrom. farthest: the largest distance, angstrom. atom: index of the atom
    that has it. atoms: indices of the matched atoms, shape (n,). x: their given coordinates, shape (n, 3), angstrom.
    collisions: pairs that collide at q. stopped: the time passed.
    """

    q: np.ndarray
    rmsd: float
    farthest: float
    atom: int
    atoms: np.ndarray
    x: np.ndarray
    collisions: int
    stopped: bool

    def __repr__(self):
        return f"<CoordinateFit: rmsd: {self.rmsd:.4g} A, atoms: {len(self.atoms)}, collisions: {self.collisions}>"


def _integer(name, value, least):
    """An integer of 64 bits, at least `least`."""
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: a {type(value).__name__}, expected an integer") from None
    if not least <= number < 2**64:
        raise ValueError(f"{name}: {number}, expected {least} to 2**64 - 1")
    return number


def _number(name, value):
    """A float."""
    if isinstance(value, (str, bytes)) or not hasattr(value, "__float__"):
        raise TypeError(f"{name}: a {type(value).__name__}, expected a number")
    return float(value)


class Checker(_core.CheckerBase):
    """Tests conformations of one molecule. Any number of threads may use it at the same time.

    molecule: a Molecule. free: what Molecule.select() takes; None: 'all', or 'none' (the loops alone) with loops.
    omega: free omega, too.
    rules: 'biocd' (set by the next five), 'severe', 'molprobity', 'chimerax', 'posebusters', or 'auto': 'severe' for a
    molecule with hydrogens if none of the five is given, otherwise 'biocd'.
    radii: 'bondi', 'probe', 'probe-united' or 'amber'. rho: threshold / sum of radii (0.8). min_bonds: number of bonds
    from which a pair counts (4). hydrogen_bonds: use the hydrogen-bond rule; None: if there are hydrogens.
    hydrogen_bond_allowance: angstrom (0.4).
    exempt_reference: leave out pairs that collide in model 0, except interfaces: pairs of two files, or of a placed
    part and the rest. exempt_interfaces: leave out these, too.
    between: pairs of parts; inside: parts. If any are given, only pairs of atoms between or inside them are tested. A
    part is words, booleans of shape (n_atoms,), or (in between) 'rest', the other atoms.
    engine: 'simd', 'lazy' (the paper's) or 'brute'; all give the same answers.
    closures: 'keep': samples and walks close cycles, such as those of disulphides, and torsions that cannot move are
    not free; 'open': only loops stay closed. open_closures: indices of closures that stay open all the same.
    threads: default of every call. Answers do not depend on it.

    Raises ModelError for unknown rules and words, ValueError and TypeError for other bad arguments. The defaults are
    those of `biocd sample`. Pickling stores the molecule's source and the options.
    """

    def __init__(
        self,
        molecule,
        free=None,
        *,
        omega=False,
        rules="auto",
        radii=None,
        rho=None,
        min_bonds=None,
        hydrogen_bonds=None,
        hydrogen_bond_allowance=None,
        exempt_reference=False,
        exempt_interfaces=False,
        between=(),
        inside=(),
        engine="simd",
        closures="keep",
        open_closures=(),
        threads=1,
    ):
        if not isinstance(molecule, Molecule):
            raise TypeError(f"molecule: a {type(molecule).__name__}, expected a Molecule")
        if exempt_interfaces and not exempt_reference:
            raise ValueError("exempt_interfaces: True without exempt_reference, expected both")
        if isinstance(inside, (str, np.ndarray)):
            inside = (inside,)
        if isinstance(between, tuple) and len(between) == 2 and not any(isinstance(b, (tuple, list)) for b in between):
            between = (between,)
        between = [tuple(pair) for pair in between]
        if any(len(pair) != 2 for pair in between):
            raise ValueError("between: expected pairs of parts, such as [('A', 'rest')]")
        if free is None:
            free = "none" if molecule.has_loops else "all"
        self._molecule = molecule
        self._free = free if isinstance(free, str) else np.array(free)
        self._options = {
            "omega": omega,
            "rules": rules,
            "radii": radii,
            "rho": rho,
            "min_bonds": min_bonds,
            "hydrogen_bonds": hydrogen_bonds,
            "hydrogen_bond_allowance": hydrogen_bond_allowance,
            "exempt_reference": exempt_reference,
            "exempt_interfaces": exempt_interfaces,
            "between": tuple(between),
            "inside": tuple(inside),
            "engine": engine,
            "closures": one_of("closures", closures, ("keep", "open")),
            "open_closures": tuple(int(k) for k in open_closures),
            "threads": threads,
        }
        atoms = molecule.atoms["residue"] if between or inside else None
        super().__init__(
            molecule,
            molecule.select(free, omega=omega),
            rules,
            radii,
            rho,
            hydrogen_bonds,
            hydrogen_bond_allowance,
            min_bonds,
            bool(exempt_reference),
            bool(exempt_interfaces),
            [tuple(residues_of(part, atoms, "between") for part in pair) for pair in between],
            [residues_of(part, atoms, "inside") for part in inside],
            engine,
            closures,
            [int(k) for k in open_closures],
            threads,
        )
        self._closing = set()

    @property
    def molecule(self):
        """The Molecule that is tested."""
        return self._molecule

    @property
    def options(self):
        """The options of the constructor, as a dict."""
        return {"free": self._free, **self._options}

    @property
    def dof_labels(self):
        """Names of the degrees of freedom: a list of dof words such as 'A:LYS6:chi1' or 'place 0:x'."""
        labels = self._molecule.torsions["label"]
        values = ("x", "y", "z", "rx", "ry", "rz")
        placed = iter(f"place {k}:{c}" for k in range(self._molecule.n_placed) for c in values)
        return [str(labels[t]) if t >= 0 else next(placed) for t in self.torsion_of_dof]

    def sample(
        self,
        n,
        seed=1,
        sigma=None,
        *,
        first=0,
        collision_free=False,
        prior=None,
        tries=None,
        threads=None,
        progress=None,
    ):
        """Return random configurations, shape (n, dof), rad and angstrom: those that `biocd sample` draws.

        seed: configuration k depends on (seed, first + k) alone. sigma: standard deviation about the reference, rad
        (sigma = numpy.radians(5) is --sigma 5); None: uniform over the full turn. first: index of the first one.
        collision_free: only configurations that do not collide; each one is grown residue by residue. prior, with
        collision_free: 'ramachandran' draws proteins by statistics of phi and psi and by rotamers of side chains,
        'uniform' over the full turn; None: 'ramachandran' without sigma. Free the side chains of a loop, too:
        Checker(m, '(A:8-14) and chi').
        tries: starts of a sample with closures to keep (None: 100) or with collision_free (None: 1000). A sample for
        which none succeeds is left out, with a warning.
        Raises ModelError if random starts do not close some cycles (see unclosable()).
        """
        n, first = _integer("n", n, 0), _integer("first", first, 0)
        seed = _integer("seed", seed, 0)
        tries = (1000 if collision_free else 100) if tries is None else _integer("tries", tries, 1)
        if prior not in (None, "ramachandran", "uniform"):
            raise ValueError(f"prior: {prior!r}, expected 'ramachandran', 'uniform' or None")
        if prior is not None and (not collision_free or sigma is not None):
            raise ValueError(f"prior: {prior!r}, expected None without collision_free=True, and with sigma")
        sigma = None if sigma is None else _number("sigma", sigma)
        if self.kept_closures.size and (seed, sigma) not in self._closing:
            open_closures = self.unclosable(seed, sigma)
            if open_closures.size:
                given = sorted({*self._options["open_closures"], *map(int, open_closures)})
                raise ModelError(
                    f"sample: random starts do not close {open_closures.size} of the cycles; leave them open: "
                    f"Checker(..., open_closures={given})"
                )
            self._closing.add((seed, sigma))
        statistics = sigma is None and prior != "uniform"
        q, found, _, _ = self._sample(
            n, seed, sigma, first, bool(collision_free), statistics, tries, threads, progress
        )
        if len(q) < n:
            what = "gave a conformation without a collision" if collision_free else "closed"
            warnings.warn(
                f"{n - len(q)} of {n} samples are missing: none of {tries} starts {what}; the first is "
                f"{first + int(np.flatnonzero(~found)[0])}",
                stacklevel=2,
            )
        return q

    def certify(self, a, b, *, smallest_step=2.0**-20, resolution=None, threads=None, progress=None):
        """Prove whether straight paths from a to b are free of collisions.

        a, b: shape (n, dof), or (dof,) for one start or end of all. smallest_step: share of the path below which it is
        not divided. resolution: instead of a proof, test states at most so far apart (rad or angstrom).
        Returns a structured array of shape (n,): verdict ('free', 'colliding', 'undecided'), parameter (of the
        collision or undecided segment, 0 to 1), half_width (of that segment), i, j (its atoms; -1: none known),
        distance, threshold (angstrom), states (number of configurations computed).
        """
        smallest_step, resolution = path_options(smallest_step, resolution)
        return named_verdicts(self._certify(a, b, smallest_step, resolution, threads, progress))

    def walk(self, steps, *, step_size=np.radians(3.0), changes=1, seed=1, every=100, start=None, progress=None):
        """Make a Monte Carlo walk of collision-free moves, the same as `biocd walk`. Returns a Walk.

        step_size: standard deviation of a torsion's change, rad. changes: torsions per move. every: steps from one
        returned configuration to the next. start: shape (dof,); None: the reference. seed: of the random moves.
        Raises ModelError if the start collides.
        """
        steps, changes = _integer("steps", steps, 0), _integer("changes", changes, 0)
        seed, every = _integer("seed", seed, 0), _integer("every", every, 0)
        step_size = _number("step_size", step_size)
        rows, end, accepted, unclosed = self._walk(steps, step_size, changes, seed, every, start, progress)
        return Walk(rows, end, steps, accepted, unclosed)

    def steric(self, q, softness=0.0, *, threads=None, progress=None):
        """Return the steric energy and its gradient, a smooth measure of the clashes.

        q: shape (dof,) or (n, dof). softness: angstrom. Returns (energy, gradient): the sum of (M + softness - d)^2
        over the tested pairs with d < M + softness (square angstrom; a float, or shape (n,)), and its derivatives by
        the values of q (shape of q; square angstrom per rad, or angstrom for moves of placed parts).
        """
        energy, gradient = self._steric(q, softness, threads, progress)
        return (float(energy[0]), gradient[0]) if np.ndim(q) == 1 else (energy, gradient)

    def relax(self, q=None, *, tries=1000, seed=1, threads=None, progress=None):
        """Mend the clashes of configurations and move them as little as possible, as `biocd relax` does.

        q: shape (dof,) or (n, dof); None: the reference. Cycles that the checker keeps are closed at q and stay
        closed. tries: largest number of random restarts, if descent does not mend all clashes. seed: of the restarts.
        Returns a Relaxation. It never has more colliding pairs than q; look at `collisions` to see what is left.
        """
        given = np.zeros(self.dof) if q is None else q
        found = self._relax(given, _integer("tries", tries, 0), _integer("seed", seed, 0), threads, progress)
        if np.ndim(given) == 1:
            return Relaxation(found[0][0], *(value[0].item() for value in found[1:]))
        return Relaxation(*found)

    def plan(self, start, end, *, tries=100_000, seed=1, seconds=None):
        """Find a motion between two conformations on which no pair collides, as `biocd plan` does.

        start, end: shape (dof,), rad and angstrom; None: the reference; or a CoordinateFit. Both have to be free, and
        cycles that the checker keeps are closed at them. But if a CoordinateFit is more than 0.002 angstrom from its
        coordinates, the motion may have another conformation there, within 1 angstrom of them (counted over the atoms
        that the selection moves) or as near as the fit: look at `start_rmsd` and `end_rmsd`. Only one is replaced:
        `end` if it is such a fit, otherwise `start`. tries: largest number of motions to test before one is found.
        seed: of the random conformations. seconds: the search ends after this time. Returns a Motion; look at
        `reached`. No motion is no proof that there is none. Torsions may reach the end with whole turns more or less.
        Raises ConfigurationError, with the pair, if an end collides.
        """

        def parts_of(given):
            if isinstance(given, CoordinateFit):
                return given.q, given.x, given.atoms
            return (np.zeros(self.dof) if given is None else given,)

        return Motion(
            *self._plan(
                parts_of(start),
                parts_of(end),
                _integer("tries", tries, 1),
                _integer("seed", seed, 0),
                seconds_of(seconds),
            )
        )

    def fit_coordinates(self, x, *, atoms=None, collision_free=False, seconds=None):
        """Return the configuration whose atoms are nearest to given coordinates, as the ends of `biocd plan` are found.

        x: shape (n, 3), angstrom, in any frame; or a Molecule, whose atoms match by chain, residue and atom name.
        atoms: indices or booleans of the n atoms; None: all. collision_free: move the result until no pair collides, as
        little as possible; look at `collisions`. seconds: the search ends after this time.
        The mean squared distance after superposition is minimised over the free torsions, from two starts. Bond
        lengths, angles and other torsions stay as in the reference, so the atoms come as near as these allow: look at
        `rmsd`. Cycles that the checker keeps are closed at the result. Returns a CoordinateFit.
        fit() reads the torsions of frames of the same molecule instead.
        """
        if isinstance(x, Molecule):
            if atoms is not None:
                raise ValueError("atoms: given with a Molecule, expected None")
            atoms, x = self._match(x)
        elif atoms is None:
            atoms = np.arange(len(self._molecule.atoms))
        q, rmsd, farthest, atom, collisions, stopped = self._fit_coordinates(
            x, atoms, bool(collision_free), seconds_of(seconds)
        )
        atoms = np.asarray(atoms)
        atoms = np.flatnonzero(atoms) if atoms.dtype == bool else atoms.astype(np.int64)
        return CoordinateFit(q, rmsd, farthest, atom, atoms, np.array(x, np.float64), collisions, stopped)

    def fit(self, x, *, progress=None):
        """Return the configurations with the torsions of given coordinates, shape (n, dof), rad.

        x: shape (n, n_atoms, 3) or (n_atoms, 3), angstrom, or a Trajectory. Bond lengths, angles and other torsions
        stay as in the reference. Raises LoadError where a torsion is undefined.
        """
        return _core._fit(self, x, progress)

    def residue_clashes(self, pairs):
        """Return which residues clash: a structured array, most frequent first.

        pairs: rows of pairs() or pairs_coordinates(). Fields: residue_i, residue_j (indices), label_i, label_j, chain
        and residue, conformations (number in which they clash), contacts (pairs of atoms), overlap (largest, angstrom).
        """
        return residue_clashes(self, pairs)

    def __reduce__(self):
        return _rebuild, (type(self), self._molecule, self._free, self._options)

    def __repr__(self):
        free = self._free if isinstance(self._free, str) else f"{len(self._free)} chosen"
        rule = f"d < {self.rho} * ({self.radii} radii)" if self.rho else self.rules
        return (
            f"<Checker of {self._molecule.name!r}: free {free}, {self.dof} DOF, {self.n_rigid_groups} rigid groups, "
            f"{rule}, {self.min_bonds} bonds apart>"
        )


def _rebuild(cls, molecule, free, options):
    return cls(molecule, free, **options)


def residue_clashes(checker, pairs):
    """The table of Checker.residue_clashes()."""
    atoms = checker.molecule.atoms
    pairs = np.asarray(pairs)
    pairs = pairs[pairs["collides"]]
    residue = atoms["residue"]
    ends = np.sort(np.stack([residue[pairs["i"]], residue[pairs["j"]]], axis=1), axis=1)
    unique, row = np.unique(ends, axis=0, return_inverse=True)
    table = np.zeros(
        len(unique),
        [
            ("residue_i", "i4"),
            ("residue_j", "i4"),
            ("label_i", "U24"),
            ("label_j", "U24"),
            ("conformations", "i8"),
            ("contacts", "i8"),
            ("overlap", "f8"),
        ],
    )
    if len(unique) == 0:
        return table
    labels = residue_labels(checker.molecule)
    table["residue_i"], table["residue_j"] = unique.T
    table["label_i"], table["label_j"] = labels[unique[:, 0]], labels[unique[:, 1]]
    table["contacts"] = np.bincount(row, minlength=len(unique))
    seen = np.unique(np.stack([row, pairs["conformation"]], axis=1), axis=0)
    table["conformations"] = np.bincount(seen[:, 0], minlength=len(unique))
    table["overlap"] = -np.inf
    np.maximum.at(table["overlap"], row, checker.overlaps(np.ascontiguousarray(pairs)))
    return table[np.lexsort((-table["contacts"], -table["conformations"]))]


def residue_labels(molecule):
    """Names of the residues, such as 'A:LYS77', shape (n_residues,)."""
    first = np.unique(molecule.atoms["residue"], return_index=True)[1]
    return np.array([molecule.label(int(k)).rsplit(":", 1)[0] for k in first])
