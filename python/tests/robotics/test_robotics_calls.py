# SPDX-License-Identifier: BSD-3-Clause
"""Pickles, threads, interrupts and progress of hinge.robotics."""

import pickle
import threading
import time

import numpy as np
import pytest

import hinge.robotics as hr
from conftest import PROMPT
from robot_cases import ARM


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


def test_pickles(robot, checker, tmp_path):
    q = robot.sample(50)
    again = pickle.loads(pickle.dumps(checker))
    assert np.array_equal(again.collides(q), checker.collides(q))
    assert repr(again) == repr(checker)
    world = hr.Environment(0.01)
    triangle = np.array([[[0.3, -1, 0.4], [0.3, 1, 0.4], [0.3, 0, 1.4]]])
    world.add(hr.Mesh(triangle, scale=(1, 2, 1)), (0.1, 0, 0), "sheet")
    world.add(hr.PointCloud(np.random.default_rng(1).uniform(-1, 1, (50, 3)), 0.02), name="cloud")
    world.add(hr.Capsule(0.02, 0.3), name="gone")
    world.add(hr.Cylinder(0.02, 0.3), name="tool")
    world.remove("gone")
    c = hr.Checker(robot, environment=world, clearance=0.005, base=(0, 0, 0.1), disable=[("base", "hand")])
    c.attach("hand", "tool", (0, 0, 0.2))
    c.allow("sheet", "base")
    again = pickle.loads(pickle.dumps(c))
    assert again.environment.names == ["sheet", "cloud", "tool"]
    assert again.environment.attached_to("tool") == (again.robot, "hand")
    assert np.array_equal(again.collides(q), c.collides(q))
    assert again.named(again.pairs(q)) == c.named(c.pairs(q))
    assert np.array_equal(again.closest(q)["distance"], c.closest(q)["distance"])
    made = hr.Robot([hr.Link("a", hr.Sphere(1)), "b"], [hr.Joint("j", "continuous", "a", "b")])
    for one in (made, robot, robot.with_tiers("capsule"), hr.Robot.from_urdf(ARM.read_text())):
        two = pickle.loads(pickle.dumps(one))
        assert np.array_equal(two.links, one.links) and np.array_equal(two.joints, one.joints)
    m = hr.CollisionMatrix(robot, samples=100, cells=10)
    assert pickle.loads(pickle.dumps(m)).srdf() == m.srdf()


def test_two_threads_share_one_checker(robot, checker):
    q = robot.sample(400)
    expected = checker.collides(q), checker.closest(q)["distance"]
    failures = []

    def work():
        for _ in range(3):
            if not np.array_equal(checker.collides(q), expected[0]):
                failures.append("collides")
            if not np.array_equal(checker.closest(q)["distance"], expected[1]):
                failures.append("closest")

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert failures == []


def test_every_call_sees_one_state_of_the_bodies(robot):
    """One thread moves a wall that hits everything or nothing, while others check."""
    world = hr.Environment()
    world.add(hr.Box((9, 9, 9)), (0, 0, 0), "wall")
    c = hr.Checker(robot, environment=world, threads=2)
    q = robot.sample(3000)
    alone = c.collides(q, against="self").sum()
    done = threading.Event()
    seen, wrong = set(), []

    def check():
        while not done.is_set():
            hits = int(c.collides(q).sum())
            seen.add(hits)
            if hits not in (alone, len(q)):
                wrong.append(hits)

    threads = [threading.Thread(target=check) for _ in range(2)]
    for thread in threads:
        thread.start()
    for k in range(40):  # each waits for the running calls, not for those that begin later
        world.set_pose("wall", (100.0 * (k % 2), 0, 0))
        time.sleep(0.002)
        if k % 10 == 0:
            world.remove(world.add(hr.Sphere(1), (0, 0, 100)))
    done.set()
    for thread in threads:
        thread.join()
    assert wrong == []
    assert len(seen) == 2


def test_changes_in_a_callback_are_refused(robot, world, checker):
    def change(done, total):
        world.set_pose("ball", (0.4, 0.2, 0.5))

    with pytest.raises(RuntimeError, match="environment: changed by a callback"):
        checker.closest(np.repeat(robot.sample(100), 300, axis=0), progress=change)
    world.set_pose("ball", (0.4, 0.2, 0.5))


def test_progress_and_answers_do_not_depend_on_threads(robot, checker):
    q = robot.sample(2000)
    seen = []
    one = checker.pairs(q, progress=lambda done, total: seen.append((done, total)))
    assert seen[-1] == (2000, 2000)
    assert sorted(seen) == seen
    assert np.array_equal(checker.pairs(q, threads=3), one)
    assert np.array_equal(checker.distances(q[:100], within=0.1, threads=3), checker.distances(q[:100], within=0.1))


INTERRUPTED = """
import signal, threading, time, os, sys
import numpy as np, hinge.robotics as hr
robot = hr.Robot.from_urdf({urdf!r})
world = hr.Environment()
world.add(hr.PointCloud(np.random.default_rng(1).uniform(-1, 1, (20000, 3)), 0.001))
c = hr.Checker(robot, environment=world)
q = robot.sample(2_000_000)
calls = dict(
    collides=lambda: c.collides(q, threads={threads}),
    closest=lambda: c.closest(q, threads={threads}),
    pairs=lambda: c.pairs(q, threads={threads}),
    certify=lambda: hr.Checker(robot).certify(q[:-1], q[1:], threads={threads}),
    matrix=lambda: hr.CollisionMatrix(robot, samples=2**40),
)
call = calls[{name!r}]
sent = []
def interrupt():
    time.sleep(0.4)
    sent.append(time.perf_counter())
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
try:
    call()
    print("not interrupted")
except KeyboardInterrupt:
    print(time.perf_counter() - sent[0])
"""


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", ["collides", "closest", "pairs", "certify", "matrix"])
def test_keyboard_interrupt_is_obeyed(run_python, name, threads):
    if threads == 2 and name == "matrix":
        pytest.skip("works on one thread")
    done = run_python(INTERRUPTED.format(urdf=str(ARM), name=name, threads=threads))
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) < PROMPT


def test_temporaries_may_go(robot):
    q = robot.sample(5)
    assert hr.Checker(hr.Robot.from_urdf(ARM)).collides(q).shape == (5,)
    c = hr.Checker(robot, environment=hr.Environment())
    c.environment.add(hr.Sphere(9))
    assert c.collides(q).all()
    points = hr.PointCloud(np.ones((4, 3)), 1).points
    assert points.tolist() == np.ones((4, 3)).tolist()
