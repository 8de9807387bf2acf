# SPDX-License-Identifier: BSD-3-Clause
"""Proteins, nucleic acids and ligands as mechanisms of torsions. Lengths are in angstrom, angles in radians."""

__all__: list = []
