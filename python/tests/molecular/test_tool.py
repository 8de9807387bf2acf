# SPDX-License-Identifier: BSD-3-Clause
"""Every answer of hinge.molecular equals the command line's."""

import json
import math
import subprocess

import numpy as np
import pytest

import hinge.molecular as hm
from conftest import tool
from molecular_cases import MOLECULES, biocd, options_of, path_of, rows, rows_of

names = pytest.mark.parametrize("name", MOLECULES)


@pytest.fixture(scope="module")
def molecules():
    cache = {}

    def get(name):
        if name not in cache:
            cache[name] = hm.Molecule(path_of(name), **options_of(name))
        return cache[name]

    return get


@names
def test_info(molecules, name):
    told = biocd("info", name, ok=(0,))
    told = told.get("model", told)
    m = molecules(name)
    c = hm.Checker(m, closures="open")
    assert (m.n_atoms, len(m.bonds), m.n_residues, m.n_chains) == (
        told["atoms"],
        told["bonds"],
        told["residues"],
        told["chains"],
    )
    assert (c.dof, c.n_rigid_groups, m.n_closures) == (told["dof"], told["rigid_groups"], told["closures"])
    assert (c.rules, c.radii, c.rho, c.min_bonds) == (told["rules"], told["radii"], told["rho"], told["min_bonds"])
    assert len(c.reference_collisions) == told["reference_collisions"]
    assert set(m.notes) <= set(told["notes"])


@names
@pytest.mark.parametrize("mode", ["all", "within:0.3", "closest", "any"])
def test_check(molecules, name, mode):
    told = biocd("check", name, "--mode", mode)
    c = hm.Checker(molecules(name))
    x = c.molecule.models
    expected = told["conformations"]
    assert len(x) == len(expected)
    assert c.collides_coordinates(x).tolist() == [row["collides"] for row in expected]
    if mode == "closest":
        got, wanted = c.closest_coordinates(x), [rows_of([row["closest"]], k) for k, row in enumerate(expected)]
    elif mode == "any":
        return
    else:
        within = 0.3 if mode.startswith("within") else 0.0
        got, wanted = c.pairs_coordinates(x, within=within), [rows_of(r["pairs"], k) for k, r in enumerate(expected)]
    assert rows(got) == sum(wanted, [])
    if mode == "all":
        overlaps = [p["overlap"] for row in expected for p in row["pairs"]]
        assert c.overlaps(got).tolist() == overlaps


@pytest.mark.parametrize("rules", ["severe", "molprobity", "chimerax", "posebusters"])
def test_check_by_rules_of_other_programs(molecules, rules):
    told = biocd("check", "2juy", "--rules", rules)["conformations"][0]
    c = hm.Checker(molecules("2juy"), rules=rules)
    assert rows(c.pairs_coordinates(c.molecule.coordinates)) == rows_of(told["pairs"], 0)


def test_check_with_every_number_of_the_rules(molecules):
    given = ["--radii", "amber", "--rho", "0.7", "--min-bonds", "3", "--hbond", "on", "--hbond-allowance", "0.6"]
    told = biocd("check", "1ubq", *given)["conformations"][0]
    c = hm.Checker(
        molecules("1ubq"), radii="amber", rho=0.7, min_bonds=3, hydrogen_bonds=True, hydrogen_bond_allowance=0.6
    )
    assert rows(c.pairs_coordinates(c.molecule.coordinates)) == rows_of(told["pairs"], 0)


def angles_of(c, q):
    """Torsions in degrees as the tool writes them, by the same operations."""
    degree = math.pi / 180.0
    reference = c.molecule.torsions["reference"]
    rows = np.array(q)
    for column, torsion in enumerate(c.torsion_of_dof):
        for row in rows:
            angle = math.remainder((row[column] + reference[torsion]) / degree, 360.0)
            row[column] = 180.0 if angle <= -180.0 else angle
    return rows


@names
@pytest.mark.parametrize("sigma", [None, 3.0])
def test_sample_draws_the_same_bytes(molecules, tmp_path, name, sigma):
    torsions, coordinates = tmp_path / "q.npy", tmp_path / "x.npy"
    more = [] if sigma is None else ["--sigma", sigma]
    files = ["--torsions-out", torsions, "--out", coordinates]
    told = biocd("sample", name, "-n", 20, "--seed", 7, *more, "--mode", "all", *files)
    c = hm.Checker(molecules(name))
    q = c.sample(20, 7, None if sigma is None else np.radians(sigma))
    assert angles_of(c, q).tobytes() == np.load(torsions).tobytes()
    assert c.positions(q).tobytes() == np.load(coordinates).tobytes()
    assert c.collides(q).tolist() == [row["collides"] for row in told["conformations"]]
    expected = [rows_of(row["pairs"], k) for k, row in enumerate(told["conformations"])]
    assert rows(c.pairs(q)) == sum(expected, [])


@pytest.mark.parametrize(
    "more, free, sigma, prior",
    [
        (["--sigma", 8], "(A:7-11) and chi", 8, None),
        (["--free", "none", "--prior", "uniform"], "none", None, "uniform"),
        ([], "(A:7-11) and chi", None, None),
    ],
)
def test_sample_of_a_free_loop(tmp_path, more, free, sigma, prior):
    coordinates = tmp_path / "x.npy"
    given = ["--loop", "A:7-11", "--collision-free", "--exempt-reference", "--out", coordinates, *more]
    told = biocd("sample", "1ubq", "-n", 5, *given, ok=(0,))
    m = hm.Molecule(path_of("1ubq"), loops="A:7-11")
    c = hm.Checker(m, free, exempt_reference=True)
    q = c.sample(5, 1, None if sigma is None else np.radians(sigma), collision_free=True, prior=prior, threads=2)
    assert len(q) == told["summary"]["checked"]
    assert c.positions(q).tobytes() == np.load(coordinates).tobytes()
    assert not c.collides(q).any()
    assert c.closure_residuals(q).max() < 1e-8


def test_docking(tmp_path):
    coordinates = tmp_path / "x.npy"
    given = ["--place", "B=4,30", "--between", "B", "rest", "--free", "none", "--exempt-reference"]
    told = biocd("sample", "1bna", "-n", 30, "--seed", 3, *given, "--mode", "all", "--out", coordinates)
    m = hm.Molecule(path_of("1bna"), place=[("B", 4.0, np.radians(30))])
    c = hm.Checker(m, "none", between=[("B", "rest")], exempt_reference=True)
    assert c.dof == told["model"]["dof"] == 6
    q = c.sample(30, 3)
    assert c.positions(q).tobytes() == np.load(coordinates).tobytes()
    assert c.collides(q).tolist() == [row["collides"] for row in told["conformations"]]
    by_mask = hm.Molecule(path_of("1bna"), place=[(m.select_atoms("B"), 4.0, np.radians(30))])
    c2 = hm.Checker(by_mask, "none", between=[(m.select_atoms("B"), m.select_atoms("A"))], exempt_reference=True)
    assert np.array_equal(c2.sample(30, 3), q)
    assert rows(c2.pairs(q)) == rows(c.pairs(q))


def test_walk(molecules, tmp_path):
    coordinates = tmp_path / "x.npy"
    given = ["--free", "A:60-76", "--exempt-reference", "--steps", 1000, "--step-size", 4, "--changes", 2, "--seed", 5]
    told = biocd("walk", "1ubq", *given, "--every", 50, "--out", coordinates, ok=(0,))["summary"]
    c = hm.Checker(molecules("1ubq"), "A:60-76", exempt_reference=True)
    walk = c.walk(1000, step_size=np.radians(4), changes=2, seed=5, every=50)
    assert (walk.accepted, walk.unclosed) == (told["accepted"], told["unclosed"])
    assert c.positions(walk.configurations).tobytes() == np.load(coordinates).tobytes()
    assert not c.collides(walk.end)
    assert np.array_equal(walk.end, walk.configurations[-1])


def test_relax(molecules, tmp_path):
    coordinates = tmp_path / "x.npy"
    told = biocd("relax", "1ubq", "--out", coordinates, ok=(0,))
    c = hm.Checker(molecules("1ubq"), "all")
    found = c.relax()
    assert (found.collisions_before, found.collisions, found.restarts) == (1, 0, told["restarts"])
    assert c.positions(found.q[None]).tobytes() == np.load(coordinates).tobytes()
    moved = {change["dof"]: change["degrees"] for change in told["changes"]}
    turned = [(label, turn) for label, turn in zip(c.dof_labels, np.degrees(found.q)) if abs(turn) > 0.05]
    assert dict(turned) == pytest.approx(moved, abs=1e-3)

    # Several at once, for any number of threads.
    q = np.random.default_rng(3).normal(0.0, 0.4, (6, c.dof))
    one, three = c.relax(q, seed=2, threads=1), c.relax(q, seed=2, threads=3)
    assert one.q.tobytes() == three.q.tobytes() and one.q.shape == q.shape
    assert np.array_equal(one.collisions_before, np.bincount(c.pairs(q)["conformation"], minlength=6))
    assert np.array_equal(one.collisions, np.bincount(c.pairs(one.q)["conformation"], minlength=6))
    assert np.all(one.collisions < one.collisions_before) and np.all(one.energy < one.energy_before)


def test_steric(molecules):
    c = hm.Checker(molecules("1ubq"), "A:60-76")
    q = np.random.default_rng(4).normal(0.0, 0.5, (5, c.dof))
    energy, gradient = c.steric(q, 0.1)
    assert energy.shape == (5,) and gradient.shape == q.shape
    for k in range(5):
        pairs = c.pairs(q[k], within=0.1)
        assert energy[k] == pytest.approx(np.sum((pairs["threshold"] + 0.1 - pairs["distance"]) ** 2), rel=1e-12)
        one, slope = c.steric(q[k], 0.1)
        assert one == energy[k] and slope.tobytes() == gradient[k].tobytes()
        steps = 1e-6 * np.eye(c.dof)
        differences = (c.steric(q[k] + steps, 0.1)[0] - c.steric(q[k] - steps, 0.1)[0]) / 2e-6
        assert np.allclose(slope, differences, atol=1e-6 * np.abs(slope).max())
    assert c.steric(np.zeros(c.dof))[0] >= 0.0
    with pytest.raises(ValueError, match="softness"):
        c.steric(q, -1.0)


@pytest.mark.parametrize("name", ["1ubq", "1crn"])
def test_path(molecules, name):
    c = hm.Checker(molecules(name), "A:30-40", closures="open", exempt_reference=True)
    ends = np.random.default_rng(1).normal(0.0, 0.1, (4, c.dof))
    degree = math.pi / 180.0
    for a, b in zip(ends[:2], ends[2:]):
        words = [",".join(repr(v) for v in (end / degree).tolist()) for end in (a, b)]
        given = ["--free", "A:30-40", "--exempt-reference", f"--from={words[0]}", f"--to={words[1]}"]
        told = biocd("path", name, *given, ok=(0, 1, 4))
        exact = [np.array([float(v) for v in text.split(",")]) * degree for text in words]
        answer = c.certify(*exact)[0]
        assert answer["verdict"] == told["verdict"]
        assert answer["states"] == told["states_looked_at"]
        if told["verdict"] == "colliding":
            assert answer["parameter"] == told["parameter"]


def test_trajectory(shared):
    told = biocd_frames(shared("molecules/1l2y.pdb"), shared("molecules/1l2y.xtc"))
    m = hm.Molecule(shared("molecules/1l2y.pdb"), model=1)
    c = hm.Checker(m, closures="open")
    frames = hm.Trajectory(m, shared("molecules/1l2y.xtc"))
    expected = [rows_of(row["pairs"], k) for k, row in enumerate(told)]
    assert rows(c.pairs_coordinates(frames)) == sum(expected, [])
    assert c.collides_coordinates(frames, threads=2).tolist() == [row["collides"] for row in told]
    assert rows(c.pairs_coordinates(np.stack(list(frames)))) == sum(expected, [])


def biocd_frames(*files):
    done = subprocess.run([tool("biocd"), "check", *files, "--model", "1", "--json"], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)["conformations"]


def test_rigid_groups(shared):
    file = shared("molecules/paper/nmr_neopetrosiamide.pdb")
    given = ["--rigid-from", str(file), "--rigid-tolerance", "0.8", "--json"]
    done = subprocess.run([tool("biocd"), "info", str(file), "--model", "1", *given], capture_output=True, text=True)
    told = json.loads(done.stdout)
    m = hm.Molecule(file, model=1)
    groups = hm.find_rigid_groups(m, hm.Molecule(file).models, tolerance=0.8)
    expected = told["rigid_ensemble"]["groups"]
    assert [[part.tolist() for part in group] for group in groups.segments] == [g["segments"] for g in expected]
    assert np.allclose(groups.spreads, [g["distance_spread"] for g in expected], atol=1e-3)
    labels = [row["torsion"] for row in told["rigid_ensemble"]["torsions"]]
    assert m.torsions["label"][groups.torsions].tolist() == labels
    held = hm.Molecule(file, model=1, held=groups.held)
    c = hm.Checker(held, groups.torsions, closures="open")
    assert c.dof == told.get("model", told)["dof"]
