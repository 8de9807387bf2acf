// SPDX-License-Identifier: BSD-3-Clause
// PDB format 3.3 columns; atom specifications as ChimeraX and PyMOL write them.
#include "hinge/molecular/write_structure.hpp"

#include <array>
#include <cstdio>
#include <ostream>

#include "hinge/core/error.hpp"
#include "hybrid36.hpp"

namespace hinge::molecular {

namespace {

/// A name of fewer than four characters starts in column 14 when its element symbol has one letter.
std::string atom_field(const Atom& atom) {
  std::string name = atom.name.substr(0, 4);
  if (name.size() < 4 && atom.element.size() < 2) name.insert(name.begin(), ' ');
  name.resize(4, ' ');
  return name;
}

const Residue& residue_of(const Structure& s, PrimitiveId i) { return s.residues[s.atoms[index(i)].residue]; }

std::string number_of(const Residue& residue) {
  return std::to_string(residue.sequence_number) +
         (residue.insertion_code != '\0' ? std::string(1, residue.insertion_code) : "");
}

std::string chimerax_spec(const Structure& s, PrimitiveId i) {
  const Residue& residue = residue_of(s, i);
  const std::string& chain = s.chains[residue.chain].name;
  return (chain.empty() ? "" : "/" + chain) + ":" + number_of(residue) + "@" + s.atoms[index(i)].name;
}

std::string pymol_spec(const Structure& s, PrimitiveId i) {
  const Residue& residue = residue_of(s, i);
  return "/conformation//" + s.chains[residue.chain].name + "/" + number_of(residue) + "/" + s.atoms[index(i)].name;
}

}  // namespace

void write_pdb_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions, int number) {
  std::array<char, 96> line{};
  std::snprintf(line.data(), line.size(), "MODEL %8d\n", number);
  out << line.data();
  for (std::size_t i = 0; i < structure.atoms.size(); ++i) {
    const Atom& atom = structure.atoms[i];
    const Residue& residue = structure.residues[atom.residue];
    const std::string& chain = structure.chains[residue.chain].name;
    if (chain.size() > 1) throw ModelError("chain " + chain + ": PDB format has one character for a chain name");
    for (int k = 0; k < 3; ++k)
      if (!(positions[i][k] > -999.9995 && positions[i][k] < 9999.9995))
        throw ModelError(label(structure, static_cast<std::uint32_t>(i)) +
                         ": a coordinate does not fit the PDB columns");
    const bool hetero = residue.kind == ResidueKind::other || residue.kind == ResidueKind::water;
    std::snprintf(line.data(), line.size(), "%-6s%5s %4s%c%3.3s %c%4d%c   %8.3f%8.3f%8.3f%6.2f%6.2f          %2.2s\n",
                  hetero ? "HETATM" : "ATOM", hybrid36(i + 1).c_str(), atom_field(atom).c_str(), ' ',
                  residue.name.c_str(), chain.empty() ? ' ' : chain.front(), residue.sequence_number % 10000,
                  residue.insertion_code == '\0' ? ' ' : residue.insertion_code, positions[i][0], positions[i][1],
                  positions[i][2], 1.0, 0.0, atom.element.c_str());
    out << line.data();
  }
  out << "ENDMDL\n";
}

void write_chimerax_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                           const std::string& pdb_file) {
  out << "open " << pdb_file << "\nhide atoms\nshow cartoons\ncolor bychain\n";
  for (const Hit& hit : pairs) {
    const std::string a = chimerax_spec(structure, hit.first), b = chimerax_spec(structure, hit.second);
    out << "show " << a << " " << b << " atoms\ndistance " << a << " " << b << " color red radius 0.1\n";
  }
  if (!pairs.empty()) out << "style sphere\nview\n";
}

void write_pymol_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                        const std::string& pdb_file) {
  out << "load " << pdb_file << ", conformation\nhide everything\nshow cartoon\nutil.cbc\n";
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::string a = pymol_spec(structure, pairs[k].first), b = pymol_spec(structure, pairs[k].second);
    out << "show spheres, " << a << " or " << b << "\ndistance clash" << k + 1 << ", " << a << ", " << b << "\n";
  }
  out << "set sphere_scale, 0.25\ncolor red, clash*\nzoom\n";
}

}  // namespace hinge::molecular
