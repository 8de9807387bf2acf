// SPDX-License-Identifier: BSD-3-Clause
// LoopedMolecule: a molecule with free torsions, or with loops whose ends are held.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/selection.hpp"

namespace hinge::bench {

class LoopedMolecule {
 public:
  /// loop: residues whose ends are held; empty: the torsions of `free` turn.
  LoopedMolecule(const std::filesystem::path& file, std::string loop, std::string free)
      : loop_(std::move(loop)), free_(std::move(free)) {
    molecular::Structure structure = molecular::read_structure(file);
    molecular::MoleculeOptions made;
    if (!loop_.empty()) made.loops = molecular::find_loops(structure, loop_);
    molecule_ = std::make_shared<const molecular::Molecule>(std::move(structure), made);
  }

  const molecular::Molecule& molecule() const { return *molecule_; }
  /// The free torsions of plain samples.
  molecular::KeptClosures plain() const { return kept("none"); }
  /// Those of samples that grow: the side chains of a loop, too.
  molecular::KeptClosures grown() const { return kept("(" + loop_ + ") and chi"); }
  /// Collisions of the file itself are exempt.
  molecular::Checker checker(const molecular::KeptClosures& kept) const {
    molecular::CheckOptions options;
    options.exempt_reference = true;
    return {molecule_, molecule_->select(kept.torsions), options};
  }

 private:
  molecular::KeptClosures kept(const std::string& side_chains) const {
    return find_kept_closures(*molecule_,
                              loop_.empty() ? select_torsions(*molecule_, free_, false)
                                            : select_loop_torsions(*molecule_, side_chains, false),
                              molecular::Closures::all);
  }

  std::string loop_, free_;
  std::shared_ptr<const molecular::Molecule> molecule_;
};

}  // namespace hinge::bench
