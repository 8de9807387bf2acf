# SPDX-License-Identifier: BSD-3-Clause
"""Shapes of links and bodies, and poses. Lengths in m, angles in rad."""

import numpy as np

from .._core import robotics as _core
from ._arguments import number, path


class Shape:
    """A shape in its own frame, centred there as in URDF. It does not change. See Box, Sphere, Cylinder, Capsule, Mesh
    and PointCloud. Lengths are in m, at least 0.
    """

    def __init__(self):
        raise TypeError("Shape: expected one of Box, Sphere, Cylinder, Capsule, Mesh, PointCloud")

    def _keep(self, data, *arguments):
        self._data = data
        self._arguments = arguments

    @property
    def surface(self):
        """Triangles on the surface, for pictures: shape (n, 3, 3), m. A sphere has 320, a cylinder has 32 sides."""
        return self._data.surface

    @property
    def open_edge(self):
        """Text about an edge where the surface is open, or None if it is closed. A solid shape is closed."""
        return self._data.open_edge

    def __reduce__(self):
        return type(self), self._arguments

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(map(repr, self._arguments))})"


class Box(Shape):
    """A solid box.

    size: edge lengths along x, y, z, m, shape (3,). Raises TypeError, ValueError, and ModelError for negative lengths.
    """

    def __init__(self, size):
        self._keep(_core.ShapeData.box(size), tuple(np.asarray(size, float).tolist()))

    @property
    def size(self):
        """Edge lengths along x, y, z, m, shape (3,)."""
        return np.array(self._arguments[0])


class Sphere(Shape):
    """A solid sphere. radius: m. Raises TypeError, ValueError, and ModelError for a negative radius."""

    def __init__(self, radius):
        radius = number("radius", radius)
        self._keep(_core.ShapeData.sphere(radius), radius)

    @property
    def radius(self):
        """Radius of the shape, m."""
        return self._arguments[0]


class _Round(Shape):
    def __init__(self, radius, length):
        radius, length = number("radius", radius), number("length", length)
        self._keep(getattr(_core.ShapeData, type(self).__name__.lower())(radius, length), radius, length)

    @property
    def radius(self):
        """Radius of the shape, m."""
        return self._arguments[0]

    @property
    def length(self):
        """Length along z, m."""
        return self._arguments[1]


class Cylinder(_Round):
    """A solid cylinder along z.

    radius, length: m. Raises TypeError, ValueError, and ModelError for negative lengths.
    """


class Capsule(_Round):
    """A solid capsule: all points within a radius of a segment along z.

    radius, length of the segment: m. Raises TypeError, ValueError, and ModelError for negative lengths.
    """


class Mesh(Shape):
    """A surface of triangles. Two surfaces collide where they touch; the inside is free unless the mesh is solid.

    vertices: shape (n, 3), m. faces: integers of shape (m, 3), indices of vertices; None: vertices has shape (m, 3, 3).
    scale: a factor, or one per axis; negative factors mirror. solid: the inside collides, too; the mesh must be closed.
    Raises TypeError, ValueError and IndexError for bad arrays, ModelError for a mesh without triangles or a scale of 0.
    """

    def __init__(self, vertices, faces=None, *, scale=1.0, solid=False):
        scale = _scale(scale)
        self._keep(_core.ShapeData.mesh(vertices, faces, scale, bool(solid)), scale, bool(solid))
        self._notes = ()
        self._path = None

    @classmethod
    def read(cls, file, *, scale=1.0, solid=False):
        """Read the triangles of an STL, OBJ, PLY or DAE file, in m.

        file: a path. scale, solid: as in Mesh(). Raises LoadError for bad files.
        """
        scale = _scale(scale)
        made = cls.__new__(cls)
        made._path = path("file", file)
        data, notes = _core.ShapeData.read_mesh(made._path, scale, bool(solid))
        made._keep(data, scale, bool(solid))
        made._notes = tuple(notes)
        return made

    @property
    def triangles(self):
        """Corners of the triangles before scaling: a read-only view of shape (m, 3, 3), m."""
        return self._data.triangles

    @property
    def scale(self):
        """Factors along x, y, z, shape (3,)."""
        return self._arguments[0].copy()

    @property
    def solid(self):
        """True if the inside collides."""
        return self._arguments[1]

    @property
    def notes(self):
        """What the reader of the file skipped, one sentence each."""
        return list(self._notes)

    def __reduce__(self):
        return _mesh, (type(self), np.array(self.triangles), *self._arguments)

    def __repr__(self):
        source = f" from {self._path!r}" if self._path else ""
        return f"<Mesh of {len(self.triangles)} triangles{source}{', solid' if self.solid else ''}>"


class PointCloud(Shape):
    """Solid spheres of one radius, such as the points of a depth camera with their uncertainty.

    points: shape (n, 3), m, at least one. radius: m.
    Raises TypeError, ValueError, and ModelError for a negative radius.
    """

    def __init__(self, points, radius):
        radius = number("radius", radius)
        self._keep(_core.ShapeData.point_cloud(points, radius), radius)

    @classmethod
    def read(cls, file, radius):
        """Read a text file with x y z in each line, m.

        file: a path. radius: m. Raises LoadError for bad files.
        """
        made = cls.__new__(cls)
        made._keep(_core.ShapeData.read_points(path("file", file), number("radius", radius)), number("radius", radius))
        return made

    @property
    def points(self):
        """The points: a read-only view of shape (n, 3), m."""
        return self._data.points

    @property
    def radius(self):
        """Radius of the shape, m."""
        return self._arguments[0]

    def __reduce__(self):
        return type(self), (np.array(self.points), self.radius)

    def __repr__(self):
        return f"<PointCloud of {len(self.points)} points, radius {self.radius}>"


def _scale(scale):
    array = np.asarray(scale)
    if array.dtype.kind not in "fiu":
        raise TypeError("scale: expected a factor, or one per axis")
    if array.shape not in ((), (3,)):
        raise ValueError(f"scale: shape {array.shape}, expected one factor or three")
    return np.array(np.broadcast_to(array.astype(float), (3,)))


def _mesh(cls, triangles, scale, solid):
    return cls(triangles, scale=scale, solid=solid)


def pose(xyz=(0.0, 0.0, 0.0), rpy=(0.0, 0.0, 0.0)):
    """Return a pose as a matrix of shape (4, 4), by the same operations as a URDF origin.

    xyz: translation, m, shape (3,). rpy: roll about x, then pitch about y, then yaw about z, fixed axes, rad. Raises
    TypeError and ValueError.
    """
    return _core.matrix_of_rpy(xyz, rpy)


def matrix(name, value):
    """A pose as an argument: a copy of shape (4, 4); None is the identity, and three numbers are a translation."""
    if value is None:
        return np.eye(4)
    array = np.array(value)
    if array.shape == (3,):
        made = np.eye(4)
        made[:3, 3] = array
        return made
    return array
