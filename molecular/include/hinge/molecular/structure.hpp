// SPDX-License-Identifier: BSD-3-Clause
// Structure: the atoms, residues, chains, bonds and models of a molecular file, after the loader's checks.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// One atom of the chosen conformer. Its positions are in Structure::models.
struct Atom {
  std::string name;           ///< as in the file, without blanks: "CA", "HG11"
  std::string element;        ///< symbol in periodic-table case: "C", "Zn"; deuterium is "H"
  std::uint32_t residue = 0;  ///< index in Structure::residues
  char altloc = '\0';         ///< alternative location; '\0': the file has none
  int serial = 0;             ///< serial number in the file
  std::uint32_t record = 0;   ///< index among the atom records of its model in the file, from 0
  double b_factor = 0.0;      ///< temperature factor (angstrom^2); in predicted models the confidence pLDDT, 0 to 100
};

/// Waters, amino acids and nucleotides by name and backbone atoms; ions, ligands, sugars and chain caps are `other`.
enum class ResidueKind : std::uint8_t { amino_acid, nucleotide, water, other };

/// A residue and its atoms [first_atom, last_atom).
struct Residue {
  std::string name;                       ///< residue name: "ALA", "HOH", "DA"
  int sequence_number = 0;                ///< author's number in the file
  char insertion_code = '\0';             ///< '\0': none
  std::uint32_t chain = 0;                ///< index in Structure::chains
  std::uint32_t first_atom = 0;           ///< index in Structure::atoms
  std::uint32_t last_atom = 0;            ///< index past the last atom
  ResidueKind kind = ResidueKind::other;  ///< by name and backbone atoms
};

/// A chain and its residues [first_residue, last_residue).
struct Chain {
  std::string name;                 ///< empty: the chain has no name
  std::uint32_t first_residue = 0;  ///< index in Structure::residues
  std::uint32_t last_residue = 0;   ///< index past the last residue
  std::uint32_t file = 0;           ///< index of the file the chain comes from, if files were joined (join_structures)
};

/// The source of a bond.
enum class BondOrigin : std::uint8_t {
  residue_template,  ///< the built-in residue tables; also the bonds of hydrogens
  peptide,           ///< C(i)-N(i+1)
  phosphodiester,    ///< O3'(i)-P(i+1)
  disulphide,        ///< SSBOND, struct_conn or SG-SG by distance
  record,            ///< LINK, CONECT, struct_conn, or the bonds that Hinge wrote to a file
  component,         ///< a chemical component's definition
  covalent_radii     ///< covalent radii: distance alone
};

/// The known part of a bond's order. multiple: double, triple, aromatic or delocalised. coordination: every bond of a
/// metal.
enum class BondOrder : std::uint8_t { unknown, single, multiple, coordination };

/// How perceive_bonds finds bonds between residues. Both use the order of the polymer and the recorded bonds. recorded:
/// no others. geometry: also disulphides, bonds that close a backbone, and bonds of residues outside polymers, if
/// distance, valences and angles allow them.
enum class BondSearch : std::uint8_t { recorded, geometry };

/// A bond of two atoms: indices in Structure::atoms, first < second.
struct Bond {
  std::uint32_t first = 0;                           ///< atom
  std::uint32_t second = 0;                          ///< atom
  BondOrigin origin = BondOrigin::residue_template;  ///< where the bond comes from
  BondOrder order = BondOrder::unknown;              ///< the known part of the order
};

/// A bond that the file records (SSBOND, LINK, struct_conn, CONECT) between two kept atoms: indices in
/// Structure::atoms, first < second.
struct BondRecord {
  std::uint32_t first = 0;               ///< atom
  std::uint32_t second = 0;              ///< atom
  bool disulphide = false;               ///< SSBOND or struct_conn says so, or both atoms are SG
  bool conect = false;                   ///< only CONECT records it; CONECT also lists bonds inside residues
  BondOrder order = BondOrder::unknown;  ///< multiple if CONECT repeats the partner
};

/// The source of the bonds inside residues of one name. Residues of fewer than two heavy atoms are not listed.
struct BondSource {
  std::string residue;    ///< residue name
  std::string source;     ///< "residue table", "covalent radii", "CONECT records", "records of Hinge" or a file
  std::size_t count = 0;  ///< number of residues
};

/// A helix or strand from HELIX and SHEET records: residues [first, last] of one chain, indices in Structure::residues.
struct SecondaryStructure {
  /// The two kinds that are kept.
  enum class Kind : std::uint8_t { helix, strand } kind = Kind::helix;  ///< helix or strand
  std::uint32_t first = 0;                                              ///< first residue
  std::uint32_t last = 0;                                               ///< last residue, included
};

/// A molecule as read or built: topology once, coordinates per model in angstrom. Indices in its members are not
/// checked after loading; code that edits it keeps them consistent.
struct Structure {
  std::string name;                                            ///< entry id; if the file has none, its stem
  std::vector<Atom> atoms;                                     ///< grouped by residue
  std::vector<Residue> residues;                               ///< grouped by chain
  std::vector<Chain> chains;                                   ///< each with its residues
  std::vector<BondRecord> bond_records;                        ///< `bonds` holds those that were accepted
  std::vector<Bond> bonds;                                     ///< sorted by atoms, each once
  std::vector<BondSource> bond_sources;                        ///< sorted by residue and source
  std::vector<SecondaryStructure> secondary_structure;         ///< helices and strands that the file records
  std::vector<std::vector<Vec3>> models;                       ///< models[m][atom], angstrom; at least one model
  std::vector<int> model_numbers;                              ///< model numbers in the file, one per model
  std::vector<std::string> notes;                              ///< repairs, guesses and warnings, one sentence each
  std::size_t waters_dropped = 0;                              ///< residues
  std::size_t hetero_dropped = 0;                              ///< atoms
  std::map<std::string, std::size_t> hetero_residues_dropped;  ///< number of dropped residues by name
  std::size_t atom_records = 0;  ///< atom records of the first chosen model, kept or not; 0: not read from a file
  bool more_models = false;      ///< the file holds further models that were not read (ReadOptions::first_model)
};

/// Returns "A:LYS77:NZ" for an index in structure.atoms. The insertion code follows the number ("A:SER60A:OG"); a blank
/// chain name is printed as "_".
HINGE_API std::string label(const Structure& structure, std::uint32_t atom);

/// Returns "A:LYS77" for an index in structure.residues, in the form of label().
HINGE_API std::string residue_label(const Structure& structure, std::uint32_t residue);

/// True if any atom is a hydrogen (or deuterium).
HINGE_API bool has_hydrogens(const Structure& structure) noexcept;

}  // namespace hinge::molecular
