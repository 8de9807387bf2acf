// SPDX-License-Identifier: BSD-3-Clause
// The steps of read_structure that live in files of their own. C++17: clang compiles read_gemmi.cpp as that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

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

/// Coordinates of an atom record, angstrom. LoadError names the line, atom and coordinate: blank or no number.
Vec3 read_pdb_coordinates(std::string_view line, const std::string& path, std::size_t line_number);

/// Refuses what the parser would silently repair: blank or malformed coordinates, repeated or nested MODEL records.
/// LoadError names the line; the text starts with line `number` + 1.
void check_pdb(std::string_view text, const std::string& path, std::size_t number = 0);

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
  std::vector<Component> components;  ///< that an mmCIF file brings along
  std::vector<RawElement> elements;
  std::vector<std::string> notes;
};

/// Parses the bytes with gemmi (PDB or mmCIF). LoadError carries the parser's message.
RawFile parse_with_gemmi(const std::string& bytes, const std::string& path, bool cif);

/// The CONECT records of a PDB file, each pair once, first < second. A field that is no serial number ends its record:
/// these records are hints, and programs put other things there.
std::vector<RawConnection> read_conect(const std::string& text);

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

/// LoadError, starting with `where`: not the molecule's atoms in its order, by name and residue number.
void check_same_atoms(const Structure& other, const Structure& molecule, const std::string& where);

/// Chooses conformers, kinds and elements and leaves out what was not asked for.
Structure assemble(RawFile raw, const std::string& path, const ReadOptions& options);

}  // namespace hinge::molecular
