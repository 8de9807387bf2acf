# SPDX-License-Identifier: BSD-3-Clause
"""Checker: the rules of a robot, the bodies around it, and what is asked about configurations."""

import dataclasses

import numpy as np

from .. import ModelError
from .._core import robotics as _core
from .._paths import named_verdicts, path_options
from .._planning import Motion, seconds_of
from . import _arguments as _check
from ._environment import Environment
from ._matrix import CollisionMatrix
from ._robot import Robot
from ._shapes import Shape, matrix


@dataclasses.dataclass(frozen=True, eq=False)
class PathAnswer:
    """The answer of Checker.check_path().

    verdict: 'free', 'colliding' or 'undecided'. segment: the first that collides, otherwise the first undecided one;
    -1: free. parameter: of the collision, or the middle of what is undecided, 0 to 1 on the segment. half_width: of
    what is undecided. configuration: at the parameter, shape (dof,), rad or m; None: free. pairs: names of links and
    bodies that collide there; undecided: the pair that is not proved apart, if known. states: number of configurations
    computed.
    """

    verdict: str
    segment: int
    parameter: float
    half_width: float
    configuration: object
    pairs: list
    states: int

    @property
    def is_free(self):
        """True if the whole path is free."""
        return self.verdict == "free"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Relaxation:
    """The result of Checker.relax(), for one configuration or for n of them (arrays of shape (n,)).

    q: shape as given, rad and m: a free configuration, or the given one if none was found. is_free: whether q collides
    with nothing. distance: root of the sum of the squared changes of the joints, rad and m alike. tries: configurations
    that were tested.
    """

    q: np.ndarray
    is_free: "bool | np.ndarray"
    distance: "float | np.ndarray"
    tries: "int | np.ndarray"

    def __repr__(self):
        if self.q.ndim == 1:
            return f"<Relaxation: {'free' if self.is_free else 'not free'}, distance: {self.distance:.4g}>"
        return f"<Relaxation: free: {np.count_nonzero(self.is_free)} of {len(self.q)}>"


class Checker(_core.CheckerBase):
    """Tests configurations of one robot against itself and the bodies around it. Any number of threads may use it.

    robot: a Robot. clearance: links closer than this collide, m; links that touch always do. pair_clearances: others
    for some pairs: {(name, name): m}. environment: an Environment with the same engine, or None. disable: pairs of link
    names that are not tested, in addition to those of the robot's SRDF, or a CollisionMatrix.
    tiers: a tier for all links, or tiers by link name, see Robot.with_tiers(); the robot of the checker is then another
    one. base: pose of the root link in the world, shape (4, 4) or a translation of shape (3,), m; a robot with a
    floating base needs it for an environment.
    engine: 'simd', 'lazy' (the paper's) or 'brute'; all give the same answers. threads: default of every call. Answers
    do not depend on it.

    Tested are all pairs of links with geometry, except pairs in one rigid group, pairs joined by one movable joint, and
    disabled pairs. Raises ModelError for unknown names and bad numbers. Pickling stores robot, options and environment.
    """

    def __init__(
        self,
        robot,
        *,
        clearance=0.0,
        pair_clearances=None,
        environment=None,
        disable=(),
        tiers=None,
        base=None,
        engine="simd",
        threads=1,
    ):
        if not isinstance(robot, Robot):
            raise TypeError(f"robot: a {type(robot).__name__}, expected a Robot")
        if tiers is not None:
            robot = robot.with_tiers(tiers) if isinstance(tiers, str) else robot.with_tiers(links=tiers)
        if isinstance(disable, CollisionMatrix):
            disable = disable.disabled_pairs()
        _environment(environment)
        special = {}
        for pair, value in dict(pair_clearances or {}).items():
            names = _check.pair_names("pair_clearances", [pair])[0]
            special[names] = _check.number("pair_clearances", value, positive=True)
        self._robot = robot
        self._environment = environment
        self._options = {
            "clearance": _check.number("clearance", clearance, positive=True),
            "pair_clearances": special,
            "disable": _check.pair_names("disable", disable),
            "base": None if base is None else matrix("base", base),
            "engine": _check.one_of("engine", engine, ("simd", "lazy", "brute")),
            "threads": threads,
        }
        super().__init__(
            robot,
            self._options["clearance"],
            [(*pair, value) for pair, value in special.items()],
            self._options["disable"],
            environment,
            self._options["base"],
            engine,
            threads,
        )

    @property
    def robot(self):
        """The Robot; with tiers, the one that they made."""
        return self._robot

    @property
    def environment(self):
        """The Environment, or None. It can be replaced."""
        return self._environment

    @environment.setter
    def environment(self, environment):
        self._set_environment(_environment(environment), self._options["base"] is not None)
        self._environment = environment

    @property
    def base(self):
        """World pose of the root link, shape (4, 4), m. Setting it costs a copy of the checker; a base that moves in
        every configuration is better three prismatic and three continuous joints of the robot.
        """
        return self._base()

    @base.setter
    def base(self, pose):
        given = matrix("base", pose)
        self._set_base(given)
        self._options["base"] = given

    @property
    def names(self):
        """Names that results refer to by index, shape (n,): the links of the robot, then the bodies ('' for removed
        ones).
        """
        bodies = self._environment._names if self._environment is not None else []
        return np.array([*self._robot.link_names, *bodies])

    def colliding_links(self, q, *, against="all"):
        """Return the names of what collides at one configuration, as pairs.

        q: shape (dof,), rad or m. against: as in collides().
        """
        q = np.asarray(q)
        if q.ndim != 1:
            raise ValueError(f"q: shape {q.shape}, expected one configuration, shape ({self.dof},)")
        return self.named(self.pairs(q, against=against))

    def named(self, rows):
        """Return the names of what is in rows of pairs(), distances(), closest() or contained(): a list of tuples.

        rows: a structured array with fields first and second, or outer and inner.
        """
        names = self.names
        fields = [field for field in ("first", "second", "outer", "inner") if field in rows.dtype.names]
        return [tuple(str(name) for name in names[[row[field] for field in fields]]) for row in rows]

    def distance(self, q, *, against="all", threads=None, progress=None):
        """Return the smallest distance of each configuration, shape (n,), or one float, m.

        It is that of closest(), 0 where something touches or overlaps, and infinite if no pair is tested. q, against:
        as in collides().
        """
        rows = self.closest(q, against=against, threads=threads, progress=progress)
        if np.ndim(q) == 1:
            return float(rows["distance"][0]) if len(rows) else np.inf
        found = np.full(len(q), np.inf)
        found[rows["configuration"]] = rows["distance"]
        return found

    def relax(self, q, *, tries=20000, seed=1, threads=None, progress=None):
        """Move configurations out of collision, as little as a random search can, as `robocd relax` does.

        q: shape (dof,) or (n, dof). tries: largest number of configurations to test for each. seed: of the search.
        Joints stay within their limits. Returns a Relaxation; look at `is_free`. Links and bodies both count.
        """
        found = self._relax(q, _check.count("tries", tries, 1), _check.seed(seed), threads, progress)
        if np.ndim(q) == 1:
            return Relaxation(found[0][0], *(value[0].item() for value in found[1:]))
        return Relaxation(*found)

    def plan(self, start, end, *, tries=100_000, seed=1, seconds=None):
        """Find a motion from one configuration to another on which nothing collides, as `robocd plan` does.

        start, end: shape (dof,), rad and m; both have to be free. tries: largest number of motions to test before one is
        found. seed: of the random configurations. seconds: the search ends after this time. Joints stay within their
        limits. Links and bodies both count. Returns a Motion; look at `reached`. No motion is no proof that there is
        none. Raises ConfigurationError, with the pair, if an end collides.
        """
        return Motion(
            *self._plan(start, end, _check.count("tries", tries, 1), _check.seed(seed), seconds_of(seconds))
        )

    def certify(self, a, b, *, smallest_step=2.0**-20, resolution=None, threads=None, progress=None):
        """Prove whether straight paths from a to b are free of collisions, with links and with bodies.

        a, b: shape (n, dof), or (dof,) for one start or end of all; rad or m. smallest_step: share of the path below
        which it is not divided. resolution: instead of a proof, test states at most so far apart, rad or m.
        Returns a structured array of shape (n,): verdict ('free', 'colliding', 'undecided'), parameter (of the
        collision or undecided segment, 0 to 1), half_width (of that segment), first, second (indices into names of a
        pair that collides or is not proved apart; -1: none known), distance, threshold (m, of one pair of their
        triangles), states (number of configurations computed).
        """
        return self._paths(a, b, smallest_step, resolution, threads, progress)[0]

    def check_path(self, waypoints, *, smallest_step=2.0**-20, resolution=None, progress=None):
        """Prove whether the path that joins each waypoint to the next is free: the answer of `robocd path`.

        waypoints: shape (n, dof) with n at least 2, rad or m. smallest_step, resolution: as in certify(). Returns a
        PathAnswer. Segments after the first that collides are not examined.
        """
        waypoints = np.asarray(waypoints)
        if waypoints.ndim != 2 or len(waypoints) < 2:
            raise ValueError(f"waypoints: shape {waypoints.shape}, expected (n, {self.dof}) with n at least 2")
        found, segment, states = None, -1, 0
        for k in range(len(waypoints) - 1):
            rows, at = self._paths(waypoints[k], waypoints[k + 1], smallest_step, resolution, 1, None)
            row = rows[0]
            states += int(row["states"])
            if row["verdict"] == "colliding" or (row["verdict"] != "free" and segment < 0):
                found, segment = (row, at[0]), k
            if progress is not None and callable(progress):
                progress(k + 1, len(waypoints) - 1)
            if row["verdict"] == "colliding":
                break
        if found is None:
            return PathAnswer("free", -1, 0.0, 0.0, None, [], states)
        row, q = found
        pairs = self.colliding_links(q) if row["verdict"] == "colliding" else []
        if not pairs and row["first"] >= 0:
            pairs = [tuple(str(name) for name in self.names[[row["first"], row["second"]]])]
        return PathAnswer(
            str(row["verdict"]), segment, float(row["parameter"]), float(row["half_width"]), q, pairs, states
        )

    def attach(self, link, body, pose=None, *, may_touch=None, name=None):
        """Attach a body to a link of the robot and return its name.

        link: name of a link. body: the name of a body of the environment, or a Shape, which is added as a body `name`.
        pose: of the body in the link's frame, shape (4, 4) or (3,); None: the identity. may_touch: names of links that
        the body may touch; None: those of the link's rigid group.
        """
        if self._environment is None:
            self.environment = Environment(engine=self.engine)
        added = isinstance(body, Shape)
        if added:
            body = self._environment.add(body, None, name)
        try:
            self._environment.attach(body, self._robot, link, pose, may_touch=may_touch)
        except Exception:
            if added:
                self._environment.remove(body)
            raise
        return body

    def detach(self, body, q=None, *, remove=False):
        """Detach a body from this robot.

        body: its name. q: shape (dof,): the body stays where the link holds it at this configuration; None: it returns
        to where it stood before it was attached. remove: remove the body instead.
        """
        held = None if self._environment is None else self._environment.attached_to(body)
        if held is None or held[0] is not self._robot:
            raise ModelError(f"body: {body!r} is not attached to this robot")
        if remove:
            self._environment.remove(body)
            return
        pose = None
        if q is not None:
            links = self.link_poses(np.asarray(q).reshape(-1))
            at = links[self._robot.link_names.index(held[1])]
            pose = _core.compose(at, self._environment._attached[body][2])
        self._environment.detach(body, pose)

    def allow(self, a, b):
        """Allow two links, or a link and a body, to touch from now on. a, b: names, in any order."""
        a, b = _check.text("a", a), _check.text("b", b)
        links = self._robot.link_names
        bodies = self._environment if self._environment is not None else ()
        if a in links and b in links:
            self._allow_links(a, b)
            self._options["disable"].append((a, b))
        elif a in links and b in bodies:
            self._environment.allow(b, self._robot, a)
        elif b in links and a in bodies:
            self._environment.allow(a, self._robot, b)
        else:
            raise ModelError(f"a, b: {a!r}, {b!r}, expected two links, or a link and a body")

    def _paths(self, a, b, smallest_step, resolution, threads, progress):
        smallest_step, resolution = path_options(smallest_step, resolution)
        rows, at = self._certify(a, b, smallest_step, resolution, threads, progress)
        return named_verdicts(rows), at

    def __reduce__(self):
        return _rebuild, (type(self), self._robot, self._options, self._environment)

    def __repr__(self):
        around = f", {len(self._environment)} bodies" if self._environment is not None else ""
        return (
            f"<Checker of {self._robot.name!r}: {self.dof} degrees of freedom, {len(self.tested_pairs)} pairs of links "
            f"tested, clearance {self.clearance} m{around}>"
        )


def _environment(environment):
    if environment is not None and not isinstance(environment, Environment):
        raise TypeError(f"environment: a {type(environment).__name__}, expected an Environment or None")
    return environment


def _rebuild(cls, robot, options, environment):
    return cls(robot, environment=environment, **options)
