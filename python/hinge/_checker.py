# SPDX-License-Identifier: BSD-3-Clause
"""Checker: the rules of a model from arrays, and what is asked about configurations."""

import numpy as np

from . import _core
from ._model import Model, indices
from ._paths import named_verdicts, path_options


def pairs_of(name, value):
    """Pairs as an array of shape (m, 2)."""
    pairs = np.asarray(value)
    pairs = pairs.reshape(0, 2) if pairs.size == 0 else pairs
    if pairs.ndim != 2 or pairs.shape[1] != 2:
        raise ValueError(f"{name}: shape {pairs.shape}, expected (m, 2)")
    return pairs


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
        exclude = pairs_of("exclude", exclude)
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
                "types": indices("types", types, (n,), min(len(table), 65536)).tolist(),
                "exclude": indices("exclude", exclude, exclude.shape, n).tolist(),
                "groups": indices("groups", groups, (n,), count).tolist(),
                "admitted": admitted,
                "free": indices("free", free, free.shape[:1], model.n_joints).tolist(),
                "engine": str(engine),
                "threads": threads,
            }
        )

    @property
    def model(self):
        """The Model that is tested."""
        return self._model

    @property
    def engine(self):
        """Name of the engine."""
        return str(self._arguments["engine"])

    def certify(self, a, b, *, smallest_step=2.0**-20, resolution=None, threads=None, progress=None):
        """Prove whether straight paths from a to b are free of collisions.

        a, b: shape (n, dof), or (dof,) for one start or end of all. smallest_step: share of the path below which it is
        not divided. resolution: instead of a proof, test states at most so far apart, rad or the model's length.
        Returns a structured array of shape (n,): verdict ('free', 'colliding', 'undecided'), parameter (of the
        collision or undecided segment, 0 to 1), half_width (of that segment), i, j (primitives that collide or are not
        proved apart; -1: none known), distance, threshold, states (number of configurations computed).
        Raises TypeError and ValueError.
        """
        smallest_step, resolution = path_options(smallest_step, resolution)
        return named_verdicts(self._certify(a, b, smallest_step, resolution, threads, progress))

    def collides_with(self, other, q, q_other, *, exclude=(), admitted=None, threads=None, progress=None):
        """Tell whether this model collides with another one in the same world frame.

        other: a Checker with the same kind of primitives, threshold and engine. q, q_other: shape (n, dof) of each
        model, or (dof,) for one of all; rad or length. All pairs (i of this model, j of the other) are tested, except
        those in `exclude`, shape (m, 2), and those whose groups are not admitted: booleans of shape (g, h), for the
        groups of this checker and those of the other; None: all.
        Returns booleans of shape (n,), or one bool. Raises TypeError, ValueError, IndexError, and ModelError for other
        thresholds.
        """
        across = self._across(other, exclude, admitted)
        return self._collides_with(other, q, q_other, across, threads, progress)

    def pairs_with(self, other, q, q_other, *, within=0.0, exclude=(), admitted=None, threads=None, progress=None):
        """Return the pairs of primitives of two models that collide, or with d < threshold + within.

        within: a length, at least 0. Returns rows of pairs(): i is a primitive of this model, j one of the other. The
        other arguments are as in collides_with().
        """
        across = self._across(other, exclude, admitted)
        return self._pairs_with(other, q, q_other, across, within, threads, progress)

    def closest_with(self, other, q, q_other, *, exclude=(), admitted=None, threads=None, progress=None):
        """Return the pair of two models with the least distance - threshold for each k, as rows of pairs_with().

        Arguments as in collides_with(). A pair of configurations without tested pairs has no row.
        """
        across = self._across(other, exclude, admitted)
        return self._pairs_with(other, q, q_other, across, None, threads, progress)

    def _across(self, other, exclude, admitted):
        """(admitted, exclude) as the compiled part takes them."""
        if not isinstance(other, Checker):
            raise TypeError(f"other: a {type(other).__name__}, expected a Checker")
        mine, theirs = (self._model.kind, self.engine), (other._model.kind, other.engine)
        if mine != theirs:
            raise ValueError(f"other: {theirs[0]}s with engine {theirs[1]!r}, expected {mine[0]}s with {mine[1]!r}")
        if admitted is not None:
            admitted = np.asarray(admitted)
            if admitted.dtype != bool or admitted.ndim != 2:
                raise ValueError(f"admitted: {admitted.dtype} of shape {admitted.shape}, expected booleans (g, h)")
        exclude = pairs_of("exclude", exclude)
        ends = (self._model.n_primitives, other._model.n_primitives)
        columns = [indices("exclude", exclude[:, k], (len(exclude),), ends[k]).tolist() for k in (0, 1)]
        return admitted, list(zip(*columns))

    def __reduce__(self):
        return _rebuild, (type(self), self._model, self._arguments)

    def __repr__(self):
        return f"<Checker of {self._model.n_primitives} {self._model.kind}s, {self.dof} degrees of freedom>"


def _rebuild(cls, model, arguments):
    return cls(model, **arguments)
