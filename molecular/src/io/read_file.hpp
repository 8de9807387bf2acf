// SPDX-License-Identifier: BSD-3-Clause
// The steps of read_structure that have files of their own. C++17: clang compiles read_gemmi.cpp in that mode.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/recorded_bonds.hpp"
#include "hinge/molecular/components.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// Returns the file's bytes, gunzipped if needed. first_model: if a model follows the first ENDMDL, keep only CONECT
/// records after it, and set cut_short. Throws LoadError if the file cannot be opened, is damaged, empty, or unpacks to
/// too many bytes.
std::string read_bytes(const std::filesystem::path& path, bool first_model = false, bool* cut_short = nullptr);

/// True if the content is mmCIF.
bool looks_like_cif(const std::string& bytes);

/// True if the line begins with the name of a record. gemmi compares four letters, in either case.
inline bool is_record(std::string_view line, std::string_view name) {
  return line.size() >= name.size() &&
         std::equal(name.begin(), name.end(), line.begin(), [](char a, char b) { return a == (b & ~0x20); });
}

/// True if this line of a PDB file holds an atom for gemmi. A number of six digits begins in column 6.
inline bool is_atom_record(std::string_view line) { return is_record(line, "ATOM") || is_record(line, "HETA"); }

/// True for MODEL, which begins a model of a PDB file.
inline bool is_model_record(std::string_view line) { return is_record(line, "MODE"); }

/// True for ENDMDL, which ends a model of a PDB file.
inline bool is_endmdl(std::string_view line) { return is_record(line, "ENDM"); }

/// True for END. ModelScan tells whether it ends a model.
inline bool is_end(std::string_view line) {
  return line.substr(0, 3) == "END" && line.find_first_not_of(" \t\r", 3) == std::string_view::npos;
}

/// Returns the number in a MODEL record, or `otherwise` if the record has none.
int model_number(std::string_view line, int otherwise);

/// Numbers models by their positions, from 1, if a number occurs twice: files that were joined begin again, and so do
/// writers after 9999, the last number with four columns.
void number_by_position_if_repeated(std::vector<int>& numbers);

/// Returns the finite number that is the whole text, which may begin with +; nullopt: it is none.
std::optional<double> finite_number(std::string_view text);

/// Returns the coordinates of an atom record, angstrom. Throws LoadError, with line, atom and coordinate, if one is
/// blank or not a number.
Vec3 read_pdb_coordinates(std::string_view line, const std::string& path, std::size_t line_number);

/// Refuses data that the parser would silently repair: blank or malformed coordinates, empty or nested MODELs. The text
/// starts at line `number` + 1. Throws LoadError with the line. Repeated numbers of MODELs are noted. A MODEL without
/// ENDMDL is accepted, with a note, if a later record (END, CONECT, MASTER) shows that the file is complete, or if it
/// is the only model and its last atom record is as long as the longest.
void check_pdb(std::string_view text, const std::string& path, std::size_t number = 0,
               std::vector<std::string>* notes = nullptr);

/// What a file has in the place of an atom's element. virtual_site: EP, or a type of AutoDock's pseudo atoms.
enum class ElementField : std::uint8_t { symbol, blank, virtual_site };

/// An atom as in the file, before conformers are chosen.
struct RawAtom {
  std::string name;
  std::string element;  ///< of the file; if that is blank, as the name's columns tell; empty: unknown
  ElementField element_field = ElementField::symbol;
  char altloc = '\0';
  int serial = 0;
  std::uint32_t record = 0;  ///< index among the atom records of its model
  double occupancy = 1.0;
  double b_factor = 0.0;
  Vec3 position = Vec3::Zero();  ///< angstrom
};

/// A residue as in the file.
struct RawResidue {
  std::string chain;
  std::string name;
  int number = 0;
  char insertion_code = '\0';
  bool hetero = false;                    ///< HETATM record
  ResidueKind kind = ResidueKind::other;  ///< by name alone
  std::vector<RawAtom> atoms;
};

/// A model as in the file.
struct RawModel {
  int number = 1;
  std::vector<RawResidue> residues;  ///< grouped by chain
};

/// The name of a residue or atom in a record.
struct RawAddress {
  std::string chain;
  int number = 0;
  char insertion_code = '\0';
  std::string atom;  ///< empty: a residue
};

/// A bond of SSBOND, LINK or struct_conn.
struct RawBondRecord {
  RawAddress first, second;
  bool disulphide = false;
};

/// Two atoms that a CONECT record joins, by serial number. repeated: listed more than once, as double bonds are.
struct RawConnection {
  int first = 0, second = 0;
  bool repeated = false;
};

/// A helix or strand of a record.
struct RawElement {
  SecondaryStructure::Kind kind{};
  RawAddress first, last;
};

/// All data of a file, before conformers and residues are chosen.
struct RawFile {
  std::string name;
  std::vector<RawModel> models;
  std::vector<RawBondRecord> bond_records;
  std::vector<RawConnection> conect;
  std::vector<Component> components;      ///< of an mmCIF file
  std::optional<RecordedBonds> recorded;  ///< nullopt: the file was not written by Hinge, or its bonds were edited
  std::vector<RawElement> elements;
  std::vector<std::string> notes;
};

/// What gemmi does not keep of the atoms. It merges split residues and chains and loses the order of atoms, so it gets
/// indices from 0 as serial numbers.
struct AtomFields {
  std::vector<int> serials;            ///< serial number in the file, by index
  std::vector<ElementField> elements;  ///< by index
  std::vector<std::size_t> labels;     ///< mmCIF only, by index: a number for each label_asym_id and label_seq_id
  std::vector<std::size_t> ters;       ///< PDB only, by index: the number of TER records before the atom
  std::string fourth_letters;          ///< PDB only, by index: fourth letter of the residue's name; ' ': none
  /// PDB only, per model: the number of its MODEL record, otherwise its position from 1; see
  /// number_by_position_if_repeated().
  std::vector<int> model_numbers;
};

/// A PDB file's text for the parser.
struct PreparedPdb {
  std::string text;
  AtomFields fields;
  std::size_t joined_at = 0;  ///< line of the first END that atoms of the same model follow; 0: none
};

/// True if column 21 of a PDB file's atoms holds the fourth letter of a residue's name (LYSH, TIP3, POPC), as programs
/// for molecular dynamics write it. False if it holds the first of two letters of a chain's name. The PDB format leaves
/// the column blank. It is a letter of the residue if that follows an amino acid or nucleotide without such a letter in
/// its chain, or if the chain of two letters would hold no water and not two different amino acids or nucleotides.
bool has_long_residue_names(std::string_view text);

/// Numbers atoms from 0, cuts lines after `columns` and removes MODEL records. gemmi would start a new line after some
/// characters beyond its own limit. It reads 0 and a blank as the same model number, and counts models without MODEL
/// records by itself. Lengths at the end of LINK and SSBOND records are removed as well: gemmi would read beyond the
/// end of the line at the start of "nan" or "inf". gemmi stops at END, so none is left; it becomes ENDMDL where it
/// ends a model. gemmi reads column 21 as a letter of the chain, so fourth letters of residue names become blanks.
PreparedPdb prepare_pdb(const std::string& text, std::size_t columns);

/// True if the name of a file ends with .pqr or .pqr.gz, in either case.
bool is_pqr(std::filesystem::path path);

/// Returns a PQR file's text as mmCIF. Blanks separate the fields of an atom record: record, serial number, name,
/// residue, chain (may be absent), residue number, x, y, z, charge, radius. Where they do not, because fields touch,
/// the columns of PDB files are read. Models are numbered from 1; charges and radii are dropped. Throws LoadError with
/// the line.
std::string pqr_as_cif(std::string_view text, const std::string& path);

/// Parses the bytes of a PDB or mmCIF file with gemmi. Throws LoadError with the parser's message.
RawFile parse_with_gemmi(const std::string& bytes, const std::string& path, bool cif);

/// Returns the CONECT records of a PDB file, each pair once, first < second. A field that is not a serial number ends
/// its record: CONECT records are hints, and programs write other data there.
std::vector<RawConnection> read_conect(const std::string& text);

/// Returns all data of a file. first_model: keep only the first model; cut_short is set if there are others. Throws
/// LoadError if the data are malformed.
RawFile read_raw(const std::string& bytes, const std::filesystem::path& path, bool first_model = false,
                 bool* cut_short = nullptr);

/// Returns the bonds that Hinge recorded in a PDB file; nullopt if the file is from another program or lost CONECT
/// records.
std::optional<RecordedBonds> read_recorded(const std::string& text, const std::vector<RawConnection>& conect);

/// Returns every component with bonds in a CIF file. Throws LoadError if it is not CIF, or a bond does not join two
/// different atoms or has an unknown order.
std::vector<Component> parse_components(const std::string& bytes, const std::string& path);

/// Returns the kind of residues[r], by its name, otherwise by its backbone atoms. A HETATM residue of a polymer's kind
/// is a ligand (other) if it is not bonded to a neighbour and no residue of the polymer follows it in its chain (SAH,
/// AMP).
ResidueKind residue_kind(const std::vector<RawResidue>& residues, std::size_t r);

/// True for a massless particle: an extra point of a force field (element EP), a pseudo atom of AutoDock, a lone pair
/// (no element, named LP...), or an atom of a water without an element.
bool is_virtual_site(const RawAtom& atom, const RawResidue& residue, ResidueKind kind);

/// True for an unidentified atom or ion (residue UNX, or one atom named UNK, UNX or DUM), and for dummy atoms (residue
/// DUM), with which OPM marks the borders of a membrane.
bool is_dummy(const RawResidue& residue);

/// Some programs name the atoms of ligands by their elements alone, so that a residue has many atoms C. Returns the
/// residue with such atoms numbered, C1, C2 and so on; nullopt if every atom has a name of its own.
std::optional<RawResidue> with_own_names(const RawResidue& residue);

/// Returns the element: of ions and of residues in the tables by the atom's name, otherwise from the file, otherwise by
/// name; empty if unknown.
std::string element_by_name(const RawAtom& atom, const RawResidue& residue);

/// Describes the first atom that differs by name, residue number, insertion code or order; empty if there is none.
std::string first_difference(const Structure& other, const Structure& molecule);

/// Returns the molecule's atoms among those of another structure with one model, matched by chain, residue and name;
/// nullopt if one is missing.
struct MatchedAtoms {
  std::vector<Vec3> positions;         ///< angstrom, in the molecule's order
  std::vector<std::uint32_t> records;  ///< Atom::record of each
};
std::optional<MatchedAtoms> match_atoms(const Structure& other, const Structure& molecule);
/// Returns another structure with one model as a conformation of the molecule: its atoms in order, or, if
/// may_have_more, all of them among others. Throws OtherAtoms, with `where` in front, if it is not one.
MatchedAtoms conformation(const Structure& other, const Structure& molecule, bool may_have_more,
                          const std::string& where);

/// Returns every model as a structure of its own.
std::vector<Structure> assemble_each(RawFile raw, const std::string& path, ReadOptions options);
/// Returns the first model with the atoms that all models have; a note counts the others. Throws OtherAtoms if no atom
/// is common.
Structure assemble_common(RawFile raw, const std::string& path, const ReadOptions& options);

/// Chooses conformers, kinds and elements, and drops unwanted residues. Throws OtherAtoms if the models differ.
Structure assemble(RawFile raw, const std::string& path, const ReadOptions& options);

}  // namespace hinge::molecular
