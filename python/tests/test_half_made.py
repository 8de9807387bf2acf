# SPDX-License-Identifier: BSD-3-Clause
"""Objects whose __init__ has not run: an exception, never a crash."""

import copy
import os
import pathlib
import pickle
import subprocess
import sys

import pytest

import hinge
import hinge.molecular as hm
import hinge.robotics as hr
from conftest import ROOT

HANDLES = [hinge.Checker, hm.Molecule, hm.Checker, hm.Trajectory, hr.Robot, hr.Environment, hr.Checker]
HANDLES += [hr.CollisionMatrix]


def name_of(cls):
    return f"{cls.__module__}.{cls.__name__}"


MESSAGE = r"an object whose __init__\(\) has not been called"


@pytest.mark.parametrize("seed", range(3))
def test_no_use_of_a_half_made_object_crashes(seed):
    program = pathlib.Path(__file__).with_name("half_made.py")
    package = str(pathlib.Path(hinge.__file__).parents[1])
    done = subprocess.run(
        [sys.executable, str(program), str(ROOT), str(seed)],
        env={**os.environ, "PYTHONPATH": package},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0 and done.stdout.endswith("done\n"), done.stdout[-2000:] + done.stderr[-4000:]


def first_property(cls):
    """A property that the compiled part answers."""
    for base in cls.__mro__:
        if base.__name__.endswith("Base"):
            return next(name for name in vars(base) if type(vars(base)[name]).__name__ == "property")
    raise AssertionError(f"{cls} has no compiled part")


@pytest.mark.parametrize("cls", [c for c in HANDLES if c is not hr.CollisionMatrix], ids=name_of)
def test_the_exception_names_the_class(cls):
    with pytest.raises(TypeError, match=f"{cls.__name__}: {MESSAGE}"):
        getattr(cls.__new__(cls), first_property(cls))


@pytest.mark.parametrize("cls", HANDLES, ids=name_of)
def test_half_made_objects_are_not_copied(cls):
    for way in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises((TypeError, AttributeError)):
            way(cls.__new__(cls))


@pytest.mark.parametrize("cls", HANDLES, ids=name_of)
def test_heirs_call_the_init_of_their_base(cls):
    heir = type("Heir", (cls,), {"__init__": lambda self: None})
    with pytest.raises(TypeError, match="__init__"):
        heir()


def test_half_made_arguments_are_refused():
    box = hr.Box((1, 1, 1))
    robot = hr.Robot([hr.Link("a", box)])
    around = hr.Environment()
    half = {cls: cls.__new__(cls) for cls in HANDLES}
    with pytest.raises(TypeError, match=f"Environment: {MESSAGE}"):
        hr.Checker(robot, environment=half[hr.Environment])
    with pytest.raises(TypeError, match=f"Robot: {MESSAGE}"):
        hr.CollisionMatrix(half[hr.Robot])
    around.add(box, None, "b")
    with pytest.raises(TypeError, match=f"Robot: {MESSAGE}"):
        around.attach("b", half[hr.Robot], "a")


def test_whole_objects_are_copied():
    molecule = hm.Molecule(ROOT / "molecular/data/1ubq.pdb")
    checker = hm.Checker(molecule, "A:1-9", threads=2)
    for way in (copy.copy, copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))):
        again = way(checker)
        assert (again.dof, again.threads) == (checker.dof, 2)
        assert (again.collides(checker.sample(50)) == checker.collides(checker.sample(50))).all()
