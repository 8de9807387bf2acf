# SPDX-License-Identifier: BSD-3-Clause
"""What hinge.report() shows of a robot and the bodies around it."""

import os

import numpy as np

from .._report import counted, packed
from ._matrix import CollisionMatrix

_MOST_TRIANGLES = 100_000  # of the page; more are slow to draw and to load
_FEWEST_TRIANGLES = 200  # of a link, when links are made coarser
_MOST_ROWS = 1000  # pairs of one configuration
_MATRIX_WORDS = {
    "adjacent": "adjacent",
    "always": "always in collision",
    "default": "in collision in the default configuration",
    "sometimes": "sometimes in collision",
    "never": "never in collision, proved",
    "unseen": "not seen in collision, not proved",
}


class RobotPage:
    """The data of docs/reference/report.md."""

    kind = "robot"
    frame_word = "configuration"
    length_unit = "m"

    def __init__(self, checker, q, _coordinates, within, threads):
        self._checker, self._within, self._threads = checker, within, threads
        self._robot, self._environment = checker.robot, checker.environment
        self.title = self._robot.name or "robot"
        self._q, self.count = q, len(q)
        bodies = list(self._environment.names) if self._environment is not None else []
        holders = {name: self._environment.attached_to(name) for name in bodies}
        # A body that a link of this robot holds is drawn as one more link.
        self._held = {name: held[1] for name, held in holders.items() if held and held[0] is self._robot}
        self._bodies = [name for name in bodies if name not in self._held]

    def count_pairs(self, first, last):
        """Number of colliding pairs of each configuration, shape (last - first,)."""
        rows = self._checker.pairs(self._q[first:last], threads=self._threads)
        return np.bincount(rows["configuration"], minlength=last - first)

    def question(self):
        """What was asked, in words."""
        checker, links = self._checker, self._robot.links
        words = [
            (
                "Robot",
                f"{counted(len(links), 'link')}, {int((links['triangles'] > 0).sum())} with geometry, "
                f"{counted(int(links['triangles'].sum()), 'triangle')}",
            ),
            ("Free", counted(checker.dof, "joint value")),
            ("Tested", f"{counted(len(checker.tested_pairs), 'pair')} of links"),
            ("Clearance", f"{checker.clearance:g} m"),
        ]
        if self._environment is not None:
            words.append(("Bodies", ", ".join(self._environment.names) or "none"))
        return words

    def files(self):
        """Paths of the inputs."""
        return [self._robot._source] if os.path.isfile(self._robot._source or "") else []

    def notes(self):
        """One sentence each."""
        return list(self._robot.notes)

    def data(self, shown, names):
        """The members frames and robot."""
        q = self._q[shown]
        poses = self._checker.link_poses(q, threads=self._threads)
        held = [
            poses[:, self._robot.link_names.index(link)] @ self._environment._attached[name][2]
            for name, link in self._held.items()
        ]
        poses = np.concatenate([poses, *(pose[:, None] for pose in held)], axis=1)[:, :, :3]
        frames = []
        for row, k, name in zip(range(len(shown)), shown, names):
            rows, left_out = self._rows(q[row])
            frames.append(
                {
                    "index": k,
                    "name": name,
                    "collides": any(pair[4] for pair in rows),
                    "poses": packed(poses[row], "f4"),
                    "values": q[row].tolist(),
                    "pairs": rows,
                    "pairs_left_out": left_out,
                }
            )
        links = [self._robot.surface(name) for name in self._robot.link_names]
        held_surfaces = [self._environment.shape(name).surface for name in self._held]
        surfaces = [self._environment.shape(name).surface for name in self._bodies]
        total = sum(map(len, [*links, *held_surfaces, *surfaces]))
        columns = self._robot.joints
        is_prismatic = dict(zip(columns["name"].tolist(), columns["type"] == "prismatic"))
        groups = self._robot.links["group"]  # the root is fixed to the world
        moves = dict(zip(self._robot.link_names, groups != groups[0]))
        robot = {
            "links": [
                {**_mesh(surface, total), "name": name, "moves": int(moves[name])}
                for name, surface in zip(self._robot.link_names, links)
            ]
            + [
                {**_mesh(surface, total), "name": name, "moves": int(moves[link])}
                for (name, link), surface in zip(self._held.items(), held_surfaces)
            ],
            "bodies": [
                {**_mesh(surface, total), "name": name, "pose": self._pose(name)}
                for name, surface in zip(self._bodies, surfaces)
            ],
            "joints": [
                {"name": name, "unit": "m" if is_prismatic[name] else "rad"} for name in self._robot.joint_names
            ],
            "matrix": None,
            "cut": None
            if total <= _MOST_TRIANGLES
            else f"Meshes of {counted(total, 'triangle')} are drawn coarser than they are; verdicts and distances are "
            "those of the full meshes",
        }
        return {"frames": frames, "robot": robot}

    def matrix(self, matrix):
        """The member matrix."""
        if not isinstance(matrix, CollisionMatrix):
            raise TypeError(f"matrix: a {type(matrix).__name__}, expected a CollisionMatrix")
        n = len(self._robot.link_names) + len(self._held)
        cells = np.zeros((n, n), np.uint8)
        kinds = list(_MATRIX_WORDS)
        for row in matrix.entries:
            at = 1 + kinds.index(str(row["kind"]))
            cells[row["first"], row["second"]] = cells[row["second"], row["first"]] = at
        return {"words": ["not tested", *_MATRIX_WORDS.values()], "cells": packed(cells, "u1")}

    def _pose(self, name):
        return np.float32(self._environment.pose(name)[:3]).reshape(-1).tolist()

    def _rows(self, q):
        """Rows of the table by gap, and how many are left out."""
        checker = self._checker
        hits = {(int(row["first"]), int(row["second"])) for row in checker.pairs(q)}
        found = checker.distances(q, within=self._within)
        found = found[np.argsort(found["gap"], kind="stable")]
        n_links = len(self._robot.link_names)
        bodies = {name: n_links + k for k, name in enumerate([*self._held, *self._bodies])}
        place = [*range(n_links), *(bodies.get(str(name)) for name in checker.names[n_links:])]
        special = bool(checker._options["pair_clearances"])
        rows = []
        for row in found[:_MOST_ROWS]:
            first, second = int(row["first"]), int(row["second"])
            clearance = round(float(row["distance"] - row["gap"]), 12) if special else checker.clearance
            rows.append(
                [
                    place[first],
                    place[second],
                    float(row["distance"]),
                    clearance,
                    int((first, second) in hits),
                    row["point1"].tolist(),
                    row["point2"].tolist(),
                ]
            )
        return rows, len(found) - len(rows)


def _mesh(triangles, total):
    """Vertices and corners of triangles, in base64; fewer triangles if there are many in total."""
    most = len(triangles)
    if total > _MOST_TRIANGLES:
        most = max(_FEWEST_TRIANGLES, most * _MOST_TRIANGLES // total)
    points = triangles.reshape(-1, 3)
    keys, cells = points, 256.0
    while len(triangles):
        if len(triangles) > most:  # merges the vertices in each cell of a grid
            low, side = points.min(axis=0), np.ptp(points, axis=0).max()
            keys = np.floor((points - low) / side * cells) if side > 0 else points
        corner = np.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)
        corners = corner.reshape(-1, 3)
        a, b, c = corners.T
        corners = corners[(a != b) & (b != c) & (c != a)]
        if len(corners) <= most or cells <= 4:
            break
        cells *= 0.75
    else:
        return {"vertices": "", "triangles": ""}
    count = np.bincount(corner)
    vertices = np.stack([np.bincount(corner, points[:, k]) / count for k in range(3)], axis=1)
    return {"vertices": packed(vertices, "f4"), "triangles": packed(corners, "u4")}
