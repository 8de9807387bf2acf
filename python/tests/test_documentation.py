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
import hinge.distributed
import hinge.molecular
import hinge.robotics

HERE = pathlib.Path(__file__).resolve().parent
MODULES = (hinge, hinge.molecular, hinge.robotics, hinge.distributed)
# Results, which users do not construct.
RESULTS = ("CoordinateFit", "Motion", "Relaxation", "RigidGroups", "Walk")


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
        if issubclass(thing, Exception) or thing.__name__ in RESULTS:
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


def classes_of(name):
    """The class that a public name belongs to, or None."""
    for module in sorted(MODULES, key=lambda m: -len(m.__name__)):
        if name.startswith(module.__name__ + "."):
            return getattr(module, name[len(module.__name__) + 1 :].partition(".")[0], None)
    return None


@pytest.mark.parametrize("name, thing", public_things(), ids=lambda x: x if isinstance(x, str) else "")
def test_docstrings_say_what_is_raised(name, thing):
    """A function, a method or its class says it; results that users do not construct raise nothing."""
    if isinstance(thing, (classmethod, staticmethod)):
        thing = thing.__func__
    if not callable(thing) or (inspect.isclass(thing) and issubclass(thing, Exception)):
        return
    if inspect.isclass(thing) and thing.__name__ in (*RESULTS, "PathAnswer", "Shape"):
        return
    function = thing.__init__ if inspect.isclass(thing) else thing
    parameters = set(inspect.signature(function).parameters) - {"self", "threads", "progress"}
    owner = classes_of(name)
    docs = inspect.getdoc(thing) + (inspect.getdoc(owner) if inspect.isclass(owner) else "")
    assert not parameters or "aises" in docs, name


UNITS = re.compile(
    r"angstrom|\brad\b|\bm\b|length|unit|0 to 1|number|count|ind(ex|ices)|names?\b|text|boolean|bool\b|True|False|word|"
    r"path|file|sentence|dict|list|rows?\b|Robot\b|Molecule\b|Model\b|Mesh\b|Mimic\b|Environment\b|shapes?\b|None",
    re.IGNORECASE,
)


@pytest.mark.parametrize("name, thing", public_things(), ids=lambda x: x if isinstance(x, str) else "")
def test_docstrings_of_arrays_give_shapes_and_units(name, thing):
    """Where the stub has an array, the docstring has a shape, or refers to a relative that does; numbers have units."""
    if isinstance(thing, (classmethod, staticmethod)):
        thing = thing.__func__
    doc = inspect.getdoc(thing) or ""
    if type(thing).__name__ == "member_descriptor" or not (callable(thing) or hasattr(thing, "__get__")):
        return
    stub = stub_of(name)
    if stub is None or (inspect.isclass(thing) and issubclass(thing, Exception)):
        return
    if re.search(r"ArrayLike|NDArray|_Floats|_Rows", stub):
        assert re.search(r"shape|rows|structured|as (in|of) |Arguments as|factor|read-only view", doc), name
        assert UNITS.search(doc), name
    if re.search(r"\bfloat\b", stub):
        assert re.search(r"angstrom|\brad\b|\bm\b|length|share|factor|as (in|of) |Arguments as|multiplier", doc), name


def stub_of(name):
    """The text of the stub of a public function, method, property or class, from its signature to its end."""
    folder = pathlib.Path(hinge.__file__).parent
    parts = name.split(".")[1:]
    files = [folder / "__init__.pyi"]
    if parts[0] in ("molecular", "robotics"):
        files = sorted((folder / parts.pop(0)).glob("*.pyi"))
    for file in files:
        text = file.read_text()
        if inspect_class := re.search(rf"^class {parts[0]}\b.*?(?=^\S|\Z)", text, re.MULTILINE | re.DOTALL):
            member = parts[1] if len(parts) > 1 else "__init__"
            found = re.findall(rf"^    def {member}\(.*?\.\.\.$", inspect_class[0], re.MULTILINE | re.DOTALL)
            return "\n".join(found) or None
        found = re.findall(rf"^def {parts[0]}\(.*?\.\.\.$", text, re.MULTILINE | re.DOTALL)
        if found:
            return "\n".join(found)
    return None


def test_stubs_say_any_only_where_no_type_is_known():
    allowed = re.compile(r"^(from typing import .*|_(Booleans|Numbers) = .*|def __getattr__.* -> Any: \.\.\.)$")
    stubs = list(pathlib.Path(hinge.__file__).parent.rglob("*.pyi"))
    assert len(stubs) >= 8
    for stub in stubs:
        for line in stub.read_text().splitlines():
            assert not re.search(r"\bAny\b", line) or allowed.match(line), f"{stub.name}: {line}"


def test_stubs_agree_with_the_package(tmp_path):
    for needed in ("mypy", "MDAnalysis"):  # stubtest imports every module of the package
        if importlib.util.find_spec(needed) is None:
            pytest.skip(f"{needed} is not installed")
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


def test_a_type_checker_knows_results_that_depend_on_arguments(tmp_path):
    if importlib.util.find_spec("mypy") is None:
        pytest.skip("mypy is not installed")
    program = tmp_path / "program.py"
    program.write_text(
        "import hinge\nimport hinge.molecular as hm\nimport hinge.robotics as hr\n"
        "def f(a: hinge.Checker, m: hm.Checker, r: hr.Checker, t: hm.Trajectory) -> None:\n"
        "    for c in (a, m, r):\n        pass\n"
        "    reveal_type(a.collides([0.0]))\n    reveal_type(a.collides([[0.0], [1.0]]))\n"
        "    reveal_type(m.collides([0.0]))\n    reveal_type(m.collides([[0.0]]))\n"
        "    reveal_type(r.collides([0.0]))\n    reveal_type(r.collides([[0.0]]))\n"
        "    reveal_type(r.distance([0.0]))\n    reveal_type(r.distance([[0.0]]))\n"
        "    reveal_type(m.collides_coordinates([[0.0]]))\n    reveal_type(m.collides_coordinates(t))\n"
        "    reveal_type(r.collides_with(r, [0.0], [0.0]))\n    reveal_type(a.collides_with(a, [[0.0]], [[0.0]]))\n"
    )
    env = {**os.environ, "MYPYPATH": "", "PYTHONPATH": str(pathlib.Path(hinge.__file__).parents[1])}
    done = subprocess.run(
        [sys.executable, "-m", "mypy", str(program)], cwd=tmp_path, env=env, capture_output=True, text=True, timeout=300
    )
    told = re.findall(r'Revealed type is "(.*)"', done.stdout)
    kinds = ["array" if "ndarray" in kind else kind.rpartition(".")[2] for kind in told]
    one_and_several = ["bool", "array"]
    assert kinds == [*one_and_several * 3, "float", "array", *one_and_several * 2], done.stdout
    assert "Any]" not in " ".join(kind for kind in told if "ndarray" not in kind), done.stdout


def test_the_reference_page_is_up_to_date():
    import reference_page

    wanted = reference_page.page(MODULES)
    assert reference_page.PAGE.read_text() == wanted, "run python/tests/reference_page.py"
