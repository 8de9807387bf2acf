# SPDX-License-Identifier: BSD-3-Clause
"""Paths of models from arrays, and queries between two models, compared with brute force."""

import numpy as np
import pytest

import hinge
from test_core import ENGINES, placed, random_model

KINDS = ("point", "sphere", "capsule", "triangle")
SEEDS = range(5)


def balanced(rng, kind):
    """A model, and a threshold at which about one state in seven collides."""
    while True:
        model = random_model(rng, kind, links=5, each=1)
        checker = hinge.Checker(model)
        closest = checker.closest(rng.normal(0.0, 1.5, (300, checker.dof)))
        if len(closest):
            threshold = np.quantile(closest["distance"], 0.15)
            hits = (closest["distance"] < threshold) | ((closest["distance"] == 0.0) & (kind != "point"))
            if 0.05 < hits.mean() < 0.5:
                return model, threshold


def paths_of(rng, checker, n):
    """Starts and ends from short to long."""
    a = rng.normal(0.0, 1.5, (n, checker.dof))
    return a, a + rng.normal(0.0, 1.0, a.shape) * np.geomspace(0.01, 2.0, n)[:, None]


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_proofs_agree_with_states_along_the_path(kind, seed, engine):
    rng = np.random.default_rng(200 + seed)
    model, threshold = balanced(rng, kind)
    checker = hinge.Checker(model, threshold, engine=engine, threads=2)
    judge = hinge.Checker(model, threshold, engine="brute")
    a, b = paths_of(rng, checker, 30)
    rows = checker.certify(a, b)
    verdicts = rows["verdict"]
    assert {"free", "colliding"} <= set(verdicts), f"seed {seed}"
    assert (verdicts != "undecided").mean() > 0.9
    t = np.linspace(0.0, 1.0, 301)
    hits = judge.collides((a[:, None] + t[:, None] * (b - a)[:, None]).reshape(-1, judge.dof)).reshape(len(a), -1)
    assert not hits[verdicts == "free"].any(), f"seed {seed}"
    for k in np.flatnonzero(verdicts == "colliding"):
        row = rows[k]
        found = judge.pairs(a[k] + row["parameter"] * (b[k] - a[k]), within=1e-9)
        assert (row["i"], row["j"]) in set(zip(found["i"].tolist(), found["j"].tolist())), f"seed {seed}, path {k}"
        assert row["half_width"] == 0.0
    for row, other in zip(rows, checker.certify(a, b, threads=1)):
        assert row == other


@pytest.mark.parametrize("kind", KINDS)
def test_sampled_paths_agree_with_states_along_the_path(kind):
    rng = np.random.default_rng(7)
    checker = hinge.Checker(*balanced(rng, kind))
    a, b = paths_of(rng, checker, 30)
    rows = checker.certify(a, b, resolution=0.01)
    for k, row in enumerate(rows):
        steps = max(1, int(np.ceil(np.abs(b[k] - a[k]).max() / 0.01)))
        t = np.linspace(0.0, 1.0, steps + 1)[:, None]
        hits = checker.collides(a[k] + t * (b[k] - a[k]))
        assert (row["verdict"] == "colliding") == hits.any(), k
        assert row["states"] <= steps + 1
    assert set(rows["verdict"]) == {"free", "colliding"}


def test_one_start_for_many_ends():
    rng = np.random.default_rng(8)
    checker = hinge.Checker(random_model(rng, "sphere", links=5, each=1), 0.05)
    a, b = paths_of(rng, checker, 8)
    many = checker.certify(np.tile(a[0], (8, 1)), b)
    assert np.array_equal(checker.certify(a[0], b), many)
    assert checker.certify(a[0], b[0]).shape == (1,)
    with pytest.raises(ValueError, match="a and b: 3 and 8 configurations"):
        checker.certify(a[:3], b)
    with pytest.raises(ValueError, match="smallest_step: 0, expected"):
        checker.certify(a, b, smallest_step=0)
    with pytest.raises(TypeError, match="resolution: a str, expected a number"):
        checker.certify(a, b, resolution="fine")


def two_models(rng, kind, engine="simd"):
    """Two models, their rules, and one model of both trees in which only pairs across are tested."""
    parts = [random_model(rng, kind, links=4, each=4) for _ in range(2)]
    types = [rng.integers(0, 3, m.n_primitives) for m in parts]
    groups = [rng.integers(0, 3, m.n_primitives) for m in parts]
    table = rng.uniform(0, 0.35 if kind == "point" else 0.2, (3, 3))
    table = (table + table.T) / 2
    checkers = [
        hinge.Checker(m, table, types=t, groups=g, engine=engine, threads=2) for m, t, g in zip(parts, types, groups)
    ]
    return parts, checkers, types, groups, table


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", ["point", "sphere"])
@pytest.mark.parametrize("seed", SEEDS)
def test_two_models_of_balls_agree_with_numpy(kind, seed, engine):
    rng = np.random.default_rng(300 + seed)
    (m1, m2), (c1, c2), types, groups, table = two_models(rng, kind, engine)
    q1, q2 = rng.normal(0, 2, (200, c1.dof)), rng.normal(0, 2, (200, c2.dof))
    x1, x2 = placed(m1, c1, q1)[:, :, 0], placed(m2, c2, q2)[:, :, 0]
    gap = np.linalg.norm(x1[:, :, None] - x2[:, None], axis=-1) - m1.radii[:, None] - m2.radii
    gap = np.maximum(gap, 0)
    admitted = rng.random((3, 3)) < 0.6  # not symmetric
    exclude = np.stack([rng.integers(0, m.n_primitives, 30) for m in (m1, m2)], axis=1)
    seen = set()
    for rules in ({}, {"admitted": admitted}, {"exclude": exclude}, {"admitted": admitted, "exclude": exclude}):
        asked = np.ones(gap.shape[1:], bool)
        if "admitted" in rules:
            asked &= admitted[groups[0][:, None], groups[1]]
        if "exclude" in rules:
            asked[exclude[:, 0], exclude[:, 1]] = False
        threshold = table[types[0][:, None], types[1]]
        for within in (0.0, 0.15):
            expected = np.argwhere((gap < threshold + within) & asked)
            pairs = c1.pairs_with(c2, q1, q2, within=within, **rules)
            assert np.array_equal(np.stack([pairs["configuration"], pairs["i"], pairs["j"]], axis=1), expected)
            assert np.allclose(pairs["distance"], gap[tuple(expected.T)], atol=1e-12)
        hits = ((gap < threshold) & asked).any((1, 2))
        assert np.array_equal(c1.collides_with(c2, q1, q2, **rules), hits), f"seed {seed}"
        seen |= set(hits.tolist())
        assert len(expected) > 0 or rules
        closest = c1.closest_with(c2, q1, q2, **rules)
        margin = np.where(asked, gap - threshold, np.inf).reshape(len(q1), -1).min(1)
        assert np.allclose(closest["distance"] - closest["threshold"], margin, atol=1e-12)
        turned = c2.pairs_with(c1, q2, q1) if not rules else None
        if turned is not None:
            mirror = np.lexsort((turned["i"], turned["j"], turned["configuration"]))
            straight = c1.pairs_with(c2, q1, q2)
            assert np.array_equal(turned["j"][mirror], straight["i"])
            assert np.array_equal(turned["i"][mirror], straight["j"])
    assert True in seen or kind == "point"


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
def test_two_models_agree_with_one_of_both_trees(kind, seed):
    rng = np.random.default_rng(400 + seed)
    (m1, m2), (c1, c2), types, _, table = two_models(rng, kind)
    both = hinge.Model(
        [*m1._parents, *(0 if p == 0 else p + m1.n_links - 1 for p in m2._parents)],
        [*m1._joints, *m2._joints],
        axes=np.vstack([m1._axes, m2._axes]),
        points=np.vstack([m1._points, m2._points]),
        origins=np.concatenate([m1._origins, m2._origins]),
    )
    shift = np.where(m2.links == 0, 0, m2.links + m1.n_links - 1)
    add = {
        "point": lambda where, m: both.add_points(where, m.corners),
        "sphere": lambda where, m: both.add_spheres(where, m.corners, m.radii),
        "capsule": lambda where, m: both.add_capsules(where, m.corners[:, :3], m.corners[:, 3:], m.radii),
        "triangle": lambda where, m: both.add_triangles(where, m.corners.reshape(-1, 3, 3)),
    }[kind]
    add(m1.links, m1), add(shift, m2)
    sides = np.repeat([0, 1], [m1.n_primitives, m2.n_primitives])
    rules = {"groups": sides, "admitted": np.array([[False, True], [True, False]]), "engine": "brute"}
    judge = hinge.Checker(both, table, types=np.concatenate(types), **rules)
    q1, q2 = rng.normal(0, 2, (25, c1.dof)), rng.normal(0, 2, (25, c2.dof))
    # Of one model, pairs at a constant distance are left out; two models test them.
    expected = judge.pairs(np.hstack([q1, q2]), within=0.1)
    pairs = c1.pairs_with(c2, q1, q2, within=0.1)
    fixed = [_stands(m) for m in (m1, m2)]
    moves = ~(fixed[0][pairs["i"]] & fixed[1][pairs["j"]])
    got = pairs[moves]
    assert len(got) > 0
    assert np.array_equal(got["configuration"], expected["configuration"]), f"seed {seed}"
    assert np.array_equal(got["i"], expected["i"])
    assert np.array_equal(got["j"] + m1.n_primitives, expected["j"])
    assert np.allclose(got["distance"], expected["distance"], atol=1e-12)


def _stands(model):
    """Which primitives no joint moves."""
    still = [True]
    for parent, joint in zip(model._parents, model._joints):
        still.append(still[parent] and joint == "fixed")
    return np.array(still)[model.links]


def test_one_configuration_of_two_models():
    rng = np.random.default_rng(9)
    _, (c1, c2), *_ = two_models(rng, "sphere")
    q1, q2 = rng.normal(0, 2, (10, c1.dof)), rng.normal(0, 2, (10, c2.dof))
    answers = [c1.collides_with(c2, a, b) for a, b in zip(q1, q2)]
    assert all(type(answer) is bool for answer in answers)
    assert answers == c1.collides_with(c2, q1, q2).tolist()
    assert np.array_equal(c1.collides_with(c2, q1[0], q2), c1.collides_with(c2, np.tile(q1[0], (10, 1)), q2))
    assert c1.collides_with(c1, q1, q1).all()


def test_bad_arguments_of_two_models():
    rng = np.random.default_rng(10)
    (m1, _), (c1, c2), *_ = two_models(rng, "sphere")
    points = random_model(rng, "point")
    q1, q2 = np.zeros(c1.dof), np.zeros(c2.dof)
    for other, more, error, message in (
        (m1, {}, TypeError, "other: a Model, expected a Checker"),
        (hinge.Checker(points), {}, ValueError, "other: points with engine 'simd', expected spheres with 'simd'"),
        (hinge.Checker(m1, 0.1), {}, hinge.ModelError, "different distance matrices"),
        (c2, {"exclude": [(0, 99)]}, IndexError, "exclude: 99 to 99, expected 0 to"),
        (c2, {"exclude": [0, 1]}, ValueError, r"exclude: shape \(2,\), expected \(m, 2\)"),
        (c2, {"admitted": [1, 0]}, ValueError, "admitted: int64 of shape"),
        (c2, {"admitted": [[True]]}, ValueError, "admitted: group . has no row or column"),
    ):
        with pytest.raises(error, match=message):
            c1.collides_with(other, q1, q2 if other is c2 else np.zeros(other.dof if other is not m1 else 1), **more)
    with pytest.raises(ValueError, match="q and q_other: 2 and 3 configurations"):
        c1.collides_with(c2, np.zeros((2, c1.dof)), np.zeros((3, c2.dof)))
