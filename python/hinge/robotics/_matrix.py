# SPDX-License-Identifier: BSD-3-Clause
"""CollisionMatrix: the pairs of links that need no test, with proofs."""

import collections

import numpy as np

from .._core import robotics as _core
from . import _arguments as _check
from ._robot import Robot

_KINDS = np.array(["adjacent", "always", "default", "sometimes", "never", "unseen"])


class CollisionMatrix(_core.MatrixBase):
    """What is known about every pair of links of a robot, by samples and by proofs over the joint limits: the answer of
    `robocd matrix`.

    robot: a Robot; pairs that its SRDF disables are not proved. samples: number of random configurations. seed: of
    these. cells: boxes of joint values that a proof may use per pair; 0: no proofs. clearance: m; closer links are too
    close. settled: further pairs of names that need no proof.
    Depends on these arguments alone. Pass the result as `disable` of a Checker. Pickling stores the arguments.
    Raises TypeError, ValueError, and ModelError for unknown links.
    """

    def __init__(self, robot, *, samples=100_000, seed=1, cells=20_000, clearance=0.0, settled=(), progress=None):
        if not isinstance(robot, Robot):
            raise TypeError(f"robot: a {type(robot).__name__}, expected a Robot")
        self._robot = robot
        self._options = {
            "samples": _check.count("samples", samples),
            "seed": _check.seed(seed),
            "cells": _check.count("cells", cells),
            "clearance": _check.number("clearance", clearance, positive=True),
            "settled": tuple(_check.pair_names("settled", settled)),
        }
        super().__init__(robot, *list(self._options.values())[:4], list(self._options["settled"]), progress)

    @property
    def robot(self):
        """The Robot whose links the matrix pairs."""
        return self._robot

    @property
    def entries(self):
        """One row per pair of links with geometry: a structured array with first, second (rows of Robot.links), kind,
        samples (number tested), hits (samples in which they were too close), cells (boxes that the proof tried),
        smallest_gap (m, the smallest distance computed; infinite if none was).

        kind: 'adjacent', 'always' (in all samples), 'default' (in the default configuration), 'sometimes', 'never'
        (proved within the limits), 'unseen' (neither found too close nor proved).
        """
        rows = self._rows()
        table = np.empty(rows.shape, [(n, "U9" if n == "kind" else rows.dtype[n]) for n in rows.dtype.names])
        for name in rows.dtype.names:
            table[name] = _KINDS[rows[name]] if name == "kind" else rows[name]
        return table

    def disabled_pairs(self, *, disable_unseen=False):
        """Return the pairs of link names that need no test, those of the robot's SRDF included.

        disable_unseen: unseen pairs, too, although nothing proves them.
        """
        return self._disabled(bool(disable_unseen))

    def srdf(self, *, disable_unseen=False):
        """Return the text of an SRDF file with the pairs and the reasons, as `robocd matrix` writes it.

        It extends the SRDF of the robot, if there is one. disable_unseen: as in disabled_pairs().
        """
        return self._srdf(bool(disable_unseen))

    def __reduce__(self):
        return _rebuild, (type(self), self._robot, self._options)

    def __repr__(self):
        counts = collections.Counter(self.entries["kind"].tolist())
        text = ", ".join(f"{counts[kind]} {kind}" for kind in _KINDS.tolist() if counts[kind])
        return f"<CollisionMatrix of {self._robot.name!r}: {text}>"


def _rebuild(cls, robot, options):
    return cls(robot, **options)
