// SPDX-License-Identifier: BSD-3-Clause
// Builds the kinematic tree of a molecule: rigid fragments, a spanning tree over them, closures for the other bonds.
#include "hinge/molecular/molecule.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/kinematics/joint.hpp"
#include "mechanism/close_cycles.hpp"
#include "mechanism/disjoint_sets.hpp"
#include "mechanism/place_parts.hpp"

namespace hinge::molecular {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Returns true for a bond between residues that is no backbone bond between consecutive residues.
bool is_cross_link(const Structure& s, const Bond& bond) {
  const std::uint32_t r = s.atoms[bond.first].residue, t = s.atoms[bond.second].residue;
  const bool backbone = bond.origin == BondOrigin::peptide || bond.origin == BondOrigin::phosphodiester;
  return r != t && (!backbone || (r < t ? t - r : r - t) > 1);  // > 1: the bond that closes a cyclic backbone
}

}  // namespace

/// Builds the links and joints of one Molecule; call build() once.
class MoleculeBuilder {
 public:
  MoleculeBuilder(Molecule& molecule, const MoleculeOptions& options)
      : molecule_(molecule),
        options_(options),
        s_(molecule.structure_),
        rigid_(s_.atoms.size()),
        link_(s_.atoms.size(), none),
        placer_(s_, molecule.placed_) {}

  void build() {
    find_cuts();
    split_bonds();
    find_fragments();
    for (const std::uint32_t root : roots())
      if (!reached_.contains(root)) grow(root);  // both sides of a cut in a cyclic backbone are one component
    close_open_cycles();
    add_atoms();
    molecule_.model_ = model_.finish();
    order_torsions();
  }

 private:
  struct Hinge {  // the central bond of a torsion, seen from one end
    std::uint32_t torsion;
    std::uint32_t from, to;  // atoms
  };

  const Vec3& at(std::uint32_t atom) const { return s_.models.front()[atom]; }

  /// Finds the torsions at which loops are cut: psi of the last residue of each loop.
  void find_cuts() {
    for (const Loop& loop : options_.loops) {
      const auto& all = molecule_.torsions_;
      const auto psi = std::find_if(all.begin(), all.end(), [&](const Torsion& torsion) {
        return torsion.residue == loop.last && torsion.name == "psi";
      });
      if (psi == all.end())
        throw ModelError("loop '" + label(s_, loop) + "': psi of its last residue is undefined, expected N, CA, C");
      cuts_.push_back(static_cast<std::uint32_t>(psi - all.begin()));
    }
  }
  bool in_loop(std::uint32_t atom) const {
    return std::any_of(options_.loops.begin(), options_.loops.end(), [&](const Loop& loop) {
      return loop.first <= s_.atoms[atom].residue && s_.atoms[atom].residue <= loop.last;
    });
  }
  bool is_cut(std::uint32_t torsion) const { return std::find(cuts_.begin(), cuts_.end(), torsion) != cuts_.end(); }

  /// Splits the bonds into bonds_, from which the spanning tree is built, and cross_links_: cross-links that would
  /// close a cycle, and disulphides of loops, since nothing may be attached to a loop through them. Sets whole_: the
  /// components of bonds_ without the cut bonds.
  void split_bonds() {
    DisjointSets whole(s_.atoms.size());
    for (const Bond& bond : s_.bonds)
      if (!is_cross_link(s_, bond)) {
        whole.join(bond.first, bond.second);
        bonds_.push_back(bond);
      }
    for (const Bond& bond : s_.bonds) {
      if (!is_cross_link(s_, bond)) continue;
      const bool of_loop = bond.origin == BondOrigin::disulphide && (in_loop(bond.first) || in_loop(bond.second));
      (!of_loop && whole.join(bond.first, bond.second) ? bonds_ : cross_links_).push_back(bond);
    }
    if (cuts_.empty()) {
      whole_ = std::move(whole);
      return;
    }
    whole_ = DisjointSets(s_.atoms.size());
    for (const Bond& bond : bonds_)
      if (std::none_of(cuts_.begin(), cuts_.end(), [&](std::uint32_t t) {
            const auto& a = molecule_.torsions_[t].atoms;
            return std::pair(bond.first, bond.second) == std::pair(std::min(a[1], a[2]), std::max(a[1], a[2]));
          }))
        whole_.join(bond.first, bond.second);
  }

  /// Merges atoms joined by non-rotatable bonds into rigid fragments. A torsion whose two ends are in one fragment lies
  /// in a ring and is no DOF.
  void find_fragments() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> turning;
    for (std::uint32_t t = 0; t < molecule_.torsions_.size(); ++t) {
      const auto& a = molecule_.torsions_[t].atoms;
      turning.emplace(std::minmax(a[1], a[2]), t);
    }
    for (const Bond& bond : bonds_)
      if (!turning.contains({bond.first, bond.second})) rigid_.join(bond.first, bond.second);
    for (const auto& [bond, t] : turning) {
      const auto [a, b] = bond;
      if (rigid_.find(a) == rigid_.find(b)) {
        note(t, "lies in a ring and stays rigid");
        continue;
      }
      hinges_[rigid_.find(a)].push_back({t, a, b});
      hinges_[rigid_.find(b)].push_back({t, b, a});
    }
  }

  /// Returns the root fragment of each connected component. It holds the first N of a loop that starts in the
  /// component, because that atom is fixed; otherwise it is the fragment in the middle.
  std::vector<std::uint32_t> roots() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
    for (std::uint32_t atom = 0; atom < s_.atoms.size(); ++atom) parts[whole_.find(atom)].push_back(atom);
    std::vector<std::uint32_t> roots;
    std::map<std::uint32_t, std::uint32_t> starts;  // component -> N of the first residue of a loop
    for (const Loop& loop : options_.loops)
      for (std::uint32_t i = s_.residues[loop.first].first_atom; i < s_.residues[loop.first].last_atom; ++i)
        if (s_.atoms[i].name == "N") starts.emplace(whole_.find(i), i);
    for (const auto& [part, atoms] : parts) {
      const auto start = starts.find(part);
      roots.push_back(start != starts.end() ? rigid_.find(start->second) : middle(atoms));
    }
    return roots;
  }

  /// Returns the fragment of a component (its atoms) from which no branch of the tree holds more than half of the
  /// atoms. So a turned side chain moves itself, never the rest of the protein.
  std::uint32_t middle(const std::vector<std::uint32_t>& atoms) {
    struct Branch {
      std::uint32_t fragment;
      std::size_t parent, size = 0;
    };
    std::map<std::uint32_t, std::size_t> sizes;
    for (const std::uint32_t atom : atoms) ++sizes[rigid_.find(atom)];
    std::vector<Branch> tree{{rigid_.find(atoms[atoms.size() / 2]), 0}};
    std::set<std::uint32_t> seen{tree.front().fragment};
    for (std::size_t k = 0; k < tree.size(); ++k)
      for (const Hinge& hinge : hinges_[tree[k].fragment])
        if (const std::uint32_t next = rigid_.find(hinge.to); !is_cut(hinge.torsion) && seen.insert(next).second)
          tree.push_back({next, k});
    for (std::size_t k = tree.size() - 1;; --k) {
      tree[k].size += sizes[tree[k].fragment];
      if (k == 0 || 2 * tree[k].size > atoms.size()) return tree[k].fragment;  // the outermost of these branches
      tree[tree[k].parent].size += tree[k].size;
    }
  }

  /// Builds the spanning tree over hinges from a root fragment. The search is breadth first; links are added depth
  /// first, small branches first, so that side chains are numbered next to their backbone link. All link frames equal
  /// the frame of the structure at the reference.
  void grow(std::uint32_t root) {
    struct Branch {
      std::uint32_t fragment;
      std::size_t parent;
      Hinge hinge;
      std::size_t size = 1;
      std::vector<std::size_t> children{};
    };
    std::vector<Branch> tree{{root, 0, {}}};
    reached_.insert(root);
    for (std::size_t k = 0; k < tree.size(); ++k)
      for (const Hinge& hinge : hinges_[tree[k].fragment]) {
        const std::uint32_t next = rigid_.find(hinge.to);
        if (!done_.insert({hinge.torsion, {}}).second) continue;
        if (is_cut(hinge.torsion)) continue;
        if (reached_.insert(next).second)
          tree.push_back({next, k, hinge});
        else
          closing_.push_back(hinge.torsion);
      }
    for (std::size_t k = tree.size(); k-- > 1;) {
      tree[tree[k].parent].size += tree[k].size;
      tree[tree[k].parent].children.push_back(k);
    }
    std::vector<std::size_t> stack{0};
    while (!stack.empty()) {
      Branch& branch = tree[stack.back()];
      stack.pop_back();
      if (branch.fragment == root)
        link_[root] = static_cast<std::uint32_t>(index(model_.add_link(placer_.base_of(root, model_), Fixed{})));
      else
        add_joint(branch.fragment, link_[tree[branch.parent].fragment], branch.hinge);
      std::stable_sort(branch.children.begin(), branch.children.end(),
                       [&](std::size_t a, std::size_t b) { return tree[a].size > tree[b].size; });
      stack.insert(stack.end(), branch.children.begin(), branch.children.end());
    }
  }

  void add_joint(std::uint32_t fragment, std::uint32_t parent, const Hinge& hinge) {
    // Rotating the far side by +q about the axis pointing at it adds q to the dihedral angle, from either end.
    const Vec3 axis = at(hinge.to) - at(hinge.from);
    done_[hinge.torsion] = id<DofId>(model_.tree().dof_count());
    const std::string& name = molecule_.torsions_[hinge.torsion].name;
    link_[fragment] = static_cast<std::uint32_t>(
        index(model_.add_link(id<LinkId>(parent), Revolute{axis, at(hinge.from), {}, name})));
    // The far atom lies on the axis and is fixed in the near link; it belongs to the pseudo-backbone there.
    on_axis_[hinge.to] = parent;
  }

  void add_atoms() {
    for (std::uint32_t atom = 0; atom < s_.atoms.size(); ++atom) {
      const auto axis = on_axis_.find(atom);
      const std::uint32_t link = axis != on_axis_.end() ? axis->second : link_[rigid_.find(atom)];
      model_.add_primitive(id<LinkId>(link), Point{at(atom)});
    }
    model_.set_basic_groups(basic_groups(s_));
  }

  void close_open_cycles() {
    for (const std::uint32_t t : cuts_) {
      const auto& a = molecule_.torsions_[t].atoms;
      on_axis_[a[1]] = link_[rigid_.find(a[2])];  // CA at the end of a loop is fixed, like C
    }
    const auto is_hinge = [&](const Bond& bond) {  // a joint, or closed as a torsion
      const std::vector<Hinge>& near = hinges_[rigid_.find(bond.first)];
      return std::any_of(near.begin(), near.end(), [&](const Hinge& h) {
        return std::minmax(h.from, h.to) == std::minmax(bond.first, bond.second);
      });
    };
    std::erase_if(cross_links_, is_hinge);
    std::vector<std::uint32_t> link_of_atom;
    for (std::uint32_t atom = 0; atom < s_.atoms.size(); ++atom) link_of_atom.push_back(link_[rigid_.find(atom)]);
    const OpenCycles cycles{cuts_, closing_, cross_links_, options_.keep_hydrogen_bonds, options_.held};
    for (auto& [closure, atoms] : close_cycles(s_, molecule_.torsions_, cycles, link_of_atom, molecule_.notes_)) {
      model_.add_closure(std::move(closure));
      molecule_.closure_atoms_.push_back(atoms);
    }
  }

  void note(std::uint32_t torsion, const char* what) {
    const Torsion& t = molecule_.torsions_[torsion];
    molecule_.notes_.push_back("torsion " + t.name + " of " + label(s_, t.atoms[1]) + ": " + what);
  }

  /// Removes the torsions that are not joints, and sets the maps between torsions and DOF.
  void order_torsions() {
    std::vector<Torsion> kept;
    molecule_.torsion_of_.assign(molecule_.model_->tree().dof_count(), Molecule::no_torsion);
    for (std::uint32_t t = 0; t < molecule_.torsions_.size(); ++t) {
      const auto found = done_.find(t);
      if (found == done_.end() || !found->second) continue;
      molecule_.torsion_of_[index(*found->second)] = kept.size();
      molecule_.dof_.push_back(*found->second);
      kept.push_back(molecule_.torsions_[t]);
    }
    molecule_.torsions_ = std::move(kept);
  }

  Molecule& molecule_;
  const MoleculeOptions& options_;
  const Structure& s_;
  ModelBuilder<Point> model_;
  std::vector<Bond> bonds_;
  std::vector<Bond> cross_links_;
  DisjointSets whole_{0};
  DisjointSets rigid_;
  std::map<std::uint32_t, std::vector<Hinge>> hinges_;  // by root atom of the fragment
  std::vector<std::uint32_t> link_;                     // by root atom of the fragment
  PartPlacer placer_;
  std::set<std::uint32_t> reached_;                     // root atoms of the fragments that are in a tree
  std::map<std::uint32_t, std::uint32_t> on_axis_;      // atom -> link on the near side of its axis
  std::map<std::uint32_t, std::optional<DofId>> done_;  // torsion -> its DOF, if it has one
  std::vector<std::uint32_t> cuts_, closing_;           // torsions that are no joints: at loop ends, closing a cycle
};

Molecule::Molecule(Structure structure, const MoleculeOptions& options)
    : structure_(std::move(structure)), loops_(options.loops), torsions_(find_torsions(structure_, notes_)) {
  for (const Part& part : options.placed) placed_.push_back({part});
  MoleculeBuilder(*this, options).build();
}

DofSelection Molecule::select(std::span<const std::size_t> torsions) const {
  std::vector<DofId> free;
  for (const std::size_t k : torsions) free.push_back(dof_.at(k));
  return {model_->tree(), std::move(free)};
}

}  // namespace hinge::molecular
