# SPDX-License-Identifier: BSD-3-Clause
"""Planned motions, which the checkers of both packages return."""

import dataclasses
import math
import numbers

import numpy as np


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Motion:
    """The result of Checker.plan().

    waypoints: shape (n, dof), from the start on; the straight path from each to the next is proved free. The last one is
    the end if it was reached, otherwise the nearest to it that was found. reached: whether it is the end. length: sum of
    the distances between neighbours. straight: distance from the start to the end. remaining: distance from the last
    waypoint to the end; 0 if it was reached. opening: of molecules, how far kept cycles are open half way between
    waypoints at most, angstrom. motions: number of motions that were tested. stopped: the time passed. start_rmsd,
    end_rmsd: of molecules, how far the first and the last waypoint are from the coordinates of a CoordinateFit; else 0.
    Distances are in angstrom for molecules (root mean square distance of the atoms after superposition) and in m for
    robots (how far the joints move the robot's farthest point, root of the sum of squares).
    """

    waypoints: np.ndarray
    reached: bool
    length: float
    straight: float
    remaining: float
    opening: float
    motions: int
    stopped: bool
    start_rmsd: float = 0.0
    end_rmsd: float = 0.0

    def __repr__(self):
        end = "reached" if self.reached else f"{self.remaining:.4g} from the end"
        return f"<Motion: {end}, waypoints: {len(self.waypoints)}, length: {self.length:.4g}>"

    def steps(self, step):
        """Return configurations along the motion, shape (m, dof), with all waypoints.

        step: no value changes by more than this from one configuration to the next; rad, and angstrom or m. Raises
        TypeError and ValueError unless it is a finite number above 0.
        """
        if isinstance(step, (bool, np.bool_)) or not isinstance(step, numbers.Real):
            raise TypeError(f"step: a {type(step).__name__}, expected a number")
        if not (0 < step and math.isfinite(step)):
            raise ValueError(f"step: {step}, expected a finite number above 0")
        return states_along(self.waypoints, lambda a, b: math.ceil(np.abs(b - a).max() / step))


def states_along(waypoints, count):
    """Configurations along a motion, with all waypoints. count(a, b): number of steps from a waypoint to the next."""
    rows = [waypoints[:1]]
    for a, b in zip(waypoints, waypoints[1:]):
        steps = max(1, count(a, b))
        rows += [a + np.arange(1, steps)[:, None] / steps * (b - a), b[None]]
    return np.concatenate(rows)


def seconds_of(seconds):
    """The limit of a search as a float, or None."""
    if seconds is None:
        return None
    if isinstance(seconds, (bool, np.bool_)) or not isinstance(seconds, numbers.Real):
        raise TypeError(f"seconds: a {type(seconds).__name__}, expected a number or None")
    if not 0 <= seconds <= 1e9:
        raise ValueError(f"seconds: {seconds}, expected 0 to 1e9")
    return float(seconds)
