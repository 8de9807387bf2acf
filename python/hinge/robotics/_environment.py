# SPDX-License-Identifier: BSD-3-Clause
"""Environment: bodies around robots, which are added, moved, attached to links and removed."""

from .. import ModelError
from .._core import robotics as _core
from . import _arguments as _check
from ._robot import Robot
from ._shapes import Shape, matrix


class Environment(_core.EnvironmentBase):
    """Bodies around one or several robots, by name. Checkers see changes in their next call.

    clearance: distance that bodies keep from robots and from held bodies, m; between links and bodies the larger one of
    this and the checker's holds. engine: that of every checker of the environment: 'simd', 'lazy' or 'brute'.
    primitives, tolerance: as in Robot().

    Poses are matrices of shape (4, 4), or translations of shape (3,), in the world frame, m. Any number of threads may
    use checkers of one environment; a change waits until running calls end. Pickling stores bodies and attachments.
    Raises ModelError for unknown bodies, ConfigurationError for poses that are not rigid.
    """

    def __init__(self, clearance=0.0, *, engine="simd", primitives="exact", tolerance=1e-3):
        self._options = {
            "clearance": _check.number("clearance", clearance, positive=True),
            "engine": _check.one_of("engine", engine, ("simd", "lazy", "brute")),
            "primitives": _check.one_of("primitives", primitives, ("exact", "reference")),
            "tolerance": _check.number("tolerance", tolerance),
        }
        super().__init__(*(self._options[k] for k in ("clearance", "engine", "primitives", "tolerance")))
        self._bodies = {}  # name: (number, shape)
        self._names = []  # by number; '' if removed
        self._attached = {}  # name: (robot, link, pose, may_touch)
        self._allowed = []  # (name, robot, links)

    def add(self, shape, pose=None, name=None):
        """Add a body and return its name.

        shape: a Shape. pose: of the shape's frame in the world; None: the identity. name: unique; None: 'body N'.
        """
        if not isinstance(shape, Shape):
            raise TypeError(f"shape: a {type(shape).__name__}, expected a Shape")
        name = f"body {len(self._names)}" if name is None else _check.text("name", name)
        if not name or name in self._bodies:
            raise ModelError(f"name: {name!r}, expected a name that no body has")
        number = self._add(shape._data, matrix("pose", pose), name)
        self._bodies[name] = (number, shape)
        self._names.append(name)
        return name

    def remove(self, name):
        """Remove a body. name: of the body."""
        number = self._number(name)
        self._remove(number)
        del self._bodies[name]
        self._names[number] = ""
        self._attached.pop(name, None)
        self._allowed = [entry for entry in self._allowed if entry[0] != name]

    def set_pose(self, name, pose):
        """Move a body that is not attached.

        name: of the body. pose: of its frame in the world, shape (4, 4) or (3,), m.
        """
        self._set_pose(self._number(name), matrix("pose", pose))

    def pose(self, name):
        """Return the pose of a body, shape (4, 4). name: of the body; of an attached one, where it stood before."""
        return self._pose(self._number(name))

    def shape(self, name):
        """Return the shape of a body. name: of the body."""
        self._number(name)
        return self._bodies[name][1]

    def attach(self, name, robot, link, pose=None, *, may_touch=None):
        """Attach a body to a link of a robot: in every answer for this robot, its pose is link pose * pose.

        name: of the body. robot: a Robot. link: its name. pose: of the body in the link's frame, shape (4, 4)
        or (3,), m; None: the identity.
        may_touch: names of links that the body may touch; None: those of the link's rigid group. A body held by another
        robot stands where it stood before.
        """
        number = self._number(name)
        link = _check.text("link", link)
        at = matrix("pose", pose)
        links = None if may_touch is None else _names_of("may_touch", may_touch)
        self._attach(number, _robot("robot", robot), link, at, links)
        self._attached[name] = (robot, link, at, links)

    def detach(self, name, pose=None):
        """Detach a body.

        name: of the body. pose: where it stands now, shape (4, 4) or (3,), m, in the world; None: where it
        stood before it was attached.
        """
        number = self._number(name)
        if name not in self._attached:
            raise ModelError(f"name: body {name!r} is not attached")
        self._detach(number, None if pose is None else matrix("pose", pose))
        del self._attached[name]

    def attached_to(self, name):
        """Return the robot and the name of the link that hold a body, or None. name: of the body."""
        self._number(name)
        found = self._attached.get(name)
        return found and found[:2]

    def allow(self, name, robot, links):
        """Allow links of a robot to touch a body, such as a base and its table.

        name: of the body. robot: a Robot. links: names of its links, or one name.
        """
        number = self._number(name)
        links = _names_of("links", links)
        self._allow(number, _robot("robot", robot), links)
        self._allowed.append((name, robot, links))

    @property
    def names(self):
        """Names of the bodies, in the order of addition."""
        return list(self._bodies)

    def _number(self, name):
        _check.text("name", name)
        if name not in self._bodies:
            raise ModelError(f"name: no body {name!r}, expected one of {', '.join(map(repr, self._bodies)) or 'none'}")
        return self._bodies[name][0]

    def __len__(self):
        return len(self._bodies)

    def __iter__(self):
        return iter(self.names)

    def __contains__(self, name):
        return name in self._bodies

    def __getstate__(self):
        bodies = [(name, shape, self.pose(name)) for name, (_, shape) in self._bodies.items()]
        return self._options, bodies, self._attached, self._allowed

    def __setstate__(self, state):
        options, bodies, attached, allowed = state
        Environment.__init__(self, **options)
        for name, shape, pose in bodies:
            self.add(shape, pose, name)
        for name, robot, links in allowed:
            self.allow(name, robot, links)
        for name, (robot, link, pose, may_touch) in attached.items():
            self.attach(name, robot, link, pose, may_touch=may_touch)

    def __reduce__(self):
        return _new, (type(self),), self.__getstate__()

    def __repr__(self):
        held = f", {len(self._attached)} attached" if self._attached else ""
        return f"<Environment of {len(self)} bodies{held}, clearance {self.clearance} m>"


def _new(cls):
    return cls.__new__(cls)


def _robot(name, robot):
    if not isinstance(robot, Robot):
        raise TypeError(f"{name}: a {type(robot).__name__}, expected a Robot")
    return robot


def _names_of(argument, names):
    return [names] if isinstance(names, str) else [_check.text(argument, name) for name in names]
