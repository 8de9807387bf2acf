# SPDX-License-Identifier: BSD-3-Clause
"""Robot: links, joints and named states, from URDF and SRDF or from code."""

import os

import numpy as np

from .. import ModelError
from .._core import robotics as _core
from . import _arguments as _check
from ._description import joint_data, link_data

_TIERS = ("mesh", "hull", "capsule", "spheres")


class Robot(_core.RobotBase):
    """A robot: a tree of links with collision shapes, joined by joints. It does not change after construction.

    links: Link objects (or names of links without shapes). joints: Joint objects. They form one tree, whose root is
    fixed to the world. name: may be empty.
    primitives: 'exact': spheres and capsules are exact, cylinders are enclosed within `tolerance` (m); or 'reference':
    inscribed meshes. solid: closed meshes collide inside, too.

    Raises ModelError, naming the link or joint, for descriptions that are no robot. Two Robot objects of one file are
    two robots: bodies are attached to one of them. Pickling stores the arguments; files are read again.
    """

    def __init__(self, links, joints=(), *, name="", primitives="exact", tolerance=1e-3, solid=False):
        if isinstance(links, (str, bytes, os.PathLike)):
            raise TypeError(f"links: a {type(links).__name__}, expected Link objects; Robot.from_urdf() reads a file")
        links, joints = tuple(links), tuple(joints)
        options = {
            "name": _check.text("name", name),
            "primitives": _check.one_of("primitives", primitives, ("exact", "reference")),
            "tolerance": _check.number("tolerance", tolerance),
            "solid": bool(solid),
        }
        made = [link_data(link) for link in links], [joint_data(joint) for joint in joints]
        super().__init__(name, *made, primitives, options["tolerance"], options["solid"])
        self._made_by = (_from_code, (type(self), links, joints, options))
        self._source = None

    @classmethod
    def from_urdf(
        cls,
        urdf,
        *,
        srdf=None,
        package_path=(),
        missing_meshes="refuse",
        primitives="exact",
        tolerance=1e-3,
        solid=False,
        unknown_links="refuse",
        folder=".",
    ):
        """Read a robot. Defaults are those of the tool robocd.

        urdf, srdf: a path, or the text of the file (a str that contains '<'). The SRDF disables pairs of links and
        names states and groups. package_path: folders for package://, before those of ROS_PACKAGE_PATH and
        AMENT_PREFIX_PATH. missing_meshes: 'refuse' or 'skip' (see incomplete_links).
        primitives, tolerance, solid: as in Robot(). unknown_links: 'refuse' or 'note' pairs of the SRDF with links that
        the robot does not have. folder: for a text, where paths of its meshes begin.
        Raises LoadError, naming file, line and element, for bad files.
        """
        if isinstance(package_path, (str, os.PathLike)):
            package_path = (package_path,)
        folder = _check.path("folder", folder)
        options = {
            "package_path": tuple(_check.path("package_path", entry) for entry in package_path),
            "missing_meshes": _check.one_of("missing_meshes", missing_meshes, ("refuse", "skip")),
            "primitives": _check.one_of("primitives", primitives, ("exact", "reference")),
            "tolerance": _check.number("tolerance", tolerance),
            "solid": bool(solid),
            "unknown_links": _check.one_of("unknown_links", unknown_links, ("refuse", "note")),
            "folder": folder,
        }
        made = cls.__new__(cls)
        urdf_source = _source("urdf", urdf, folder)
        _core.RobotBase.__init__(
            made,
            urdf_source,
            None if srdf is None else _source("srdf", srdf, folder),
            list(options["package_path"]),
            missing_meshes == "skip",
            primitives,
            options["tolerance"],
            bool(solid),
            unknown_links == "note",
        )
        made._made_by = (_from_urdf, (cls, _portable(urdf), None if srdf is None else _portable(srdf), options))
        made._source = urdf_source[1]
        return made

    def with_tiers(self, tier="mesh", *, links=None, most_spheres=32, tolerance=1e-3):
        """Return the robot with simpler shapes, each of which encloses the shapes of its link.

        tier: for all links: 'mesh' (as they are), 'hull', 'capsule' or 'spheres'. links: exceptions, tiers by name of
        the link. most_spheres: per link. tolerance: largest distance of a hull from rounded shapes inside, m.
        A free verdict of the result holds for this robot, too. Raises ModelError for unknown links.
        """
        links = dict(links or {})
        for given in (tier, *links.values()):
            _check.one_of("tier", given, _TIERS)
        arguments = (tier, links, _check.count("most_spheres", most_spheres), _check.number("tolerance", tolerance))
        made = type(self).__new__(type(self))
        _core.RobotBase.__init__(made, self, *arguments)
        made._made_by = (_with_tiers, (self, *arguments))
        made._source = self._source
        return made

    @property
    def links(self):
        """The links, parents first: a structured array with name, parent ('' for the root), group (rigid group),
        triangles, degenerate (triangles without area), rounded (points and segments with a radius), closed (the
        surface has no open edge). Results count links by its rows.
        """
        if "_links" not in self.__dict__:
            self._links = _table(self._link_columns())
        return self._links

    @property
    def joints(self):
        """The joints, in the order of the description: a structured array with name, type, parent, child, lower, upper
        (rad or m; infinite for continuous joints, 0 for fixed ones), column (of a configuration; -1 for fixed joints),
        mimic (the joint that is followed, or ''), multiplier, offset: the value is multiplier * q[column] + offset.
        """
        if "_joints" not in self.__dict__:
            self._joints = _table(self._joint_columns())
        return self._joints

    @property
    def states(self):
        """Named states of the SRDF: configurations of shape (dof,) by 'GROUP/NAME', 0 for joints they leave out."""
        return {name: self.state(name) for name, _ in self._states()}

    def state(self, *names):
        """Return the configuration of named states, shape (dof,). Later states override earlier ones; all others are 0.

        names: 'GROUP/NAME'. Raises ModelError for an unknown state.
        """
        q = np.zeros(self.dof)
        states = self._states()
        for name in names:
            _check.text("state", name)
            found = [values for known, values in states if known == name]
            if not found:
                known = ", ".join(state for state, _ in states) or "none: there is no SRDF with states"
                raise ModelError(f"state {name!r}, expected one of {known}")
            for values in found:
                for column, value in values:
                    q[column] = value
        return q

    def sample(self, n, seed=1, *, first=0, progress=None):
        """Return random configurations within the limits, shape (n, dof), rad or m: those of `robocd check --random`.

        Configuration k depends on (seed, first + k) alone. Raises ModelError for limits above 1e15.
        """
        return self._sample(_check.count("n", n), _check.seed(seed), _check.count("first", first), progress)

    def columns(self, names):
        """Return where the columns of this robot are among other names: integers of shape (dof,).

        names: names of joints in the order of another program, such as MoveIt's JointState.name or Pinocchio's
        model.names[1:]. q[:, robot.columns(names)] is a configuration of this robot. Raises ValueError for a joint that
        is missing or named twice.
        """
        names = [str(name) for name in names]
        found = []
        for joint in self.joint_names:
            if names.count(joint) != 1:
                raise ValueError(f"names: joint {joint!r} occurs {names.count(joint)} times, expected once")
            found.append(names.index(joint))
        return np.array(found, dtype=np.intp)

    def from_columns(self, q, names, sizes=None):
        """Return configurations of this robot from those of another program, shape (n, dof) or (dof,).

        q: shape (n, k) or (k,). names: of the joints of q, in order. sizes: number of columns of each joint, 1 or 2,
        default 1; two are the cosine and sine of the angle, as Pinocchio has for continuous joints (model.nqs[1:]).
        Columns of other joints are not used. Raises ValueError as columns() does, and for a wrong number of columns.
        """
        names = [str(name) for name in names]
        sizes = [1] * len(names) if sizes is None else [int(size) for size in sizes]
        if len(sizes) != len(names) or not set(sizes) <= {1, 2}:
            raise ValueError(f"sizes: {sizes}, expected 1 or 2 for each of {len(names)} names")
        q = np.asarray(q, dtype=np.float64)
        if q.ndim not in (1, 2) or q.shape[-1] != sum(sizes):
            raise ValueError(f"q: shape {q.shape}, expected {sum(sizes)} columns, those of the names")
        starts = np.concatenate([[0], np.cumsum(sizes)]).astype(int)
        made = np.empty((*q.shape[:-1], self.dof))
        for column, k in enumerate(self.columns(names)):
            start = starts[k]
            made[..., column] = (
                q[..., start] if sizes[k] == 1 else np.arctan2(q[..., start + 1], q[..., start])
            )
        return made

    def to_columns(self, q, names):
        """Return the values of joints in the order of another program, shape (n, len(names)) or (len(names),).

        q: shape (n, dof) or (dof,). names: joints of this robot, mimic joints included; fixed joints are 0. Raises
        ValueError for a name that is no joint.
        """
        joints = self.joints
        row_of = {name: row for row, name in enumerate(joints["name"])}
        for name in names:
            if name not in row_of:
                raise ValueError(f"names: robot {self.name!r} has no joint {name!r}")
        movable = self.movable_joints
        full = self.expand(q)
        zero = np.zeros((*full.shape[:-1], 1))
        full = np.concatenate([full, zero], axis=-1)
        order = [movable.index(name) if name in movable else len(movable) for name in names]
        return full[..., order]

    @property
    def spheres(self):
        """The spheres of a robot made only of spheres: a structured array with link (row of links), center (m, in the
        link's frame, shape (3,)), radius (m). with_tiers('spheres') makes such a robot. Raises ModelError for others.
        """
        links, centers, radii = self._spheres()
        made = np.empty(len(radii), [("link", "i4"), ("center", "f8", (3,)), ("radius", "f8")])
        made["link"], made["center"], made["radius"] = links, centers, radii
        return made

    def __reduce__(self):
        return self._made_by

    def __repr__(self):
        source = f" from {self._source!r}" if self._source else ""
        return f"<Robot {self.name!r}{source}: {len(self.link_names)} links, {self.dof} degrees of freedom>"


def _table(columns):
    arrays = {name: np.asarray(column) for name, column in columns.items()}
    for name, array in arrays.items():
        if array.size == 0 and array.dtype == np.float64 and isinstance(columns[name], list):
            arrays[name] = array.astype("U1")  # an empty list of names
    table = np.empty(len(next(iter(arrays.values()))), [(name, array.dtype) for name, array in arrays.items()])
    for name, array in arrays.items():
        table[name] = array
    table.flags.writeable = False
    return table


def _source(name, given, folder):
    """(text or None, path) of a file or its text."""
    if isinstance(given, str) and "<" in given:
        return given, os.path.join(folder, f"{name} text")
    if isinstance(given, bytes) and b"<" in given:
        return given.decode("utf-8", "surrogateescape"), os.path.join(folder, f"{name} text")
    return None, _check.path(name, given)


def _portable(given):
    return given if isinstance(given, (str, bytes)) else os.fspath(given)


def _from_code(cls, links, joints, options):
    return cls(links, joints, **options)


def _from_urdf(cls, urdf, srdf, options):
    return cls.from_urdf(urdf, srdf=srdf, **options)


def _with_tiers(robot, tier, links, most_spheres, tolerance):
    return robot.with_tiers(tier, links=links, most_spheres=most_spheres, tolerance=tolerance)
