# SPDX-License-Identifier: BSD-3-Clause
"""Model and Checker: points, spheres, capsules or triangles on a tree of links, from arrays."""

import numpy as np

from . import _core

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


def _indices(name, value, shape, end):
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
        self._parents = _indices("parents", parents, (n,), max(n, 1))
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
        self._parts.append((kind, _indices("links", links, (len(corners),), self.n_links), corners, radii))
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


class Checker(_core.CheckerBase):
    """Tests configurations of a Model. Any number of threads may use it at the same time.

    model: a Model with primitives; later additions to it have no effect. A pair of primitives collides if it is
    admitted and its distance is below its threshold; solids (not points) also collide if they touch.
    threshold: a length for all pairs, or a symmetric matrix of lengths by type, shape (t, t). types: type of each
    primitive, shape (n_primitives,), with a matrix.
    exclude: pairs of primitives that are not tested, shape (m, 2). groups: group of each primitive, shape
    (n_primitives,); default its link. admitted: which groups are tested against each other, symmetric booleans of
    shape (g, g); default all.
    free: indices of the joints that move (of n_joints), default all; the others stay at 0.
    engine: 'simd', 'lazy' or 'brute'; all give the same answers. threads: default of every call.

    Pairs on links that do not move against each other are not tested; constant_contacts lists those that collide.
    Raises ModelError, TypeError, ValueError, IndexError. Pickling stores the model and the options.
    """

    def __init__(
        self,
        model,
        threshold=0.0,
        *,
        types=None,
        exclude=(),
        groups=None,
        admitted=None,
        free=None,
        engine="simd",
        threads=1,
    ):
        if not isinstance(model, Model):
            raise TypeError(f"model: a {type(model).__name__}, expected a Model")
        n = model.n_primitives
        if n == 0:
            raise ValueError("model: 0 primitives, expected at least one")
        table = np.asarray(threshold, dtype=np.float64)
        if table.ndim == 0:
            table = table.reshape(1, 1)
            types = np.zeros(n, np.int64) if types is None else types
        if table.ndim != 2 or table.shape[0] != table.shape[1]:
            raise ValueError(f"threshold: shape {table.shape}, expected a number or (t, t)")
        if types is None:
            raise ValueError("types: None, expected the type of each primitive, because threshold is a matrix")
        groups = model.links if groups is None else groups
        count = model.n_links if admitted is None else len(admitted)
        if admitted is None and np.size(groups):
            count = max(count, int(np.max(groups)) + 1)
        admitted = np.ones((count, count), bool) if admitted is None else np.asarray(admitted)
        if admitted.dtype != bool or admitted.shape != (count, count):
            raise ValueError(f"admitted: {admitted.dtype} of shape {admitted.shape}, expected booleans of shape (g, g)")
        exclude = np.asarray(exclude)
        exclude = exclude.reshape(0, 2) if exclude.size == 0 else exclude
        if exclude.ndim != 2 or exclude.shape[1] != 2:
            raise ValueError(f"exclude: shape {exclude.shape}, expected (m, 2)")
        free = np.arange(model.n_joints) if free is None else np.asarray(free)
        self._arguments = {
            "threshold": threshold,
            "types": types,
            "exclude": exclude,
            "groups": groups,
            "admitted": admitted,
            "free": free,
            "engine": engine,
            "threads": threads,
        }
        self._model = model
        super().__init__(
            {
                "kind": model.kind,
                "parents": model._parents.tolist(),
                "joints": model._joints,
                "names": model._names,
                "axes": model._axes,
                "points": model._points,
                "origins": model._origins[:, :3].reshape(-1, 12),
                "links": model.links.tolist(),
                "corners": model.corners,
                "radii": model.radii,
                "thresholds": table,
                "types": _indices("types", types, (n,), min(len(table), 65536)).tolist(),
                "exclude": _indices("exclude", exclude, exclude.shape, n).tolist(),
                "groups": _indices("groups", groups, (n,), count).tolist(),
                "admitted": admitted,
                "free": _indices("free", free, free.shape[:1], model.n_joints).tolist(),
                "engine": str(engine),
                "threads": threads,
            }
        )

    @property
    def model(self):
        """The Model that is tested."""
        return self._model

    def __reduce__(self):
        return _rebuild, (type(self), self._model, self._arguments)

    def __repr__(self):
        return f"<Checker of {self._model.n_primitives} {self._model.kind}s, {self.dof} degrees of freedom>"


def _rebuild(cls, model, arguments):
    return cls(model, **arguments)
