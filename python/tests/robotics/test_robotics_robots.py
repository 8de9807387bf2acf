# SPDX-License-Identifier: BSD-3-Clause
"""Robots from code and from text, their joints in other orders, tiers, and robots without joints."""

import pickle

import numpy as np
import pytest

import hinge
import hinge.robotics as hr
from robot_cases import ARM, slider


def test_robot_from_code():
    robot = slider()
    assert (robot.name, robot.dof, robot.joint_names) == ("slider", 1, ["slide"])
    assert robot.link_names == ["root", "cube", "ball"]
    assert robot.links["group"].tolist() == [0, 1, 1]
    assert robot.links["triangles"].tolist() == [0, 12, 1]
    assert robot.joints["type"].tolist() == ["prismatic", "fixed"]
    assert (robot.lower.tolist(), robot.upper.tolist()) == ([-5.0], [5.0])
    poses = hr.Checker(robot).link_poses([2.0])
    assert poses[1].tolist() == [[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    assert not hr.Checker(robot).collides([0.0])
    assert repr(robot) == "<Robot 'slider': 3 links, 1 degrees of freedom>"


def test_urdf_text_is_as_the_file(tmp_path):
    text = ARM.read_text()
    srdf = ARM.with_suffix(".srdf").read_text()
    one = hr.Robot.from_urdf(ARM, srdf=ARM.with_suffix(".srdf"))
    for robot in (hr.Robot.from_urdf(text, srdf=srdf), hr.Robot.from_urdf(text.encode(), srdf=srdf.encode())):
        assert np.array_equal(robot.links, one.links)
        assert np.array_equal(robot.joints, one.joints)
        assert robot.groups == one.groups
        assert {k: v.tolist() for k, v in robot.states.items()} == {k: v.tolist() for k, v in one.states.items()}
    (tmp_path / "cube.stl").write_bytes(b"solid x\nendsolid x\n")
    shape = "<geometry><mesh filename='cube.stl'/></geometry>"
    mesh = f"<robot name='r'><link name='a'><collision>{shape}</collision></link></robot>"
    with pytest.raises(hinge.LoadError, match="cube.stl"):
        hr.Robot.from_urdf(mesh, folder=tmp_path)
    with pytest.raises(hinge.LoadError, match="urdf text:1: "):
        hr.Robot.from_urdf("<robot>\n<link/></robot>".replace("\n", ""))


def test_mimic_joints_follow_and_have_columns():
    robot = hr.Robot(
        ["a", "b", "c", "d"],
        [
            hr.Joint("lift", "revolute", "a", "b", lower=-1, upper=1),
            hr.Joint("follow", "prismatic", "b", "c", lower=-9, upper=9, mimic=hr.Mimic("lift", 2.0, 0.5)),
            hr.Joint("spin", "continuous", "c", "d"),
        ],
    )
    assert robot.joint_names == ["lift", "spin"]
    assert robot.movable_joints == ["lift", "follow", "spin"]
    assert robot.joints["column"].tolist() == [0, 0, 1]
    assert robot.expand([[0.25, 3.0], [0.0, 1.0]]).tolist() == [[0.25, 1.0, 3.0], [0.0, 0.5, 1.0]]
    assert robot.to_columns([0.25, 3.0], ["spin", "follow"]).tolist() == [3.0, 1.0]
    assert robot.lower.tolist() == [-1.0, -np.pi]
    assert robot.joints["upper"].tolist() == [1.0, 9.0, np.inf]


def test_columns_of_other_programs():
    robot = hr.Robot.from_urdf(ARM)
    other = ["grip", "bend", "wheel", "roll", "elbow", "lift", "turn"]
    q = robot.sample(20)
    theirs = np.zeros((20, 7))
    for name, column in zip(robot.joint_names, q.T):
        theirs[:, other.index(name)] = column
    assert np.array_equal(theirs[:, robot.columns(other)], q)
    assert np.array_equal(robot.from_columns(theirs, other), q)
    assert np.array_equal(robot.from_columns(theirs[3], other), q[3])
    sizes = [2 if name == "turn" else 1 for name in other]
    circle = np.hstack([theirs[:, :6], np.cos(theirs[:, 6:]), np.sin(theirs[:, 6:])])
    assert np.allclose(robot.from_columns(circle, other, sizes), q, atol=1e-15, rtol=0)
    with pytest.raises(ValueError, match="joint 'turn' occurs 0 times"):
        robot.columns(other[:-1])
    with pytest.raises(ValueError, match="expected 8 columns"):
        robot.from_columns(theirs, other, sizes)


def test_allow_two_links():
    robot = hr.Robot.from_urdf(ARM)
    c = hr.Checker(robot)
    q = robot.sample(300)
    rows = c.named(c.pairs(q))
    worst = max(set(rows), key=rows.count)
    c.allow(*worst)
    assert worst not in c.tested_pairs
    assert c.named(c.pairs(q)) == [row for row in rows if row != worst]
    assert hr.Checker(robot, disable=[worst]).tested_pairs == c.tested_pairs
    assert pickle.loads(pickle.dumps(c)).tested_pairs == c.tested_pairs


def test_tiers_enclose():
    robot = hr.Robot.from_urdf(ARM)
    q = robot.sample(300, 2)
    exact = hr.Checker(robot).collides(q)
    for tier in ("hull", "capsule", "spheres"):
        c = hr.Checker(robot, tiers=tier)
        assert (c.collides(q) | ~exact).all(), tier
        assert c.robot is not robot and c.robot.joint_names == robot.joint_names
    some = robot.with_tiers(links={"forearm": "capsule"})
    assert some.links["rounded"].sum() > robot.links["rounded"].sum()
    assert robot.with_tiers("spheres", most_spheres=4).has_only_spheres
    spheres = robot.with_tiers("spheres", most_spheres=4).spheres
    assert spheres["center"].shape == (len(spheres), 3)
    assert (np.bincount(spheres["link"]) <= 8).all()
    for bad in ("round", None):
        with pytest.raises(ValueError, match="tier: "):
            robot.with_tiers(bad)
    with pytest.raises(hinge.ModelError, match="does not exist"):
        robot.with_tiers(links={"nose": "hull"})


def test_floating_bases_need_a_place():
    text = """<robot name="r"><link name="world"/><link name="body"><collision><geometry><box size="1 1 1"/></geometry>
      </collision></link>
      <joint name="free" type="floating"><parent link="world"/><child link="body"/></joint></robot>"""
    robot = hr.Robot.from_urdf(text)
    assert robot.floating_base == "free"
    assert len(robot.notes) == 1
    hr.Checker(robot)
    with pytest.raises(hinge.ModelError, match="base: joint 'free' is a floating base"):
        hr.Checker(robot, environment=hr.Environment())
    world = hr.Environment()
    world.add(hr.Box((1, 1, 1)))
    assert hr.Checker(robot, environment=world, base=np.eye(4)).collides(np.empty(0))
    assert not hr.Checker(robot, environment=world, base=(3, 0, 0)).collides(np.empty(0))


def test_without_joints_or_geometry():
    robot = hr.Robot(["only"])
    c = hr.Checker(robot)
    assert (c.dof, c.tested_pairs, len(c.closest(np.empty(0)))) == (0, [], 0)
    assert c.distance(np.empty((3, 0))).tolist() == [np.inf] * 3
    assert c.collides(np.empty((3, 0))).tolist() == [False] * 3
    assert robot.sample(4).shape == (4, 0)
    assert hr.Checker(slider()).collides(np.empty((0, 1))).shape == (0,)
    assert hr.Checker(slider()).pairs(np.empty((0, 1))).shape == (0,)


def test_triangle_pairs_and_open_links():
    robot = hr.Robot.from_urdf(ARM)
    c = hr.Checker(robot)
    q = robot.sample(100)
    triangles, links = c.triangle_pairs(q), c.pairs(q)
    named = set(zip(triangles["configuration"], c.named(triangles)))
    assert named <= set(zip(links["configuration"], c.named(links)))
    assert c.open_links == []
    flat = hr.Robot([hr.Link("flat", [hr.Mesh([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]])])])
    assert hr.Checker(flat).open_links[0][0] == "flat"


def test_calibrate_changes_no_answer():
    robot = hr.Robot.from_urdf(ARM)
    c = hr.Checker(robot)
    q = robot.sample(200)
    before = c.collides(q)
    c.calibrate(q)
    assert np.array_equal(c.collides(q), before)
