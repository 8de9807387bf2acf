// SPDX-License-Identifier: BSD-3-Clause
// Scripts that mark pairs, with atom specifications of ChimeraX and PyMOL.
#include "hinge/molecular/write_structure.hpp"

#include <ostream>

namespace hinge::molecular {

namespace {

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
    out << "show spheres, " << a << " or " << b << "\ndistance clash" << std::to_string(k + 1) << ", " << a << ", " << b
        << "\n";
  }
  out << "set sphere_scale, 0.25\ncolor red, clash*\nzoom\n";
}

}  // namespace hinge::molecular
