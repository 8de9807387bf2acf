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
  return "#1" + (chain.empty() ? "" : "/" + chain) + ":" + number_of(residue) + "@" + s.atoms[index(i)].name;
}

std::string pymol_spec(const Structure& s, PrimitiveId i) {
  const Residue& residue = residue_of(s, i);
  const char* escape = residue.sequence_number < 0 ? "\\" : "";  // otherwise PyMOL reads a range
  return "/conformation//" + s.chains[residue.chain].name + "/" + escape + number_of(residue) + "/" +
         s.atoms[index(i)].name;
}

bool has_models(const std::string& file) { return file.ends_with(".pdb") || file.ends_with(".cif"); }

}  // namespace

void write_chimerax_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                           const ViewedFiles& files) {
  const auto quoted = [](const std::string& file) { return "\"" + file + "\""; };
  out << "open " << quoted(files.structure) << "\n";
  if (files.ensemble.ends_with(".npy"))
    out << "# " << files.ensemble << " is left out: ChimeraX does not open NumPy files\n";
  else if (has_models(files.ensemble))
    out << "open " << quoted(files.ensemble) << " coordsets true\n";
  else if (!files.ensemble.empty())
    out << "open " << quoted(files.structure) << "\nopen " << quoted(files.ensemble) << " structureModel #2\n";
  out << "hide atoms\nshow cartoons\ncolor bychain\n";
  if (!files.ensemble.empty() && !files.ensemble.ends_with(".npy")) out << "color #2 light gray\n";
  for (const Hit& hit : pairs) {
    const std::string a = chimerax_spec(structure, hit.first), b = chimerax_spec(structure, hit.second);
    out << "show " << a << " " << b << " atoms\nstyle " << a << " " << b << " sphere\ndistance " << a << " " << b
        << " color red radius 0.1 dashes 5\n";
  }
  out << "view\n";
}

void write_pymol_script(std::ostream& out, const Structure& structure, std::span<const Hit> pairs,
                        const ViewedFiles& files) {
  out << "load " << files.structure << ", conformation\n";
  if (files.ensemble.ends_with(".npy"))
    out << "load " << files.structure << ", ensemble\npython\nimport numpy\nfor k, x in enumerate(numpy.load(r'"
        << files.ensemble << "')): cmd.load_coordset(x, 'ensemble', k + 1)\npython end\n";
  else if (has_models(files.ensemble))
    out << "load " << files.ensemble << ", ensemble\n";
  else if (!files.ensemble.empty())
    out << "load " << files.structure << ", ensemble\nload_traj " << files.ensemble << ", ensemble, 1\n";
  out << "hide everything\nshow cartoon\nutil.cbc\n";
  if (!files.ensemble.empty()) out << "color gray80, ensemble\n";
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::string a = pymol_spec(structure, pairs[k].first), b = pymol_spec(structure, pairs[k].second);
    out << "show spheres, " << a << " or " << b << "\ndistance clash" << std::to_string(k + 1) << ", " << a << ", " << b
        << "\n";
  }
  out << "set sphere_scale, 0.25\n";
  if (!pairs.empty()) out << "color red, clash*\n";
  out << "zoom conformation\n";
}

}  // namespace hinge::molecular
