# SPDX-License-Identifier: BSD-3-Clause
"""Ratios of the Python package to MDAnalysis, mdtraj, the C++ library and NumPy: ./run bench python.

    PYTHONPATH=build/python /usr/bin/python3 python/bench/python_bench.py FOLDER_OF_PYTHON_BENCH_REFERENCE

One thread each, medians. Lines: what, ratio or difference, target, and the times it is made of.
"""

import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
import warnings

import numpy as np

import hinge
import hinge.molecular as hm

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = ROOT.parent / "shared" / "data" / "molecules"
PROTEIN = ROOT / "molecular/data/1ubq.pdb"
MARGIN = 0.5  # angstrom; clashes are rare, so the pairs within thresholds + MARGIN are compared


def median_time(call, repeats=5):
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return statistics.median(times)


def line(name, value, target, met, detail):
    print(f"{name:<44} {value:>10}   target {target:<12} {'met' if met else 'MISSED':<7} {detail}", flush=True)


def peers_of(name, molecule, x):
    """Rows for MDAnalysis and mdtraj on frames x, after a comparison of the pairs.

    MDAnalysis: self_capped_distance with the largest threshold; mdtraj: compute_neighborlist with it. Their times are
    without the thresholds by type and the bonded pairs, which only the comparison applies.
    """
    import mdtraj
    from MDAnalysis.lib.distances import self_capped_distance

    c = hm.Checker(molecule, "none")
    single = x.astype(np.float32)
    reach = float(c.threshold_table.max())
    found = c.pairs_coordinates(x, within=MARGIN)
    mine = {tuple(row) for row in np.stack([found["conformation"], found["i"], found["j"]], axis=1).tolist()}
    excluded = {tuple(pair) for pair in c.excluded_pairs.tolist()}
    theirs = set()
    for k, frame in enumerate(single):
        pairs = np.sort(self_capped_distance(frame, max_cutoff=reach + MARGIN, return_distances=False), axis=1)
        i, j = pairs.T
        near = np.linalg.norm(x[k, i] - x[k, j], axis=1) < c.threshold_table[c.types[i], c.types[j]] + MARGIN
        theirs |= {(k, a, b) for a, b in pairs[near].tolist() if (a, b) not in excluded}
    differ = len(mine ^ theirs)

    topology = mdtraj.Topology()
    residue = topology.add_residue("X", topology.add_chain())
    for _ in range(molecule.n_atoms):
        topology.add_atom("C", mdtraj.element.carbon, residue)
    frames = mdtraj.Trajectory(single / 10, topology)
    ours = median_time(lambda: c.pairs_coordinates(x))
    what = f"{len(x)} frames of {molecule.n_atoms} atoms, {differ} of {len(mine)} pairs differ"
    for peer, target, call in (
        ("MDAnalysis", 10, lambda: [self_capped_distance(frame, max_cutoff=reach) for frame in single]),
        ("mdtraj", 40, lambda: [mdtraj.compute_neighborlist(frames, reach / 10, k) for k in range(len(x))]),
    ):
        other = median_time(call)
        detail = f"{other / len(x) * 1e3:.2f} against {ours / len(x) * 1e3:.3f} ms a frame; {what}"
        ratio = other / ours
        line(f"{name}: {peer} / hinge", f"{ratio:.1f} x", f">= {target} x", ratio >= target and not differ, detail)


def trajectories():
    if not DATA.exists():
        print(f"skipped: {DATA} does not exist")
        return
    molecule = hm.Molecule(DATA / "adk_closed.pdb", model=1)
    peers_of("adk", molecule, hm.Trajectory(molecule, DATA / "adk_dims.dcd").read())
    molecule = hm.Molecule(DATA / "1igy.cif.gz", model=1)
    shaken = hm.Checker(molecule, "chi", closures="open")
    peers_of("1IGY", molecule, shaken.positions(shaken.sample(20, seed=1, sigma=np.radians(2))))


def against_cpp():
    """Run by a process of its own with HINGE_ISA=baseline, the set that the reference is compiled for."""
    folder = pathlib.Path(sys.argv[2])
    c = hm.Checker(hm.Molecule(PROTEIN))
    q = c.sample(10_000, seed=1, sigma=np.radians(5))
    with tempfile.TemporaryDirectory() as work:
        numbers = pathlib.Path(work, "q.bin")
        numbers.write_bytes(q.tobytes())
        program = [str(folder / "python_bench_reference"), str(PROTEIN), str(numbers), "5"]
        rounds = []
        for _ in range(5):  # interleaved, because the speed of a machine changes
            batch, single, hits = map(float, subprocess.run(program, capture_output=True, check=True).stdout.split())
            ours = median_time(lambda: c.collides(q))

            def many():
                for _ in range(1000):
                    c.collides(one)

            one = q[0]
            rounds.append((batch, ours, single, median_time(many) / 1000))
        assert int(hits) == int(c.collides(q).sum())
    print(json.dumps([statistics.median(column) for column in zip(*rounds)]))


def cpp_rows(folder):
    done = subprocess.run(
        [sys.executable, __file__, "--against-cpp", str(folder)],
        env={**os.environ, "HINGE_ISA": "baseline"},
        capture_output=True,
        text=True,
        check=True,
    )
    batch, ours, single, one = json.loads(done.stdout)
    over = 100 * (ours / batch - 1)
    detail = f"{ours * 1e3:.1f} against {batch * 1e3:.1f} ms"
    line("10 000 conformations over C++", f"{over:+.1f} %", "<= +3 %", over <= 3, detail)
    over = 1e6 * (one - single)
    detail = f"{one * 1e6:.2f} against {single * 1e6:.2f} us"
    line("one conformation over C++", f"{over:+.2f} us", "<= 1 us", over <= 1, detail)


def import_row():
    times = {code: [] for code in ("import numpy", "import numpy, hinge")}
    for _ in range(20):
        for code, of in times.items():
            start = time.perf_counter()
            subprocess.run([sys.executable, "-c", code], check=True)
            of.append(time.perf_counter() - start)
    numpy, both = (statistics.median(of) * 1e3 for of in times.values())
    added = both - numpy
    detail = f"{both:.0f} against {numpy:.0f} ms"
    line("import hinge over import numpy", f"{added:+.0f} ms", "<= 60 ms", added <= 60, detail)


def main(folder):
    warnings.simplefilter("ignore")
    print(f"instruction set {hinge.instruction_set}; load of the machine {os.getloadavg()[0]:.2f}")
    trajectories()
    cpp_rows(folder)
    import_row()


if __name__ == "__main__":
    if sys.argv[1] == "--against-cpp":
        against_cpp()
    else:
        main(sys.argv[1])
