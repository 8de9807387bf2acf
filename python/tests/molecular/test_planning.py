# SPDX-License-Identifier: BSD-3-Clause
"""Planned motions and fitted conformations: as the command line, and free by other calls."""

import numpy as np
import pytest

import hinge
import hinge.molecular as hm
from molecular_cases import biocd, path_of

SEED = 20261126


@pytest.fixture(scope="module")
def tail():
    return hm.Checker(hm.Molecule(path_of("1ubq")), "A:74-76:psi", exempt_reference=True)


def test_a_motion_is_as_the_tool_finds_it(tail):
    end = np.radians([-120.0, -120.0, 90.0])
    given = ["--free", "A:74-76:psi", "--exempt-reference", "--to", "-120,-120,90"]
    told = biocd("plan", "1ubq", *given, ok=(0,))
    found = tail.plan(None, end)
    assert found.reached and not found.stopped and found.remaining == found.opening == 0.0
    assert found.motions == told["motions"] and len(found.waypoints) > 2
    assert np.allclose(np.degrees(found.waypoints), told["waypoints"], atol=1e-3)
    assert found.length == pytest.approx(told["length"], abs=1e-3) and found.length > found.straight
    assert np.all(found.waypoints[0] == 0.0)
    assert np.allclose(np.remainder(found.waypoints[-1] - end + np.pi, 2 * np.pi), np.pi)
    assert (tail.certify(found.waypoints[:-1], found.waypoints[1:])["verdict"] == "free").all()
    q = found.steps(0.02)
    assert np.abs(np.diff(q, axis=0)).max() <= 0.02 + 1e-12 and not tail.collides(q).any()
    assert {tuple(row) for row in found.waypoints} <= {tuple(row) for row in q}
    assert tail.plan(None, end).waypoints.tobytes() == found.waypoints.tobytes()
    assert tail.plan(end, np.zeros(3), seed=2).reached


def test_what_is_not_found_is_said():
    c = hm.Checker(hm.Molecule(path_of("1ubq")), "A:60:phi", exempt_reference=True)
    found = c.plan(None, [np.pi], tries=50)
    assert not found.reached and not found.stopped and 0 < found.remaining < found.straight
    assert not c.collides(found.steps(0.05)).any()
    stopped = c.plan(None, [np.pi], tries=10**12, seconds=0.2)
    assert stopped.stopped and not stopped.reached


def test_cycles_stay_closed():
    m = hm.Molecule(path_of("1ubq"), loops="A:7-13")
    c = hm.Checker(m, exempt_reference=True)
    ends = c.sample(40, SEED, 0.1)
    end = ends[~c.collides(ends)][0]
    found = c.plan(None, end, tries=300)
    assert np.abs(c.closure_residuals(found.waypoints)).max() < 1e-6
    assert 0 < found.opening < 0.02
    middles = (found.waypoints[1:] + found.waypoints[:-1]) / 2
    assert np.abs(c.closure_residuals(middles)).max() <= found.opening * (1 + 1e-6)


def test_bad_ends(tail):
    drawn = tail.sample(200, SEED)
    bad = drawn[tail.collides(drawn)][0]
    with pytest.raises(hinge.ConfigurationError, match="the end of the motion collides: A:"):
        tail.plan(None, bad)
    with pytest.raises(hinge.ConfigurationError, match="the start of the motion collides: A:"):
        tail.plan(bad, None)
    for end in ([1.0], np.zeros((2, 3)), [np.nan, 0, 0], [np.inf, 0, 0]):
        with pytest.raises(ValueError):
            tail.plan(None, end)
    with pytest.raises(TypeError, match="end"):
        tail.plan(None, "abc")
    for option in ({"tries": 0}, {"seed": -1}, {"seconds": -1}, {"seconds": float("nan")}):
        with pytest.raises(ValueError, match=next(iter(option))):
            tail.plan(None, np.zeros(3), **option)
    found = tail.plan(None, np.zeros(3))
    for step in (0, -1, np.inf):
        with pytest.raises(ValueError, match="step"):
            found.steps(step)


def test_coordinates_are_fitted():
    c = hm.Checker(hm.Molecule(path_of("1ubq")), "A:60-76 and backbone")
    random = np.random.default_rng(SEED)
    q = random.normal(0.0, 0.3, c.dof)
    x = c.positions(q)
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.linalg.det(turn)
    moved = x @ turn.T + [30.0, -20.0, 5.0]
    found = c.fit_coordinates(moved)
    assert found.rmsd < 1e-4 and len(found.atoms) == len(x) and not found.stopped
    assert np.allclose(found.q, q, atol=1e-3)
    # Some atoms, chosen by index or by booleans.
    chosen = np.arange(len(x)) % 2 == 0
    for atoms in (chosen, np.flatnonzero(chosen)):
        part = c.fit_coordinates(moved[chosen], atoms=atoms)
        assert part.rmsd < 1e-4 and (part.atoms == np.flatnonzero(chosen)).all()
    # With few free torsions, it comes as near as these allow.
    few = hm.Checker(c.molecule, "A:76:phi").fit_coordinates(moved)
    assert few.rmsd > 1.0 and few.farthest > few.rmsd and 0 <= few.atom < len(x)
    noisy = moved + random.normal(0.0, 0.5, moved.shape)
    assert c.fit_coordinates(noisy, seconds=0).stopped and not c.fit_coordinates(noisy).stopped


def test_a_motion_to_coordinates_may_end_near_them():
    c = hm.Checker(hm.Molecule(path_of("1ubq")), "all", exempt_reference=True)
    random = np.random.default_rng(SEED)
    x = c.positions(random.normal(0.0, 0.02, c.dof)) + random.normal(0.0, 0.2, (len(c.molecule.atoms), 3))
    fit = c.fit_coordinates(x)
    assert fit.collisions == len(c.pairs(fit.q)) > 0
    free = c.fit_coordinates(x, collision_free=True)
    assert free.collisions == 0 and fit.rmsd <= free.rmsd < 1.0 and not c.collides(free.q)
    for start, end in ((None, fit), (fit, None), (None, free), (free, fit)):
        found = c.plan(start, end, tries=2000)
        assert found.reached and found.start_rmsd < 1.0 and found.end_rmsd < 1.0
        assert (found.start_rmsd > 0) == (start is not None) and (found.end_rmsd > 0) == (end is not None)
        for given, waypoint in ((start, found.waypoints[0]), (end, found.waypoints[-1])):
            if given is None:
                assert np.all(np.abs(np.remainder(waypoint + np.pi, 2 * np.pi) - np.pi) < 1e-9)
        assert (c.certify(found.waypoints[:-1], found.waypoints[1:])["verdict"] == "free").all()


def test_molecules_match_by_name(tmp_path):
    m = hm.Molecule(path_of("1ubq"))
    c = hm.Checker(m, "A:60-76 and backbone")
    q = np.random.default_rng(SEED).normal(0.0, 0.3, c.dof)
    lines = [line for line in open(path_of("1ubq")) if line.startswith("ATOM")]
    text = [
        line[:30] + "".join(f"{v:8.3f}" for v in at) + line[54:] for line, at in zip(lines, c.positions(q), strict=True)
    ]
    residues = {}
    for line in text:
        residues.setdefault(line[22:27], []).append(line)
    file = tmp_path / "other.pdb"
    file.write_text("".join("".join(reversed(atoms)) for atoms in list(residues.values())[5:]))
    found = c.fit_coordinates(hm.Molecule(file))
    assert len(found.atoms) == len(lines) - sum(len(atoms) for atoms in list(residues.values())[:5])
    assert found.rmsd < 1e-3 and np.allclose(found.q, q, atol=0.02)
    with pytest.raises(ValueError, match="atoms"):
        c.fit_coordinates(m, atoms=[0])
    for x in (np.zeros((3, 3)), np.full((len(lines), 3), np.nan)):
        with pytest.raises(ValueError):
            c.fit_coordinates(x)
    with pytest.raises(IndexError, match="atoms"):
        c.fit_coordinates(np.zeros((1, 3)), atoms=[len(lines)])
