// SPDX-License-Identifier: BSD-3-Clause
// Structure: what a molecular file says, after the loader's checks: atoms, residues, chains, bonds, models.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hinge/core/vec3.hpp"

namespace hinge::molecular {

/// One atom of the chosen conformer. Positions live in Structure::models.
struct Atom {
  std::string name;     ///< as in the file, without blanks: "CA", "HG11"
  std::string element;  ///< symbol in periodic-table case: "C", "Zn"; deuterium is "H"
  std::uint32_t residue = 0;
  char altloc = '\0';        ///< '\0' where the file has none
  int serial = 0;            ///< as in the file
  std::uint32_t record = 0;  ///< which atom record of its model in the file, from 0
};

enum class ResidueKind : std::uint8_t { amino_acid, nucleotide, water, other };

/// A residue and the range [first_atom, last_atom) it owns.
struct Residue {
  std::string name;  ///< three-letter code, "HOH"
  int sequence_number = 0;
  char insertion_code = '\0';
  std::uint32_t chain = 0;
  std::uint32_t first_atom = 0;
  std::uint32_t last_atom = 0;
  ResidueKind kind = ResidueKind::other;
};

/// A chain and the range [first_residue, last_residue) it owns.
struct Chain {
  std::string name;
  std::uint32_t first_residue = 0;
  std::uint32_t last_residue = 0;
  std::uint32_t file = 0;  ///< position among the files that were joined
};

/// Where a bond comes from; the output says so for everything but templates and peptides.
enum class BondOrigin : std::uint8_t {
  residue_template,  ///< our own residue tables
  peptide,           ///< C(i)-N(i+1)
  phosphodiester,    ///< O3'(i)-P(i+1)
  disulphide,        ///< SSBOND, struct_conn or SG-SG by distance
  record,            ///< LINK, CONECT or struct_conn
  component,         ///< a chemical component's definition
  covalent_radii     ///< perceived from distance
};

/// What is known of a bond's order. Multiple: double, triple, aromatic or delocalised. A metal's bonds are
/// coordination.
enum class BondOrder : std::uint8_t { unknown, single, multiple, coordination };

/// Bonds between residues that neither a record nor the order of a polymer tells of. recorded: there are none.
/// geometry: disulphides, closed backbones, and those of residues outside of polymers, where distance, valences and
/// angles allow them.
enum class BondSearch : std::uint8_t { recorded, geometry };

/// first < second, positions in Structure::atoms.
struct Bond {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  BondOrigin origin = BondOrigin::residue_template;
  BondOrder order = BondOrder::unknown;
};

/// A bond the file records (SSBOND, LINK, struct_conn, CONECT) between two kept atoms.
struct Link {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  bool disulphide = false;
  bool conect = false;                   ///< by CONECT alone, which lists the bonds inside residues too
  BondOrder order = BondOrder::unknown;  ///< where CONECT repeats partners
};

/// Where the bonds inside residues of one name come from; residues of one heavy atom have none.
struct BondSource {
  std::string residue;
  std::string source;  ///< "residue table", "covalent radii", a file
  std::size_t count = 0;
};

/// A helix or strand from HELIX/SHEET records: residues [first, last] of one chain, positions in Structure::residues.
struct SecondaryStructure {
  enum class Kind : std::uint8_t { helix, strand } kind = Kind::helix;
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

/// A molecule as read (or built): topology once, coordinates per model, in angstrom.
struct Structure {
  std::string name;  ///< entry id, or the file's stem
  std::vector<Atom> atoms;
  std::vector<Residue> residues;
  std::vector<Chain> chains;
  std::vector<Link> links;               ///< as recorded; bonds says which of them hold
  std::vector<Bond> bonds;               ///< sorted, unique
  std::vector<BondSource> bond_sources;  ///< sorted by residue and source
  std::vector<SecondaryStructure> secondary_structure;
  std::vector<std::vector<Vec3>> models;  ///< models[m][atom]; at least one
  std::vector<int> model_numbers;         ///< as in the file, one per model
  std::vector<std::string> notes;         ///< repairs, guesses and warnings, one sentence each
  std::size_t waters_dropped = 0;
  std::size_t hetero_dropped = 0;                              ///< atoms
  std::map<std::string, std::size_t> hetero_residues_dropped;  ///< by name
  std::size_t atom_records = 0;  ///< of the first model in the file, kept or not; 0: made by no file
  bool more_models = false;      ///< the file goes on with models that were not read (ReadOptions::first_model)
};

/// "A:LYS77:NZ" (insertion code behind the number: "A:SER60A:OG"); a blank chain name is printed as "_".
std::string label(const Structure& structure, std::uint32_t atom);

/// Is any of its atoms a hydrogen?
bool has_hydrogens(const Structure& structure) noexcept;

}  // namespace hinge::molecular
