// SPDX-License-Identifier: BSD-3-Clause
// Tables of amino acids: IUPAC-IUB 1970 names, bonds and side-chain torsions.
#include "chemistry/residue_table.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hinge::molecular {

namespace {

constexpr std::array<ResidueTemplate, 21> templates{{
    {"ALA", 'A', "CA-CB", ""},
    {"ARG", 'R', "CA-CB CB-CG CG-CD CD-NE NE-CZ CZ-NH1 CZ-NH2", "N-CA-CB-CG CA-CB-CG-CD CB-CG-CD-NE CG-CD-NE-CZ"},
    {"ASN", 'N', "CA-CB CB-CG CG-OD1 CG-ND2", "N-CA-CB-CG CA-CB-CG-OD1"},
    {"ASP", 'D', "CA-CB CB-CG CG-OD1 CG-OD2", "N-CA-CB-CG CA-CB-CG-OD1"},
    {"CYS", 'C', "CA-CB CB-SG", "N-CA-CB-SG"},
    {"GLN", 'Q', "CA-CB CB-CG CG-CD CD-OE1 CD-NE2", "N-CA-CB-CG CA-CB-CG-CD CB-CG-CD-OE1"},
    {"GLU", 'E', "CA-CB CB-CG CG-CD CD-OE1 CD-OE2", "N-CA-CB-CG CA-CB-CG-CD CB-CG-CD-OE1"},
    {"GLY", 'G', "", ""},
    {"HIS", 'H', "CA-CB CB-CG CG-ND1 CG-CD2 ND1-CE1 CE1-NE2 CD2-NE2", "N-CA-CB-CG CA-CB-CG-ND1"},
    {"ILE", 'I', "CA-CB CB-CG1 CB-CG2 CG1-CD1 CG1-CD", "N-CA-CB-CG1 CA-CB-CG1-CD1"},
    {"LEU", 'L', "CA-CB CB-CG CG-CD1 CG-CD2", "N-CA-CB-CG CA-CB-CG-CD1"},
    {"LYS", 'K', "CA-CB CB-CG CG-CD CD-CE CE-NZ", "N-CA-CB-CG CA-CB-CG-CD CB-CG-CD-CE CG-CD-CE-NZ"},
    {"MET", 'M', "CA-CB CB-CG CG-SD SD-CE", "N-CA-CB-CG CA-CB-CG-SD CB-CG-SD-CE"},
    {"MSE", '\0', "CA-CB CB-CG CG-SE SE-CE", "N-CA-CB-CG CA-CB-CG-SE CB-CG-SE-CE"},
    {"PHE", 'F', "CA-CB CB-CG CG-CD1 CG-CD2 CD1-CE1 CD2-CE2 CE1-CZ CE2-CZ", "N-CA-CB-CG CA-CB-CG-CD1"},
    {"PRO", 'P', "CA-CB CB-CG CG-CD CD-N", ""},
    {"SER", 'S', "CA-CB CB-OG", "N-CA-CB-OG"},
    {"THR", 'T', "CA-CB CB-OG1 CB-CG2", "N-CA-CB-OG1"},
    {"TRP", 'W', "CA-CB CB-CG CG-CD1 CG-CD2 CD1-NE1 NE1-CE2 CD2-CE2 CD2-CE3 CE2-CZ2 CE3-CZ3 CZ2-CH2 CZ3-CH2",
     "N-CA-CB-CG CA-CB-CG-CD1"},
    {"TYR", 'Y', "CA-CB CB-CG CG-CD1 CG-CD2 CD1-CE1 CD2-CE2 CE1-CZ CE2-CZ CZ-OH", "N-CA-CB-CG CA-CB-CG-CD1"},
    {"VAL", 'V', "CA-CB CB-CG1 CB-CG2", "N-CA-CB-CG1"},
}};

/// Names of force fields (AMBER, CHARMM, GROMOS, OPLS): protonation states of histidine, cysteine and its disulphides,
/// and further names of protonated acids and neutral lysine.
constexpr std::array<std::pair<std::string_view, std::string_view>, 24> force_field_names{{
    {"HID", "HIS"},  {"HIE", "HIS"},  {"HIP", "HIS"},  {"HSD", "HIS"},  {"HSE", "HIS"},  {"HSP", "HIS"},
    {"HISA", "HIS"}, {"HISB", "HIS"}, {"HISD", "HIS"}, {"HISE", "HIS"}, {"HISH", "HIS"}, {"HIS1", "HIS"},
    {"HIS2", "HIS"}, {"CYX", "CYS"},  {"CYM", "CYS"},  {"CYS1", "CYS"}, {"CYS2", "CYS"}, {"CYSH", "CYS"},
    {"LYSH", "LYS"}, {"ASPP", "ASH"}, {"ASPH", "ASH"}, {"GLUP", "GLH"}, {"GLUH", "GLH"}, {"LSN", "LYN"},
}};

/// Residues that share the backbone, side-chain names and bonds of another: neutral states of charged residues, D
/// residues, and modified residues, whose further atoms are bonded by distance.
constexpr std::array<std::pair<std::string_view, std::string_view>, 41> variants{{
    {"ASH", "ASP"}, {"GLH", "GLU"}, {"LYN", "LYS"}, {"ARGN", "ARG"}, {"DAL", "ALA"}, {"DAR", "ARG"}, {"DSG", "ASN"},
    {"DAS", "ASP"}, {"DCY", "CYS"}, {"DGN", "GLN"}, {"DGL", "GLU"},  {"DHI", "HIS"}, {"DIL", "ILE"}, {"DLE", "LEU"},
    {"DLY", "LYS"}, {"MED", "MET"}, {"DPN", "PHE"}, {"DPR", "PRO"},  {"DSN", "SER"}, {"DTH", "THR"}, {"DTR", "TRP"},
    {"DTY", "TYR"}, {"DVA", "VAL"}, {"SEP", "SER"}, {"TPO", "THR"},  {"PTR", "TYR"}, {"TYS", "TYR"}, {"HYP", "PRO"},
    {"MLY", "LYS"}, {"MLZ", "LYS"}, {"M3L", "LYS"}, {"ALY", "LYS"},  {"KCX", "LYS"}, {"CSO", "CYS"}, {"CSD", "CYS"},
    {"CSX", "CYS"}, {"OCS", "CYS"}, {"CME", "CYS"}, {"SMC", "CYS"},  {"SME", "MET"}, {"HIC", "HIS"},
}};

template <class Table>
std::string_view mapped(const Table& table, std::string_view name) noexcept {
  const auto found = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.first == name; });
  return found == table.end() ? name : found->second;
}

const ResidueTemplate* find_by_pdb_name(std::string_view name) noexcept {
  const std::string_view standard = mapped(variants, name);
  const auto found =
      std::find_if(templates.begin(), templates.end(), [&](const auto& t) { return t.name == standard; });
  return found == templates.end() ? nullptr : found;
}

}  // namespace

std::string_view pdb_residue_name(std::string_view name) noexcept {
  const bool is_end = name.size() == 4 && (name.front() == 'N' || name.front() == 'C');  // AMBER: NALA, CALA
  if (is_end) {
    const std::string_view inner = mapped(force_field_names, name.substr(1));
    if (find_by_pdb_name(inner) != nullptr) return inner;
  }
  return mapped(force_field_names, name);
}

const ResidueTemplate* find_residue_template(std::string_view name) noexcept {
  return find_by_pdb_name(pdb_residue_name(name));
}

bool is_histidine(std::string_view name) noexcept {
  const ResidueTemplate* known = find_residue_template(name);
  return known != nullptr && known->name == "HIS";
}

const ResidueTemplate* find_residue_template(char letter) noexcept {
  const auto found = std::find_if(templates.begin(), templates.end(),
                                  [&](const auto& t) { return letter != '\0' && t.letter == letter; });
  return found == templates.end() ? nullptr : found;
}

bool is_cap(std::string_view name) noexcept {
  return name == "ACE" || name == "FOR" || name == "NME" || name == "NH2" || name == "ETA";
}

}  // namespace hinge::molecular
