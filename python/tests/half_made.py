# SPDX-License-Identifier: BSD-3-Clause
"""Program of test_half_made.py: uses objects whose __init__ has not run, in every way. A crash ends the process."""

import copy
import inspect
import pickle
import random
import sys

import numpy as np

import hinge
import hinge._core
import hinge.molecular
import hinge.robotics


def classes():
    """Every class of the package, compiled or not, but its exceptions."""
    found = set()
    for module in [m for name, m in sorted(sys.modules.items()) if name.partition(".")[0] == "hinge"]:
        for thing in vars(module).values():
            if inspect.isclass(thing) and str(thing.__module__).partition(".")[0] == "hinge":
                found.add(thing)
    return sorted((c for c in found if not issubclass(c, Exception)), key=lambda c: (c.__module__, c.__qualname__))


def whole(root):
    """Objects that work."""
    molecule = hinge.molecular.Molecule(f"{root}/molecular/data/1ubq.pdb")
    model = hinge.Model([0])
    model.add_spheres([0, 1], [[0, 0, 1], [0, 0, 2]], 0.1)
    box = hinge.robotics.Box((1, 1, 1))
    robot = hinge.robotics.Robot(
        [hinge.robotics.Link("a", box), hinge.robotics.Link("b", box)],
        [hinge.robotics.Joint("j", "revolute", "a", "b", axis=(0, 0, 1), lower=-1, upper=1)],
    )
    around = hinge.robotics.Environment()
    around.add(box, (2, 0, 0), "box")
    return [
        molecule,
        hinge.molecular.Checker(molecule, "A:1-3"),
        model,
        hinge.Checker(model),
        box,
        robot,
        around,
        hinge.robotics.Checker(robot, environment=around),
    ]


def attempt(call, *arguments):
    """Calls and expects any answer or any exception of Python's."""
    try:
        return call(*arguments)
    except Exception as error:
        assert not isinstance(error, (SystemError, MemoryError)), error
        return None


def use(thing, others, rng):
    """Calls every member of the object with members of `others`."""
    for way in (repr, str, len, iter, bool, hash, list, copy.copy, copy.deepcopy, pickle.dumps, vars):
        attempt(way, thing)
    for name in sorted(set(dir(thing)) | set(dir(type(thing)))):
        if name in ("__class__", "__init_subclass__", "__subclasshook__", "__new__", "__dir__"):
            continue
        member = attempt(getattr, thing, name)
        if callable(member):
            for count in (0, 1, 1, 2, 3, 4):
                attempt(member, *(rng.choice(others) for _ in range(count)))


def main(root, seed):
    rng = random.Random(seed)
    values = [None, 0, 1, -1, 2.5, "A", "x", "all", (), [], np.zeros((2, 3)), np.zeros(2), {}, b"bytes"]
    compiled = 0
    for cls in classes():
        half = attempt(cls.__new__, cls)
        if half is None:
            continue
        reader = next((n for n, m in inspect.getmembers_static(cls) if isinstance(m, property) and n[0] != "_"), None)
        if any(base.__module__.startswith("pybind11") for base in cls.__mro__):
            compiled += 1
            if reader is not None:
                try:
                    answer = getattr(half, reader)
                except (TypeError, AttributeError):
                    pass
                else:
                    raise AssertionError(f"{cls}.{reader} of a half-made object is {answer!r}, expected an exception")
        use(half, [*values, half], rng)
        for thing in whole(root):
            use(thing, [half, half, *values], rng)
        empty = type(cls.__name__ + "Heir", (cls,), {"__init__": lambda self: None})
        heir = attempt(empty)
        if heir is not None:
            use(heir, [*values, heir], rng)
    assert compiled >= 8, compiled
    molecule, checker = whole(root)[:2]
    assert checker.dof > 0 and checker.collides(np.zeros(checker.dof)) in (True, False)
    print("done")


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
