# SPDX-License-Identifier: BSD-3-Clause
"""Bad arguments of hinge.robotics are refused by name, and nothing crashes."""

import numpy as np
import pytest

import hinge
import hinge.robotics as hr
from robot_cases import ARM

SEED = 4217


@pytest.fixture(scope="module")
def robot():
    return hr.Robot.from_urdf(ARM, srdf=ARM.with_suffix(".srdf"))


@pytest.fixture(scope="module")
def world():
    made = hr.Environment()
    made.add(hr.Box((1, 2, 0.05)), (0.5, 0, -0.1), "table")
    made.add(hr.Sphere(0.1), (0.4, 0.2, 0.5), "ball")
    return made


@pytest.fixture(scope="module")
def checker(robot, world):
    return hr.Checker(robot, environment=world)


@pytest.mark.parametrize(
    "q, error, text",
    [
        (np.zeros(5), ValueError, r"q: shape \(5,\), expected \(n, 6\) or \(6,\)"),
        (np.zeros((2, 7)), ValueError, r"q: shape \(2, 7\)"),
        (np.zeros((2, 2, 6)), ValueError, r"q: shape \(2, 2, 6\)"),
        (np.zeros(()), ValueError, r"q: shape \(\)"),
        (None, TypeError, "q: None, expected an array of real numbers"),
        ("home", TypeError, "q: "),
        (np.zeros(6, complex), TypeError, "q: an array of complex128"),
        (np.zeros(6, bool), TypeError, "q: an array of bool"),
        ([[0.0] * 6, [0, 0, 0, np.nan, 0, 0]], ValueError, r"q\[1, 3\] is nan"),
        ([0, 0, np.inf, 0, 0, 0], ValueError, r"q\[2\] is inf"),
        (np.full((3, 6), 1e305), ValueError, r"q\[0\]: "),
    ],
)
def test_bad_configurations_are_refused(checker, q, error, text):
    for call in (
        checker.collides,
        checker.pairs,
        checker.closest,
        checker.link_poses,
        checker.contained,
        lambda x: checker.distances(x, within=0.1),
    ):
        with pytest.raises(error, match=text):
            call(q)


def test_arrays_need_not_be_float64_in_c_order(checker, robot):
    q = robot.sample(20)
    expected = checker.collides(q)
    assert np.array_equal(checker.collides(np.asfortranarray(q)), expected)
    assert np.array_equal(checker.collides(np.repeat(q, 2, axis=0)[::2]), expected)
    assert np.array_equal(checker.collides(q.tolist()), expected)
    assert np.array_equal(checker.collides(q.astype(">f8")), expected)
    checker.collides(q.astype(np.float32))
    read_only = q.copy()
    read_only.flags.writeable = False
    assert np.array_equal(checker.collides(read_only), expected)


@pytest.mark.parametrize(
    "call, error, text",
    [
        (lambda c, q: c.collides(q, against="me"), ValueError, "against: 'me', expected 'all', 'self' or 'env"),
        (lambda c, q: c.pairs(q, within=-1), ValueError, "within: -1.0"),
        (lambda c, q: c.pairs(q, within=np.nan), ValueError, "within: nan"),
        (lambda c, q: c.distances(q), TypeError, "within"),
        (lambda c, q: c.collides(q, threads=0), ValueError, "threads: 0"),
        (lambda c, q: c.collides(q, threads=1.5), TypeError, "threads: expected an integer"),
        (lambda c, q: c.collides(q, progress=3), TypeError, "progress: "),
        (lambda c, q: c.certify(q[0], q[1], smallest_step=0), ValueError, "smallest_step: 0"),
        (lambda c, q: c.certify(q[0], q[1], resolution=-1), ValueError, "resolution: -1"),
        (lambda c, q: c.certify(q, q[:2]), ValueError, "a and b: 5 and 2 configurations"),
        (lambda c, q: c.check_path(q[:1]), ValueError, "waypoints: shape"),
        (lambda c, q: c.colliding_links(q), ValueError, "q: shape"),
        (lambda c, q: c.allow("hand", "nothing"), hinge.ModelError, "a, b: 'hand', 'nothing'"),
        (lambda c, q: c.attach("hand", "nothing"), hinge.ModelError, "name: no body 'nothing'"),
        (lambda c, q: c.attach(3, "ball"), TypeError, "link: a int, expected a str"),
        (lambda c, q: c.detach("ball"), hinge.ModelError, "not attached"),
        (lambda c, q: hr.Checker(c), TypeError, "robot: a Checker, expected a Robot"),
        (lambda c, q: hr.Checker(c.robot, clearance=-1), ValueError, "clearance: -1"),
        (lambda c, q: hr.Checker(c.robot, clearance="1"), TypeError, "clearance: a str"),
        (lambda c, q: hr.Checker(c.robot, engine="fast"), ValueError, "engine: 'fast'"),
        (lambda c, q: hr.Checker(c.robot, disable=[("hand", "nose")]), hinge.ModelError, "disable: .* 'nose'"),
        (lambda c, q: hr.Checker(c.robot, disable="hand"), TypeError, "disable: a str"),
        (lambda c, q: hr.Checker(c.robot, disable=["hand"]), ValueError, "disable: 'hand', expected a pair"),
        (lambda c, q: hr.Checker(c.robot, pair_clearances={("hand", "nose"): 1}), hinge.ModelError, "pair_clearances: "),
        (lambda c, q: hr.Checker(c.robot, environment=3), TypeError, "environment: a int"),
        (lambda c, q: hr.Checker(c.robot, engine="lazy", environment=c.environment), hinge.ModelError, "environment: "),
        (lambda c, q: hr.Checker(c.robot, base=np.ones((4, 4))), ValueError, "base: the last row"),
        (lambda c, q: hr.Checker(c.robot, base=np.diag([1.0, 2, 1, 1])), hinge.ConfigurationError, "base"),
        (lambda c, q: hr.Checker(c.robot, threads=-1), ValueError, "threads: -1"),
        (lambda c, q: c.environment.add("box"), TypeError, "shape: a str, expected a Shape"),
        (lambda c, q: c.environment.add(hr.Sphere(1), name="table"), hinge.ModelError, "name: 'table'"),
        (lambda c, q: c.environment.add(hr.Sphere(1), np.eye(3)), ValueError, r"pose: shape \(3, 3\)"),
        (lambda c, q: c.environment.add(hr.Sphere(1), (0, 0, np.nan)), ValueError, r"pose\[2, 3\] is nan"),
        (lambda c, q: c.environment.set_pose("table", -np.eye(4)), ValueError, "pose: the last row"),
        (lambda c, q: c.environment.set_pose("table", np.diag([1.0, 1, -1, 1])), hinge.ConfigurationError, "table"),
        (lambda c, q: c.environment.allow("table", c.robot, ["nose"]), hinge.ModelError, "links: .* 'nose'"),
        (lambda c, q: c.environment.allow("table", c, "hand"), TypeError, "robot: a Checker"),
        (lambda c, q: hr.Environment(-1), ValueError, "clearance: -1"),
        (lambda c, q: hr.Environment(engine="fast"), ValueError, "engine: 'fast'"),
        (lambda c, q: hr.Shape(), TypeError, "expected one of Box"),
        (lambda c, q: hr.Box((1, 2)), ValueError, r"size: shape \(2,\), expected \(3,\)"),
        (lambda c, q: hr.Box((1, 2, -3)), hinge.ModelError, "box of size"),
        (lambda c, q: hr.Sphere(-1), hinge.ModelError, "sphere of radius -1"),
        (lambda c, q: hr.Sphere(np.nan), ValueError, "radius: nan"),
        (lambda c, q: hr.Sphere("1"), TypeError, "radius: a str"),
        (lambda c, q: hr.Capsule(1, np.inf), ValueError, "length: inf"),
        (lambda c, q: hr.Mesh(np.zeros((3, 2)), [[0, 1, 2]]), ValueError, "vertices: shape"),
        (lambda c, q: hr.Mesh(np.zeros((3, 3)), [[0, 1, 3]]), IndexError, r"faces\[2\] is 3"),
        (lambda c, q: hr.Mesh(np.zeros((3, 3)), [[0, 1, -1]]), IndexError, "faces"),
        (lambda c, q: hr.Mesh(np.zeros((3, 3)), [[0.0, 1, 2]]), TypeError, "faces: expected an array of integers"),
        (lambda c, q: hr.Mesh(np.zeros((3, 3)), [0, 1, 2]), ValueError, "faces: 1 dimensions"),
        (lambda c, q: hr.Mesh(np.full((1, 3, 3), np.nan)), ValueError, r"vertices\[0, 0, 0\] is nan"),
        (lambda c, q: hr.Mesh(np.zeros((0, 3, 3))), hinge.ModelError, "mesh: has no triangles"),
        (lambda c, q: hr.Mesh(np.zeros((1, 3, 3)), scale=0), hinge.ModelError, "scale"),
        (lambda c, q: hr.Mesh(np.zeros((1, 3, 3)), scale=(1, 2)), ValueError, "scale: shape"),
        (lambda c, q: hr.Mesh.read("nothing.stl"), hinge.LoadError, "nothing.stl"),
        (lambda c, q: hr.Mesh.read(3), TypeError, "file: a int, expected a path"),
        (lambda c, q: hr.PointCloud(np.zeros((0, 3)), 1), hinge.ModelError, "point cloud without points"),
        (lambda c, q: hr.PointCloud(np.zeros((4, 2)), 1), ValueError, "points: shape"),
        (lambda c, q: hr.PointCloud(np.zeros((4, 3)), -1), hinge.ModelError, "radius"),
        (lambda c, q: hr.pose((0, 0)), ValueError, "xyz: shape"),
        (lambda c, q: hr.pose(rpy=(0, 0, np.inf)), ValueError, r"rpy\[2\] is inf"),
        (lambda c, q: hr.Robot([]), hinge.ModelError, "no links"),
        (lambda c, q: hr.Robot("arm.urdf"), TypeError, r"links: a str, .* Robot.from_urdf\(\) reads a file"),
        (lambda c, q: hr.Robot([3]), TypeError, "links: a int, expected a Link"),
        (lambda c, q: hr.Robot([hr.Link("a", [3])]), TypeError, "links: link 'a' has a int"),
        (lambda c, q: hr.Robot(["a"], [3]), TypeError, "joints: a int, expected a Joint"),
        (lambda c, q: hr.Robot(["a", "b"]), hinge.ModelError, "'a'|'b'"),
        (lambda c, q: hr.Robot(["a", "b"], [hr.Joint("j", "bent", "a", "b")]), ValueError, "joint 'j': type: 'bent'"),
        (lambda c, q: hr.Robot(["a", "b"], [hr.Joint("j", "fixed", "a", "c")]), hinge.ModelError, "'c'"),
        (
            lambda c, q: hr.Robot(["a", "b"], [hr.Joint("j", "revolute", "a", "b", axis=(0, 0, 0))]),
            hinge.ModelError,
            "axis",
        ),
        (
            lambda c, q: hr.Robot(["a", "b"], [hr.Joint("j", "revolute", "a", "b", lower=1)]),
            hinge.ModelError,
            "lower|limit",
        ),
        (lambda c, q: hr.Robot.from_urdf("nothing.urdf"), hinge.LoadError, "nothing.urdf"),
        (lambda c, q: hr.Robot.from_urdf(3), TypeError, "urdf: a int, expected a path"),
        (lambda c, q: hr.Robot.from_urdf("<robot"), hinge.LoadError, "urdf text"),
        (lambda c, q: hr.Robot.from_urdf(ARM, primitives="fine"), ValueError, "primitives: 'fine'"),
        (lambda c, q: hr.Robot.from_urdf(ARM, srdf="<robot/"), hinge.LoadError, "srdf text"),
        (lambda c, q: hr.Robot.from_urdf(ARM, tolerance=0), hinge.Error, "toleran"),
        (lambda c, q: c.robot.sample(-1), ValueError, "n: -1"),
        (lambda c, q: c.robot.sample(2.5), TypeError, "n: a float"),
        (lambda c, q: c.robot.sample(2, -1), ValueError, "seed: -1"),
        (lambda c, q: c.robot.state("arm/nowhere"), hinge.ModelError, "expected one of arm/home, arm/reach"),
        (lambda c, q: c.robot.spheres, hinge.ModelError, "sphere"),
        (lambda c, q: c.robot.to_columns(q, ["nose"]), ValueError, "no joint 'nose'"),
        (lambda c, q: hr.CollisionMatrix(c), TypeError, "robot: a Checker"),
        (lambda c, q: hr.CollisionMatrix(c.robot, samples=-1), ValueError, "samples: -1"),
        (lambda c, q: hr.CollisionMatrix(c.robot, clearance=-1), ValueError, "clearance: -1"),
        (lambda c, q: c.collides_with(c.robot, q, q), TypeError, "incompatible"),
    ],
)
def test_bad_arguments_name_the_argument(checker, robot, call, error, text):
    with pytest.raises(error, match=text):
        call(checker, robot.sample(5))


def test_fuzz_of_arguments_never_crashes(robot):
    random = np.random.default_rng(SEED)
    odd = [None, "x", b"x", -1, 0, 1.5, np.nan, np.inf, [], (), {}, np.eye(4), np.zeros((2, 6)), np.zeros(6), object(),
           "hand", "table", hr.Sphere(0.1), ["hand"], [("hand", "wrist")], np.zeros((3, 3)), True, 2**70, 1j,
           np.array(["a"]), np.array([None] * 6), np.zeros((1, 3, 3)), robot, lambda *a: None]
    world = hr.Environment()
    world.add(hr.Box((1, 1, 0.1)), (0, 0, -2), "table")
    c = hr.Checker(robot, environment=world)
    calls = [c.collides, c.pairs, c.closest, c.distances, c.clearances, c.distance, c.relax, c.plan, c.certify, c.check_path, c.link_poses,
             c.contained, c.attach, c.detach, c.allow, c.colliding_links, c.calibrate, c.collides_with, c.closest_with,
             world.add,
             world.attach, world.detach, world.allow, world.set_pose, world.remove, world.pose, hr.Box, hr.Sphere,
             hr.Capsule, hr.Mesh, hr.PointCloud, hr.pose, hr.Robot, hr.Link, hr.Environment, hr.Checker, robot.sample,
             robot.expand, robot.columns, robot.from_columns, robot.to_columns, robot.with_tiers, robot.state]
    keywords = ["threads", "progress", "within", "influence", "against", "name", "pose", "may_touch", "solid", "scale", "base"]
    refused = 0
    for _ in range(4000):
        call = calls[random.integers(len(calls))]
        arguments = [odd[random.integers(len(odd))] for _ in range(random.integers(4))]
        key, value = keywords[random.integers(len(keywords))], odd[random.integers(len(odd))]
        more = {key: value} if random.random() < 0.3 else {}
        if call is robot.sample and any(isinstance(a, int) and a > 100 for a in arguments):
            continue
        try:
            call(*arguments, **more)
        except (TypeError, ValueError, IndexError, hinge.Error, AttributeError):
            refused += 1
    assert refused > 3000, f"seed {SEED}"
    assert c.collides(np.zeros(6)) in (True, False)
