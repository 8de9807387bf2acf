# SPDX-License-Identifier: BSD-3-Clause
"""How calls behave: threads, Ctrl-C, progress, lifetime and pickling."""

import concurrent.futures
import gc
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import hinge.molecular as hm
from conftest import PROMPT, ROOT

FILE = ROOT / "molecular/data/1ubq.pdb"


@pytest.fixture(scope="module")
def m():
    return hm.Molecule(FILE)


@pytest.fixture(scope="module")
def c(m):
    return hm.Checker(m, "A:60-76", exempt_reference=True)


def test_threads_do_not_change_answers(c):
    q = c.sample(500, 3, 0.1)
    x = c.positions(q)
    for threads in (2, 3, 7):
        assert np.array_equal(c.sample(500, 3, 0.1, threads=threads), q)
        assert np.array_equal(c.positions(q, threads=threads), x)
        assert np.array_equal(c.collides(q, threads=threads), c.collides(q))
        assert np.array_equal(c.pairs(q, threads=threads), c.pairs(q))
        assert np.array_equal(c.closest(q, threads=threads), c.closest(q))
        assert np.array_equal(c.collides_coordinates(x, threads=threads), c.collides_coordinates(x))


def test_the_first_number_that_is_not_finite_is_named_for_any_number_of_threads(c):
    q = c.sample(4000, 3, 0.1)
    q[[3800, 2345], [0, 2]] = np.nan, -np.inf
    for threads in (1, 2, 7):
        for ask in (c.collides, c.pairs, c.closest, c.positions):
            with pytest.raises(ValueError, match=r"^q\[2345, 2\] is -inf, expected finite numbers$"):
                ask(q, threads=threads)


def test_one_configuration_answers_as_many(c):
    q = c.sample(50, 4, 0.1)
    assert [c.collides(row) for row in q] == c.collides(q).tolist()
    assert all(isinstance(c.collides(row), bool) for row in q[:2])
    assert np.array_equal(c.positions(q[0]), c.positions(q)[0])
    assert c.collides_coordinates(c.positions(q[0])) == c.collides_coordinates(c.positions(q))[0]


def test_samples_depend_on_seed_and_index_alone(c):
    q = c.sample(40, 9, 0.2)
    assert np.array_equal(c.sample(15, 9, 0.2, first=25), q[25:])
    assert not np.array_equal(c.sample(40, 10, 0.2), q)
    assert abs(c.sample(4000, 9, 0.2).std() - 0.2) < 0.002


def test_many_threads_of_python_may_share_a_checker(c):
    q = c.sample(400, 5, 0.1)
    expected, pairs = c.collides(q), c.pairs(q)

    def ask(k):
        if k % 2:
            return np.array_equal(c.pairs(q, threads=1 + k % 3), pairs)
        return all(c.collides(row) == verdict for row, verdict in zip(q, expected))

    with concurrent.futures.ThreadPoolExecutor(8) as pool:
        assert all(pool.map(ask, range(24)))


def test_the_lock_is_released(m):
    c = hm.Checker(m, "none")
    x = np.repeat(m.coordinates[None], 2000, axis=0)
    ticks, done = [0], threading.Event()

    def count():
        while not done.is_set():
            ticks[0] += 1
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    before, start = ticks[0], time.perf_counter()
    c.pairs_coordinates(x, within=2.0)
    during, passed = ticks[0] - before, time.perf_counter() - start
    done.set()
    other.join()
    assert during > max(5, passed / 0.001 * 0.05)  # the other thread ran; a held lock would let it run once or twice


@pytest.mark.parametrize("threads", [1, 2])
def test_ctrl_c_ends_a_long_call(c, threads):
    q = np.repeat(c.sample(1000, 5, 0.01), 2000, axis=0)

    def press():
        time.sleep(0.1)
        pressed.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    pressed = []
    thread = threading.Thread(target=press)
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        c.closest(q, threads=threads)
    late = time.perf_counter() - pressed[0]
    thread.join()
    assert late < PROMPT, f"{late:.3f} s"
    assert c.collides(q[:10]).shape == (10,)


@pytest.mark.parametrize("call", ["walk", "sample", "certify", "one endless path", "two endless paths", "frames"])
def test_ctrl_c_ends_every_kind_of_call(m, c, call):
    start = []

    def press():
        time.sleep(0.1)
        start.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    q = c.sample(2, 1, 0.01)
    with pytest.raises(KeyboardInterrupt):
        if call == "walk":
            c.walk(10**9)
        elif call == "sample":
            c.sample(2 * 10**6, 1, 0.1)
        elif "endless" in call:
            free = hm.Checker(m, "A:2:chi1", exempt_reference=True)
            threads = 2 if call == "two endless paths" else 1
            free.certify(np.zeros((20 * threads, 1)), [6.28], resolution=1e-12, threads=threads)
        elif call == "certify":
            c.certify(np.repeat(q[:1], 10**5, axis=0), q[1])
        else:
            c.pairs_coordinates(np.repeat(m.coordinates[None], 50000, axis=0), within=3.0)
    assert time.perf_counter() - start[0] < PROMPT
    thread.join()


def test_progress_is_a_callback_or_a_bar(c):
    q = np.repeat(c.sample(1000, 5, 0.01), 10, axis=0)
    calls = []
    c.closest(q, progress=lambda done, total: calls.append((done, total)))
    assert calls[-1] == (len(q), len(q))
    assert calls == sorted(calls)

    class Bar:
        n = 0

        def update(self, k):
            self.n += k

    bar = Bar()
    c.collides(q, progress=bar, threads=2)
    assert bar.n == len(q)

    class Stop(Exception):
        pass

    def stop(done, total):
        raise Stop

    with pytest.raises(Stop):
        c.closest(q, progress=stop)
    with pytest.raises(TypeError, match="progress: expected a callable"):
        c.collides(q, progress=3)


def test_arrays_that_fit_are_not_copied(m, c):
    import tracemalloc

    q = np.repeat(c.sample(1000, 5, 0.01), 40, axis=0)
    tracemalloc.start()
    c.collides(q)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < q.nbytes / 10
    out = np.empty((3, m.n_atoms, 3))
    assert c.positions(q[:3], out=out) is out


def test_other_layouts_and_types_give_the_same(c):
    q = c.sample(30, 5, 0.01)
    expected = c.collides(q)
    single = q.astype(np.float32)
    for other in (np.asfortranarray(q), q[::-1][::-1], np.repeat(q, 2, axis=0)[::2], q.tolist(), q.astype(">f8")):
        assert np.array_equal(c.collides(other), expected)
    assert np.array_equal(c.collides(single), c.collides(single.astype(float)))
    assert np.array_equal(c.collides(np.zeros((3, c.dof), np.int32)), [False] * 3)
    assert c.collides(np.empty((0, c.dof))).shape == (0,)
    assert len(c.pairs(np.empty((0, c.dof)))) == 0


def test_temporaries_stay_alive():
    x = hm.Molecule(FILE).coordinates
    gc.collect()
    assert x.shape == (602, 3) and np.isfinite(x).all()
    with pytest.raises(ValueError, match="read-only"):
        x[0, 0] = 1.0
    c = hm.Checker(hm.Molecule(FILE), "A:70-76")
    gc.collect()
    pairs = c.pairs(c.sample(10))
    labels = c.dof_labels
    del c
    gc.collect()
    assert pairs["i"].max() < 602 and labels[0] == "A:VAL70:phi"
    frames = iter(hm.Trajectory(hm.Molecule(FILE), FILE))
    gc.collect()
    assert next(frames).shape == (602, 3)


def test_closed_trajectories(m, c):
    with hm.Trajectory(m, FILE) as frames:
        assert len(frames) == 1 and not frames.closed
    assert frames.closed and "closed" in repr(frames)
    for use in (lambda: len(frames), lambda: frames[0], lambda: c.collides_coordinates(frames), lambda: frames.notes):
        with pytest.raises(ValueError, match="the trajectory is closed"):
            use()


def test_pickling(m, c):
    again = pickle.loads(pickle.dumps(c))
    q = c.sample(100, 1, 0.1)
    assert np.array_equal(again.pairs(q), c.pairs(q))
    assert again.options.keys() == c.options.keys()
    from_bytes = hm.Molecule(FILE.read_bytes(), hydrogens="drop")
    twin = pickle.loads(pickle.dumps(from_bytes))
    assert np.array_equal(twin.coordinates, from_bytes.coordinates)
    frames = pickle.loads(pickle.dumps(hm.Trajectory(m, FILE)))
    assert np.array_equal(frames[0], m.coordinates)


def test_other_processes(c):
    q = c.sample(64, 1, 0.1)
    import multiprocessing

    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        parts = list(pool.map(c.collides, np.split(q, 4)))
    assert np.array_equal(np.concatenate(parts), c.collides(q))
