# SPDX-License-Identifier: BSD-3-Clause
"""Times clash checks of coordinates against MDAnalysis and mdtraj, one thread each, and compares the pairs.

    PYTHONPATH=build/python /usr/bin/python3 python/bench/trajectory_clashes.py TOPOLOGY [TRAJECTORY]

MDAnalysis: self_capped_distance with the largest threshold; mdtraj: compute_neighborlist with it. Both times are
without the thresholds by type and the bonded pairs, which only the comparison applies. Medians of five runs.
"""

import statistics
import sys
import time
import warnings

import numpy as np

import hinge
import hinge.molecular as hm

warnings.simplefilter("ignore")
import MDAnalysis  # noqa: E402
import mdtraj  # noqa: E402
from MDAnalysis.lib.distances import self_capped_distance  # noqa: E402


def median_time(call):
    times = []
    for _ in range(5):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def main(topology, trajectory=None):
    m = hm.Molecule(topology, model=None if trajectory is None else 1)
    c = hm.Checker(m, "none")
    x = m.models if trajectory is None else hm.Trajectory(m, trajectory).read()
    single = x.astype(np.float32)
    reach = float(c.threshold_table.max())
    margin = 0.5  # clashes are rare: compare all pairs with d < threshold + margin
    found = c.pairs_coordinates(x, within=margin)
    expected = {tuple(row) for row in np.stack([found["conformation"], found["i"], found["j"]], axis=1).tolist()}

    excluded = np.zeros((m.n_atoms, m.n_atoms), bool)
    excluded[tuple(c.excluded_pairs.T)] = True
    peers = set()
    for k, frame in enumerate(single):
        pairs = np.sort(self_capped_distance(frame, max_cutoff=reach + margin, return_distances=False), axis=1)
        i, j = pairs.T
        exact = np.linalg.norm(x[k, i] - x[k, j], axis=1)
        clash = (exact < c.threshold_table[c.types[i], c.types[j]] + margin) & ~excluded[i, j]
        peers |= {(k, a, b) for a, b in pairs[clash].tolist()}

    atoms = mdtraj.Topology()
    residue = atoms.add_residue("X", atoms.add_chain())
    for _ in range(m.n_atoms):
        atoms.add_atom("C", mdtraj.element.carbon, residue)
    frames = mdtraj.Trajectory(single / 10, atoms)
    times = {
        "hinge, all pairs": median_time(lambda: c.pairs_coordinates(x)),
        "hinge, yes or no": median_time(lambda: c.collides_coordinates(x)),
        "MDAnalysis self_capped_distance": median_time(
            lambda: [self_capped_distance(frame, max_cutoff=reach) for frame in single]
        ),
        "mdtraj compute_neighborlist": median_time(
            lambda: [mdtraj.compute_neighborlist(frames, reach / 10, k) for k in range(len(single))]
        ),
    }
    print(f"{m.name}: {len(x)} frames of {m.n_atoms} atoms, {hinge.instruction_set}; {found['collides'].sum()} clashes")
    differ = len(expected ^ peers)
    print(f"{len(expected)} pairs within {margin} angstrom of their threshold; {differ} differ from MDAnalysis")
    for name, seconds in times.items():
        print(f"  {name:<32} {seconds / len(x) * 1e3:9.3f} ms a frame, {seconds / times['hinge, all pairs']:6.1f} x")


if __name__ == "__main__":
    main(*sys.argv[1:])
