// SPDX-License-Identifier: BSD-3-Clause
// Scenes: proteins with the rules that all peers share, the paper's set-ups of free residues, and their
// conformations.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/batch/state_batch.hpp"
#include "hinge/engine/lazy.hpp"
#include "hinge/engine/simd.hpp"
#include "hinge/hierarchy.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/primitive/point.hpp"
#include "peers/peer.hpp"

namespace hinge::bench {

template <template <class, class, class> class EngineOf>
using Molecular = Hierarchy<Point, molecular::BondExclusions, TypedThresholds, EngineOf>;

inline constexpr std::uint64_t seed = 2005;

enum class Sampling : std::uint8_t { random, five_degrees, near_free };
inline constexpr Sampling all_samplings[] = {Sampling::random, Sampling::five_degrees, Sampling::near_free};
inline constexpr const char* sampling_names[] = {"random", "5deg", "near-free"};
inline const char* name(Sampling s) { return sampling_names[static_cast<std::size_t>(s)]; }

/// A structure and its pair rules, equal for every selection of DOF.
struct Protein {
  std::shared_ptr<const molecular::Molecule> molecule;
  TypedThresholds thresholds;
  molecular::BondExclusions filter;
};

/// M(i, j) = r(i) + r(j), which spheres of radius r (FCL's) reproduce. r = 0.8 x Bondi radius; hydrogens 0.8 x 1.10
/// angstrom or, on N, O and S, 0.8 x 0.60 angstrom, which replaces a rule for hydrogen bonds.
inline TypedThresholds additive_thresholds(const molecular::Structure& structure) {
  constexpr double rho = 0.8, hydrogen = 1.10, polar_hydrogen = 0.60;
  molecular::ThresholdOptions options;
  options.rho = rho;
  options.hydrogen_bonds = false;
  const TypedThresholds bondi = molecular::make_thresholds(structure, options).matrix;
  const auto classes = molecular::classify_atoms(structure);
  std::vector<std::uint16_t> types;
  std::vector<double> radius(bondi.type_count(), 0.0);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const PrimitiveId atom = id<PrimitiveId>(i);
    types.push_back(bondi.type(atom));
    switch (classes[i]) {
      case molecular::AtomClass::hydrogen_polar:
      case molecular::AtomClass::hydrogen_hydroxyl: radius[types.back()] = rho * polar_hydrogen; break;
      case molecular::AtomClass::hydrogen:
      case molecular::AtomClass::hydrogen_alpha:
      case molecular::AtomClass::hydrogen_aromatic: radius[types.back()] = rho * hydrogen; break;
      default: radius[types.back()] = bondi.threshold(atom, atom) / 2;
    }
  }
  std::vector<double> table;
  for (const double r : radius)
    for (const double s : radius) table.push_back(r + s);
  return {std::move(types), radius.size(), std::move(table)};
}

/// Admits pairs at least min_bonds apart, except pairs closer than M + 0.05 angstrom in the native structure, which
/// would collide in nearly every sample.
inline molecular::BondExclusions exempt_native(const molecular::Molecule& molecule, const TypedThresholds& thresholds,
                                               int min_bonds) {
  constexpr double allowance = 0.05;
  Molecular<Lazy> native(molecule.model(), molecule.select({}),
                         molecular::BondExclusions(molecule.structure(), min_bonds), thresholds);
  std::vector<Point> placed;
  for (const Vec3& x : molecule.structure().models.front()) placed.push_back(Point{x});
  native.update_placed(placed);
  std::vector<std::pair<PrimitiveId, PrimitiveId>> pairs;
  for (const Hit& hit : native.self_within(allowance)) pairs.emplace_back(hit.first, hit.second);
  return {molecule.structure(), min_bonds, pairs};
}

/// Additive thresholds and exclusions for a structure.
inline Protein make_protein(molecular::Structure structure) {
  auto molecule = std::make_shared<const molecular::Molecule>(std::move(structure));
  TypedThresholds thresholds = additive_thresholds(molecule->structure());
  molecular::BondExclusions filter = exempt_native(*molecule, thresholds, 4);
  return {std::move(molecule), std::move(thresholds), std::move(filter)};
}

inline Protein read_protein(const std::string& file, bool hydrogens) {
  molecular::ReadOptions options;
  options.keep_hydrogens = hydrogens;
  options.model = 1;
  return make_protein(molecular::read_structure(file, options));
}

/// Path of a file of the shared data; empty if it does not exist.
inline std::string shared_molecule(const std::string& name) {
  const auto path = std::filesystem::path(HINGE_SHARED_DATA) / "molecules" / name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}
inline std::string ubiquitin() { return std::string(HINGE_SOURCE_DIR) + "/molecular/data/1ubq.pdb"; }

/// A protein file and the number of its free residues.
struct Setup {
  std::string name;  ///< name in the output: "1mbn"
  std::string file;
  bool hydrogens = false;
  int residues = 0;  ///< number of free residues, at regular intervals
};

/// The 17 set-ups of docs/explanation/benchmarks.md. Without the shared data, 1UBQ replaces them and a line says so.
inline std::vector<Setup> paper_setups() {
  struct Source {
    const char *name, *file;
    bool hydrogens;
    std::vector<int> residues;
  };
  const Source sources[] = {{"1vii", "paper/1vii_3frames.pdb", false, {10, 36}},
                            {"2axd", "paper/2axd.pdb.gz", false, {10, 76}},
                            {"1mbn", "paper/1mbn.pdb", false, {1, 5, 10, 35, 153}},
                            {"1be0", "paper/1be0.cif", false, {10, 310}},
                            {"2d0f", "paper/2d0f.pdb", false, {10, 637}},
                            {"2axd+H", "paper/2axd.pdb.gz", true, {10, 76}},
                            {"adk+H", "adk_closed.pdb", true, {10, 211}}};
  std::vector<Setup> setups;
  for (const Source& source : sources) {
    const std::string file = shared_molecule(source.file);
    if (file.empty()) {
      std::printf("the shared %s is missing: 1UBQ is used instead of all proteins\n", source.file);
      setups.clear();
      for (const int k : {1, 5, 10, 35, 76}) setups.push_back({"1ubq", ubiquitin(), false, k});
      return setups;
    }
    for (const int k : source.residues) setups.push_back({source.name, file, source.hydrogens, k});
  }
  return setups;
}

/// Of these set-ups, those of 1MBN and 2D0F, or of 1UBQ, with all residues free.
inline std::vector<Setup> all_free_setups(const std::vector<Setup>& setups) {
  std::vector<Setup> chosen;
  for (const Setup& setup : setups) {
    if (setup.name != "1mbn" && setup.name != "2d0f" && setup.name != "1ubq") continue;
    if (!chosen.empty() && chosen.back().name == setup.name) chosen.pop_back();  // it has fewer free residues
    chosen.push_back(setup);
  }
  return chosen;
}

/// One conformation as the input of every peer; not timed.
struct Conformation {
  std::vector<double> q;    ///< rad, one per selected DOF
  std::vector<double> xyz;  ///< angstrom, 3 per atom
};

/// A protein with some free DOF: makes peers and conformations.
class Scene {
 public:
  Scene(Protein protein, DofSelection selection)
      : protein_(std::move(protein)), selection_(std::move(selection)), source_(make<Lazy>()), input_(make_input()) {
    for (std::size_t i = 0; i < size(); ++i) {
      const PrimitiveId a = id<PrimitiveId>(i);
      radii_.push_back(protein_.thresholds.threshold(a, a) / 2);
      if (source_.model().group_of(a) != GroupId{0}) moved_.push_back(i);
    }
  }
  /// residues: number of free residues, at regular intervals, with phi, psi, omega and all chi.
  Scene(const Protein& protein, int residues) : Scene(protein, "count:" + std::to_string(residues)) {}
  Scene(const Protein& protein, const std::string& words)
      : Scene(protein, protein.molecule->select(molecular::select_torsions(*protein.molecule, words, true))) {}

  template <template <class, class, class> class EngineOf>
  Molecular<EngineOf> make() const {
    return {protein_.molecule->model(), selection_, protein_.filter, protein_.thresholds};
  }
  StateBatch<Point, molecular::BondExclusions, TypedThresholds> make_batch() const {
    return {protein_.molecule->model(), selection_, protein_.filter, protein_.thresholds};
  }
  std::size_t size() const { return protein_.molecule->model().size(); }
  std::size_t dof_count() const { return selection_.size(); }
  const std::shared_ptr<const PeerInput>& input() const { return input_; }
  /// Radii r with M(i, j) = r(i) + r(j), angstrom.
  std::span<const double> radii() const { return radii_; }
  /// Atoms outside the static rigid group.
  std::span<const std::size_t> moved() const { return moved_; }

  std::vector<double> configuration(Sampling sampling, std::uint64_t k) {
    return molecular::sample_configuration(source_of(sampling), k, dof_count());
  }
  Conformation conformation(Sampling sampling, std::uint64_t k) { return conformation(configuration(sampling, k)); }
  Conformation conformation(std::vector<double> q) {
    Conformation c{std::move(q), {}};
    source_.update(c.q);
    for (const Point& p : source_.placed()) c.xyz.insert(c.xyz.end(), {p.position[0], p.position[1], p.position[2]});
    return c;
  }
  /// Sigma (rad) of Gaussian conformations about the native structure: the largest, to 2 %, at which at most a
  /// quarter of the conformations collide. At most 0.2.
  double near_free_sigma() {
    if (!sigma_) sigma_ = find_sigma(0.25);
    return *sigma_;
  }
  /// The same for another share of colliding conformations.
  double find_sigma(double share) const {
    const std::uint64_t samples = size() > 20'000 ? 20 : 100;  // large scenes take long
    const double allowed = share * static_cast<double>(samples);
    auto asked = make<Simd>();
    double low = 1e-8, high = 0.2;
    while (high / low > 1.02) {
      const double middle = std::sqrt(low * high);
      double colliding = 0.0;
      for (std::uint64_t k = 0; k < samples && colliding <= allowed; ++k) {
        asked.update(molecular::sample_configuration({seed, middle}, k, dof_count()));
        colliding += asked.self_collides() ? 1.0 : 0.0;
      }
      (colliding <= allowed ? low : high) = middle;
    }
    return low;
  }

 private:
  molecular::Sampling source_of(Sampling sampling) {
    switch (sampling) {
      case Sampling::random: return {seed, {}};
      case Sampling::five_degrees: return {seed, 5 * std::numbers::pi / 180};
      case Sampling::near_free: break;
    }
    return {seed, near_free_sigma()};
  }

  /// Excludes pairs in different groups whose distance is constant: an atom on the axis between two groups is fixed
  /// in both.
  std::shared_ptr<const PeerInput> make_input() const {
    PeerInput input;
    const auto& model = source_.model();
    const auto atom = [](std::size_t i) { return id<PrimitiveId>(i); };
    input.n = size();
    input.type_count = protein_.thresholds.type_count();
    input.table.resize(input.type_count * input.type_count);
    std::vector<std::vector<std::uint32_t>> fixed_too(model.groups()->size());  // besides the group's own atoms
    for (std::size_t i = 0; i < input.n; ++i) {
      input.type.push_back(protein_.thresholds.type(atom(i)));
      input.group.push_back(static_cast<std::uint32_t>(index(model.group_of(atom(i)))));
      for (const GroupId g : model.also_fixed_in(atom(i))) fixed_too[index(g)].push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<std::optional<PrimitiveId>> representative(input.type_count);
    for (std::size_t i = 0; i < input.n; ++i) representative[input.type[i]] = atom(i);
    for (std::size_t s = 0; s < input.type_count; ++s)
      for (std::size_t t = 0; t < input.type_count; ++t)
        if (representative[s] && representative[t])
          input.table[s * input.type_count + t] = protein_.thresholds.threshold(*representative[s], *representative[t]);
    input.excluded.resize(input.n);
    for (std::size_t i = 0; i < input.n; ++i)
      for (const PrimitiveId j : protein_.filter.excluded(atom(i)))
        input.excluded[i].push_back(static_cast<std::uint32_t>(index(j)));
    const auto exclude = [&](std::uint32_t i, std::uint32_t j) {
      if (input.group[i] == input.group[j]) return;
      input.excluded[i].push_back(j);
      input.excluded[j].push_back(i);
    };
    for (std::size_t g = 0; g < fixed_too.size(); ++g)
      for (std::size_t k = 0; k < fixed_too[g].size(); ++k) {
        for (const PrimitiveId j : model.primitives_of(id<GroupId>(g)))
          exclude(fixed_too[g][k], static_cast<std::uint32_t>(index(j)));
        for (std::size_t l = 0; l < k; ++l) exclude(fixed_too[g][k], fixed_too[g][l]);
      }
    for (auto& list : input.excluded) {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return std::make_shared<const PeerInput>(std::move(input));
  }

  Protein protein_;
  DofSelection selection_;
  Molecular<Lazy> source_;
  std::shared_ptr<const PeerInput> input_;
  std::vector<double> radii_;
  std::vector<std::size_t> moved_;
  std::optional<double> sigma_;
};

}  // namespace hinge::bench
