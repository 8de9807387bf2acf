// SPDX-License-Identifier: BSD-3-Clause
// Implements the choices of MoleculeDial that free fewer torsions.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/settings_file.hpp"
#include "molecule_dial.hpp"
#include "scene.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::counted;
using hinge::tool::shell_quoted;
using hinge::tool::Sound;

void MoleculeDial::add_fewer_torsions() {
  if (!options_.loop.empty() || !job_.kept.closures.empty()) return;
  const Molecule& molecule = *job_.molecule;
  std::vector<std::size_t> given;
  for (const hinge::DofId dof : job_.checker.selection().dofs())
    if (const std::size_t t = molecule.torsion_of(dof); t != Molecule::no_torsion) given.push_back(t);
  std::ranges::sort(given);
  for (const char* words : {"backbone", "chi", "loops", "count:35", "count:10"}) {
    std::vector<std::size_t> kept;
    try {
      std::ranges::set_intersection(given, select_torsions(molecule, words, options_.omega), std::back_inserter(kept));
    } catch (const hinge::ModelError&) {  // such as loops without HELIX and SHEET records
      continue;
    }
    if (kept.empty() || kept.size() == given.size()) continue;
    CheckOptions check = options_.check;
    check.scope = read_scope(options_, molecule.structure());
    Checker checker(job_.molecule, molecule.select_placed(kept), check);
    const std::string expression =
        options_.free == "all" ? std::string(words) : fmt::format("({}) and {}", options_.free, words);
    add("torsions", fmt::format("only {} free, {} torsions", words, kept.size()),
        {make_variant(job_, std::move(checker)), {"--free " + shell_quoted(expression)}, Sound::unknown, {}});
  }
}

void MoleculeDial::add_rigid_groups() {
  if (ensemble_.empty() || !options_.loop.empty() || !job_.kept.closures.empty()) return;
  const auto leave_out = [&](const std::string& why) {
    section_notes_.push_back("rigid groups of the ensemble: left out" + why);
  };
  Options other = options_;
  other.rigid_from = ensemble_;
  try {
    const Job job = load(other);
    const std::size_t free = job.checker.dof_count();
    if (free == 0 || free == job_.checker.dof_count()) {
      leave_out(free == 0 ? ", because no torsion would be free" : ", because all torsions stay free");
      return;
    }
    std::vector<std::string> lines;
    for (const std::string& file : ensemble_) lines.push_back("--rigid-from " + shell_quoted(file));
    lines.push_back(fmt::format("--rigid-tolerance {}", options_.rigid_tolerance));
    add("torsions", fmt::format("rigid groups of the ensemble, {}", counted(free, "torsion")),
        {make_variant(job_, job.checker), lines, Sound::unknown, {}});
  } catch (const hinge::LoadError& error) {
    if (ensemble_.front() != options_.file) throw;  // a file that the user gave for this
    leave_out(std::string(": ") + error.what());
  } catch (const hinge::ModelError& error) {
    leave_out(std::string(": ") + error.what());
  }
}

}  // namespace biocd
