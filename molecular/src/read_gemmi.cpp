// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes gemmi, which takes long to compile.
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <utility>

#include <gemmi/cif.hpp>
#include <gemmi/mmcif.hpp>
#include <gemmi/pdb.hpp>
#include <gemmi/resinfo.hpp>

#include "hinge/core/error.hpp"
#include "read_file.hpp"

namespace hinge::molecular {

namespace {

char or_null(char c) { return c == ' ' ? '\0' : c; }

RawAddress address(const gemmi::AtomAddress& a) {
  return {a.chain_name, *a.res_id.seqid.num, or_null(a.res_id.seqid.icode), a.atom_name};
}

ResidueKind kind_of(const std::string& name) {
  if (name == "WAT" || name == "TIP" || name == "TIP3" || name == "SOL" || name == "DOD" || name == "H2O")
    return ResidueKind::water;
  const gemmi::ResidueInfo& info = gemmi::find_tabulated_residue(name);
  if (info.is_water()) return ResidueKind::water;
  if (info.is_amino_acid()) return ResidueKind::amino_acid;
  if (info.is_nucleic_acid()) return ResidueKind::nucleotide;
  return ResidueKind::other;
}

RawModel convert(const gemmi::Model& model, int number) {
  RawModel raw;
  raw.number = number;
  for (const gemmi::Chain& chain : model.chains)
    for (const gemmi::Residue& residue : chain.residues) {
      RawResidue r;
      r.chain = chain.name;
      r.name = residue.name;
      r.number = residue.seqid.num.has_value() ? *residue.seqid.num : 0;
      r.insertion_code = or_null(residue.seqid.icode);
      r.hetero = residue.het_flag == 'H';
      r.kind = kind_of(residue.name);
      for (const gemmi::Atom& atom : residue.atoms) {
        RawAtom a;
        a.name = atom.name;
        if (atom.element != gemmi::El::X) a.element = atom.element == gemmi::El::D ? "H" : atom.element.name();
        a.altloc = atom.altloc;
        a.serial = atom.serial;
        a.occupancy = static_cast<double>(atom.occ);
        a.position = Vec3(atom.pos.x, atom.pos.y, atom.pos.z);
        r.atoms.push_back(std::move(a));
      }
      raw.residues.push_back(std::move(r));
    }
  return raw;
}

gemmi::Structure parse(const std::string& bytes, const std::string& path, bool cif, std::vector<std::string>& notes) {
  if (cif) return gemmi::make_structure(gemmi::cif::read_memory(bytes.data(), bytes.size(), path.c_str()));
  try {
    return gemmi::read_pdb_from_memory(bytes.data(), bytes.size(), path);
  } catch (const std::exception& first) {
    // Files from before 1996 carry the entry's name and a line number in columns 73-80, where element and charge are
    // now.
    gemmi::PdbReadOptions options;
    options.max_line_length = 72;
    try {
      gemmi::Structure st = gemmi::read_pdb_from_memory(bytes.data(), bytes.size(), path, options);
      notes.emplace_back("old PDB format: columns 73-80 ignored, elements taken from atom names");
      return st;
    } catch (const std::exception&) {
      throw std::runtime_error(first.what());
    }
  }
}

}  // namespace

RawFile parse_with_gemmi(const std::string& bytes, const std::string& path, bool cif) {
  RawFile raw;
  gemmi::Structure st;
  try {
    st = parse(bytes, path, cif, raw.notes);
  } catch (const std::exception& error) {
    std::string what = error.what();
    std::replace(what.begin(), what.end(), '\n', ' ');  // some messages quote a line with its end
    throw LoadError(what.find(path) != std::string::npos ? what : path + ": " + what);
  }
  st.merge_chain_parts();
  raw.name = st.name;
  int position = 0;
  for (const gemmi::Model& model : st.models) {
    ++position;
    const int number = std::atoi(model.name.c_str());
    raw.models.push_back(convert(model, number != 0 ? number : position));
  }
  for (const gemmi::Connection& link : st.connections)
    if (link.type == gemmi::Connection::Covale || link.type == gemmi::Connection::Disulf ||
        link.type == gemmi::Connection::MetalC || link.type == gemmi::Connection::Unknown)
      raw.links.push_back({address(link.partner1), address(link.partner2), link.type == gemmi::Connection::Disulf});
  for (const gemmi::Helix& helix : st.helices)
    raw.elements.push_back({SecondaryStructure::Kind::helix, address(helix.start), address(helix.end)});
  for (const gemmi::Sheet& sheet : st.sheets)
    for (const gemmi::Sheet::Strand& strand : sheet.strands)
      raw.elements.push_back({SecondaryStructure::Kind::strand, address(strand.start), address(strand.end)});
  return raw;
}

}  // namespace hinge::molecular
