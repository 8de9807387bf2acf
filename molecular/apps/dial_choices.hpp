// SPDX-License-Identifier: BSD-3-Clause
// The choices that biocd dial measures, and the conformations about which they are asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/closed_sampler.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge_tools/dial.hpp"
#include "options.hpp"

namespace biocd {

/// The conformations of one round, which all choices share: those of `biocd sample` with these options.
class Conformations {
 public:
  /// sampling: seed and distribution. Refers to the job.
  Conformations(const Job& job, const hinge::molecular::Sampling& sampling);

  /// Makes questions first .. first + count - 1 available to at().
  void prepare(std::uint64_t first, std::size_t count);
  /// Returns one value per free DOF; empty if no start of a conformation with closed cycles closed.
  std::span<const double> at(std::uint64_t k) const;

 private:
  const Job& job_;
  hinge::molecular::Sampling sampling_;
  std::optional<hinge::molecular::ClosedSampler> closed_;
  std::uint64_t first_ = 0;
  std::vector<std::vector<double>> drawn_;
};

/// A checker for other rules, other atoms or fewer free torsions than the job's.
struct Variant {
  hinge::molecular::Checker checker;
  /// For each of its DOF: the DOF of the job with the same torsion or placement; nothing: it stays at the reference.
  std::vector<std::optional<std::size_t>> sources;
};

/// Finds the DOF of the job for each DOF of the checker: by residue and name of the torsion.
Variant make_variant(const Job& job, hinge::molecular::Checker checker);

/// How the conformations are asked about.
struct Manner {
  bool in_blocks = false;  ///< sixteen at a time, as `sample --mode any`
  unsigned threads = 1;
};

/// Makes a choice that answers yes or no.
hinge::tool::DialChoice make_choice(std::string kind, std::string name, std::string options, hinge::tool::Sound sound,
                                    const Variant& variant, std::shared_ptr<Conformations> conformations,
                                    const Manner& manner = {});

/// Returns the standard deviation (rad) at which about half of the conformations collide, or nothing if the reference
/// collides.
std::optional<double> balanced_sigma(const Job& job, std::uint64_t seed);

/// Returns the choices about straight paths: a proof, and samples at several distances.
hinge::tool::DialSection path_section(const Job& job, const hinge::molecular::Sampling& sampling);

}  // namespace biocd
