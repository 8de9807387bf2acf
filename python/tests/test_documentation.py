# SPDX-License-Identifier: BSD-3-Clause
"""Stubs agree with the package, and everything public has a docstring that says what its arguments are."""

import importlib.util
import inspect
import os
import pathlib
import re
import subprocess
import sys

import pytest

import hinge
import hinge.molecular
import hinge.robotics

HERE = pathlib.Path(__file__).resolve().parent
MODULES = (hinge, hinge.molecular, hinge.robotics)


def public_things():
    """(name, object) of every public function, class, method and property."""
    for module in MODULES:
        for name in module.__all__:
            thing = getattr(module, name)
            if not inspect.isclass(thing):
                if callable(thing):
                    yield f"{module.__name__}.{name}", thing
                continue
            yield f"{module.__name__}.{name}", thing
            if issubclass(thing, Exception):
                continue
            for member in dir(thing):
                if not member.startswith("_"):
                    yield f"{module.__name__}.{name}.{member}", inspect.getattr_static(thing, member)


@pytest.mark.parametrize("name, thing", public_things(), ids=lambda x: x if isinstance(x, str) else "")
def test_everything_public_has_a_docstring(name, thing):
    if type(thing).__name__ == "member_descriptor" or not (callable(thing) or hasattr(thing, "__get__")):
        pytest.skip("a field of a dataclass; its class describes it")
    doc = inspect.getdoc(thing)
    assert doc and len(doc) > 15, name


@pytest.mark.parametrize("name, thing", public_things(), ids=lambda x: x if isinstance(x, str) else "")
def test_docstrings_name_every_argument(name, thing):
    """Of the functions, arguments that are not described by a relative with the same ones."""
    if isinstance(thing, (classmethod, staticmethod)):
        thing = thing.__func__
    if inspect.isclass(thing):
        if issubclass(thing, Exception) or thing.__name__ in ("Walk", "RigidGroups"):
            return
        doc, function = inspect.getdoc(thing), thing.__init__
    elif callable(thing):
        doc, function = inspect.getdoc(thing), thing
    else:
        return
    parameters = [p for p in inspect.signature(function).parameters if p not in ("self", "cls", "threads", "progress")]
    shared_elsewhere = ("as in " in doc, "as of " in doc)
    missing = [p for p in parameters if not re.search(rf"\b{p}\b", doc)]
    assert not missing or any(shared_elsewhere), f"{name}: {missing}"


def test_stubs_agree_with_the_package(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    package = str(pathlib.Path(hinge.__file__).parents[1])
    arguments = [sys.executable, "-m", "mypy.stubtest", "hinge", "--allowlist", str(HERE / "stubtest_allowlist.txt")]
    env = {**os.environ, "PYTHONPATH": package, "MYPYPATH": ""}
    done = subprocess.run(
        [*arguments, "--ignore-unused-allowlist"], cwd=tmp_path, env=env, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_type_checker_accepts_a_program_and_finds_its_mistakes(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    program = tmp_path / "program.py"
    program.write_text(
        "import numpy as np\nimport hinge.molecular as hm\n"
        "m = hm.Molecule('a.pdb', hetero=True)\nc = hm.Checker(m, 'A:1-5', threads=2)\n"
        "q = c.sample(10, seed=1, sigma=0.1)\nn: int = c.dof\nhits = c.collides(q, progress=print)\n"
        "hm.Molecule('a.pdb', hydrogens='maybe')\nc.sample('ten')\n"
    )
    env = {**os.environ, "MYPYPATH": "", "PYTHONPATH": str(pathlib.Path(hinge.__file__).parents[1])}
    done = subprocess.run(
        [sys.executable, "-m", "mypy", str(program)], cwd=tmp_path, env=env, capture_output=True, text=True, timeout=300
    )
    wrong = sorted(int(n) for n in re.findall(r"program\.py:(\d+): error", done.stdout))
    assert wrong == [8, 9], done.stdout


def test_the_reference_page_is_up_to_date():
    import reference_page

    wanted = reference_page.page(MODULES)
    assert reference_page.PAGE.read_text() == wanted, "run python/tests/reference_page.py"
