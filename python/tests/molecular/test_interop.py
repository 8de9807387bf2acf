# SPDX-License-Identifier: BSD-3-Clause
"""Structures and coordinates of gemmi, MDAnalysis and mdtraj give the answers of the files they were read from."""

import warnings

import numpy as np
import pytest

import hinge.molecular as hm
from conftest import ROOT, SHARED
from molecular_cases import biocd

FILES = [
    ROOT / "molecular/data/1ubq.pdb",
    ROOT / "molecular/data/1bna.pdb",
    SHARED / "molecules/1crn.pdb",
    SHARED / "molecules/5pti.pdb",
    SHARED / "molecules/1hpx.pdb",
    SHARED / "molecules/paper/nmr_neopetrosiamide.pdb",
]
files = pytest.mark.parametrize("file", FILES, ids=lambda f: f.stem)


def imported(name):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of old modules with a newer Python
        return pytest.importorskip(name, reason=f"{name} is not installed (./run python installs it)")


def existing(file):
    if not file.exists():
        pytest.skip(f"{file} does not exist")
    return file


@files
def test_gemmi(file):
    gemmi = imported("gemmi")
    m = hm.Molecule(existing(file), hetero=True)
    g = hm.Molecule.from_gemmi(gemmi.read_structure(str(file)), hetero=True)
    assert np.array_equal(g.models, m.models)
    assert [m.label(k) for k in range(m.n_atoms)] == [g.label(k) for k in range(g.n_atoms)]
    mine, theirs = hm.Checker(m, "none"), hm.Checker(g, "none")
    assert np.array_equal(mine.pairs_coordinates(m.models, within=0.3), theirs.pairs_coordinates(g.models, within=0.3))


@pytest.mark.filterwarnings("ignore")
def test_mdanalysis_keeps_b_factors():
    """Selections by the confidence of predicted models read them."""
    mda = imported("MDAnalysis")
    m = hm.Molecule(FILES[0], hetero="waters", model=1)
    x = hm.Molecule.from_mdanalysis(mda.Universe(str(FILES[0])))
    chosen = m.select("plddt<=12")
    assert 0 < len(chosen) < len(m.torsions)
    assert np.array_equal(x.select("plddt<=12"), chosen)


@pytest.mark.filterwarnings("ignore")
def test_mdanalysis_b_factors_that_are_not_finite_are_zero():
    universe = imported("MDAnalysis").Universe(str(FILES[0]))
    universe.atoms.tempfactors = np.where(np.arange(len(universe.atoms)) % 2, np.nan, np.inf)
    x = hm.Molecule.from_mdanalysis(universe)
    assert np.array_equal(x.select("plddt<=0"), x.select("all"))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("ending", ["pdb", "cif"])
def test_written_files_hold_the_b_factors(tmp_path, ending):
    gemmi = imported("gemmi")
    out = tmp_path / f"x.{ending}"
    biocd("sample", "1ubq", "-n", 2, "--out", out)

    def b_factors(path):
        s = gemmi.read_structure(str(path))
        s.remove_waters()
        return [[a.b_iso for chain in model for residue in chain for a in residue] for model in s]

    (expected,) = b_factors(FILES[0])
    assert len(set(expected)) > 100
    assert b_factors(out) == [expected, expected]
    if ending == "pdb":
        universe = imported("MDAnalysis").Universe(str(out))
        assert np.allclose(universe.atoms.tempfactors, expected, rtol=0, atol=1e-6)


@files
@pytest.mark.filterwarnings("ignore")
def test_mdanalysis(file):
    mda = imported("MDAnalysis")
    m = hm.Molecule(existing(file), hetero="waters", model=1)
    universe = mda.Universe(str(file))
    x = hm.Molecule.from_mdanalysis(universe)
    assert [m.label(k) for k in range(m.n_atoms)] == [x.label(k) for k in range(x.n_atoms)]
    mine, theirs = hm.Checker(m, "none"), hm.Checker(x, "none")
    expected = mine.pairs_coordinates(m.coordinates, within=0.3)
    positions = universe.atoms.positions[x.atoms["record"]]
    assert positions.dtype == np.float32
    assert np.array_equal(theirs.pairs_coordinates(positions, within=0.3, decimals=3), expected)


def two_molecules(mda):
    """A universe of ubiquitin twice, 60 angstrom apart, with the same names and residue numbers."""
    protein = mda.Universe(str(FILES[0])).select_atoms("protein")
    both = mda.Merge(protein, protein)
    both.atoms[len(protein) :].translate((60, 60, 60))
    both.add_TopologyAttr("charges", np.zeros(len(both.atoms)))
    both.add_TopologyAttr("radii", np.ones(len(both.atoms)))
    return both


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("ending", ["pdb", "pqr"])
def test_files_of_two_molecules_that_mdanalysis_writes(tmp_path, ending):
    mda = imported("MDAnalysis")
    file = tmp_path / f"two.{ending}"
    two_molecules(mda).atoms.write(str(file))
    m, universe = hm.Molecule(file), mda.Universe(str(file))
    assert m.n_atoms == len(universe.atoms)
    assert np.array_equal(m.atoms["name"], universe.atoms.names)
    assert np.array_equal(m.atoms["residue_name"], universe.atoms.resnames)
    assert np.array_equal(m.atoms["residue_number"], universe.atoms.resids)
    assert np.array_equal(np.float32(m.coordinates), universe.atoms.positions)
    assert len(m.bonds) == 2 * len(hm.Molecule(FILES[0], model=1).bonds)


def test_joined_files_hold_what_gemmi_reads_from_each(tmp_path):
    """gemmi itself stops at the first END."""
    gemmi = imported("gemmi")
    joined = tmp_path / "joined.pdb"
    joined.write_text("".join(file.read_text() for file in FILES[:2]))
    expected = []
    for file in FILES[:2]:
        s = gemmi.read_structure(str(file))
        s.remove_waters()
        expected += [(a.name, *a.pos.tolist()) for chain in s[0] for residue in chain for a in residue]
    m = hm.Molecule(joined)
    assert m.n_models == 1
    assert [(name, *x) for name, x in zip(m.atoms["name"], m.coordinates.tolist())] == expected


@pytest.mark.filterwarnings("ignore")
def test_part_of_a_universe():
    mda = imported("MDAnalysis")
    universe = mda.Universe(str(FILES[0]))
    group = universe.select_atoms("resid 10-30")
    m = hm.Molecule.from_mdanalysis(group)
    assert m.n_atoms == len(group)
    assert m.atoms["residue_number"].min() == 10 and m.atoms["residue_number"].max() == 30
    with pytest.raises(ValueError, match="atoms: 0 atoms"):
        hm.Molecule.from_mdanalysis(universe.select_atoms("resid 999"))
    with pytest.raises(TypeError, match="atoms: a str, expected an AtomGroup"):
        hm.Molecule.from_mdanalysis("1ubq")
    with pytest.raises(TypeError, match="structure: a str, expected a gemmi.Structure"):
        hm.Molecule.from_gemmi("1ubq")


@pytest.mark.parametrize("top, trajectory, decimals", [("1l2y.pdb", "1l2y.xtc", 3), ("1l2y.pdb", "1l2y.dcd", None)])
@pytest.mark.filterwarnings("ignore")
def test_trajectories_of_mdanalysis_and_mdtraj(shared, top, trajectory, decimals):
    mda, mdtraj = imported("MDAnalysis"), imported("mdtraj")
    top, trajectory = shared(f"molecules/{top}"), shared(f"molecules/{trajectory}")
    m = hm.Molecule(top, model=1)
    c = hm.Checker(m, "none")
    frames = hm.Trajectory(m, trajectory)
    expected = c.pairs_coordinates(frames)
    universe = mda.Universe(str(top), str(trajectory))
    x = np.stack([universe.atoms.positions for _ in universe.trajectory])
    assert np.array_equal(c.pairs_coordinates(x, decimals=decimals), expected)
    nanometres = mdtraj.load(str(trajectory), top=str(top)).xyz
    got = c.pairs_coordinates(nanometres.astype(float) * 10, decimals=3)
    if decimals == 3:
        assert np.array_equal(got, expected)
    else:  # mdtraj's nanometres are rounded once more
        assert abs(len(got) - len(expected)) <= 0.02 * len(expected)


@pytest.mark.filterwarnings("ignore")
def test_analysis_class(shared):
    mda = imported("MDAnalysis")
    from hinge.molecular.mdanalysis import ClashAnalysis

    top, trajectory = shared("molecules/1l2y.pdb"), shared("molecules/1l2y.xtc")
    universe = mda.Universe(str(top), str(trajectory))
    analysis = ClashAnalysis(universe, decimals=3).run(start=3, stop=20, step=2)
    m = hm.Molecule(top, model=1)
    c = hm.Checker(m, "none")
    expected = c.pairs_coordinates(hm.Trajectory(m, trajectory).read(3, 20, 2))
    assert np.array_equal(analysis.results.pairs, expected)
    assert analysis.results.collides.tolist() == c.collides_coordinates(hm.Trajectory(m, trajectory)[3:20:2]).tolist()
    assert analysis.results.residues["contacts"].sum() == len(expected)
    assert analysis.frames.tolist() == list(range(3, 20, 2))
