# SPDX-License-Identifier: BSD-3-Clause
"""Models from arrays, compared with NumPy."""

import pickle

import numpy as np
import pytest

import hinge

ENGINES = ("simd", "lazy", "brute")
SEEDS = range(6)


def random_model(rng, kind, links=8, each=5):
    """A tree of links with primitives of one kind."""
    parents = [int(rng.integers(0, k + 1)) for k in range(links)]
    joints = [str(rng.choice(["revolute", "prismatic", "fixed"], p=[0.7, 0.2, 0.1])) for _ in range(links)]
    origins = np.tile(np.eye(4), (links, 1, 1))
    origins[:, :3, 3] = rng.normal(0.0, 0.7, (links, 3))
    model = hinge.Model(
        parents, joints, axes=rng.normal(size=(links, 3)), points=rng.normal(0, 0.1, (links, 3)), origins=origins
    )
    where = rng.integers(0, links + 1, links * each)
    x = rng.normal(0.0, 0.4, (len(where), 3, 3))
    if kind == "point":
        model.add_points(where, x[:, 0])
    elif kind == "sphere":
        model.add_spheres(where, x[:, 0], rng.uniform(0, 0.2, len(where)))
    elif kind == "capsule":
        model.add_capsules(where, x[:, 0], x[:, 1], rng.uniform(0, 0.1, len(where)))
    else:
        model.add_triangles(where, x)
    return model


def placed(model, checker, q):
    """World coordinates of the primitives' corners, shape (n, primitives, corners, 3), from the links' poses."""
    poses = checker.link_poses(q)[:, model.links]
    corners = model.corners.reshape(model.n_primitives, -1, 3)
    return np.einsum("npij,pcj->npci", poses[..., :3, :3], corners) + poses[..., None, :3, 3]


def moving(model):
    """Pairs of primitives whose distance can change: on links with a joint that moves between them."""
    body = [0]
    for k, (parent, joint) in enumerate(zip(model._parents, model._joints)):
        body.append(body[parent] if joint == "fixed" else k + 1)
    body = np.array(body)[model.links]
    return body[:, None] != body[None, :]


def segment_distances(a, b, c, d):
    """Distances of segments a-b and c-d, by sampling one and solving the other; an upper bound within 1e-3."""
    t = np.linspace(0.0, 1.0, 400)
    p = a[..., None, :] + t[:, None] * (b - a)[..., None, :]
    direction = (d - c)[..., None, :]
    s = ((p - c[..., None, :]) * direction).sum(-1) / np.maximum((direction**2).sum(-1), 1e-300)
    nearest = c[..., None, :] + np.clip(s, 0, 1)[..., None] * direction
    return np.linalg.norm(p - nearest, axis=-1).min(-1)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("kind", ["point", "sphere"])
@pytest.mark.parametrize("seed", SEEDS)
def test_balls_agree_with_numpy(kind, seed, engine):
    rng = np.random.default_rng(seed)
    model = random_model(rng, kind)
    n = model.n_primitives
    types = rng.integers(0, 3, n)
    table = rng.uniform(0, 0.3, (3, 3))
    table = (table + table.T) / 2
    admitted = rng.random((4, 4)) < 0.8
    admitted = admitted | admitted.T
    groups = rng.integers(0, 4, n)
    exclude = rng.integers(0, n, (40, 2))
    exclude = exclude[exclude[:, 0] != exclude[:, 1]]
    checker = hinge.Checker(
        model, table, types=types, exclude=exclude, groups=groups, admitted=admitted, engine=engine, threads=2
    )
    q = rng.normal(0.0, 2.0, (50, checker.dof))
    x = placed(model, checker, q)[:, :, 0]
    gap = np.linalg.norm(x[:, :, None] - x[:, None], axis=-1) - model.radii[:, None] - model.radii[None]
    asked = moving(model) & admitted[groups[:, None], groups[None]] & np.triu(np.ones((n, n), bool), 1)
    asked[exclude[:, 0], exclude[:, 1]] = asked[exclude[:, 1], exclude[:, 0]] = False
    threshold = table[types[:, None], types[None]]
    for within in (0.0, 0.2):
        expected = np.argwhere((np.maximum(gap, 0) < threshold + within) & asked)
        pairs = checker.pairs(q, within=within)
        got = np.stack([pairs["configuration"], pairs["i"], pairs["j"]], axis=1)
        assert np.array_equal(got, expected), f"seed {seed}"
        if within == 0.0:
            assert np.array_equal(checker.collides(q), np.bincount(expected[:, 0], minlength=50) > 0)
        assert np.allclose(pairs["distance"], np.maximum(gap, 0)[tuple(expected.T)], atol=1e-12)
        assert np.array_equal(pairs["threshold"], threshold[pairs["i"], pairs["j"]])
    closest = checker.closest(q)
    margin = np.where(asked, np.maximum(gap, 0) - threshold, np.inf).reshape(len(q), -1).min(1)
    assert np.allclose(closest["distance"] - closest["threshold"], margin, atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_capsules_agree_with_numpy(seed):
    rng = np.random.default_rng(seed)
    model = random_model(rng, "capsule", links=5, each=3)
    checker = hinge.Checker(model, 0.05)
    q = rng.normal(0.0, 2.0, (10, checker.dof))
    x = placed(model, checker, q)
    ends = x[:, :, None], x[:, None]
    distance = segment_distances(ends[0][..., 0, :], ends[0][..., 1, :], ends[1][..., 0, :], ends[1][..., 1, :])
    gap = np.maximum(distance - model.radii[:, None] - model.radii[None], 0.0)
    asked = moving(model) & np.triu(np.ones(gap.shape[1:], bool), 1)
    got = np.zeros(gap.shape, bool)
    pairs = checker.pairs(q)
    got[pairs["configuration"], pairs["i"], pairs["j"]] = True
    sure = np.abs(gap - 0.05) > 3e-3
    assert np.array_equal(got & sure, (gap < 0.05) & asked & sure), f"seed {seed}"


@pytest.mark.parametrize("kind", ["point", "sphere", "capsule", "triangle"])
@pytest.mark.parametrize("seed", SEEDS)
def test_engines_agree(kind, seed):
    rng = np.random.default_rng(100 + seed)
    model = random_model(rng, kind)
    checkers = [hinge.Checker(model, 0.1, engine=engine) for engine in ENGINES]
    q = rng.normal(0.0, 2.0, (20, checkers[0].dof))
    answers = [(c.collides(q), c.pairs(q, within=0.1), c.closest(q)) for c in checkers]
    for hits, pairs, closest in answers[1:]:
        assert np.array_equal(hits, answers[0][0])
        assert np.array_equal(pairs, answers[0][1]), f"seed {seed}"
        assert np.allclose(closest["distance"], answers[0][2]["distance"], atol=1e-12)


def test_the_arm_of_the_readme():
    elbow = np.eye(4)
    elbow[0, 3] = 0.5
    model = hinge.Model([0, 1], origins=[np.eye(4), elbow], names=["shoulder", "elbow"])
    assert model.add_spheres(1, [[0, 0, 0], [0.4, 0, 0]], 0.1).tolist() == [0, 1]
    assert model.add_spheres(2, [[0.4, 0, 0]], [0.1]).tolist() == [2]
    arm = hinge.Checker(model, 0.05)
    assert arm.collides([0.0, 3.0]) is True
    assert arm.collides([[0.0, 3.0], [0.0, 0.0]]).tolist() == [True, False]
    assert repr(model) == "<Model: 3 links, 2 joints that move, 3 spheres>"
    assert "3 spheres" in repr(arm)


def test_points_spheres_and_capsules_mix():
    rng = np.random.default_rng(3)
    mixed, capsules = (hinge.Model([0, 1], axes=[[0, 0, 1], [0, 1, 0]]) for _ in range(2))
    x = rng.normal(size=(12, 3))
    mixed.add_points(1, x[:3])
    mixed.add_spheres(2, x[3:6], 0.2)
    mixed.add_capsules([0, 1, 2], x[6:9], x[9:], 0.1)
    capsules.add_capsules(
        [1] * 3 + [2] * 3 + [0, 1, 2], x[:9], np.concatenate([x[:6], x[9:]]), [0.0] * 3 + [0.2] * 3 + [0.1] * 3
    )
    assert mixed.kind == "capsule"
    q = rng.normal(0, 3, (30, 2))
    assert np.array_equal(hinge.Checker(mixed, 0.1).pairs(q), hinge.Checker(capsules, 0.1).pairs(q))
    with pytest.raises(ValueError, match="triangles cannot be mixed"):
        mixed.add_triangles(1, np.zeros((1, 3, 3)))
    assert mixed.n_primitives == 9


def test_free_joints():
    rng = np.random.default_rng(5)
    model = random_model(rng, "sphere")
    all_free, some = hinge.Checker(model, 0.1), hinge.Checker(model, 0.1, free=[1, 3])
    q = np.zeros((10, all_free.dof))
    q[:, [1, 3]] = rng.normal(0, 2, (10, 2))
    assert some.dof == 2
    assert np.allclose(some.link_poses(q[:, [1, 3]]), all_free.link_poses(q))
    constant = {(row["i"], row["j"]) for row in some.constant_contacts}
    wide = {(k, i, j) for k, i, j in all_free.pairs(q)[["configuration", "i", "j"]].tolist() if (i, j) not in constant}
    assert {(k, i, j) for k, i, j in some.pairs(q[:, [1, 3]])[["configuration", "i", "j"]].tolist()} == wide


def test_pickling():
    model = random_model(np.random.default_rng(7), "sphere")
    checker = hinge.Checker(model, 0.1, exclude=[(0, 1)], threads=2)
    again = pickle.loads(pickle.dumps(checker))
    q = np.random.default_rng(8).normal(size=(20, checker.dof))
    assert np.array_equal(again.pairs(q), checker.pairs(q))
    assert again.threads == 2


@pytest.mark.parametrize(
    "make, error, message",
    [
        (lambda: hinge.Model([1]), IndexError, "parents: 1 to 1, expected 0 to 0"),
        (lambda: hinge.Model([0, 0, 3]), IndexError, "parents"),
        (lambda: hinge.Model([0, 2, 0]), ValueError, r"parents\[1\] is 2, expected 0 to 1"),
        (lambda: hinge.Model([0], "hinge"), ValueError, "joints: 'hinge', expected fixed, revolute or prismatic"),
        (lambda: hinge.Model([0], axes=[[1, 0]]), ValueError, r"axes: shape \(1, 2\), expected \(1, 3\) or \(3,\)"),
        (lambda: hinge.Model([0], axes=(np.nan, 0, 1)), ValueError, "axes: contains nan, expected finite numbers"),
        (lambda: hinge.Model([0], axes=["z"]), TypeError, "axes: an array of <U1, expected real numbers"),
        (lambda: one().add_points(5, [[0, 0, 0]]), IndexError, "links: 5 to 5, expected 0 to 1"),
        (lambda: one().add_points(0.5, [[0, 0, 0]]), TypeError, "links: an array of float64, expected integers"),
        (lambda: one().add_spheres(1, [[0, 0, 0]], -1), ValueError, "radii: -1.0, expected at least 0"),
        (lambda: hinge.Checker(one()), ValueError, "model: 0 primitives"),
        (lambda: hinge.Checker("arm"), TypeError, "model: a str, expected a Model"),
        (lambda: hinge.Checker(ball(), -1.0), hinge.ModelError, "is -1, expected a finite length >= 0"),
        (lambda: hinge.Checker(ball(), [[0, 1], [0, 0]], types=[0]), hinge.ModelError, "mirror"),
        (lambda: hinge.Checker(ball(), [[0.0]]), ValueError, "types: None"),
        (lambda: hinge.Checker(ball(), exclude=[(0, 1)]), IndexError, "exclude"),
        (lambda: hinge.Checker(ball(), engine="fast"), hinge.ModelError, "expected simd, lazy or brute"),
        (lambda: hinge.Checker(ball(), free=[2]), IndexError, "free: 2 to 2, expected 0 to 0"),
        (lambda: hinge.Checker(ball(), free=[0, 0]), hinge.ModelError, "selected twice"),
        (lambda: hinge.Checker(ball(), admitted=[[1]]), ValueError, "admitted"),
        (lambda: hinge.Checker(ball(axes=(0, 0, 0))), hinge.ModelError, "axis"),
    ],
)
def test_bad_arguments(make, error, message):
    with pytest.raises(error, match=message):
        make()


def one(**more):
    return hinge.Model([0], **more)


def ball(**more):
    model = one(**more)
    model.add_spheres(1, [[0, 0, 0]], 0.1)
    return model
