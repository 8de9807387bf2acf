# SPDX-License-Identifier: BSD-3-Clause
"""Planned motions: as the command line, and free by other calls."""

import json
import subprocess

import numpy as np
import pytest

import hinge
import hinge.robotics as hr
from conftest import ROOT, tool
from robot_cases import slider

DATA = ROOT / "robotics" / "data"


@pytest.fixture(scope="module")
def arm():
    robot = hr.Robot.from_urdf(DATA / "arm.urdf", srdf=DATA / "arm.srdf")
    world = hr.Environment()
    world.add(hr.Mesh.read(DATA / "shelf.obj"), name="shelf")
    return hr.Checker(robot, environment=world)


def test_a_motion_is_as_the_tool_finds_it(arm):
    command = [tool("robocd"), "plan", str(DATA / "arm.urdf"), "--srdf", str(DATA / "arm.srdf"), "--json"]
    command += ["--env", f"shelf={DATA / 'shelf.obj'}", "--from", "state:arm/home", "--to", "state:arm/reach"]
    told = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    start, end = arm.robot.state("arm/home"), arm.robot.state("arm/reach")
    assert arm.certify(start, end)["verdict"][0] == "colliding"
    found = arm.plan(start, end)
    assert found.waypoints.tolist() == told["waypoints"]
    for field in ("reached", "length", "straight", "remaining", "motions"):
        assert getattr(found, field) == told[field], field
    assert found.opening == 0.0 and not found.stopped
    assert (found.waypoints[0] == start).all() and (found.waypoints[-1] == end).all()
    assert arm.check_path(found.waypoints).is_free
    q = found.steps(0.01)
    assert np.abs(np.diff(q, axis=0)).max() <= 0.01 + 1e-12 and not arm.collides(q).any()
    assert arm.plan(start, end, seed=3).waypoints.tolist() != told["waypoints"]


def test_what_is_not_found_is_said():
    world = hr.Environment()
    world.add(hr.Box((1, 9, 9)), (3, 0, 0), "wall")
    c = hr.Checker(slider(), environment=world)
    found = c.plan([1.0], [4.5], tries=30)
    assert not found.reached and found.remaining > 0 and found.motions >= 30
    assert not c.collides(found.steps(0.05)).any()
    stopped = c.plan([1.0], [4.5], tries=10**12, seconds=0.2)
    assert stopped.stopped and not stopped.reached
    world.remove("wall")
    assert c.plan([1.0], [4.5]).waypoints.tolist() == [[1.0], [4.5]]


def test_bad_ends():
    world = hr.Environment()
    world.add(hr.Box((1, 9, 9)), (3, 0, 0), "wall")
    c = hr.Checker(slider(), environment=world)
    with pytest.raises(hinge.ConfigurationError, match="the end collides: link 'cube' and body 'wall'"):
        c.plan([0.0], [2.5])
    with pytest.raises(hinge.ConfigurationError, match="the start collides"):
        c.plan([2.5], [0.0])
    for end in ([1.0, 2.0], [[1.0]], [np.nan]):
        with pytest.raises(ValueError, match="end"):
            c.plan([0.0], end)
    with pytest.raises(TypeError, match="start"):
        c.plan("abc", [0.0])
    for option in ({"tries": 0}, {"seed": -1}, {"seconds": -1}, {"seconds": float("inf")}):
        with pytest.raises(ValueError, match=next(iter(option))):
            c.plan([0.0], [1.0], **option)
