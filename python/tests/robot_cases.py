# SPDX-License-Identifier: BSD-3-Clause
"""Robots that the tests compare with the command line, and how they run it."""

import json
import subprocess

import hinge.robotics as hr
from conftest import ROOT, shared, tool

ARM = ROOT / "robotics/data/arm.urdf"
# name: (has an SRDF, options of the tool, the same for Robot.from_urdf())
ROBOTS = {
    "arm": (True, [], {}),
    "panda": (True, [], {}),
    "ur5_robotiq": (True, ["--note-unknown-links"], {"unknown_links": "note"}),
    "baxter": (True, ["--note-unknown-links"], {"unknown_links": "note"}),
    "pr2": (True, ["--note-unknown-links"], {"unknown_links": "note"}),
    "allegro_hand": (False, ["--primitives", "reference"], {"primitives": "reference"}),
}


def urdf_of(name):
    return ARM if name == "arm" else shared(f"robots/{name}/{name}.urdf")


def srdf_of(name):
    return urdf_of(name).with_suffix(".srdf") if ROBOTS[name][0] else None


def options_of(name):
    """Keyword arguments of Robot.from_urdf()."""
    return {"srdf": srdf_of(name), **ROBOTS[name][2]}


def run_robocd(command, name, *more, ok=(0, 1)):
    """Runs robocd and returns what it printed."""
    given = ["--srdf", str(srdf_of(name))] if ROBOTS[name][0] else []
    matrix_options = [option for option in ROBOTS[name][1]]
    arguments = [tool("robocd"), command, str(urdf_of(name)), *given, *matrix_options, *map(str, more)]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=600)
    assert done.returncode in ok, (arguments, done.stderr)
    return done.stdout


def robocd(command, name, *more, ok=(0, 1)):
    """Runs robocd and returns its JSON."""
    return json.loads(run_robocd(command, name, *more, "--json", ok=ok))


def pair_rows(c, rows):
    """Rows of pairs() as {configuration: [(name, name)]}."""
    found = {}
    for row, names in zip(rows, c.named(rows)):
        found.setdefault(int(row["configuration"]), []).append(names)
    return found


def near_rows(c, rows):
    """Rows of distances() as tuples like those of told()."""
    return [
        (*names, float(row["distance"]), row["point1"].tolist(), row["point2"].tolist())
        for row, names in zip(rows, c.named(rows))
    ]


def told(pair):
    """A pair of JSON as a tuple."""
    first = pair.get("link1", pair.get("link"))
    names = (first, pair.get("link2", pair.get("body")))
    return (*names, pair["distance"], pair["point1"], pair["point2"]) if "distance" in pair else names


def slider(**options):
    """A unit cube that slides along x, and a ball one above it, fixed to it."""
    return hr.Robot(
        [hr.Link("root"), hr.Link("cube", [hr.Box((1, 1, 1))]), hr.Link("ball", [(hr.Sphere(0.25), (0, 0, 1))])],
        [
            hr.Joint("slide", "prismatic", "root", "cube", axis=(1, 0, 0), lower=-5, upper=5),
            hr.Joint("mount", "fixed", "cube", "ball"),
        ],
        name="slider",
        **options,
    )
