// SPDX-License-Identifier: BSD-3-Clause
// TorsionPrior: many draws against the tables, for every kind of residue.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "chemistry/ramachandran_table.hpp"
#include "chemistry/rotamer_table.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/molecular/ideal_protein.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/torsion_prior.hpp"
#include "molecular/test_files.hpp"

namespace hinge::molecular {
namespace torsion_prior_test {

constexpr std::size_t bins = ramachandran_bins;
constexpr double bin_width = 2.0 * std::numbers::pi / static_cast<double>(bins);

Structure ideal(const std::string& sequence) {
  return build_ideal_protein(sequence, std::string(sequence.size(), 'C'));
}

std::size_t bin_of(double angle) {
  double turned = std::fmod(angle + std::numbers::pi, 2.0 * std::numbers::pi);
  if (turned < 0.0) turned += 2.0 * std::numbers::pi;
  return std::min(static_cast<std::size_t>(turned / bin_width), bins - 1);
}

/// A molecule with the residues' torsions as units, and a prior.
struct Drawn {
  Drawn(Structure structure, const std::string& words, std::vector<std::vector<std::string>> names)
      : molecule(std::make_shared<const Molecule>(std::move(structure))),
        selection(molecule->select(select_torsions(*molecule, words, false))) {
    for (const std::vector<std::string>& unit : names) {
      units.emplace_back();
      for (const std::string& name : unit) units.back().push_back(position(name));
    }
    prior.emplace(*molecule, selection, Prior::ramachandran, std::nullopt, units);
    q.resize(selection.size());
  }
  std::size_t position(const std::string& name) const {
    for (std::size_t k = 0; k < selection.size(); ++k)
      if (torsion(k).name == name) return k;
    throw std::out_of_range(name);
  }
  const Torsion& torsion(std::size_t k) const {
    return molecule->torsions()[molecule->torsion_of(selection.dofs()[k])];
  }
  double angle(const std::string& name) const {
    const std::size_t k = position(name);
    return torsion(k).reference + q[k];
  }
  void draw(SampleStream& stream) {
    for (std::size_t u = 0; u < units.size(); ++u) prior->draw(u, stream, q);
  }

  std::shared_ptr<const Molecule> molecule;
  DofSelection selection;
  std::vector<std::vector<std::size_t>> units;
  std::optional<TorsionPrior> prior;
  std::vector<double> q;
};

/// Largest difference between shares of counts and of weights, in standard deviations of a count; cells of fewer than
/// five expected counts are joined.
double worst_deviation(const std::vector<double>& counts, const std::vector<double>& weights) {
  double n = 0.0, total = 0.0, worst = 0.0, rare = 0.0, rare_weight = 0.0;
  for (const double count : counts) n += count;
  for (const double weight : weights) total += weight;
  const auto compare = [&](double count, double weight) {
    const double p = weight / total;
    if (p > 0.0 && p < 1.0) worst = std::max(worst, std::abs(count - n * p) / std::sqrt(n * p * (1.0 - p)));
  };
  for (std::size_t k = 0; k < counts.size(); ++k) {
    if (weights[k] == 0.0) {
      EXPECT_EQ(counts[k], 0.0) << "cell " << k << " does not occur in the table";
    }
    if (n * weights[k] / total >= 5.0) {
      compare(counts[k], weights[k]);
    } else {
      rare += counts[k];
      rare_weight += weights[k];
    }
  }
  if (n * rare_weight / total >= 5.0) compare(rare, rare_weight);
  return worst;
}

std::vector<double> table_of(BackboneKind kind) {
  const auto& table = ramachandran_tables[static_cast<std::size_t>(kind)];
  return {std::begin(table), std::end(table)};
}

TEST(TorsionPrior, DrawsPhiAndPsiAsTheTablesSay) {
  struct Case {
    const char* sequence;
    const char* words;
    BackboneKind kind;
  };
  for (const Case& c : {Case{"AALAA", "A:3:backbone", BackboneKind::general},
                        Case{"AAIAA", "A:3:backbone", BackboneKind::isoleucine_valine},
                        Case{"AAVAA", "A:3:backbone", BackboneKind::isoleucine_valine},
                        Case{"AAGAA", "A:3:backbone", BackboneKind::glycine},
                        Case{"AALPA", "A:3:backbone", BackboneKind::before_proline},
                        Case{"AAGPA", "A:3:backbone", BackboneKind::glycine}}) {
    SCOPED_TRACE(c.sequence);
    for (const bool together : {true, false}) {
      const std::vector<std::vector<std::string>> units = together
                                                              ? std::vector<std::vector<std::string>>{{"phi", "psi"}}
                                                              : std::vector<std::vector<std::string>>{{"psi"}, {"phi"}};
      Drawn drawn(ideal(c.sequence), c.words, units);
      SampleStream stream(1, 0);
      std::vector<double> counts(bins * bins);
      for (int k = 0; k < 200'000; ++k) {
        drawn.draw(stream);
        ++counts[bin_of(drawn.angle("phi")) * bins + bin_of(drawn.angle("psi"))];
      }
      EXPECT_LT(worst_deviation(counts, table_of(c.kind)), 5.0);
    }
  }
}

TEST(TorsionPrior, DrawsPsiGivenAFixedPhi) {
  for (const bool proline : {true, false}) {
    Drawn drawn(ideal(proline ? "AAPAA" : "AALAA"), "A:3:psi", {{"psi"}});
    const std::vector<double> table = table_of(proline ? BackboneKind::trans_proline : BackboneKind::general);
    double phi = 0.0;  // of the ideal protein
    for (const Torsion& torsion : drawn.molecule->torsions())
      if (!proline && torsion.residue == 2 && torsion.name == "phi") phi = torsion.reference;
    if (proline) {
      const Structure& s = drawn.molecule->structure();
      std::map<std::pair<std::uint32_t, std::string>, Vec3> at;
      for (std::uint32_t atom = 0; atom < s.atoms.size(); ++atom)
        at[{s.atoms[atom].residue, s.atoms[atom].name}] = s.models.front()[atom];
      phi = dihedral(at[{1, "C"}], at[{2, "N"}], at[{2, "CA"}], at[{2, "C"}]);
    }
    const std::size_t row = bin_of(phi);
    const std::vector<double> weights(table.begin() + static_cast<std::ptrdiff_t>(row * bins),
                                      table.begin() + static_cast<std::ptrdiff_t>((row + 1) * bins));
    double total = 0.0;
    for (const double weight : weights) total += weight;
    ASSERT_GT(total, 0.0);
    SampleStream stream(2, 0);
    std::vector<double> counts(bins);
    for (int k = 0; k < 100'000; ++k) {
      drawn.draw(stream);
      ++counts[bin_of(drawn.angle("psi"))];
    }
    EXPECT_LT(worst_deviation(counts, weights), 5.0);
  }
}

TEST(TorsionPrior, MirrorsDResidues) {
  Structure s = ideal("AALAA");
  for (Vec3& x : s.models.front()) x[2] = -x[2];
  Drawn drawn(s, "A:3", {{"phi", "psi", "chi1", "chi2"}});
  SampleStream stream(3, 0);
  int left = 0, trans_chi1 = 0;
  for (int k = 0; k < 10'000; ++k) {
    drawn.draw(stream);
    left += std::remainder(drawn.angle("phi"), 2.0 * std::numbers::pi) > 0.0 ? 1 : 0;
    trans_chi1 += std::remainder(drawn.angle("chi1"), 2.0 * std::numbers::pi) > 0.0 ? 1 : 0;
  }
  EXPECT_GT(left, 9'500);        // L residues: 97 % below 0
  EXPECT_GT(trans_chi1, 6'000);  // leucine mt, 59 %: chi1 near -65; mirrored near +65
}

TEST(TorsionPrior, DrawsSideChainsByRotamers) {
  for (const char letter : std::string("RNDCQEHILKMFSTWYV")) {
    SCOPED_TRACE(letter);
    const Structure s = ideal(std::string("AA") + letter + "AA");
    const std::string name = s.residues[2].name;
    std::vector<Rotamer> expected;
    for (std::size_t k = 0; k < rotamer_count; ++k)
      if (rotamers[k].residue == name) expected.push_back(rotamers[k]);
    ASSERT_FALSE(expected.empty());
    std::vector<std::string> chis;
    for (int c = 1; c <= expected.front().chis; ++c) chis.push_back("chi" + std::to_string(c));
    Drawn drawn(s, "A:3:chi", {chis});
    // Moments of the circle, for every torsion: mean of exp(i chi) over the mixture of Gaussians.
    constexpr int n = 40'000;
    SampleStream stream(4, static_cast<std::uint64_t>(letter));
    std::array<std::array<double, 2>, 4> sum{};
    for (int k = 0; k < n; ++k) {
      drawn.draw(stream);
      for (std::size_t c = 0; c < chis.size(); ++c) {
        sum[c][0] += std::cos(drawn.angle(chis[c]));
        sum[c][1] += std::sin(drawn.angle(chis[c]));
      }
    }
    constexpr double degree = std::numbers::pi / 180.0;
    double total = 0.0;
    for (const Rotamer& rotamer : expected) total += rotamer.share;
    for (std::size_t c = 0; c < chis.size(); ++c) {
      double x = 0.0, y = 0.0;
      for (const Rotamer& rotamer : expected) {
        const double spread = degree * rotamer.spread[c];
        const double length = rotamer.share / total * std::exp(-0.5 * spread * spread);
        x += length * std::cos(degree * rotamer.mean[c]);
        y += length * std::sin(degree * rotamer.mean[c]);
      }
      EXPECT_NEAR(sum[c][0] / n, x, 5.0 / std::sqrt(n));
      EXPECT_NEAR(sum[c][1] / n, y, 5.0 / std::sqrt(n));
    }
  }
}

TEST(TorsionPrior, LeavesOtherTorsionsUniform) {
  Drawn drawn(read_structure(test::molecule_file("1ehz.pdb.gz")), "A:5:gamma", {{"gamma"}});
  SampleStream stream(5, 0);
  std::vector<double> counts(bins);
  for (int k = 0; k < 100'000; ++k) {
    drawn.draw(stream);
    ++counts[bin_of(drawn.q[0])];
  }
  EXPECT_LT(worst_deviation(counts, std::vector<double>(bins, 1.0)), 4.5);
}

TEST(TorsionPrior, RefusesStatisticsWithASpread) {
  const Molecule molecule(ideal("AAA"));
  const DofSelection selection = molecule.select(select_torsions(molecule, "all", false));
  EXPECT_THROW(TorsionPrior(molecule, selection, Prior::ramachandran, 0.1, {}), ModelError);
}

}  // namespace torsion_prior_test
}  // namespace hinge::molecular
