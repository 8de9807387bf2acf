#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes ramachandran_table.cpp and rotamer_table.cpp from the Top8000 data of the Richardson laboratory.

    make_torsion_tables.py FOLDER

FOLDER holds rama8000-*.data and the rotamers' CSV files from https://github.com/rlabduke/reference_data (CC BY 4.0).
"""

import csv
import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).parent
HEADER = """// SPDX-License-Identifier: BSD-3-Clause
// {what} Data: CC-BY-4.0.
// Made by make_torsion_tables.py from the Top8000 data set of the Richardson laboratory, Duke University, licence CC BY
// 4.0, https://github.com/rlabduke/reference_data. {changed}
#include "chemistry/{name}.hpp"

namespace hinge::molecular {{

"""
CLASSES = {
    "general": "general-noGPIVpreP",
    "isoleucine_valine": "ileval-nopreP",
    "glycine": "gly-sym",
    "before_proline": "prepro-noGP",
    "trans_proline": "transpro",
    "cis_proline": "cispro",
}
BIN = 10  # degrees
SCALE = 10_000  # sum of a table


def densities(path):
    """Return the share of the data in each bin, shape (360 / BIN, 360 / BIN), phi by psi.

    The file gives for each cell of 2 degrees the share of the data where the density is lower than in the cell. So the
    cells in order of this share are in order of density, and the share grows from one cell to the next by what the cell
    holds. Runs of 25 cells are averaged, because a single difference is noisy.
    """
    rows = np.array([line.split() for line in path.read_text().splitlines() if line[0] != "#"], dtype=float)
    rows = rows[rows[:, 2] > 0]
    rows = rows[np.argsort(rows[:, 2], kind="stable")]
    held = np.diff(rows[:, 2], prepend=0.0)
    for first in range(0, len(held), 25):
        held[first : first + 25] = held[first : first + 25].mean()
    table = np.zeros((360 // BIN, 360 // BIN))
    bins = ((rows[:, :2] + 180.0) // BIN).astype(int)
    np.add.at(table, (bins[:, 0], bins[:, 1]), held)
    return table / table.sum()


def ramachandran(folder):
    changed = "Changed: densities from percentiles, in\n// bins of 10 degrees."
    text = HEADER.format(what="Shares of backbone torsions (phi, psi) in bins, by kind of residue.", changed=changed,
                         name="ramachandran_table")
    text += "// clang-format off\nconst RamachandranTable ramachandran_tables[6] = {\n"
    for name, file in CLASSES.items():
        text += f"{{  // {name}\n"
        for row in np.rint(densities(folder / f"rama8000-{file}.data") * SCALE).astype(int):
            line = ""
            for number in row:
                piece = f"{number},"
                if len(line) + len(piece) > 118:
                    text += line.rstrip() + "\n"
                    line = ""
                line += piece
            text += line.rstrip() + "\n"
        text += "},\n"
    text += "};\n// clang-format on\n\n}  // namespace hinge::molecular\n"
    (HERE / "ramachandran_table.cpp").write_text(text)


def rotamers(folder):
    changed = "Changed: rotamers below 0.1 % and bond\n// angles are left out."
    text = HEADER.format(what="Rotamers of amino acids: shares, means and standard deviations of side chain torsions.",
                         changed=changed, name="rotamer_table")
    text += "// clang-format off\nconst Rotamer rotamers[] = {\n"
    count = 0
    for file in sorted(folder.glob("???.csv")):
        if file.stem == "PRO":  # its side chain is a rigid ring here
            continue
        for row in csv.DictReader(file.open()):
            share = float(row["frequency%"])
            if share < 0.1:
                continue
            chis = [k for k in range(1, 5) if row.get(f"chi{k}_mean")]
            means = ", ".join(row[f"chi{k}_mean"] for k in chis)
            spreads = ", ".join(row[f"chi{k}_esd"] for k in chis)
            text += f'{{"{file.stem}", {share}, {len(chis)}, {{{means}}}, {{{spreads}}}}},  // {row["rotamer"]}\n'
            count += 1
    text += "};\n// clang-format on\n" + f"const std::size_t rotamer_count = {count};\n"
    text += "\n}  // namespace hinge::molecular\n"
    (HERE / "rotamer_table.cpp").write_text(text)


if __name__ == "__main__":
    data = pathlib.Path(sys.argv[1])
    ramachandran(data)
    rotamers(data)
