# SPDX-License-Identifier: BSD-3-Clause
"""Program of test_interrupts.py: presses Ctrl-C in a long call and prints when the call ended.

Arguments: the call, and the seconds from its start to Ctrl-C.
"""

import gzip
import os
import pathlib
import signal
import sys
import threading
import time

import numpy as np

import hinge
import hinge.molecular as hm
import hinge.robotics as hr

# A shell starts background jobs with SIGINT ignored, and their children inherit it.
signal.signal(signal.SIGINT, signal.default_int_handler)

ROOT = pathlib.Path(__file__).resolve().parents[2]


def many_chains(count):
    """mmCIF text of so many copies of ubiquitin, far from each other."""
    molecule = hm.Molecule(ROOT / "molecular/data/1ubq.pdb")
    columns = "group_PDB id type_symbol label_atom_id label_alt_id label_comp_id label_asym_id label_entity_id"
    columns += " label_seq_id pdbx_PDB_ins_code Cartn_x Cartn_y Cartn_z occupancy B_iso_or_equiv auth_seq_id"
    columns += " auth_asym_id pdbx_PDB_model_num"
    lines = ["data_many", "loop_", *(f"_atom_site.{column}" for column in columns.split())]
    rows = list(zip(molecule.atoms, molecule.coordinates.tolist()))
    for copy in range(count):
        shift = 60.0 * np.array([copy % 10, copy // 10 % 10, copy // 100])
        for k, (atom, x) in enumerate(rows):
            place = " ".join(f"{c:.3f}" for c in x + shift)
            lines.append(
                f"ATOM {copy * len(rows) + k + 1} {atom['element']} {atom['name']} . {atom['residue_name']} C{copy} "
                f"? . ? {place} 1.0 0 {atom['residue_number']} C{copy} 1"
            )
    return ("\n".join(lines) + "\n").encode()


def surface(side):
    """Vertices and faces of a wavy sheet of 2 * (side - 1)^2 triangles."""
    x, y = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    vertices = np.stack([x, y, 0.1 * np.sin(9 * x) * np.cos(7 * y)], axis=-1).reshape(-1, 3)
    k = np.arange(side * side).reshape(side, side)
    lower = np.stack([k[:-1, :-1], k[1:, :-1], k[:-1, 1:]], axis=-1).reshape(-1, 3)
    upper = np.stack([k[1:, 1:], k[:-1, 1:], k[1:, :-1]], axis=-1).reshape(-1, 3)
    return vertices, np.concatenate([lower, upper])


def lifted(mesh):
    """A robot with one mesh above another."""
    joint = hr.Joint("lift", "prismatic", "low", "high", axis=(0, 0, 1), lower=0, upper=9)
    return hr.Robot([hr.Link("low", mesh), hr.Link("high", mesh)], [joint])


def prepare(name):
    """Returns the call, and how many times to repeat it."""
    if name == "small_plan":  # phi alone: there is no motion to find
        molecule = hm.Molecule(ROOT / "molecular/data/1ubq.pdb")
        checker = hm.Checker(molecule, "A:60:phi", exempt_reference=True)
        return lambda: checker.plan(None, [np.pi], tries=10**9)
    if name == "small_fit":
        checker = hm.Checker(hm.Molecule(ROOT / "molecular/data/1ubq.pdb"))
        target = checker.molecule.coordinates[::-1]
        return lambda: [checker.fit_coordinates(target) for _ in range(1000)]
    if name == "small_relax":
        checker = hm.Checker(hm.Molecule(ROOT / "molecular/data/1ubq.pdb"))
        q = checker.sample(1000)
        return lambda: checker.relax(q)
    if name.startswith("molecule"):
        source = sys.argv[3] if len(sys.argv) > 3 else gzip.compress(many_chains(250), 1)
        if name == "molecule":
            return lambda: hm.Molecule(source)
        molecule = hm.Molecule(source)
        if name == "molecule_checker":
            return lambda: hm.Checker(molecule, "chi")
        checker = hm.Checker(molecule, "chi", exempt_reference=True)
        q = np.zeros(checker.dof)
        if name == "molecule_certify":
            return lambda: [checker.certify(q, q) for _ in range(100)]
        return lambda: [checker.walk(1) for _ in range(100)]
    if name.startswith("model"):
        vertices, faces = surface(400)
        model = hinge.Model([0], "prismatic")
        model.add_triangles(0, vertices[faces])
        model.add_triangles(1, vertices[faces[:9]] + 5.0)
        if name == "model_checker":
            return lambda: [hinge.Checker(model) for _ in range(100)]
        checker = hinge.Checker(model)
        return lambda: [checker.certify([0.0], [0.1]) for _ in range(1000)]
    vertices, faces = surface(300)
    if name == "mesh":
        return lambda: [hr.Mesh(vertices, faces) for _ in range(1000)]
    mesh = hr.Mesh(vertices, faces)
    if name == "robot":
        return lambda: [lifted(mesh) for _ in range(100)]
    if name == "environment":
        world = hr.Environment()
        return lambda: [world.add(mesh) for _ in range(100)]
    robot = lifted(mesh)
    if name == "robot_tiers":
        return lambda: robot.with_tiers("spheres")
    if name == "robot_links":
        return lambda: [robot._link_columns() for _ in range(1000)]
    if name == "robot_checker":
        return lambda: [hr.Checker(robot) for _ in range(100)]
    world = hr.Environment()
    if name == "robot_plan":
        world.add(hr.Box((9, 9, 0.1)), (0, 0, 2), "wall")
        return lambda: hr.Checker(robot, environment=world).plan([1.0], [4.0], tries=10**9)
    world.add(mesh, (0, 0, -5), "sheet")
    checker = hr.Checker(robot, environment=world)

    def certify():
        for k in range(100):
            world.set_pose("sheet", (0, 0, -5 - k))
            checker.certify([3.0], [3.1])

    return certify


def main():
    call, delay = prepare(sys.argv[1]), float(sys.argv[2])
    pressed = []

    def press():
        time.sleep(delay)
        pressed.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    try:
        call()
    except KeyboardInterrupt:
        print(f"interrupted after {time.perf_counter() - pressed[0]:.3f} s", flush=True)
    else:
        print("ended before Ctrl-C", flush=True)
        os._exit(0)


main()
