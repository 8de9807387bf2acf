// SPDX-License-Identifier: BSD-3-Clause
// The parser. The only file that includes gemmi's parsers, which take long to compile.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <gemmi/cif.hpp>
#include <gemmi/mmcif.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>

#include "hinge/core/error.hpp"
#include "io/prepare_cif.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

char or_null(char c) { return c == ' ' ? '\0' : c; }
double or_zero(float x) { return std::isfinite(x) ? static_cast<double>(x) : 0.0; }

RawAddress address(const gemmi::AtomAddress& a) {
  return {a.chain_name, *a.res_id.seqid.num, or_null(a.res_id.seqid.icode), a.atom_name};
}

/// Returns the number of a model. From gemmi 0.7 on it is an int `num`; before, a text `name`.
template <class Model>
auto number_of(const Model& model, int) -> decltype(model.num) {
  return model.num;
}
template <class Model>
int number_of(const Model& model, long position) {
  int number = static_cast<int>(position);
  std::from_chars(model.name.data(), model.name.data() + model.name.size(), number);
  return number;
}

ResidueKind kind_of(const std::string& name) {
  for (const char* water : {"WAT", "TIP", "TIP2", "TIP3", "TIP4", "TIP5", "TP3M", "SPCE", "SOL", "DOD", "H2O"})
    if (name == water) return ResidueKind::water;
  const gemmi::ResidueInfo& info = gemmi::find_tabulated_residue(name);
  if (info.is_water()) return ResidueKind::water;
  if (info.is_amino_acid()) return ResidueKind::amino_acid;
  if (info.is_nucleic_acid()) return ResidueKind::nucleotide;
  return ResidueKind::other;
}

/// gemmi joins residues of one chain that have the same name and number: those of a second molecule in a file without
/// chain names, and those of a numbering that begins again. Returns the atoms of each. A further residue begins at an
/// atom that does not follow the one before it in the file, if the atoms from there on repeat a name. follows(a, b): of
/// two atoms.
template <class Follows>
std::vector<std::vector<RawAtom>> separated(std::vector<RawAtom> atoms, const Follows& follows) {
  std::vector<std::vector<RawAtom>> residues(1);
  const auto jumps = [&](const RawAtom& a, const RawAtom& b) { return !follows(a, b); };
  if (std::adjacent_find(atoms.begin(), atoms.end(), jumps) == atoms.end()) {  // nearly always
    residues.back() = std::move(atoms);
    return residues;
  }
  std::set<std::pair<std::string, char>> names;  // of the last residue
  for (auto first = atoms.begin(), end = first; first != atoms.end(); first = end) {
    end = std::adjacent_find(first, atoms.end(), jumps);
    if (end != atoms.end()) ++end;
    if (std::any_of(first, end, [&](const RawAtom& atom) { return names.count({atom.name, atom.altloc}) > 0; })) {
      residues.emplace_back();
      names.clear();
    }
    for (auto atom = first; atom != end; ++atom) {
      names.emplace(atom->name, atom->altloc);
      residues.back().push_back(std::move(*atom));
    }
  }
  return residues;
}

RawModel convert(const gemmi::Model& model, int number, const AtomFields& fields) {
  RawModel raw;
  raw.number = number;
  int first = std::numeric_limits<int>::max();  // smallest index in the model
  for (const gemmi::Chain& chain : model.chains)
    for (const gemmi::Residue& residue : chain.residues)
      for (const gemmi::Atom& atom : residue.atoms) first = std::min(first, atom.serial);
  const auto ters = [&](const RawAtom& atom) {
    return fields.ters.empty() ? 0 : fields.ters.at(static_cast<std::size_t>(first) + atom.record);
  };
  const auto follows = [&](const RawAtom& a, const RawAtom& b) {
    return b.record == a.record + 1 && ters(a) == ters(b);
  };
  for (const gemmi::Chain& chain : model.chains) {
    const auto chain_start = static_cast<std::ptrdiff_t>(raw.residues.size());
    for (const gemmi::Residue& residue : chain.residues) {
      RawResidue r;
      r.chain = chain.name;
      r.name = residue.name;
      r.number = residue.seqid.num.has_value() ? *residue.seqid.num : 0;
      r.insertion_code = or_null(residue.seqid.icode);
      r.hetero = residue.het_flag == 'H';
      const auto front = static_cast<std::size_t>(residue.atoms.front().serial);
      if (!fields.fourth_letters.empty() && fields.fourth_letters.at(front) != ' ')
        r.name += fields.fourth_letters.at(front);
      r.kind = kind_of(r.name);
      std::map<std::size_t, std::vector<RawAtom>> parts;  // by label: several residues may have the same author name
      for (const gemmi::Atom& atom : residue.atoms) {
        RawAtom a;
        a.name = atom.name;
        if (atom.element != gemmi::El::X) a.element = atom.element == gemmi::El::D ? "H" : atom.element.name();
        a.altloc = atom.altloc;
        const auto id = static_cast<std::size_t>(atom.serial);
        a.element_field = fields.elements.at(id);
        a.serial = fields.serials.at(id);
        a.record = static_cast<std::uint32_t>(atom.serial - first);
        a.occupancy = or_zero(atom.occ);
        a.b_factor = or_zero(atom.b_iso);
        a.position = Vec3(atom.pos.x, atom.pos.y, atom.pos.z);
        parts[fields.labels.empty() ? 0 : fields.labels.at(id)].push_back(std::move(a));
      }
      for (auto& part : parts)
        for (std::vector<RawAtom>& atoms : separated(std::move(part.second), follows))
          raw.residues.emplace_back(r).atoms = std::move(atoms);
    }
    std::stable_sort(raw.residues.begin() + chain_start, raw.residues.end(),
                     [](const RawResidue& a, const RawResidue& b) { return a.atoms[0].record < b.atoms[0].record; });
  }
  return raw;
}

/// Converts wwPDB's value_order or the type of a refinement dictionary; the first letters of the word decide.
BondOrder bond_order(std::string word, bool aromatic) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (aromatic) return BondOrder::multiple;
  if (word.rfind("sing", 0) == 0) return BondOrder::single;
  if (word.rfind("metal", 0) == 0) return BondOrder::coordination;
  for (const char* multiple : {"doub", "trip", "quad", "arom", "delo", "pi", "1.5"})
    if (word.rfind(multiple, 0) == 0) return BondOrder::multiple;
  if (word.empty() || word == "poly" || word == "coval") return BondOrder::unknown;
  throw std::runtime_error("chem_comp_bond of order '" + word + "', expected single, double, triple, aromatic, deloc");
}

std::string trimmed(const std::string& value) {
  const std::string text = gemmi::cif::as_string(value);
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::vector<Component> components_of(gemmi::cif::Document& document, const std::string& source) {
  std::map<std::string, Component> found;
  for (gemmi::cif::Block& block : document.blocks) {
    const std::string category = "_chem_comp_bond.";
    gemmi::cif::Table table = block.find(
        category, {"comp_id", "atom_id_1", "atom_id_2", "?type", "?value_order", "?pdbx_aromatic_flag", "?aromatic"});
    for (const auto& row : table) {
      const std::string name = trimmed(row[0]);
      ComponentBond bond{trimmed(row[1]), trimmed(row[2]), BondOrder::unknown};
      if (name.empty() || bond.first.empty() || bond.second.empty() || bond.first == bond.second)
        throw std::runtime_error("chem_comp_bond of '" + name + "' between '" + bond.first + "' and '" + bond.second +
                                 "', expected two different atoms");
      const auto value = [&](std::size_t column) { return row.has2(column) ? trimmed(row[column]) : std::string(); };
      const auto yes = [&](std::size_t column) { return value(column) == "Y" || value(column) == "y"; };
      bond.order = bond_order(value(3).empty() ? value(4) : value(3), yes(5) || yes(6));
      Component& component = found[name];
      component.name = name;
      component.source = source;
      component.bonds.push_back(std::move(bond));
    }
  }
  std::vector<Component> components;
  for (auto& [name, component] : found) components.push_back(std::move(component));
  return components;
}

/// Returns the bonds that write_cif_head recorded; nullopt if the file is from another program or was edited.
std::optional<RecordedBonds> recorded_of(gemmi::cif::Document& document) {
  if (document.blocks.empty()) return std::nullopt;
  const auto read = [](const std::string& text) {
    std::uint32_t n = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
    return error == std::errc{} && end == text.data() + text.size() ? n : 0;
  };
  gemmi::cif::Block& block = document.blocks.front();
  const std::string *version = block.find_value("_hinge_bonds.version"),
                    *atoms = block.find_value("_hinge_bonds.atoms");
  if (version == nullptr || *version != "1" || atoms == nullptr) return std::nullopt;
  RecordedBonds recorded{read(*atoms), {}};
  for (const auto& row : block.find("_hinge_bond.", {"atom_1", "atom_2", "order"})) {
    const std::uint32_t i = read(row[0]), j = read(row[1]);
    if (i == 0 || j == 0 || i == j || i > recorded.atoms || j > recorded.atoms) return std::nullopt;
    const bool bonded = row[2] != "none";
    recorded.bonds.push_back({i - 1, j - 1, bonded ? bond_order(trimmed(row[2]), false) : BondOrder::unknown, bonded});
  }
  return recorded;
}

/// Throws LoadError with the message on one line and the file's name.
[[noreturn]] void refuse_file(const std::exception& error, const std::string& path) {
  std::string what = error.what();
  std::replace(what.begin(), what.end(), '\n', ' ');  // some messages quote a line with its line end
  throw LoadError(what.find(path) != std::string::npos ? what : path + ": " + what);
}

gemmi::Structure parse(const std::string& bytes, const std::string& path, bool cif, RawFile& raw, AtomFields& fields) {
  if (cif) {
    gemmi::cif::Document document = gemmi::cif::read_memory(bytes.data(), bytes.size(), path.c_str());
    raw.components = components_of(document, path);
    raw.recorded = recorded_of(document);
    fields = prepare_cif(document);
    // NOLINTNEXTLINE(performance-move-const-arg): gemmi 0.6 and later take the document
    return gemmi::make_structure(std::move(document));
  }
  gemmi::PdbReadOptions options;
  std::size_t joined_at = 0;
  const auto read = [&](int columns) {
    options.max_line_length = columns;
    PreparedPdb pdb = prepare_pdb(bytes, static_cast<std::size_t>(columns));
    fields = std::move(pdb.fields);
    joined_at = pdb.joined_at;
    return gemmi::read_pdb_from_memory(pdb.text.data(), pdb.text.size(), path, options);
  };
  const auto note_joined = [&] {
    if (joined_at != 0)
      raw.notes.push_back("line " + std::to_string(joined_at) + ": atoms follow END; they belong to the same model");
  };
  try {
    gemmi::Structure st = read(120);  // more columns than gemmi reads
    note_joined();
    return st;
  } catch (const std::exception& first) {
    // Before 1996, columns 73-80 held the entry's name and a line number; now they hold segment, element and charge.
    try {
      gemmi::Structure st = read(72);
      raw.notes.emplace_back("old PDB format: columns 73-80 ignored, elements taken from atom names");
      note_joined();
      return st;
    } catch (const std::exception&) {
      throw std::runtime_error(first.what());
    }
  }
}

}  // namespace

std::vector<Component> parse_components(const std::string& bytes, const std::string& path) {
  try {
    gemmi::cif::Document document = gemmi::cif::read_memory(bytes.data(), bytes.size(), path.c_str());
    return components_of(document, path);
  } catch (const std::exception& error) {
    refuse_file(error, path);
  }
}

RawFile parse_with_gemmi(const std::string& bytes, const std::string& path, bool cif) {
  RawFile raw;
  gemmi::Structure st;
  AtomFields fields;
  try {
    st = parse(bytes, path, cif, raw, fields);
  } catch (const std::exception& error) {
    refuse_file(error, path);
  }
  st.merge_chain_parts();
  raw.name = st.name;
  for (const gemmi::Model& model : st.models) {
    const int position = static_cast<int>(raw.models.size()) + 1;
    const int number = cif ? number_of(model, position) : fields.model_numbers.at(raw.models.size());
    raw.models.push_back(convert(model, number, fields));
  }
  for (const gemmi::Connection& link : st.connections)
    if (link.type == gemmi::Connection::Covale || link.type == gemmi::Connection::Disulf ||
        link.type == gemmi::Connection::MetalC || link.type == gemmi::Connection::Unknown)
      raw.bond_records.push_back(
          {address(link.partner1), address(link.partner2), link.type == gemmi::Connection::Disulf});
  for (const gemmi::Helix& helix : st.helices)
    raw.elements.push_back({SecondaryStructure::Kind::helix, address(helix.start), address(helix.end)});
  for (const gemmi::Sheet& sheet : st.sheets)
    for (const gemmi::Sheet::Strand& strand : sheet.strands)
      raw.elements.push_back({SecondaryStructure::Kind::strand, address(strand.start), address(strand.end)});
  return raw;
}

}  // namespace hinge::molecular
