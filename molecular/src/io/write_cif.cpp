// SPDX-License-Identifier: BSD-3-Clause
// mmCIF: loops of the PDBx dictionary, and a category of Hinge for bonds. Numbers are converted to text first: the
// stream's locale could group digits.
#include <map>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "chemistry/recorded_bonds.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/molecular/write_structure.hpp"

namespace hinge::molecular {

namespace {

/// A value of a loop; quoted if it has characters other than letters, digits and - + * / :.
std::string value(const std::string& text) {
  if (text.empty()) return ".";
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-*/:";
  if (text.find_first_not_of(plain) == std::string::npos) return text;
  return text.find('"') == std::string::npos ? '"' + text + '"' : '\'' + text + '\'';
}

/// auth_asym_id. A blank name is an empty text: where it is said to be unknown, some readers take label_asym_id for it.
std::string chain_value(const std::string& name) { return name.empty() ? "''" : value(name); }

const std::string& chain_name_of(const Structure& s, const Residue& residue) { return s.chains[residue.chain].name; }

bool is_hetero_record(const Residue& residue) {
  return residue.kind == ResidueKind::other || residue.kind == ResidueKind::water;
}

/// label_seq_id: the residue's index in its chain, from 1; "." for hetero residues.
std::string sequence_id(const Structure& s, std::uint32_t r) {
  return is_hetero_record(s.residues[r]) ? "." : std::to_string(r - s.chains[s.residues[r].chain].first_residue + 1);
}

/// label_asym_id of every residue: the name of its chain. Hetero residues that repeat an earlier author name would be
/// ambiguous, because they have no label_seq_id: they get a name of their own, "A-1", "A-2" ...
std::vector<std::string> label_chains(const Structure& s) {
  std::set<std::string> names;
  for (const Chain& chain : s.chains) names.insert(chain.name);
  const std::vector<std::uint32_t> copies = copies_of_residues(s);
  std::map<std::pair<std::string, std::uint32_t>, std::string> of_copies;
  std::vector<std::string> chains;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    chains.push_back(chain_name_of(s, s.residues[r]));
    if (copies[r] == 0 || !is_hetero_record(s.residues[r])) continue;
    std::string& name = of_copies[{chains.back(), copies[r]}];
    for (std::uint32_t k = copies[r]; name.empty(); ++k)
      if (std::string free = chains.back() + '-' + std::to_string(k); names.insert(free).second) name = free;
    chains.back() = name;
  }
  return chains;
}

std::string insertion_code(const Residue& residue) {
  return residue.insertion_code == '\0' ? "?" : value(std::string(1, residue.insertion_code));
}

std::string_view order_word(BondOrder order) {
  switch (order) {
    case BondOrder::single: return "sing";
    case BondOrder::multiple: return "delo";  // double, triple or aromatic: BondOrder does not distinguish them
    case BondOrder::coordination:
    case BondOrder::unknown: break;
  }
  return "?";
}

/// "CYS A 12 32 ? A": name, label_asym_id, label_seq_id, auth_seq_id, insertion code, auth_asym_id.
std::string residue_values(const Structure& s, const std::vector<std::string>& labels, std::uint32_t r) {
  const Residue& residue = s.residues[r];
  return value(residue.name) + ' ' + value(labels[r]) + ' ' + sequence_id(s, r) + ' ' +
         std::to_string(residue.sequence_number) + ' ' + insertion_code(residue) + ' ' +
         chain_value(chain_name_of(s, residue));
}

std::string residue_tags(const std::string& category, const std::string& partner) {
  std::string text;
  for (const char* tag : {"_label_comp_id", "_label_asym_id", "_label_seq_id", "_auth_seq_id"})
    text += category + partner + tag + '\n';
  const std::string dot = category.substr(0, category.find('.') + 1);
  return text + dot + "pdbx_" + partner + "_PDB_ins_code\n" + category + partner + "_auth_asym_id\n";
}

void write_cif_elements(std::ostream& out, const Structure& s, const std::vector<std::string>& labels) {
  using Kind = SecondaryStructure::Kind;
  for (const Kind kind : {Kind::helix, Kind::strand}) {
    const std::string category = kind == Kind::helix ? "_struct_conf." : "_struct_sheet_range.";
    int count = 0;
    for (const SecondaryStructure& element : s.secondary_structure) {
      if (element.kind != kind) continue;
      if (++count == 1)
        out << "loop_\n"
            << (kind == Kind::helix ? "_struct_conf.conf_type_id\n_struct_conf.id\n"
                                    : "_struct_sheet_range.sheet_id\n_struct_sheet_range.id\n")
            << residue_tags(category, "beg") << residue_tags(category, "end");
      const std::string id = std::to_string(count);
      out << (kind == Kind::helix ? "HELX_P HELX_P" + id : id + " 1") << ' ' << residue_values(s, labels, element.first)
          << ' ' << residue_values(s, labels, element.last) << "\n";
    }
    if (count > 0) out << "#\n";
  }
}

void write_connections(std::ostream& out, const Structure& s, const std::vector<std::string>& labels) {
  int count = 0;
  for (const Bond& bond : s.bonds) {
    const Atom &a = s.atoms[bond.first], &b = s.atoms[bond.second];
    if (a.residue == b.residue || joins_neighbours(s, bond)) continue;
    if (++count == 1) {
      out << "loop_\n_struct_conn.id\n_struct_conn.conn_type_id\n";
      for (const std::string partner : {"ptnr1", "ptnr2"})
        out << residue_tags("_struct_conn.", partner) << "_struct_conn." << partner << "_label_atom_id\n";
      out << "_struct_conn.ptnr1_symmetry\n_struct_conn.ptnr2_symmetry\n";
    }
    const char* type = bond.origin == BondOrigin::disulphide   ? "disulf"
                       : bond.order == BondOrder::coordination ? "metalc"
                                                               : "covale";
    out << type << std::to_string(count) << ' ' << type << ' ' << residue_values(s, labels, a.residue) << ' '
        << value(a.name) << ' ' << residue_values(s, labels, b.residue) << ' ' << value(b.name) << " 1_555 1_555\n";
  }
  if (count > 0) out << "#\n";
}

/// Writes the recorded bonds inside residues, by residue name: the union over all residues of that name. A residue
/// without a name has no component; Hinge reads its bonds from write_recorded().
void write_components(std::ostream& out, const Structure& s, const RecordedBonds& recorded) {
  std::map<std::tuple<std::string, std::string, std::string>, BondOrder> bonds;
  for (const RecordedBond& bond : recorded.bonds) {
    const Atom &a = s.atoms[bond.first], &b = s.atoms[bond.second];
    const std::string& residue = s.residues[a.residue].name;
    if (bond.bonded && a.residue == b.residue && !residue.empty())
      bonds.emplace(std::tuple(residue, a.name, b.name), bond.order);
  }
  if (bonds.empty()) return;
  out << "loop_\n_chem_comp_bond.comp_id\n_chem_comp_bond.atom_id_1\n_chem_comp_bond.atom_id_2\n"
         "_chem_comp_bond.value_order\n";
  for (const auto& [names, order] : bonds)
    out << value(std::get<0>(names)) << ' ' << value(std::get<1>(names)) << ' ' << value(std::get<2>(names)) << ' '
        << order_word(order) << "\n";
  out << "#\n";
}

void write_recorded(std::ostream& out, const RecordedBonds& recorded) {
  out << "_hinge_bonds.version 1\n_hinge_bonds.atoms " << std::to_string(recorded.atoms) << "\n#\n";
  if (recorded.bonds.empty()) return;
  out << "loop_\n_hinge_bond.atom_1\n_hinge_bond.atom_2\n_hinge_bond.order\n";
  for (const RecordedBond& bond : recorded.bonds)
    out << std::to_string(bond.first + 1) << ' ' << std::to_string(bond.second + 1) << ' '
        << (bond.bonded ? order_word(bond.order) : "none") << "\n";
  out << "#\n";
}

}  // namespace

void write_cif_head(std::ostream& out, const Structure& structure) {
  std::string name;
  for (const char c : structure.name) name += c > ' ' && c <= '~' && c != '"' && c != '\'' ? c : '_';
  if (name.empty()) name = "hinge";
  out << "data_" << name << "\n#\n_entry.id \"" << name << "\"\n#\n";
  const std::vector<std::string> labels = label_chains(structure);
  write_cif_elements(out, structure, labels);
  write_connections(out, structure, labels);
  const RecordedBonds recorded = record_bonds(structure);
  write_components(out, structure, recorded);
  write_recorded(out, recorded);
  out << "loop_\n";
  for (const char* tag :
       {"group_PDB", "id", "type_symbol", "label_atom_id", "label_alt_id", "label_comp_id", "label_asym_id",
        "label_entity_id", "label_seq_id", "pdbx_PDB_ins_code", "Cartn_x", "Cartn_y", "Cartn_z", "occupancy",
        "B_iso_or_equiv", "auth_seq_id", "auth_asym_id", "pdbx_PDB_model_num"})
    out << "_atom_site." << tag << "\n";
}

void write_cif_model(std::ostream& out, const Structure& s, std::span<const Vec3> positions, int model,
                     std::size_t first_id) {
  const std::vector<std::string> labels = label_chains(s);
  std::string text;
  for (std::uint32_t r = 0; r < s.residues.size(); ++r) {
    const Residue& residue = s.residues[r];
    const std::string chain = chain_value(chain_name_of(s, residue)), name = value(residue.name);
    const std::string behind_name =
        " . " + name + ' ' + value(labels[r]) + " ? " + sequence_id(s, r) + ' ' + insertion_code(residue) + ' ';
    const std::string behind =
        ' ' + std::to_string(residue.sequence_number) + ' ' + chain + ' ' + std::to_string(model) + "\n";
    for (std::uint32_t i = residue.first_atom; i < residue.last_atom; ++i) {
      const Vec3& x = positions[i];
      text += (is_hetero_record(residue) ? "HETATM " : "ATOM ") + std::to_string(first_id + i) + ' ' +
              value(s.atoms[i].element) + ' ' + value(s.atoms[i].name) + behind_name;
      text += number_text(x[0]) + ' ' + number_text(x[1]) + ' ' + number_text(x[2]) + " 1.0 " +
              number_text(static_cast<float>(s.atoms[i].b_factor)) + behind;
    }
  }
  out << text;
}

}  // namespace hinge::molecular
