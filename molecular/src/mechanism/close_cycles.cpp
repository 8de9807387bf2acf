// SPDX-License-Identifier: BSD-3-Clause
// Makes closures from the torsions and bonds that the spanning tree leaves out.
#include "mechanism/close_cycles.hpp"

#include <optional>
#include <utility>

#include "hinge/core/id.hpp"
#include "rules/hydrogen_bonds.hpp"

namespace hinge::molecular {

namespace {

class Closer {
 public:
  Closer(const Structure& s, std::span<const std::uint32_t> link_of_atom, std::vector<std::string>& notes)
      : s_(s), link_(link_of_atom), notes_(notes) {}

  /// Adds a closure for the bond a-b: both atoms coincide in the two links, so only rotation about the bond is free.
  void close(std::uint32_t a, std::uint32_t b, const char* what) {
    Closure closure;
    closure.in_first = closure.in_second = {at(a), at(b)};
    add(a, b, std::move(closure), what);
  }

  /// Adds the closure of a torsion that is not a DOF. omega is fixed as well; any other torsion follows from its cycle.
  void close(const Torsion& torsion) {
    const auto& a = torsion.atoms;
    close(a[1], a[2], "the bond");
    const bool kept = torsion.name == "omega";
    notes_.push_back("torsion " + torsion.name + " of " + label(s_, a[1]) + ": closes a cycle of torsions and " +
                     (kept ? "stays at its reference" : "follows from the others"));
    if (!kept) return;
    // The outer two atoms of the torsion fix omega, in addition to the two atoms of the bond.
    Closure closure;
    closure.in_first = closure.in_second = {at(a[0]), at(a[3])};
    add(a[1], a[2], std::move(closure), "omega of the bond");
  }

  /// Fixes the bond length and both bond angles (as three distances), but no torsion.
  void close_disulphide(const Bond& bond) {
    const auto a = beta(bond.first), b = beta(bond.second);
    if (!a || !b) return close(bond.first, bond.second, "the bond");
    Closure closure;
    closure.in_first = {at(bond.first), at(*a)};
    closure.in_second = {at(bond.second), at(*b)};
    closure.lengths.emplace();
    for (std::size_t k = 0; k < 3; ++k)
      (*closure.lengths)[k] = norm(Vec3(closure.in_first[kept_lengths[k][0]] - closure.in_second[kept_lengths[k][1]]));
    add(bond.first, bond.second, std::move(closure), "the bond");
  }

  /// Adds two closures of two points each: together they fix the relative pose of the two links.
  void hold(const HeldPlacement& held) {
    for (const std::size_t k : {0U, 2U}) {
      Closure closure;
      closure.in_first = closure.in_second = {at(held.points[k]), at(held.points[k + 1])};
      add(held.atoms[0], held.atoms[1], std::move(closure), k == 0 ? "the placement of" : nullptr);
    }
  }

  std::vector<ClosedCycle> take() { return std::move(closures_); }

 private:
  const Vec3& at(std::uint32_t atom) const { return s_.models.front()[atom]; }

  std::optional<std::uint32_t> beta(std::uint32_t sulphur) const {
    for (const Bond& bond : s_.bonds) {
      if (bond.first != sulphur && bond.second != sulphur) continue;
      const std::uint32_t other = bond.first == sulphur ? bond.second : bond.first;
      if (s_.atoms[other].name == "CB" && s_.atoms[other].residue == s_.atoms[sulphur].residue) return other;
    }
    return std::nullopt;
  }

  /// Does nothing if one link holds both atoms. what: for the note; null for the second closure of a pair, which gets
  /// no note.
  void add(std::uint32_t a, std::uint32_t b, Closure closure, const char* what) {
    if (link_[a] == link_[b]) return;
    closure.first = id<LinkId>(link_[a]);
    closure.second = id<LinkId>(link_[b]);
    closure.name = label(s_, a) + " - " + label(s_, b);
    if (what != nullptr) {
      std::string text = "closure: ";
      text += what;
      text += ' ' + closure.name + " closes a cycle";
      notes_.push_back(std::move(text));
    } else {
      closure.name += ", second axis";
    }
    closures_.push_back({std::move(closure), {a, b}});
  }

  const Structure& s_;
  std::span<const std::uint32_t> link_;
  std::vector<std::string>& notes_;
  std::vector<ClosedCycle> closures_;
};

}  // namespace

std::vector<ClosedCycle> close_cycles(const Structure& structure, std::span<const Torsion> torsions,
                                      const OpenCycles& cycles, std::span<const std::uint32_t> link_of_atom,
                                      std::vector<std::string>& notes) {
  Closer closer(structure, link_of_atom, notes);
  for (const std::uint32_t t : cycles.loop_ends)
    closer.close(torsions[t].atoms[1], torsions[t].atoms[2], "the end of a loop");
  for (const std::uint32_t t : cycles.torsions) closer.close(torsions[t]);
  for (const Bond& bond : cycles.bonds) {
    if (bond.origin == BondOrigin::disulphide)
      closer.close_disulphide(bond);
    else
      closer.close(bond.first, bond.second, "the bond");
  }
  if (cycles.hydrogen_bonds)
    for (const HydrogenBond& bond : find_hydrogen_bonds(structure))
      closer.close(bond.nitrogen, bond.oxygen, "the hydrogen bond");
  for (const HeldPlacement& held : cycles.held) closer.hold(held);
  return closer.take();
}

}  // namespace hinge::molecular
