# SPDX-License-Identifier: BSD-3-Clause
"""What all tests share: where data and tools are, and a marker for tests that take long."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys

import pytest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))  # modules that tests share
ROOT = pathlib.Path(__file__).resolve().parents[2]
SHARED = ROOT.parent / "shared" / "data"
# Seconds within which Ctrl-C must end a call while other tests use the cores. An idle machine takes less than 0.2 s,
# which the long tests of test_interrupts.py demand. Every call that is interrupted would take longer than this.
PROMPT = 0.5


def pytest_configure(config):
    config.addinivalue_line("markers", "long: takes long; `./run python` runs it, `./run test` does not")
    # A shell starts background jobs with Ctrl-C ignored, and Python then leaves it so.
    signal.signal(signal.SIGINT, signal.default_int_handler)


def tool(name):
    """The path of a command-line tool, or a skipped test."""
    folder = os.environ.get("HINGE_TOOLS_DIR", str(ROOT / "build" / "release" / "bin"))
    path = shutil.which(name, path=folder)
    if path is None:
        pytest.skip(f"{name} is not in {folder}")
    return path


def shared(name):
    """The path of a file in ../shared/data, or a skipped test."""
    path = SHARED / name
    if not path.exists():
        pytest.skip(f"{path} does not exist")
    return path


def run_python(code, **environment):
    """Runs code in a process of its own and returns it; the package is found as here."""
    import hinge

    package = str(pathlib.Path(hinge.__file__).parents[1])
    env = {**os.environ, "PYTHONPATH": package, **environment}
    return subprocess.run([sys.executable, "-c", code], env=env, capture_output=True, text=True, timeout=300)


@pytest.fixture(name="tool")
def _tool():
    return tool


@pytest.fixture(name="shared")
def _shared():
    return shared


@pytest.fixture(name="run_python")
def _run_python():
    return run_python
