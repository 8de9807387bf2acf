# SPDX-License-Identifier: BSD-3-Clause
"""Ctrl-C ends calls that read files and build checkers within 0.2 s, and the process ends well."""

import os
import pathlib
import re
import subprocess
import sys
import time

import pytest

import hinge
import hinge.molecular as hm
from conftest import PROMPT, shared

PROGRAM = pathlib.Path(__file__).with_name("interrupt_program.py")
CALLS = [
    "molecule",
    "molecule_checker",
    "molecule_certify",
    "molecule_walk",
    "model_checker",
    "model_certify",
    "mesh",
    "robot",
    "robot_tiers",
    "robot_links",
    "robot_checker",
    "robot_certify",
    "environment",
]


def late(*arguments):
    """Seconds from Ctrl-C to the end of the call."""
    env = {**os.environ, "PYTHONPATH": str(pathlib.Path(hinge.__file__).parents[1])}
    done = subprocess.run(
        [sys.executable, str(PROGRAM), *map(str, arguments)], env=env, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    found = re.fullmatch(r"interrupted after ([0-9.]+) s\n", done.stdout)
    assert found, done.stdout
    return float(found.group(1))


@pytest.mark.long
@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_ends_the_call(call):
    # The shortest of these calls takes 0.5 s. A loaded machine may be late once.
    assert min(late(call, 0.2) for _ in range(2)) < 0.2


@pytest.mark.parametrize("call", ["small_plan", "small_relax", "small_fit", "robot_plan"])
def test_ctrl_c_ends_a_search(call):
    assert min(late(call, 0.2) for _ in range(2)) < PROMPT


def load_time(path):
    """Seconds that loading a structure takes, the best of two."""
    times = []
    for _ in range(2):
        start = time.perf_counter()
        hm.Molecule(path)
        times.append(time.perf_counter() - start)
    return min(times)


@pytest.mark.long
def test_ctrl_c_ends_the_loading_of_a_large_file():
    path = shared("molecules/6zu5.cif.gz")
    seconds = load_time(path)
    for share in [0.1, 0.4, 0.7]:
        assert min(late("molecule", share * seconds, path) for _ in range(2)) < 0.2, share


def test_a_second_ctrl_c_ends_the_process(run_python):
    """While it waits at its exit for the work that the first one left behind."""
    done = run_python(
        f"import sys; sys.path.insert(0, {str(PROGRAM.parent)!r}); sys.argv = ['', 'robot_tiers', '0.3']\n"
        "import os, signal, threading, time\n"
        "def press():\n    time.sleep(1.0)\n    os.kill(os.getpid(), signal.SIGINT)\n"
        "import atexit\n"
        "start = time.perf_counter()\n"
        "import hinge, interrupt_program\n"
        "threading.Thread(target=press, daemon=True).start()\n"
        "print('last words')\n"
    )
    assert done.returncode == 130
    assert done.stdout.startswith("interrupted after") and done.stdout.endswith("last words\n")
