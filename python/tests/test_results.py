# SPDX-License-Identifier: BSD-3-Clause
"""Results print as one short line, never as whole arrays, and compare as objects."""

import re

import numpy as np

import hinge
import hinge.molecular as hm
import hinge.robotics as hr
from conftest import ROOT

DATA = ROOT / "robotics/data"


def line(result, expected):
    text = repr(result)
    assert re.fullmatch(expected, text), text
    assert result == result and len({result}) == 1
    assert not result == type(result)(**vars(result))


def test_of_molecules():
    molecule = hm.Molecule(ROOT / "molecular/data/1ubq.pdb")
    checker = hm.Checker(molecule, "A:72-76:phi,psi", exempt_reference=True)
    home = np.zeros(checker.dof)
    walk = checker.walk(20, seed=1, every=5)
    line(walk, f"<Walk: accepted: {walk.accepted} of 20, configurations: 4>")
    q = checker.sample(6, seed=1)
    relaxed = checker.relax(q)
    line(relaxed, f"<Relaxation: free: {np.sum(relaxed.collisions == 0)} of 6>")
    one = checker.relax(q[0])
    line(one, f"<Relaxation: collisions: {one.collisions_before} before, {one.collisions} left>")
    line(checker.plan(home, home), "<Motion: reached, waypoints: 2, length: 0>")
    line(checker.fit_coordinates(checker.positions(q[0])), r"<CoordinateFit: rmsd: \S+ A, atoms: 602, collisions: \d+>")
    groups = hm.find_rigid_groups(molecule, checker.positions(q))
    line(groups, f"<RigidGroups: groups: {len(groups.segments)}, torsions between them: {len(groups.torsions)}>")


def test_of_robots():
    robot = hr.Robot.from_urdf(DATA / "arm.urdf", srdf=DATA / "arm.srdf")
    environment = hr.Environment()
    environment.add(hr.Mesh.read(DATA / "shelf.obj"), name="shelf")
    checker = hr.Checker(robot, environment=environment)
    home, reach = robot.state("arm/home"), robot.state("arm/reach")
    motion = checker.plan(home, reach)
    line(motion, rf"<Motion: reached, waypoints: {len(motion.waypoints)}, length: [\d.]+>")
    stopped = checker.plan(home, reach, tries=1)
    assert not stopped.reached
    line(stopped, rf"<Motion: {stopped.remaining:.4g} from the end, waypoints: \d+, length: \S+>")
    q = robot.sample(5, seed=1)
    relaxed = checker.relax(q)
    line(relaxed, f"<Relaxation: free: {np.sum(relaxed.is_free)} of 5>")
    line(checker.relax(home), "<Relaxation: free, distance: 0>")


def gaps(rows):
    """The bytes of a structured array that belong to no field."""
    used = np.zeros(rows.dtype.itemsize, bool)
    for field, start in rows.dtype.fields.values():
        used[start : start + field.itemsize] = True
    return np.frombuffer(rows.tobytes(), np.uint8).reshape(rows.size, -1)[:, ~used]


def test_gaps_of_rows_are_zero():
    """Equal rows have equal bytes, and no bytes of other objects."""
    molecule = hm.Checker(hm.Molecule(ROOT / "molecular/data/1ubq.pdb"), "A:72-76:phi,psi")
    q = molecule.sample(4, seed=1)
    arm = hr.Robot.from_urdf(DATA / "arm.urdf")
    world = hr.Environment()
    world.add(hr.Box((0.2, 0.2, 0.2)), (0.5, 0.3, 0.3), "box")
    robot = hr.Checker(arm, environment=world)
    p = np.zeros((3, robot.dof))
    tables = [
        molecule.pairs(q, within=1.0),
        molecule.closest(q),
        molecule.certify(q[0], q[1]),
        robot.pairs(p, within=1.0),
        robot.distances(p, within=1.0),
        robot.closest(p),
        robot.clearances(p, influence=1.0)[0],
        robot.certify(p[0], p[0] + 0.1),
    ]
    for rows in map(np.atleast_1d, tables):
        assert rows.size > 0 and not gaps(rows).any(), rows.dtype
