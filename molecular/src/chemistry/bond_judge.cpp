// SPDX-License-Identifier: BSD-3-Clause
// BondJudge: the bounds on lengths and angles, with their origin, and the tests.
#include "chemistry/bond_judge.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

#include "chemistry/nucleotide_table.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/detail/core/elementary.hpp"
#include "hinge/molecular/bonds.hpp"
#include "mechanism/rotatable_bonds.hpp"

namespace hinge::molecular {

namespace {

/// Bond length minus the sum of covalent radii (angstrom). Between residues: C=N of a Schiff base -0.19, S-N and P-O of
/// sulphonamides and phosphates -0.14; the longest known is +0.15 (1A4W, sulphonamide).
constexpr double shortest_bond = -0.2, longest_bond = 0.2;
/// S-S has 1.8 angstrom then, as disulphide_min of perceive_bonds.
constexpr double shortest_disulphide = -0.3;
/// Inside a residue, triple bonds have -0.32.
constexpr double shortest_inside = -0.35;
/// For metals, whose bonds vary more: Fe-O of oxymyoglobin -0.33, Ca-O up to +0.4 (the bound of BondList).
constexpr double shortest_coordination = -0.45;
/// Degrees, between bonds of one atom. Four-membered rings have 90; known bonds between residues: 90 to 126.
constexpr double narrowest_angle = 85.0, widest_angle = 140.0;
constexpr double narrowest_sulphur = 80.0, widest_sulphur = 125.0;  // thioethers 100, disulphides 104
constexpr double widest_in_ring = 150.0;                            // at an atom of a small fused ring
constexpr int clash_bonds = 4;                                      // atoms at least this many bonds apart clash
/// Degrees, at a metal's donor: carboxylates that bind with both oxygens have 90, thiolates between two metals 87.
constexpr double narrowest_donor = 70.0;
/// Degrees, between two donors of a metal in different residues; the smallest known is 61 (1EHZ).
constexpr double narrowest_coordination = 55.0;
constexpr std::size_t most_coordinated = 9;
/// Degrees, sum of the three angles at an atom: 360 if planar, 328 if tetrahedral.
constexpr double planar_sum = 340.0;

bool is_any(std::string_view element, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), element) != list.end();
}

/// Upper bound on the number of an element's bonds, with any partners.
std::size_t most_bonds(std::string_view element) {
  if (element == "O") return 2;
  if (is_any(element, {"S", "P", "Se", "As", "Si", "Te"})) return 6;
  if (is_any(element, {"H", "F"})) return 1;
  return 4;
}

}  // namespace

BondJudge::BondJudge(const Structure& structure, std::uint32_t first, std::uint32_t last)
    : s_(structure), x_(structure.models.front()), first_(first), near_(last - first), coordinated_(last - first) {}

BondJudge::BondJudge(const Structure& structure)
    : BondJudge(structure, 0, static_cast<std::uint32_t>(structure.atoms.size())) {
  for (const Bond& bond : s_.bonds) join(bond.first, bond.second, bond.order);
}

void BondJudge::join(std::uint32_t i, std::uint32_t j, BondOrder order) {
  if (is_metal(s_.atoms[i].element) || is_metal(s_.atoms[j].element)) {
    coordinated_[i - first_].push_back(j);
    coordinated_[j - first_].push_back(i);
  } else {
    near_[i - first_].push_back({j, order});
    near_[j - first_].push_back({i, order});
  }
}

void BondJudge::part(std::uint32_t i, std::uint32_t j) {
  std::erase_if(near_[i - first_], [&](const Neighbour& n) { return n.atom == j; });
  std::erase_if(near_[j - first_], [&](const Neighbour& n) { return n.atom == i; });
}

double BondJudge::distance(std::uint32_t i, std::uint32_t j) const { return norm(Vec3(x_[i] - x_[j])); }

double BondJudge::angle(std::uint32_t k, std::uint32_t i, std::uint32_t j) const {
  const Vec3 a = x_[k] - x_[i], b = x_[j] - x_[i];
  const double across = norm(cross(a, b)), along = dot(a, b);
  const bool same_place = across == 0.0 && along == 0.0;
  return same_place ? 0.0 : detail::atan2(across, along) * 180.0 / std::numbers::pi;
}

bool BondJudge::is_multiple(std::uint32_t i, const Neighbour& neighbour) const {
  if (neighbour.order != BondOrder::unknown) return neighbour.order == BondOrder::multiple;
  const double single = single_bond_from(s_.atoms[i].element, s_.atoms[neighbour.atom].element);
  return distance(i, neighbour.atom) < single;
}

int BondJudge::multiple_bonds(std::uint32_t i) const {
  return static_cast<int>(
      std::count_if(near(i).begin(), near(i).end(), [&](const Neighbour& n) { return is_multiple(i, n); }));
}

bool BondJudge::has_terminal_oxygen(std::uint32_t i) const {
  return std::any_of(near(i).begin(), near(i).end(),
                     [&](const Neighbour& n) { return s_.atoms[n.atom].element == "O" && near(n.atom).size() == 1; });
}

int BondJudge::room_of_carbon(std::uint32_t i) const {
  const int bonds = static_cast<int>(near(i).size());
  const Residue& residue = s_.residues[s_.atoms[i].residue];
  const bool known_amino_acid =
      residue.kind == ResidueKind::amino_acid && find_residue_template(residue.name) != nullptr;
  // C of a chain's end may lack its second oxygen in the file.
  if (known_amino_acid) return s_.atoms[i].name == "C" && bonds == 2 ? 1 : 0;
  if (residue.kind == ResidueKind::nucleotide && find_nucleotide_template(residue.name) != nullptr) return 0;
  const int multiple = multiple_bonds(i);
  // A planar carbon has three bonds. If two are multiple and the file has no third, the third is a hydrogen's.
  if (multiple >= 2) return 0;
  if (bonds == 3) {
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) sum += angle(near(i)[a].atom, i, near(i)[(a + 1) % 3].atom);
    if (sum > planar_sum + 10.0) return 0;
  }
  return std::max(0, (multiple > 0 ? 3 : 4) - bonds);
}

int BondJudge::room_of_nitrogen(std::uint32_t i) const {
  const Residue& residue = s_.residues[s_.atoms[i].residue];
  const std::string_view name = s_.atoms[i].name;
  const bool polymer = residue.kind == ResidueKind::amino_acid || residue.kind == ResidueKind::nucleotide;
  const auto is_heavy = [&](const Neighbour& n) { return s_.atoms[n.atom].element != "H"; };
  const auto is_inside = [&](const Neighbour& n) { return s_.atoms[n.atom].residue == s_.atoms[i].residue; };
  // The nitrogens of peptides, Trp and Arg NE bear a hydrogen, which the file may lack. His can lose its hydrogen.
  // Proline's N has two bonds inside its residue, and none to a hydrogen inside a chain.
  const bool bears_hydrogen = polymer && name != "ND1" && name != "NE2" &&
                              std::count_if(near(i).begin(), near(i).end(), is_heavy) == 2 &&
                              !(name == "N" && std::all_of(near(i).begin(), near(i).end(), is_inside));
  return bears_hydrogen ? 0 : std::max(0, 3 - static_cast<int>(near(i).size()));
}

int BondJudge::room_of_oxygen(std::uint32_t i) const {
  if (near(i).size() != 1) return 0;
  const Residue& residue = s_.residues[s_.atoms[i].residue];
  const std::string_view of = pdb_residue_name(residue.name), name = s_.atoms[i].name;
  if (residue.kind == ResidueKind::nucleotide) return name.ends_with('\'') || name.ends_with('*') ? 1 : 0;
  if (residue.kind == ResidueKind::amino_acid && find_residue_template(of) != nullptr) {
    const bool amide = (of == "ASN" && name == "OD1") || (of == "GLN" && name == "OE1");
    return name == "O" || amide ? 0 : 1;
  }
  return s_.atoms[near(i).front().atom].element == "S" || is_multiple(i, near(i).front()) ? 0 : 1;
}

int BondJudge::room_of_sulphur(std::uint32_t i) const {
  const int bonds = static_cast<int>(near(i).size());
  if (has_terminal_oxygen(i)) return std::max(0, 4 - bonds);
  return bonds == 1 && !is_multiple(i, near(i).front()) ? 1 : 0;
}

int BondJudge::room(std::uint32_t i) const {
  const std::string_view element = s_.atoms[i].element;
  if (s_.residues[s_.atoms[i].residue].kind == ResidueKind::water) return 0;
  if (element == "C") return room_of_carbon(i);
  if (element == "N") return room_of_nitrogen(i);
  if (element == "O") return room_of_oxygen(i);
  if (element == "S" || element == "Se" || element == "Te") return room_of_sulphur(i);
  if (is_any(element, {"P", "B", "Si", "As"})) return std::max(0, 4 - static_cast<int>(near(i).size()));
  return 0;
}

bool BondJudge::has_angles(std::uint32_t i, std::uint32_t j) const {
  const std::string_view element = s_.atoms[i].element;
  const bool sulphur = near(i).size() == 1 && is_any(element, {"S", "Se", "Te"});
  double sum = 0.0;
  for (const Neighbour& n : near(i)) {
    const double degrees = angle(n.atom, i, j);
    if (degrees < (sulphur ? narrowest_sulphur : narrowest_angle) ||
        degrees > (sulphur ? widest_sulphur : widest_angle))
      return false;
    sum += degrees;
  }
  // A planar atom's third bond lies in the plane of the other two.
  const bool planar = near(i).size() == 2 && ((element == "C" && (multiple_bonds(i) > 0 || s_.atoms[i].name == "C")) ||
                                              is_histidine(s_.residues[s_.atoms[i].residue].name));
  return !planar || sum + angle(near(i)[0].atom, i, near(i)[1].atom) >= planar_sum;
}

std::string BondJudge::metal_refusal(std::uint32_t metal, std::uint32_t donor) const {
  const std::string_view element = s_.atoms[donor].element;
  if (is_metal(s_.atoms[donor].element)) return "both atoms are metals";
  const bool bare_carbon = element == "C" && near(donor).size() <= 1;
  if (!bare_carbon && !is_any(element, {"N", "O", "S", "Se", "F", "Cl", "Br", "I"}))
    return label(s_, donor) + " does not bind metals";
  if (distance(metal, donor) <
      covalent_radius(s_.atoms[metal].element) + covalent_radius(s_.atoms[donor].element) + shortest_coordination)
    return "too close for a bond";
  const auto& partners = coordinated_[metal - first_];
  if (partners.size() >= most_coordinated)
    return label(s_, metal) + " already has " + std::to_string(partners.size()) + " bonds";
  for (const Neighbour& n : near(donor))
    if (angle(n.atom, donor, metal) < narrowest_donor) return "bond angles out of range at " + label(s_, donor);
  for (const std::uint32_t other : partners)
    if (s_.atoms[other].residue != s_.atoms[donor].residue && angle(other, metal, donor) < narrowest_coordination)
      return "bond angles out of range at " + label(s_, metal);
  return {};
}

std::string BondJudge::refusal(std::uint32_t i, std::uint32_t j) const {
  const std::string &a = s_.atoms[i].element, &b = s_.atoms[j].element;
  if (is_metal(a)) return metal_refusal(i, j);
  if (is_metal(b)) return metal_refusal(j, i);
  const double excess = distance(i, j) - covalent_radius(a) - covalent_radius(b);
  if (excess < (a == "S" && b == "S" ? shortest_disulphide : shortest_bond)) return "too close for a bond";
  if (excess > longest_bond) return "too far for a bond";
  if (is_any(a, {"N", "O"}) && is_any(b, {"N", "O"})) return "N and O of different residues form no bond";
  for (const std::uint32_t k : {i, j})
    if (room(k) < 1) return label(s_, k) + " has no free valence";
  for (const auto& [k, other] : {std::pair(i, j), std::pair(j, i)})
    if (!has_angles(k, other)) return "bond angles out of range at " + label(s_, k);
  return {};
}

bool BondJudge::has_ring_angles(std::uint32_t i, std::uint32_t j) const {
  const bool linear = s_.atoms[i].element == "C" && near(i).size() == 2 && multiple_bonds(i) > 0;  // alkyne
  return std::all_of(near(i).begin(), near(i).end(), [&](const Neighbour& n) {
    if (n.atom == j) return true;
    const double degrees = angle(n.atom, i, j);
    return degrees >= narrowest_angle && (degrees <= widest_in_ring || linear);
  });
}

bool BondJudge::may_close_ring(std::uint32_t i, std::uint32_t j, int around) const {
  const std::string &a = s_.atoms[i].element, &b = s_.atoms[j].element;
  if (is_metal(a) || is_metal(b)) return true;
  const double excess = distance(i, j) - covalent_radius(a) - covalent_radius(b);
  if (excess < shortest_inside || excess > longest_bond) return false;
  for (const auto& [k, other] : {std::pair(i, j), std::pair(j, i)}) {
    if (near(k).size() > most_bonds(s_.atoms[k].element)) return false;
    if (around >= clash_bonds && !has_ring_angles(k, other)) return false;
    // An aromatic carbon has at most three bonds, all in one plane.
    std::vector<std::uint32_t> planar;
    for (const Neighbour& n : near(k))
      if (n.atom != other && is_multiple(k, n)) planar.push_back(n.atom);
    if (s_.atoms[k].element != "C" || planar.size() < 2) continue;
    if (near(k).size() > 3) return false;
    if (angle(planar[0], k, planar[1]) + angle(planar[0], k, other) + angle(planar[1], k, other) < planar_sum)
      return false;
  }
  return true;
}

int BondJudge::bonds_around(std::uint32_t i, std::uint32_t j) const {
  std::vector<int> bonds(near_.size(), -1);
  std::vector<std::uint32_t> reached{i};
  bonds[i - first_] = 0;
  for (std::size_t k = 0; k < reached.size() && bonds[j - first_] < 0; ++k) {
    const std::uint32_t from = reached[k];
    const auto visit = [&](std::uint32_t to) {
      if (bonds[to - first_] >= 0 || (from == i && to == j)) return;
      bonds[to - first_] = bonds[from - first_] + 1;
      reached.push_back(to);
    };
    for (const Neighbour& n : near(from)) visit(n.atom);
    for (const std::uint32_t to : coordinated_[from - first_]) visit(to);
  }
  return std::max(0, bonds[j - first_]);
}

}  // namespace hinge::molecular
