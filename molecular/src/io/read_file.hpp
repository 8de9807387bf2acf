// SPDX-License-Identifier: BSD-3-Clause
// The steps of read_structure that live in files of their own. C++17: clang compiles read_gemmi.cpp as that.
#pragma once

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

/// The file's bytes, gunzipped where needed. first_model: of those behind the first ENDMDL when a model follows, which
/// cut_short then says, CONECT records alone. LoadError: cannot be opened, damaged, empty.
std::string read_bytes(const std::filesystem::path& path, bool first_model = false, bool* cut_short = nullptr);

/// mmCIF by content.
bool looks_like_cif(const std::string& bytes);

/// Does this line of a PDB file hold an atom?
inline bool is_atom_record(std::string_view line) {
  return line.substr(0, 6) == "ATOM  " || line.substr(0, 6) == "HETATM";
}

/// ENDMDL, or the END that some programs put behind each frame.
inline bool ends_pdb_model(std::string_view line) {
  return line.substr(0, 6) == "ENDMDL" ||
         (line.substr(0, 3) == "END" && line.find_first_not_of(" \t\r", 3) == std::string_view::npos);
}

/// MODEL numbers have four columns: in files of more models writers start again, in others none is there twice.
constexpr std::size_t most_model_numbers = 9999;

/// What a MODEL record says behind its name, or `otherwise` where that starts with no number.
int model_number(std::string_view line, int otherwise);

/// Coordinates of an atom record, angstrom. LoadError names the line, atom and coordinate: blank or no number.
Vec3 read_pdb_coordinates(std::string_view line, const std::string& path, std::size_t line_number);

/// Refuses what the parser would silently repair: blank or malformed coordinates, repeated, empty or nested MODELs.
/// LoadError names the line; the text starts with line `number` + 1. A single MODEL without ENDMDL in a file that is
/// whole otherwise (its last line is END or CONECT) is accepted, with a note.
void check_pdb(std::string_view text, const std::string& path, std::size_t number = 0,
               std::vector<std::string>* notes = nullptr);

/// An atom as the file has it, before conformers are chosen.
struct RawAtom {
  std::string name;
  std::string element;  ///< empty: the file does not say, or says nonsense
  char altloc = '\0';
  int serial = 0;
  std::uint32_t record = 0;
  double occupancy = 1.0;
  Vec3 position = Vec3::Zero();
};

struct RawResidue {
  std::string chain;
  std::string name;
  int number = 0;
  char insertion_code = '\0';
  bool hetero = false;                    ///< HETATM
  ResidueKind kind = ResidueKind::other;  ///< by name alone
  std::vector<RawAtom> atoms;
};

struct RawModel {
  int number = 1;
  std::vector<RawResidue> residues;  ///< chain by chain
};

/// A residue or atom named by a record.
struct RawAddress {
  std::string chain;
  int number = 0;
  char insertion_code = '\0';
  std::string atom;
};

struct RawLink {
  RawAddress first, second;
  bool disulphide = false;
};

/// Two atoms a CONECT record joins, by serial number; repeated: more often than once, as double bonds are.
struct RawConnection {
  int first = 0, second = 0;
  bool repeated = false;
};

struct RawElement {
  SecondaryStructure::Kind kind{};
  RawAddress first, last;
};

struct RawFile {
  std::string name;
  std::vector<RawModel> models;
  std::vector<RawLink> links;
  std::vector<RawConnection> conect;
  std::vector<Component> components;      ///< that an mmCIF file brings along
  std::optional<RecordedBonds> recorded;  ///< Hinge wrote the file
  std::vector<RawElement> elements;
  std::vector<std::string> notes;
};

/// What the parser gets of a PDB file, and what it is not handed.
struct PreparedPdb {
  std::string text;
  std::vector<int> serials;        ///< the file's serial number of each atom record
  std::vector<int> model_numbers;  ///< of each model, by its MODEL record, else its position from 1
};
/// Atoms are numbered from 0, lines cut after so many columns: gemmi would start a new line behind some characters of
/// what it cuts off. And without the lengths behind LINK and SSBOND records, which nobody asks for: it would read the
/// start of "nan" or "inf" beyond the end of the record, of which the end of the line is the last character. Without
/// MODEL records: it takes 0 and a blank for the same number, and counts models without them by itself.
PreparedPdb prepare_pdb(const std::string& text, std::size_t columns);

/// Parses the bytes with gemmi (PDB or mmCIF). LoadError carries the parser's message.
RawFile parse_with_gemmi(const std::string& bytes, const std::string& path, bool cif);

/// The CONECT records of a PDB file, each pair once, first < second. A field that is no serial number ends its record:
/// these records are hints, and programs put other things there.
std::vector<RawConnection> read_conect(const std::string& text);

/// All that a file says, before anything is chosen. first_model: of others no more than that they are there, in
/// cut_short. LoadError: cannot be trusted.
RawFile read_raw(const std::string& bytes, const std::filesystem::path& path, bool first_model = false,
                 bool* cut_short = nullptr);

/// What a PDB file that Hinge wrote says of its bonds; none: another file, or one that lost CONECT records since.
std::optional<RecordedBonds> read_recorded(const std::string& text, const std::vector<RawConnection>& conect);

/// Every component with bonds in a CIF file. LoadError: no CIF, a bond of fewer than two different atoms or of an
/// unknown order.
std::vector<Component> parse_components(const std::string& bytes, const std::string& path);

/// Kind of residues[r], by its name, else by the backbone atoms it has. A HETATM residue that could be a polymer's but
/// is bonded to no neighbour and has no ATOM residue behind it in its chain (SAH, AMP) is a ligand: other.
ResidueKind residue_kind(const std::vector<RawResidue>& residues, std::size_t r);

/// An unidentified atom or ion: residue UNX, or one atom named UNK, UNX or DUM.
bool is_dummy(const RawResidue& residue);

/// The element the residue's table demands, else the file's, else the name's; empty when none of them tells.
std::string element_by_name(const RawAtom& atom, const RawResidue& residue);

/// The first atom in which a model is not the molecule, by name, residue number and order, in words; empty: none.
std::string first_difference(const Structure& other, const Structure& molecule);

/// The molecule's atoms among those of another structure of one model, by chain, residue and name; none: one is
/// missing.
struct MatchedAtoms {
  std::vector<Vec3> positions;
  std::vector<std::uint32_t> records;
};
std::optional<MatchedAtoms> match_atoms(const Structure& other, const Structure& molecule);
/// Another structure of one model as a conformation of the molecule: its atoms in its order, or with may_have_more all
/// of them among others. OtherAtoms, starting with `where`: it is none.
MatchedAtoms conformation(const Structure& other, const Structure& molecule, bool may_have_more,
                          const std::string& where);

/// Every model as a structure of its own.
std::vector<Structure> assemble_each(RawFile raw, const std::string& path, ReadOptions options);
/// Models that differ, as far as they are the same: the first one with the atoms that all have, which a note counts.
/// OtherAtoms: there are none.
Structure assemble_common(RawFile raw, const std::string& path, const ReadOptions& options);

/// Chooses conformers, kinds and elements and leaves out what was not asked for. OtherAtoms: models that differ.
Structure assemble(RawFile raw, const std::string& path, const ReadOptions& options);

}  // namespace hinge::molecular
