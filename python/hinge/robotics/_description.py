# SPDX-License-Identifier: BSD-3-Clause
"""Link, Joint and Mimic: a robot made in code."""

import dataclasses

import numpy as np

from . import _arguments as _check
from ._shapes import Shape, matrix

_JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic")


@dataclasses.dataclass(frozen=True)
class Link:
    """A link of a robot made in code.

    name: unique, not empty. shapes: collision shapes, each a Shape, or (Shape, pose) with the pose of the shape in the
    link, a matrix of shape (4, 4) or a translation of shape (3,), m. A link without shapes is not tested.
    Robot() raises TypeError, ValueError or ModelError for a link that is none.
    """

    name: str
    shapes: tuple = ()


@dataclasses.dataclass(frozen=True)
class Mimic:
    """Lets a joint follow another one: its value is multiplier * value of `joint` + offset (rad or m).

    Robot() raises ModelError for a joint that does not exist or follows itself.
    """

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclasses.dataclass(frozen=True, eq=False)
class Joint:
    """A joint of a robot made in code. The child's pose in the parent is origin * motion(q).

    name: unique, not empty. type: 'fixed', 'revolute', 'continuous' or 'prismatic'. parent, child: names of links.
    origin: shape (4, 4), or a translation of shape (3,), m; None: the identity. axis: shape (3,), in the child's frame.
    lower, upper: limits, rad or m; not used by fixed and continuous joints. mimic: a Mimic, or None.
    Robot() raises TypeError, ValueError or ModelError for a joint that is none.
    """

    name: str
    type: str
    parent: str
    child: str
    origin: object = None
    axis: object = (1.0, 0.0, 0.0)
    lower: float = 0.0
    upper: float = 0.0
    mimic: object = None


def link_data(link):
    """A Link as the compiled part takes it."""
    if isinstance(link, str):
        link = Link(link)
    if not isinstance(link, Link):
        raise TypeError(f"links: a {type(link).__name__}, expected a Link")
    placed = []
    for item in (link.shapes,) if isinstance(link.shapes, Shape) else link.shapes:
        shape, at = (item, None) if isinstance(item, Shape) or not _is_pair(item) else item
        if not isinstance(shape, Shape):
            raise TypeError(f"links: link {link.name!r} has a {type(shape).__name__}, expected Shape or (Shape, pose)")
        placed.append((shape._data, matrix("pose", at)))
    return _check.text("name of a link", link.name), placed


def _is_pair(item):
    return isinstance(item, (tuple, list)) and len(item) == 2


def joint_data(joint):
    """A Joint as the compiled part takes it."""
    if not isinstance(joint, Joint):
        raise TypeError(f"joints: a {type(joint).__name__}, expected a Joint")
    who = f"joint {joint.name!r}: "
    mimic = joint.mimic
    if mimic is not None and not isinstance(mimic, Mimic):
        raise TypeError(f"{who}mimic is a {type(mimic).__name__}, expected a Mimic or None")
    return (
        _check.text("name of a joint", joint.name),
        _check.one_of(who + "type", joint.type, _JOINT_TYPES),
        _check.text(who + "parent", joint.parent),
        _check.text(who + "child", joint.child),
        matrix("origin", joint.origin),
        np.asarray(joint.axis),
        _check.number(who + "lower", joint.lower),
        _check.number(who + "upper", joint.upper),
        None
        if mimic is None
        else (
            _check.text(who + "mimic", mimic.joint),
            _check.number(who + "multiplier", mimic.multiplier),
            _check.number(who + "offset", mimic.offset),
        ),
    )
