# SPDX-License-Identifier: BSD-3-Clause
"""Molecules that the tests compare with the command line, and how they run it."""

import json
import subprocess

from conftest import ROOT, shared, tool

# name: (file, options of the tool, the same for Molecule)
MOLECULES = {
    "1ubq": ("molecular/data/1ubq.pdb", [], {}),
    "1bna": ("molecular/data/1bna.pdb", [], {}),
    "1crn": ("molecules/1crn.pdb", [], {}),
    "5pti": ("molecules/5pti.pdb", ["--hydrogens", "drop"], {"hydrogens": "drop"}),
    "1hpx": ("molecules/1hpx.pdb", ["--hetero", "ligands"], {"hetero": True}),
    "2juy": ("molecules/paper/nmr_neopetrosiamide.pdb", ["--model", "3"], {"model": 3}),
}


def path_of(name):
    file = MOLECULES[name][0]
    return ROOT / file if file.startswith("molecular/") else shared(file)


def options_of(name):
    """Options of Molecule."""
    return MOLECULES[name][2]


def biocd(command, name, *more, ok=(0, 1)):
    """Runs biocd and returns its JSON."""
    arguments = [tool("biocd"), command, str(path_of(name)), *MOLECULES[name][1], *map(str, more), "--json"]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=600)
    assert done.returncode in ok, (arguments, done.stderr)
    return json.loads(done.stdout)


def rows_of(pairs, k):
    """The pairs of one conformation of JSON, as tuples like those of rows()."""
    return [(k, p["i"], p["j"], p["distance"], p["threshold"], p["collides"]) for p in pairs]


def rows(pairs):
    """Structured rows as tuples of Python numbers."""
    return [tuple(row) for row in pairs.tolist()]
