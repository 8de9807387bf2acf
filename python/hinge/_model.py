# SPDX-License-Identifier: BSD-3-Clause
"""Model: points, spheres, capsules or triangles on a tree of links, from arrays."""

import numpy as np

_JOINTS = ("fixed", "revolute", "prismatic")
_KINDS = ("point", "sphere", "capsule", "triangle")
_WIDTH = {"point": 3, "sphere": 3, "capsule": 6, "triangle": 9}


def _numbers(name, value, shape, default=None):
    """Float64 of a shape; one row stands for all, and None for the default."""
    array = np.asarray(default if value is None else value)
    if array.dtype.kind not in "fiu" and array.size:
        raise TypeError(f"{name}: an array of {array.dtype}, expected real numbers")
    array = array.astype(np.float64)
    if array.shape == shape[1:]:
        array = np.broadcast_to(array, shape)
    if array.shape != shape:
        raise ValueError(f"{name}: shape {array.shape}, expected {shape}" + (f" or {shape[1:]}" if shape[1:] else ""))
    if not np.isfinite(array).all():
        raise ValueError(f"{name}: contains {array[~np.isfinite(array)][0]}, expected finite numbers")
    return np.ascontiguousarray(array)


def indices(name, value, shape, end):
    """Integers from 0 to end - 1 of a shape; one number stands for all."""
    array = np.asarray(value)
    if array.size == 0:
        array = array.astype(np.int64)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name}: an array of {array.dtype}, expected integers")
    if array.shape == () and len(shape) == 1:
        array = np.broadcast_to(array, shape)
    if array.shape != shape:
        raise ValueError(f"{name}: shape {array.shape}, expected {shape}")
    if array.size and not 0 <= array.min() <= array.max() < end:
        raise IndexError(f"{name}: {array.min()} to {array.max()}, expected 0 to {end - 1}")
    return np.ascontiguousarray(array.astype(np.int64))


class Model:
    """Links joined by joints, and primitives in the frames of the links.

    Link 0 is the world; link k + 1 hangs on link parents[k], which is 0 to k.
    parents: integers of shape (n,). joints: 'fixed', 'revolute' or 'prismatic', one for all or n of them.
    axes: shape (n, 3) or (3,), any length except 0; default z. points: a point of each revolute axis, default 0. Both
    are in the frame of the joint's own link. origins: poses of the links in their parents' frames at q = 0, shape
    (n, 4, 4) or (4, 4), default the identity. names: n names of joints, for messages.

    Lengths have any unit, angles are in rad. Every revolute or prismatic joint is a degree of freedom, in this order.
    Add primitives of one kind by add_points(), add_spheres(), add_capsules() or add_triangles(); points, spheres and
    capsules may be mixed, and are capsules then. Raises TypeError, ValueError, IndexError for bad arrays.
    """

    def __init__(self, parents, joints="revolute", *, axes=None, points=None, origins=None, names=None):
        n = len(parents)
        self._parents = indices("parents", parents, (n,), max(n, 1))
        if (self._parents > np.arange(n)).any():
            k = int(np.flatnonzero(self._parents > np.arange(n))[0])
            raise ValueError(f"parents[{k}] is {self._parents[k]}, expected 0 to {k}: parents come first")
        self._joints = [joints] * n if isinstance(joints, str) else [str(j) for j in joints]
        names = [""] * n if names is None else [str(name) for name in names]
        for what, given in (("joints", self._joints), ("names", names)):
            if len(given) != n:
                raise ValueError(f"{what}: {len(given)}, expected {n}, one per link")
        for joint in self._joints:
            if joint not in _JOINTS:
                raise ValueError(f"joints: {joint!r}, expected fixed, revolute or prismatic")
        self._names = names
        self._axes = _numbers("axes", axes, (n, 3), (0.0, 0.0, 1.0))
        self._points = _numbers("points", points, (n, 3), (0.0, 0.0, 0.0))
        self._origins = _numbers("origins", origins, (n, 4, 4), np.eye(4))
        if not (self._origins[:, 3] == (0.0, 0.0, 0.0, 1.0)).all():
            raise ValueError("origins: expected (0, 0, 0, 1) as the last row of each matrix")
        self._parts = []  # (kind, links, corners, radii)

    def _add(self, kind, links, corners, radii):
        self._parts.append((kind, indices("links", links, (len(corners),), self.n_links), corners, radii))
        kinds = {part[0] for part in self._parts}
        if "triangle" in kinds and len(kinds) > 1:
            self._parts.pop()
            raise ValueError(f"{kind}s: triangles cannot be mixed with {' and '.join(sorted(kinds - {'triangle'}))}s")
        count = self.n_primitives
        return np.arange(count - len(corners), count)

    def add_points(self, links, points):
        """Add points and return their indices.

        links: link of each point, shape (n,), or one link for all. points: shape (n, 3), in the frames of the links.
        """
        points = _numbers("points", points, (len(points), 3))
        return self._add("point", links, points, None)

    def add_spheres(self, links, centers, radii):
        """Add spheres and return their indices.

        links: shape (n,) or one link. centers: shape (n, 3). radii: at least 0, shape (n,) or one radius.
        """
        centers = _numbers("centers", centers, (len(centers), 3))
        return self._add("sphere", links, centers, _radii(radii, len(centers)))

    def add_capsules(self, links, a, b, radii):
        """Add capsules, the points within a radius of segments from a to b, and return their indices.

        links: shape (n,) or one link. a, b: shape (n, 3). radii: at least 0, shape (n,) or one radius.
        """
        a = _numbers("a", a, (len(a), 3))
        b = _numbers("b", b, a.shape)
        return self._add("capsule", links, np.hstack([a, b]), _radii(radii, len(a)))

    def add_triangles(self, links, corners):
        """Add triangles and return their indices.

        links: shape (n,) or one link. corners: shape (n, 3, 3), such as vertices[faces].
        """
        corners = _numbers("corners", corners, (len(corners), 3, 3))
        return self._add("triangle", links, corners.reshape(-1, 9), None)

    @property
    def n_links(self):
        """Number of links, the world included."""
        return len(self._parents) + 1

    @property
    def n_primitives(self):
        """Number of primitives."""
        return sum(len(part[2]) for part in self._parts)

    @property
    def n_joints(self):
        """Number of joints that move: of values of a full configuration."""
        return sum(joint != "fixed" for joint in self._joints)

    @property
    def kind(self):
        """'point', 'sphere', 'capsule' or 'triangle'; None without primitives."""
        kinds = {part[0] for part in self._parts}
        return kinds.pop() if len(kinds) == 1 else "capsule" if kinds else None

    @property
    def links(self):
        """The link of each primitive, shape (n_primitives,)."""
        return np.concatenate([part[1] for part in self._parts]) if self._parts else np.empty(0, np.int64)

    @property
    def corners(self):
        """The primitives: shape (n_primitives, 3) for points and spheres, 6 for capsules, 9 for triangles."""
        width = _WIDTH[self.kind or "point"]
        parts = [c if c.shape[1] == width else np.hstack([c, c]) for _, _, c, _ in self._parts]
        return np.concatenate(parts) if parts else np.empty((0, width))

    @property
    def radii(self):
        """The primitives' radii, shape (n_primitives,); 0 for points and triangles."""
        parts = [np.zeros(len(c)) if r is None else r for _, _, c, r in self._parts]
        return np.concatenate(parts) if parts else np.empty(0)

    def __repr__(self):
        return f"<Model: {self.n_links} links, {self.n_joints} joints that move, {self.n_primitives} {self.kind}s>"


def _radii(radii, n):
    array = _numbers("radii", np.broadcast_to(radii, (n,)) if np.ndim(radii) == 0 else radii, (n,))
    if (array < 0).any():
        raise ValueError(f"radii: {array.min()}, expected at least 0")
    return array
