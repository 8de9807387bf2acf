# SPDX-License-Identifier: BSD-3-Clause
"""Every answer of hinge.robotics equals the command line's."""

import numpy as np
import pytest

import hinge.robotics as hr
from conftest import ROOT
from robot_cases import ROBOTS, near_rows, options_of, pair_rows, robocd, run_robocd, told, urdf_of

names = pytest.mark.parametrize("name", ROBOTS)
N = 40
SHELF = ROOT / "robotics/data/shelf.obj"


@pytest.fixture(scope="module")
def robots():
    cache = {}

    def get(name):
        if name not in cache:
            cache[name] = hr.Robot.from_urdf(urdf_of(name), **options_of(name))
        return cache[name]

    return get


@names
def test_info(robots, name):
    info = robocd("info", name)
    robot = robots(name)
    c = hr.Checker(robot)
    facts = info["robot"]
    assert robot.name == facts["name"]
    assert (len(robot.links), robot.dof, len(robot.movable_joints)) == (
        facts["links"],
        facts["dof"],
        facts["movable_joints"],
    )
    assert robot.links["triangles"].sum() == facts["triangles"]
    assert len(np.unique(robot.links["group"])) == facts["rigid_groups"]
    for row, link in zip(robot.links, info["links"]):
        assert (row["name"], row["group"], row["triangles"]) == (link["name"], link["group"], link["triangles"])
        assert (row["degenerate"], row["rounded"]) == (link["degenerate_triangles"], link["rounded"])
        assert bool(row["closed"]) == bool(link["closed"])
    for row, joint in zip(robot.joints, info["joints"]):
        assert [str(row[f]) for f in ("name", "type", "parent", "child")] == [
            joint[f] for f in ("name", "type", "parent", "child")
        ]
        if joint["lower"] is not None:
            assert (row["lower"], row["upper"]) == (joint["lower"], joint["upper"])
        assert row["mimic"] == (joint["mimic"]["joint"] if joint["mimic"] else "")
    assert c.tested_pairs == [(p["link1"], p["link2"]) for p in info["tested_pairs"]]
    assert len(robot.disabled_pairs) == facts["disabled_pairs"]
    assert robot.notes == info["notes"]
    for state in info["states"]:
        q = robot.states[state["state"]]
        assert {joint: q[robot.joint_names.index(joint)] for joint in state["values"]} == state["values"]


@names
def test_random_configurations_and_verdicts(robots, name):
    expected = robocd("check", name, "--random", N, "--seed", 7)["configurations"]
    robot = robots(name)
    q = robot.sample(N, 7)
    assert q.tolist() == [row["values"] for row in expected]
    assert np.array_equal(robot.sample(10, 7, first=30), q[30:])
    c = hr.Checker(robot)
    assert c.collides(q).tolist() == [row["collides"] for row in expected]
    assert [c.collides(one) for one in q] == c.collides(q, threads=2).tolist()
    found = pair_rows(c, c.pairs(q))
    for k, row in enumerate(expected):
        assert found.get(k, []) == [told(pair) for pair in row["pairs"]]
        assert c.colliding_links(q[k]) == found.get(k, [])


@names
@pytest.mark.parametrize("clearance", [0.0, 0.02])
def test_closest_and_within(robots, name, clearance):
    if name == "baxter" and clearance == 0.0:
        pytest.skip("the same with a clearance")
    robot = robots(name)
    q = robot.sample(6, 3)
    c = hr.Checker(robot, clearance=clearance)
    more = ["--random", 6, "--seed", 3, "--clearance", clearance]
    expected = robocd("check", name, *more, "--mode", "closest")["configurations"]
    assert near_rows(c, c.closest(q)) == [told(row["closest"]) for row in expected]
    assert c.distance(q).tolist() == [row["closest"]["distance"] for row in expected]
    assert c.collides(q).tolist() == [row["collides"] for row in expected]
    expected = robocd("check", name, *more, "--mode", "within:0.03")["configurations"]
    assert near_rows(c, c.distances(q, within=0.03)) == [told(p) for row in expected for p in row["pairs"]]
    rows = c.pairs(q, within=0.03)
    assert c.named(rows) == [told(p)[:2] for row in expected for p in row["pairs"]]


def test_bodies_of_every_shape(robots):
    env = ["--env", SHELF, "--env", "table=box:1 2 0.05,xyz=0 0 -0.03,rpy=0 0 0.3"]
    env += ["--env", "ball=sphere:0.1,xyz=0.4 0.2 0.5", "--env", "can=cylinder:0.05 0.2,xyz=0.2 -0.5 0.3"]
    env += ["--env", "rod=capsule:0.02 0.4,xyz=-0.3 0.1 0.6,rpy=0.5 -0.2 1"]
    env += ["--allow", "base", "table"]
    robot = robots("arm")
    world = hr.Environment()
    world.add(hr.Mesh.read(SHELF), name=str(SHELF))
    world.add(hr.Box((1, 2, 0.05)), hr.pose((0, 0, -0.03), (0, 0, 0.3)), "table")
    world.add(hr.Sphere(0.1), (0.4, 0.2, 0.5), "ball")
    world.add(hr.Capsule(0.02, 0.4), hr.pose((-0.3, 0.1, 0.6), (0.5, -0.2, 1)), "rod")
    world.add(hr.Cylinder(0.05, 0.2), (0.2, -0.5, 0.3), "can")
    world.allow("table", robot, "base")
    c = hr.Checker(robot, environment=world)
    q = robot.sample(N, 5)
    more = ["--random", N, "--seed", 5, *env]
    for row, verdict, k in zip(robocd("check", "arm", *more)["configurations"], c.collides(q), range(N)):
        assert row["collides"] == verdict == c.collides(q[k])
        assert c.named(c.pairs(q[k], against="self")) == [told(p) for p in row["pairs"]]
        assert c.named(c.pairs(q[k], against="environment")) == [told(p) for p in row["environment_pairs"]]
    near = robocd("check", "arm", *more, "--mode", "within:0.05")["configurations"]
    got = c.distances(q, within=0.05, against="environment")
    assert near_rows(c, got) == [told(p) for row in near for p in row["environment_pairs"]]
    close = robocd("check", "arm", *more, "--mode", "closest", "--clearance", 0.01)["configurations"]
    c = hr.Checker(robot, environment=world, clearance=0.01)
    assert near_rows(c, c.closest(q, against="environment")) == [told(row["environment_closest"]) for row in close]
    both = c.closest(q)
    own, around = c.closest(q, against="self"), c.closest(q, against="environment")
    assert np.array_equal(both["gap"], np.minimum(own["gap"], around["gap"]))


def test_point_cloud(robots, tmp_path):
    points = np.random.default_rng(11).uniform(-0.6, 0.8, (300, 3))
    file = tmp_path / "cloud.xyz"
    np.savetxt(file, points, fmt="%.17g")
    robot = robots("arm")
    q = robot.sample(N, 9)
    row = robocd("check", "arm", "--random", N, "--seed", 9, "--mode", "closest", "--env", f"points:{file} 0.01")
    for cloud in (hr.PointCloud(points, 0.01), hr.PointCloud.read(file, 0.01)):
        world = hr.Environment()
        world.add(cloud, name="cloud")
        c = hr.Checker(robot, environment=world)
        got = near_rows(c, c.closest(q, against="environment"))
        expected = [told(r["environment_closest"]) for r in row["configurations"]]
        assert [r[2:] for r in got] == [r[2:] for r in expected]
        assert c.collides(q).tolist() == [r["collides"] for r in row["configurations"]]


def test_contained(robots):
    robot = hr.Robot.from_urdf(urdf_of("arm"), srdf=options_of("arm")["srdf"], solid=True)
    q = robot.sample(20, 2)
    more = ["--random", 20, "--seed", 2, "--contained", "--env", "room=box:9 9 9"]
    world = hr.Environment()
    world.add(hr.Box((9, 9, 9)), name="room")
    c = hr.Checker(robot, environment=world)
    for k, row in enumerate(robocd("check", "arm", *more)["configurations"]):
        assert row["collides"] == c.collides(q[k])
        inside = [(p["outer"], p["inner"]) for p in row["contained"] + row["environment_contained"]]
        assert c.named(c.contained(q[k])) == inside


@pytest.mark.parametrize("name", ["arm", "panda"])
def test_path(robots, name):
    robot = robots(name)
    c = hr.Checker(robot)
    q = robot.sample(8, 4)
    rows = c.certify(q[:4], q[4:], threads=2)
    for k in range(4):
        ends = [",".join(repr(v) for v in end) for end in (q[k].tolist(), q[k + 4].tolist())]
        path = robocd("path", name, f"--from={ends[0]}", f"--to={ends[1]}", ok=(0, 1, 4))
        answer = c.check_path([q[k], q[k + 4]])
        assert rows[k]["verdict"] == answer.verdict == path["verdict"]
        assert rows[k]["states"] == answer.states == path["states_looked_at"]
        if path["parameter"] is not None:
            assert rows[k]["parameter"] == answer.parameter == path["parameter"]
            assert answer.configuration.tolist() == path["values"]
            if path["pairs"]:
                assert answer.pairs == [told(p) for p in path["pairs"]]
        sampled = robocd("path", name, f"--from={ends[0]}", f"--to={ends[1]}", "--sampled", 0.05)
        row = c.certify(q[k], q[k + 4], resolution=0.05)[0]
        assert (row["verdict"], row["states"]) == (sampled["verdict"], sampled["states_looked_at"])


def test_path_among_bodies(robots, tmp_path):
    robot = robots("arm")
    world = hr.Environment()
    world.add(hr.Mesh.read(SHELF), name=str(SHELF))
    c = hr.Checker(robot, environment=world)
    home, reach = robot.state("arm/home"), robot.state("arm/reach")
    given = ["--from", "state:arm/home", "--to", "state:arm/reach"]
    path = robocd("path", "arm", *given, "--env", SHELF)
    answer = c.check_path([home, reach])
    assert (answer.verdict, answer.parameter) == ("colliding", path["parameter"])
    assert answer.pairs == [told(p) for p in path["pairs"] + path["environment_pairs"]]
    c.environment = None
    assert c.check_path([home, reach]).is_free
    waypoints = tmp_path / "way.csv"
    rows = np.array([home, reach, home])
    np.savetxt(waypoints, rows, fmt="%.17g", delimiter=",", header=",".join(robot.joint_names), comments="")
    path = robocd("path", "arm", "--waypoints", waypoints)
    answer = c.check_path(rows)
    assert (answer.verdict, answer.states) == (path["verdict"], path["states_looked_at"])


@pytest.mark.parametrize("name, extend", [("arm", False), ("arm", True), ("panda", True)])
def test_matrix_is_the_same_text(robots, name, extend):
    given = ["--samples", 2000, "--seed", 3, "--cells", 2000, "--clearance", 0.001]
    robot = robots(name) if extend else hr.Robot.from_urdf(urdf_of(name))
    progress = []
    m = hr.CollisionMatrix(
        robot, samples=2000, seed=3, cells=2000, clearance=0.001, progress=lambda *now: progress.append(now)
    )
    assert progress[-1] == (2000, 2000)
    for more, unseen in (([], False), (["--disable-unseen"], True)):
        if extend:
            text = run_robocd("matrix", name, *given, *more)
        else:
            text = run_without_srdf("matrix", name, *given, *more)
        assert m.srdf(disable_unseen=unseen) == text
        again = hr.Robot.from_urdf(urdf_of(name), srdf=text)
        assert again.disabled_pairs == m.disabled_pairs(disable_unseen=unseen)
        disabled = m.disabled_pairs(disable_unseen=unseen)
        assert hr.Checker(again).tested_pairs == hr.Checker(robot, disable=disabled).tested_pairs


def run_without_srdf(command, name, *more):
    import subprocess

    from conftest import tool

    arguments = [tool("robocd"), command, str(urdf_of(name)), *map(str, more)]
    return subprocess.run(arguments, capture_output=True, text=True, timeout=600, check=True).stdout


@pytest.mark.parametrize("engine", ["lazy", "brute"])
def test_engines(robots, engine):
    robot = robots("arm")
    q = robot.sample(N, 5)
    c, other = hr.Checker(robot), hr.Checker(robot, engine=engine)
    assert c.collides(q).tolist() == other.collides(q).tolist()
    assert c.closest(q)["distance"].tolist() == other.closest(q)["distance"].tolist()


@pytest.mark.parametrize("name", ["panda", "ur5", "baxter"])
def test_sphere_models(shared, name):
    folder = "ur5_robotiq" if name == "ur5" else name
    file = shared(f"robots/{folder}/{name}_spherized.urdf")
    robot = hr.Robot.from_urdf(file)
    assert robot.has_only_spheres
    assert len(robot.spheres) == robot.links["rounded"].sum()
    q = robot.sample(300, 1)
    c = hr.Checker(robot)
    batch = c.collides(q)  # sixteen configurations at a time
    assert batch.tolist() == [c.collides(one) for one in q] == c.collides(q, threads=2).tolist()
    assert batch.any()
    assert name == "baxter" or not batch.all()  # without an SRDF, spheres of Baxter's base always overlap
