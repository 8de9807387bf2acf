# SPDX-License-Identifier: BSD-3-Clause
"""Arguments that do not fit: every exception names the argument, what was given and what was expected."""

import numpy as np
import pytest

import hinge
import hinge.molecular as hm
from conftest import ROOT

FILE = ROOT / "molecular/data/1ubq.pdb"


@pytest.fixture(scope="module")
def m():
    return hm.Molecule(FILE)


@pytest.fixture(scope="module")
def c(m):
    return hm.Checker(m, "A:60-76", exempt_reference=True)


@pytest.mark.parametrize(
    "call, error, message",
    [
        (lambda m, c: hm.Molecule("no/such.pdb"), hinge.LoadError, "no/such.pdb"),
        (lambda m, c: hm.Molecule(b"nothing"), hinge.LoadError, "<bytes>"),
        (lambda m, c: hm.Molecule(3), TypeError, "source: a int, expected a path or bytes"),
        (lambda m, c: hm.Molecule(FILE, hydrogens="some"), ValueError, "hydrogens: 'some', expected 'keep', 'drop'"),
        (lambda m, c: hm.Molecule(FILE, altloc="AB"), ValueError, "altloc: 'AB', expected one character"),
        (lambda m, c: hm.Molecule(FILE, model=7), hinge.LoadError, "7"),
        (lambda m, c: hm.Molecule(FILE, place=[("A", -1, 0)]), ValueError, "place: range"),
        (lambda m, c: hm.Molecule(FILE, place=["Z"]), hinge.ModelError, "Z"),
        (lambda m, c: hm.Molecule(FILE, place=np.ones(5, bool)), ValueError, r"place: .* shape \(602,\)"),
        (lambda m, c: hm.Molecule(FILE, held=[[1, 2, 3]]), ValueError, r"held: expected .* \(n, 6\)"),
        (lambda m, c: hm.Molecule(FILE, loops="A:1-3"), hinge.ModelError, "A:1-3"),
        (lambda m, c: hm.Checker(FILE), TypeError, "molecule: a PosixPath, expected a Molecule"),
        (lambda m, c: hm.Checker(m, "B:1"), hinge.ModelError, "B"),
        (lambda m, c: hm.Checker(m, [10**6]), IndexError, "free: indices"),
        (lambda m, c: hm.Checker(m, [0.5]), TypeError, "free: an array of float64"),
        (lambda m, c: hm.Checker(m, np.ones(3, bool)), ValueError, r"free: booleans of shape \(3,\)"),
        (lambda m, c: hm.Checker(m, rules="mine"), hinge.ModelError, "mine"),
        (lambda m, c: hm.Checker(m, rho=-1), hinge.ModelError, "rho"),
        (lambda m, c: hm.Checker(m, engine="fast"), hinge.ModelError, "fast"),
        (lambda m, c: hm.Checker(m, threads=0), ValueError, "threads: 0, expected 1 to 1024"),
        (lambda m, c: hm.Checker(m, exempt_interfaces=True), ValueError, "exempt_interfaces"),
        (lambda m, c: hm.Checker(m, closures="shut"), ValueError, "closures: 'shut', expected 'keep', 'open'"),
        (lambda m, c: c.collides(np.zeros((2, 3))), ValueError, r"q: shape \(2, 3\), expected \(n, \d+\) or \(\d+,\)"),
        (lambda m, c: c.collides(np.zeros((2, 3, c.dof))), ValueError, "q: shape"),
        (lambda m, c: c.collides(np.full((2, c.dof), np.nan)), ValueError, r"q\[0, 0\] is nan, expected finite"),
        (lambda m, c: c.collides(np.full(c.dof, np.inf)), ValueError, r"q\[0\] is inf, expected finite"),
        (lambda m, c: c.collides([["a"] * c.dof]), TypeError, "q: an array of <U1, expected an array of real numbers"),
        (lambda m, c: c.collides(np.zeros((2, c.dof), complex)), TypeError, "q: an array of complex128"),
        (lambda m, c: c.collides(None), TypeError, "q: None"),
        (lambda m, c: c.collides(np.zeros(c.dof), threads=1.5), TypeError, "incompatible|threads"),
        (lambda m, c: c.collides(np.zeros((1, c.dof)), threads=0), ValueError, "threads: 0, expected 1 to 1024"),
        (lambda m, c: c.pairs(np.zeros(c.dof), within=-1.0), ValueError, "within: -1.0, expected a length"),
        (lambda m, c: c.pairs(np.zeros(c.dof), within=np.nan), ValueError, "within: nan"),
        (lambda m, c: c.pairs(np.zeros(c.dof), within="x"), TypeError, "within: a str, expected a number"),
        (lambda m, c: c.sample("ten"), TypeError, "n: a str, expected an integer"),
        (lambda m, c: c.sample(5, seed=-1), ValueError, "seed: -1, expected 0 to 2"),
        (lambda m, c: c.sample(5, sigma="x"), TypeError, "sigma: a str, expected a number"),
        (lambda m, c: c.walk(2.5), TypeError, "steps: a float, expected an integer"),
        (lambda m, c: c.collides_coordinates(np.zeros((5, 3))), ValueError, r"x: shape \(5, 3\), expected \(n, 60"),
        (lambda m, c: c.collides_coordinates(m.coordinates, decimals=99), ValueError, "decimals: 99"),
        (lambda m, c: c.positions(np.zeros(c.dof), out=np.zeros(3)), ValueError, r"out: shape \(3,\), expected \(60"),
        (lambda m, c: c.positions(np.zeros(c.dof), out=[1]), TypeError, "out: expected a writeable array"),
        (lambda m, c: c.sample(5, sigma=-1.0), ValueError, "sigma: -1.0, expected a number above 0"),
        (lambda m, c: c.sample(-5), ValueError, "n: -5, expected 0 to 2"),
        (lambda m, c: c.sample(5, tries=0, collision_free=True), ValueError, "tries: 0, expected 1 to"),
        (lambda m, c: c.sample(5, prior="flat", collision_free=True), ValueError, "prior: 'flat', expected 'rama"),
        (lambda m, c: c.sample(5, prior="uniform"), ValueError, "prior: 'uniform', expected None without"),
        (lambda m, c: c.sample(5, 1, 0.1, prior="uniform", collision_free=True), ValueError, "expected None without"),
        (lambda m, c: c.walk(5, changes=0), ValueError, "changes: 0, expected 1 to"),
        (lambda m, c: c.walk(5, step_size=0), ValueError, "step_size"),
        (lambda m, c: hm.Checker(m, "A:60-76").walk(5), hinge.ModelError, "the start collides in 1 pairs"),
        (lambda m, c: c.certify(np.zeros(c.dof), np.zeros(2)), ValueError, "b: shape"),
        (lambda m, c: c.certify(np.zeros(c.dof), np.zeros(c.dof), smallest_step=0), ValueError, "smallest_step"),
        (lambda m, c: hm.Trajectory(m, "no.dcd"), hinge.LoadError, "no.dcd"),
        (lambda m, c: hm.Trajectory(m, FILE)[3], IndexError, "frame 3, expected -1 to 0"),
        (lambda m, c: m.label(602), IndexError, "atom: 602, expected an index below 602"),
        (lambda m, c: m.model(1), IndexError, "model: 1, expected an index below 1"),
        (lambda m, c: hm.superpose(np.zeros((3, 3)), np.zeros((4, 3))), ValueError, "moved and onto: 3 and 4 atoms"),
        (lambda m, c: hm.find_rigid_groups(m, m.coordinates), hinge.ModelError, "conformation"),
    ],
)
def test_bad_arguments(m, c, call, error, message):
    with pytest.raises(error, match=message):
        call(m, c)


@pytest.mark.parametrize("seed", range(40))
def test_random_arguments_never_crash(m, c, seed):
    """Every call with random arguments answers, or raises an exception of ours or of Python's."""
    rng = np.random.default_rng(seed)
    dof, atoms = c.dof, m.n_atoms
    values = [
        None, True, 0, -1, 3, 2.5, np.nan, "x", b"x", [], [[]], {}, object(), np.zeros(0), np.zeros(dof),
        np.zeros((2, dof)), np.zeros((2, dof + 1)), np.zeros((dof, 2)).T, np.full((1, dof), 1e308),
        np.full((1, dof), -np.inf), np.zeros((2, dof), object), np.zeros((2, dof), bool), np.zeros((2, dof), "M8[s]"),
        np.zeros((1, atoms, 3)), np.zeros((atoms, 3)), np.zeros((1, atoms, 3))[..., ::-1], np.full((atoms, 3), 1e300),
        c.pairs(np.zeros(dof), within=1.0), np.zeros(3, hm.pair_dtype), m, c, range(dof), np.float64(1), 10**30,
        memoryview(b"abc"), np.ma.masked_array(np.zeros(dof)), np.zeros((2,) * 5),
    ]  # fmt: skip
    methods = [
        "collides", "pairs", "closest", "positions", "closure_residuals", "collides_coordinates", "pairs_coordinates",
        "closest_coordinates", "overlaps", "residue_clashes", "sample", "unclosable", "walk", "fit", "steric",
        "relax", "plan", "fit_coordinates",
    ]  # fmt: skip
    keywords = ["threads", "progress", "within", "decimals", "out", "seed", "sigma", "first", "tries", "resolution", "softness", "seconds"]
    for _ in range(60):
        method = methods[rng.integers(len(methods))]
        pick = lambda: values[rng.integers(len(values))]  # noqa: E731
        arguments = [pick() for _ in range(1 + (rng.random() < 0.3))]
        if method in ("sample", "walk") and isinstance(arguments[0], int) and arguments[0] > 1000:
            continue
        # Paths of 1e308 turns take long; certify() gets small arrays in test_ctrl_c and test_bad_arguments.
        more = {keywords[rng.integers(len(keywords))]: pick() for _ in range(rng.integers(0, 2))}
        try:
            getattr(c, method)(*arguments, **more)
        except (hinge.Error, TypeError, ValueError, IndexError, OverflowError, KeyError, AttributeError):
            pass
    assert c.collides(np.zeros(dof)) is False
