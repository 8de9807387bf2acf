// SPDX-License-Identifier: BSD-3-Clause
// build_ideal_protein: places atoms one by one from internal coordinates.
#include "hinge/molecular/ideal_protein.hpp"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "chemistry/residue_table.hpp"
#include "hinge/core/error.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "hinge/molecular/bonds.hpp"

namespace hinge::molecular {

namespace {

/// An atom bonded to `bonded`: the distance (angstrom), the angle with `second`, the dihedral with `third` (degrees).
struct Internal {
  const char* residue;
  const char* name;
  const char* bonded;
  const char* second;
  const char* third;
  double length, angle, dihedral;
};

// Rotamers without clashes with the backbone of helices and strands: chi1 is 180 for aromatic side chains and valine.
constexpr std::array<Internal, 62> side_chain_atoms{{
    {"ARG", "CG", "CB", "CA", "N", 1.520, 114.1, -65},
    {"ARG", "CD", "CG", "CB", "CA", 1.520, 111.3, 180},
    {"ARG", "NE", "CD", "CG", "CB", 1.461, 112.0, 180},
    {"ARG", "CZ", "NE", "CD", "CG", 1.329, 124.2, 180},
    {"ARG", "NH1", "CZ", "NE", "CD", 1.326, 120.0, 0},
    {"ARG", "NH2", "CZ", "NE", "CD", 1.326, 120.0, 180},
    {"ASN", "CG", "CB", "CA", "N", 1.516, 112.6, -65},
    {"ASN", "OD1", "CG", "CB", "CA", 1.231, 120.8, -40},
    {"ASN", "ND2", "CG", "CB", "CA", 1.328, 116.4, 140},
    {"ASP", "CG", "CB", "CA", "N", 1.516, 112.6, -65},
    {"ASP", "OD1", "CG", "CB", "CA", 1.249, 118.4, -40},
    {"ASP", "OD2", "CG", "CB", "CA", 1.249, 118.4, 140},
    {"CYS", "SG", "CB", "CA", "N", 1.808, 114.4, -65},
    {"GLN", "CG", "CB", "CA", "N", 1.520, 114.1, -65},
    {"GLN", "CD", "CG", "CB", "CA", 1.516, 112.6, 180},
    {"GLN", "OE1", "CD", "CG", "CB", 1.231, 120.8, -40},
    {"GLN", "NE2", "CD", "CG", "CB", 1.328, 116.4, 140},
    {"GLU", "CG", "CB", "CA", "N", 1.520, 114.1, -65},
    {"GLU", "CD", "CG", "CB", "CA", 1.516, 112.6, 180},
    {"GLU", "OE1", "CD", "CG", "CB", 1.249, 118.4, -40},
    {"GLU", "OE2", "CD", "CG", "CB", 1.249, 118.4, 140},
    {"HIS", "CG", "CB", "CA", "N", 1.497, 113.8, -65},
    {"HIS", "ND1", "CG", "CB", "CA", 1.378, 122.7, -75},
    {"HIS", "CD2", "CG", "CB", "CA", 1.354, 131.2, 105},
    {"HIS", "CE1", "ND1", "CG", "CB", 1.321, 109.0, 180},
    {"HIS", "NE2", "CD2", "CG", "CB", 1.374, 107.2, 180},
    {"ILE", "CG1", "CB", "CA", "N", 1.530, 110.4, -65},
    {"ILE", "CG2", "CB", "CA", "N", 1.521, 110.5, 172},
    {"ILE", "CD1", "CG1", "CB", "CA", 1.513, 113.8, 170},
    {"LEU", "CG", "CB", "CA", "N", 1.530, 116.3, -65},
    {"LEU", "CD1", "CG", "CB", "CA", 1.521, 110.7, 175},
    {"LEU", "CD2", "CG", "CB", "CA", 1.521, 110.7, -62},
    {"LYS", "CG", "CB", "CA", "N", 1.520, 114.1, -65},
    {"LYS", "CD", "CG", "CB", "CA", 1.520, 111.3, 180},
    {"LYS", "CE", "CD", "CG", "CB", 1.520, 111.3, 180},
    {"LYS", "NZ", "CE", "CD", "CG", 1.489, 111.9, 180},
    {"MET", "CG", "CB", "CA", "N", 1.520, 114.1, -65},
    {"MET", "SD", "CG", "CB", "CA", 1.803, 112.7, 180},
    {"MET", "CE", "SD", "CG", "CB", 1.791, 100.9, 75},
    {"PHE", "CG", "CB", "CA", "N", 1.502, 113.8, 180},
    {"PHE", "CD1", "CG", "CB", "CA", 1.384, 120.7, 80},
    {"PHE", "CD2", "CG", "CB", "CA", 1.384, 120.7, -100},
    {"PHE", "CE1", "CD1", "CG", "CB", 1.382, 120.7, 180},
    {"PHE", "CE2", "CD2", "CG", "CB", 1.382, 120.7, 180},
    {"PHE", "CZ", "CE1", "CD1", "CG", 1.382, 120.0, 0},
    {"PRO", "CG", "CB", "CA", "N", 1.492, 104.5, 28},
    {"PRO", "CD", "CG", "CB", "CA", 1.503, 105.2, -36},
    {"SER", "OG", "CB", "CA", "N", 1.417, 111.1, -65},
    {"THR", "OG1", "CB", "CA", "N", 1.433, 109.6, -60},
    {"THR", "CG2", "CB", "CA", "N", 1.521, 110.5, 179},
    {"TRP", "CG", "CB", "CA", "N", 1.498, 113.6, 180},
    {"TRP", "CD1", "CG", "CB", "CA", 1.365, 126.9, -105},
    {"TRP", "CD2", "CG", "CB", "CA", 1.433, 126.8, 75},
    {"TRP", "NE1", "CD1", "CG", "CB", 1.374, 110.2, 180},
    {"TRP", "CE2", "CD2", "CG", "CB", 1.409, 107.2, 180},
    {"TRP", "CE3", "CD2", "CG", "CB", 1.398, 133.9, 0},
    {"TRP", "CZ2", "CE2", "CD2", "CG", 1.394, 122.4, 180},
    {"TRP", "CZ3", "CE3", "CD2", "CG", 1.382, 118.6, 180},
    {"TRP", "CH2", "CZ2", "CE2", "CD2", 1.368, 117.5, 0},
    {"VAL", "CG1", "CB", "CA", "N", 1.521, 110.5, 175},
    {"VAL", "CG2", "CB", "CA", "N", 1.521, 110.5, -63},
    // Tyrosine has phenylalanine's ring; only its hydroxyl is listed.
    {"TYR", "OH", "CZ", "CE1", "CD1", 1.376, 119.9, 180},
}};

constexpr double degree = std::numbers::pi / 180.0;

/// Returns the position at `length` from c (angstrom), with the angle to b and the dihedral to a about b-c (degrees).
Vec3 place(const Vec3& a, const Vec3& b, const Vec3& c, double length, double angle, double dihedral) {
  const Vec3 bc = c - b;
  const Vec3 u = bc / std::sqrt(squared_norm(bc));
  const Vec3 normal = cross(Vec3(b - a), u);
  const Vec3 n = normal / std::sqrt(squared_norm(normal));
  const Vec3 m = cross(n, u);
  const detail::SinCos bend = detail::sincos(angle * degree), turn = detail::sincos(dihedral * degree);
  return c + length * (u * -bend.cos + (m * turn.cos + n * turn.sin) * bend.sin);
}

class Builder {
 public:
  Builder(std::string_view sequence, std::string_view structure) : sequence_(sequence), elements_(structure) {
    s_.name = "ideal";
    s_.models.resize(1);
    s_.model_numbers = {1};
    s_.chains.push_back({"A", 0, static_cast<std::uint32_t>(sequence.size())});
  }

  Structure run() {
    for (std::size_t k = 0; k < sequence_.size(); ++k) add_residue(k);
    record_elements();
    perceive_bonds(s_);
    return std::move(s_);
  }

 private:
  double phi(std::size_t k) const {
    if (sequence_[k] == 'P') return -65;
    return elements_[k] == 'H' ? -57 : elements_[k] == 'E' ? -120 : -75;
  }
  double psi(std::size_t k) const { return elements_[k] == 'H' ? -47 : elements_[k] == 'E' ? 130 : 145; }

  void add(const std::string& name, const Vec3& x) {
    s_.atoms.push_back({name, name.substr(0, 1), static_cast<std::uint32_t>(s_.residues.size()), '\0',
                        static_cast<int>(s_.atoms.size()) + 1});
    s_.models.front().push_back(x);
    here_[name] = x;
  }

  void add_residue(std::size_t k) {
    const ResidueTemplate& known = *find_residue_template(sequence_[k]);
    Residue residue{std::string(known.name), static_cast<int>(k) + 1, '\0', 0, 0, 0, ResidueKind::amino_acid};
    residue.first_atom = static_cast<std::uint32_t>(s_.atoms.size());
    here_.clear();
    const Vec3 n = k == 0 ? Vec3(0, 0, 0) : place(n_, ca_, c_, 1.329, 117.2, psi(k - 1));
    const Vec3 ca = k == 0 ? Vec3(1.458, 0, 0) : place(ca_, c_, n, 1.458, 121.7, 180);
    const Vec3 c = k == 0 ? place({0, 1, 0}, n, ca, 1.525, 111.0, 180) : place(c_, n, ca, 1.525, 111.0, phi(k));
    add("N", n);
    add("CA", ca);
    add("C", c);
    add("O", place(n, ca, c, 1.231, 120.4, psi(k) + 180));
    const bool proline = known.letter == 'P';
    if (known.letter != 'G') add("CB", place(c, n, ca, 1.530, proline ? 103.2 : 110.4, proline ? -119.0 : -122.6));
    add_side_chain(known.name == "TYR" ? "PHE" : known.name, known.name == "TYR");
    if (k + 1 == sequence_.size()) add("OXT", place(n, ca, c, 1.249, 117.0, psi(k)));
    residue.last_atom = static_cast<std::uint32_t>(s_.atoms.size());
    s_.residues.push_back(std::move(residue));
    n_ = n;
    ca_ = ca;
    c_ = c;
  }

  void add_side_chain(std::string_view name, bool hydroxyl) {
    for (const Internal& atom : side_chain_atoms) {
      const bool tyrosine_only = hydroxyl && std::string_view(atom.name) == "OH";
      if (atom.residue != name && !tyrosine_only) continue;
      add(atom.name, place(here_.at(atom.third), here_.at(atom.second), here_.at(atom.bonded), atom.length, atom.angle,
                           atom.dihedral));
    }
  }

  void record_elements() {
    for (std::size_t begin = 0; begin < elements_.size();) {
      std::size_t end = begin;
      while (end < elements_.size() && elements_[end] == elements_[begin]) ++end;
      if (elements_[begin] != 'C')
        s_.secondary_structure.push_back(
            {elements_[begin] == 'H' ? SecondaryStructure::Kind::helix : SecondaryStructure::Kind::strand,
             static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - 1)});
      begin = end;
    }
  }

  std::string_view sequence_, elements_;
  Structure s_;
  Vec3 n_ = Vec3::Zero(), ca_ = Vec3::Zero(), c_ = Vec3::Zero();  // of the preceding residue
  std::map<std::string, Vec3> here_;                              // positions of the current residue, by name
};

}  // namespace

Structure build_ideal_protein(std::string_view sequence, std::string_view secondary_structure) {
  if (sequence.empty()) throw ModelError("sequence: is empty, expected one-letter codes");
  if (secondary_structure.size() != sequence.size())
    throw ModelError("secondary structure: " + std::to_string(secondary_structure.size()) + " letters, expected " +
                     std::to_string(sequence.size()) + " as in the sequence");
  for (std::size_t k = 0; k < sequence.size(); ++k) {
    if (find_residue_template(sequence[k]) == nullptr)
      throw ModelError("sequence: letter '" + std::string(1, sequence[k]) + "' at position " + std::to_string(k + 1) +
                       " is not an amino acid, expected its one-letter code");
    if (secondary_structure[k] != 'H' && secondary_structure[k] != 'E' && secondary_structure[k] != 'C')
      throw ModelError("secondary structure: letter '" + std::string(1, secondary_structure[k]) + "' at position " +
                       std::to_string(k + 1) + ", expected H, E or C");
  }
  return Builder(sequence, secondary_structure).run();
}

}  // namespace hinge::molecular
