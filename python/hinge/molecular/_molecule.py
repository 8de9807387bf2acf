# SPDX-License-Identifier: BSD-3-Clause
"""Molecule: reading files and objects of other libraries, and atoms, bonds and torsions as arrays."""

import contextlib
import os
import pathlib

import numpy as np

from .. import Error
from .._core import molecular as _core
from . import _interop

_HYDROGENS = ("keep", "drop")
_HETERO = ("none", "ligands", "waters")
_BONDS = ("geometry", "recorded")


def one_of(name, value, allowed):
    if value not in allowed:
        raise ValueError(f"{name}: {value!r}, expected {', '.join(map(repr, allowed))}")
    return value


def _suffix(data):
    """The extension that fits the content of a structure file."""
    if data[:2] == b"\x1f\x8b":
        import gzip

        return _suffix(gzip.decompress(data)) + ".gz"
    lines = (line for line in data.splitlines() if line.strip() and not line.startswith(b"#"))
    return ".cif" if next(lines, b"").lower().startswith(b"data_") else ".pdb"


def _table(columns, **more):
    """A read-only structured array of columns of one length."""
    arrays = {name: np.asarray(column) for name, column in {**columns, **more}.items()}
    for name, array in arrays.items():
        if array.size == 0 and array.dtype == np.float64 and name not in ("reference",):
            arrays[name] = array.astype("U1")  # an empty list of names
    dtype = [(name, array.dtype, array.shape[1:]) for name, array in arrays.items()]
    table = np.empty(len(next(iter(arrays.values()))), dtype)
    for name, array in arrays.items():
        table[name] = array
    table.flags.writeable = False
    return table


class Molecule(_core.MoleculeBase):
    """A molecule as a mechanism: rigid groups of atoms joined by torsions. It does not change after construction.

    source: path of a PDB, mmCIF or PQR file, plain or gzipped, or the content of a PDB or mmCIF
        file as bytes.
    with_files: further files (or contents) that become part of the molecule; all of them is kept except waters.
    hydrogens: 'keep' or 'drop'. model: number of the model to read; None: all, and model 0 is the reference.
    altloc: alternative location to use; None: the one of highest summed occupancy.
    hetero: 'none', 'ligands' (True; ions and sugars, too) or 'waters' (these as well).
    bonds: between residues, 'geometry' (also by distance) or 'recorded' (only those of the file).
    components: CIF files that define bonds of residues. dictionary: folder of a monomer dictionary; 'installed': this
    machine's; None: none.
    loops: segments that move between fixed ends, such as 'A:40-52,B:7-15'.
    keep_hydrogen_bonds: hydrogen bonds of the backbone become closures.
    place: parts that move as bodies, each with six more degrees of freedom: words ('B', 'KNI', 'file:2'), a boolean
    mask of atoms, or (part, distance, turn), the range of samples in angstrom and rad (default 10, pi).
    held: pairs of fragments that keep their relative pose (RigidGroups.held), shape (n, 6).

    Raises LoadError for bad files, ModelError for bad words, ValueError and TypeError for bad options. The defaults
    are those of the tool biocd. Pickling stores the source (a path, or bytes) and the options; the file is read again.
    """

    def __init__(
        self,
        source,
        *,
        with_files=(),
        hydrogens="keep",
        model=None,
        altloc=None,
        hetero="none",
        bonds="geometry",
        components=(),
        dictionary="installed",
        loops="",
        keep_hydrogen_bonds=False,
        place=(),
        held=None,
    ):
        if isinstance(hetero, (bool, np.bool_)):
            hetero = "ligands" if hetero else "none"
        if altloc is not None and (not isinstance(altloc, str) or len(altloc) != 1):
            raise ValueError(f"altloc: {altloc!r}, expected one character or None")
        if isinstance(with_files, (str, bytes, os.PathLike)):
            with_files = (with_files,)
        if isinstance(components, (str, os.PathLike)):
            components = (components,)
        sources = [self._source(s, name) for s, name in [(source, "source"), *((f, "with_files") for f in with_files)]]
        components = tuple(os.path.abspath(os.fspath(c)) for c in components)
        if dictionary == "installed":
            folder = _core.installed_dictionary()
        else:
            folder = "" if dictionary is None else os.path.abspath(os.fspath(dictionary))
        if isinstance(place, (str, np.ndarray)):
            place = (place,)
        self._options = {
            "with_files": tuple(sources[1:]),
            "hydrogens": one_of("hydrogens", hydrogens, _HYDROGENS),
            "model": model,
            "altloc": altloc,
            "hetero": one_of("hetero", hetero, _HETERO),
            "bonds": one_of("bonds", bonds, _BONDS),
            "components": components,
            "dictionary": dictionary,
            "loops": loops,
            "keep_hydrogen_bonds": keep_hydrogen_bonds,
            "place": tuple(place),
            "held": held,
        }
        self._data = sources[0]
        from_memory = any(isinstance(s, bytes) for s in sources)
        with _folder() if from_memory else contextlib.nullcontext() as t:
            paths = [self._path(t, k, s) for k, s in enumerate(sources)]
            placed = [_placed(item) for item in place]
            masks = any(not isinstance(part, str) for part, _, _ in placed)
            read = (model, altloc, hetero != "none", hetero == "waters", hydrogens == "keep", bonds == "geometry")
            more = (list(components), folder, loops, bool(keep_hydrogen_bonds))
            try:
                if masks:  # a mask is of atoms, a part is of residues: read the atoms first
                    atoms = _core.MoleculeBase(paths, *read, *more, [], None)._atom_columns()["residue"]
                    placed = [(residues_of(part, atoms, "place"), *limits) for part, *limits in placed]
                super().__init__(paths, *read, *more, placed, held)
            except Error as error:
                text = str(error)
                for path, s in zip(paths, sources):
                    text = text.replace(path, "<bytes>") if isinstance(s, bytes) else text
                raise type(error)(text) from None

    @staticmethod
    def _source(source, name):
        if isinstance(source, (bytes, bytearray, memoryview)):
            return bytes(source)
        if isinstance(source, (str, os.PathLike)):
            return os.path.abspath(os.fspath(source))
        raise TypeError(f"{name}: a {type(source).__name__}, expected a path or bytes (see from_gemmi)")

    @staticmethod
    def _path(folder, k, source):
        if isinstance(source, str):
            return source
        path = pathlib.Path(folder, f"bytes{k}{_suffix(source)}")
        path.write_bytes(source)
        return str(path)

    @classmethod
    def from_gemmi(cls, structure, **options):
        """Return the molecule of a gemmi.Structure, with all of its models.

        options: as of Molecule. The structure goes through mmCIF in memory, so its coordinates have the decimals that
        gemmi writes.
        """
        return cls(_interop.text_of_gemmi(structure), **options)

    @classmethod
    def from_mdanalysis(cls, atoms, **options):
        """Return the molecule of an MDAnalysis AtomGroup or Universe, at its present frame.

        options: as of Molecule, but hetero is 'waters' unless given, which keeps all. Chains are MDAnalysis' chainIDs,
        or segids if there are none. Bonds are found as for a file. One alternative location is kept, and chains are
        contiguous, so atoms may be fewer and in another order: atoms.positions[m.atoms["record"]] are coordinates
        for the molecule. They are 32-bit floats; pass decimals=3 where the file had three decimals.
        """
        options.setdefault("hetero", "waters")
        return cls(_interop.text_of_mdanalysis(atoms), **options)

    @property
    def source(self):
        """The path of the file, or its content as bytes."""
        return self._data

    @property
    def options(self):
        """The options of the constructor, as a dict."""
        return dict(self._options)

    @property
    def atoms(self):
        """The atoms: a read-only structured array of shape (n_atoms,).

        Fields: name, element, residue (index), residue_name, residue_number, insertion_code, chain, altloc, serial,
        record (index among the atom records of the file, or in the AtomGroup of from_mdanalysis).
        """
        if "_atoms" not in self.__dict__:
            self._atoms = _table(self._atom_columns())
        return self._atoms

    @property
    def bonds(self):
        """The bonds: a read-only structured array with i, j (indices of atoms, i < j), origin and order."""
        return _table(self._bond_columns())

    @property
    def torsions(self):
        """The torsions that can be free: a read-only structured array.

        Fields: label, name, residue (index), atoms (four indices), reference (dihedral angle in model 0, rad).
        """
        return _table(self._torsion_columns())

    @property
    def coordinates(self):
        """The coordinates of model 0: a read-only view of shape (n_atoms, 3), angstrom."""
        return self.model(0)

    @property
    def models(self):
        """The coordinates of all models: a new array of shape (n_models, n_atoms, 3), angstrom."""
        return np.stack([self.model(k) for k in range(self.n_models)])

    def select(self, free, *, omega=False):
        """Return indices of torsions, sorted, shape (n,).

        free: words, as of the tool ('all', 'A:30-40', 'chi', 'A and not omega'); booleans, one per torsion; booleans,
        one per atom: the torsions about bonds between two of the chosen atoms; or indices.
        omega: free omega, too. With loops, words select side chains, and the loops' torsions are added.
        Raises ModelError for words that select nothing, ValueError and IndexError for bad arrays.
        """
        if isinstance(free, str):
            return self._select(free, bool(omega), self.has_loops)
        chosen = np.asarray(free)
        count = len(self.torsions)
        if chosen.dtype != bool:
            if chosen.size and chosen.dtype.kind not in "iu":
                raise TypeError(f"free: an array of {chosen.dtype}, expected words, booleans or integers")
            chosen = chosen.astype(np.int64)
            if chosen.ndim != 1:
                raise ValueError(f"free: shape {chosen.shape}, expected (n,)")
            if chosen.size and not 0 <= chosen.min() <= chosen.max() < count:
                raise IndexError(f"free: indices {chosen.min()} to {chosen.max()}, expected 0 to {count - 1}")
            return np.unique(chosen)
        if chosen.shape == (self.n_atoms,):
            axis = self.torsions["atoms"][:, 1:3]
            return np.flatnonzero(chosen[axis].all(axis=1))
        if chosen.shape != (count,):
            raise ValueError(
                f"free: booleans of shape {chosen.shape}, expected ({count},), one per torsion, or ({self.n_atoms},), "
                "one per atom"
            )
        return np.flatnonzero(chosen)

    def select_atoms(self, part):
        """Return booleans of shape (n_atoms,): true for the atoms of a part, as 'A', 'KNI', 'A:10-20' or 'file:2'."""
        chosen = np.zeros(self.n_residues, bool)
        chosen[self._part_residues(part)] = True
        return chosen[self.atoms["residue"]]

    def __reduce__(self):
        return _rebuild, (type(self), self._data, self._options)

    def __repr__(self):
        def count(n, what):
            return f"{n} {what}" + ("" if n == 1 else "s")

        parts = [count(self.n_atoms, "atom"), count(self.n_residues, "residue"), count(self.n_chains, "chain")]
        models = [count(self.n_models, "model")] if self.n_models > 1 else []
        return f"<Molecule {self.name!r}: {', '.join([*parts, count(len(self.torsions), 'torsion'), *models])}>"


def residues_of(part, residues, name):
    """A part as words or as indices of residues, from words or a mask of atoms. residues: of each atom."""
    if isinstance(part, str):
        return part
    mask = np.asarray(part)
    if mask.dtype != bool or mask.shape != residues.shape:
        raise ValueError(f"{name}: expected words, or booleans of shape ({len(residues)},), one per atom")
    chosen = np.unique(residues[mask])
    if chosen.size == 0 or not mask[np.isin(residues, chosen)].all():
        raise ValueError(f"{name}: the atoms of the mask are not whole residues, at least one")
    return chosen


def _folder():
    import tempfile  # takes a tenth of the time of `import hinge`

    return tempfile.TemporaryDirectory(prefix="hinge-")


def _placed(item):
    """One item of `place` as (part, distance, turn)."""
    if isinstance(item, tuple):
        part, distance, turn = (*item, *(10.0, np.pi)[len(item) - 1 :]) if 1 <= len(item) <= 3 else (None, 0, 0)
        if part is None:
            raise ValueError(f"place: {item!r}, expected a part or (part, distance, turn)")
        return part, float(distance), float(turn)
    return item, 10.0, np.pi


def _rebuild(cls, source, options):
    return cls(source, **options)
