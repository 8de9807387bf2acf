# SPDX-License-Identifier: BSD-3-Clause
"""Compares the programs of biocd and robocd for each instruction set: time of a conformation or configuration.

Usage: instruction_sets.py FOLDER_OF_TOOLS [ROUNDS]. The programs of all instruction sets that this CPU can run must be in the
folder. They take turns in each of the rounds (3); the best time counts. Prints a table in Markdown, then the geometric mean of
each ratio. Molecules and robots of the shared data are left out with a message where it is absent.
"""
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared" / "data"
SETS = ("baseline", "avx2", "avx512")
GOALS = {("baseline", "avx512"): 3.0, ("avx2", "avx512"): 1.6}  # at most
ROBOT_SECONDS = 4


def work():
    """Yields (name, file, arguments of a tool, function from its output to microseconds)."""
    def rate(text):
        return 1e6 / float(re.search(r"(\d+) conformations per second", text).group(1))

    def dialled(section, choice):
        """Returns the function from the JSON of dial to the time of one choice."""
        def read(text):
            rows = json.loads(text)["sections"][section]["rows"]
            return 1e6 * next(row["seconds"] for row in rows if row["name"] == choice)
        return read

    for name, file, free, count in (("1UBQ, tail of 7 residues", ROOT / "molecular/data/1ubq.pdb", "A:70-76", 100_000),
                                    ("1MBN, all residues", SHARED / "molecules/paper/1mbn.pdb", "all", 50_000)):
        for sigma, mode, words in (("5", "any", "yes/no, 5 degrees"), ("0.5", "any", "yes/no, 0.5 degrees"),
                                   ("0.5", "all", "all pairs, 0.5 degrees"), ("0.5", "closest", "closest pair, 0.5 degrees")):
            command = ["biocd", "sample", file, "--free", free, "--exempt-reference", "--sigma", sigma, "--mode", mode,
                       "-n", count, "--threads", 1, "--seed", 2005, "--exit-zero"]
            yield f"{name}: {words}", file, command, rate
    for robot in ("panda", "ur5_robotiq", "talos", "pr2"):
        folder = SHARED / "robots" / robot
        command = ["robocd", "dial", folder / f"{robot}.urdf", "--srdf", folder / f"{robot}.srdf", "--time", ROBOT_SECONDS,
                   "--seed", 2005, "--json"]
        for words, read in (("yes/no", dialled(0, "shapes of the URDF")),
                            ("proof of a motion", dialled(1, "every state, by proof"))):
            yield f"{robot}: {words}", folder / f"{robot}.urdf", command, read


def run(tools, command, instruction_set):
    done = subprocess.run([str(Path(tools) / command[0]), *map(str, command[1:])], capture_output=True, text=True, check=False,
                          env={**os.environ, "HINGE_ISA": instruction_set})
    if done.returncode != 0:
        sys.exit(f"{instruction_set}: {' '.join(map(str, command))}: exit status {done.returncode}\n{done.stderr}")
    return done.stdout


def three_digits(number):
    return f"{number:.{max(0, 2 - math.floor(math.log10(number)))}f}"


def sets_here(tools):
    """Returns the instruction sets of this CPU, and stops if a program is missing."""
    here = []
    for name in SETS:
        try_it = subprocess.run([str(Path(tools) / "biocd"), "--version"], capture_output=True, text=True, check=False,
                                env={**os.environ, "HINGE_ISA": name})
        if try_it.returncode != 0:
            break
        for tool in ("biocd", "robocd"):
            if name != "baseline" and not (Path(tools) / f"{tool}-{name}").exists():
                sys.exit(f"{tools}/{tool}-{name} is missing: ./run build makes it")
        here.append(name)
    return here


def main():
    tools, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3
    sets = sets_here(tools)
    pairs = [pair for pair in (("baseline", "avx512"), ("avx2", "avx512"), ("baseline", "avx2")) if set(pair) <= set(sets)]
    print("| microseconds | " + " | ".join(sets + [" / ".join(pair) for pair in pairs]) + " |")
    print("|" + "---|" * (1 + len(sets) + len(pairs)))
    ratios = {pair: [] for pair in pairs}
    outputs = {}
    for name, file, command, read in work():
        if not file.exists():
            print(f"{name}: left out, the shared data is missing", file=sys.stderr)
            continue
        key = tuple(map(str, command))
        if key not in outputs:
            outputs[key] = [{s: run(tools, command, s) for s in sets} for _ in range(rounds)]
        best = {s: min(read(output[s]) for output in outputs[key]) for s in sets}
        for pair in pairs:
            ratios[pair].append(best[pair[0]] / best[pair[1]])
        cells = [three_digits(best[s]) for s in sets] + [f"{ratios[pair][-1]:.2f}" for pair in pairs]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)
    for pair in pairs:
        goal = f", target at most {GOALS[pair]}" if pair in GOALS else ""
        mean = math.exp(sum(map(math.log, ratios[pair])) / len(ratios[pair]))
        print(f"ratio instruction-set {pair[0]} {pair[1]} {mean:.2f}, largest {max(ratios[pair]):.2f}{goal}")


if __name__ == "__main__":
    main()
