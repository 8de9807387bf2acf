// SPDX-License-Identifier: BSD-3-Clause
// MoleculeDial: measures the choices of biocd dial and finds a recommendation.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dial_choices.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge_tools/dial_report.hpp"
#include "options.hpp"

namespace biocd {

class MoleculeDial {
 public:
  /// ensemble: files of conformations whose rigid groups are one of the choices; may be empty. Refers to the first two
  /// arguments.
  MoleculeDial(const Options& options, const Job& job, std::vector<std::string> ensemble);

  /// Measures for about options.dial_seconds.
  hinge::tool::DialReport run();

  /// Returns the recommended options, one with its values per line. Empty before run(), and if there are none.
  const std::vector<std::string>& settings() const { return settings_; }

 private:
  /// A choice of rules, atoms or torsions, and of a manner to ask.
  struct Selected {
    Variant variant;
    std::vector<std::string> lines;  // options that select the variant, one with its values each
    hinge::tool::Sound sound = hinge::tool::Sound::exact;
    Manner manner{};
  };

  hinge::molecular::Sampling sampling(std::uint64_t seed) const;
  Selected reference() const;
  std::vector<std::string> lines_of(const Selected& selected) const;
  std::string sentence(const Selected& selected, const hinge::tool::DialRow& row) const;

  void add(const char* kind, std::string name, const Selected& selected);
  /// Adds a choice of other rules or radii. line: its option. Nothing is added if the rules do not fit the molecule.
  void add_rules(const char* kind, std::string name, std::string line, hinge::molecular::CheckOptions check);
  void add_engines();
  void add_all_rules();
  void add_hydrogens();
  void add_fewer_torsions();
  void add_rigid_groups();
  void recommend();
  /// Measures a candidate on fresh conformations. Returns true if it keeps the limits and wins time.
  bool try_advice(const Selected& selected, double share);

  const Options& options_;
  const Job& job_;
  const std::vector<std::string> ensemble_;
  std::optional<double> sigma_;  // rad; nothing: uniform
  std::shared_ptr<Conformations> conformations_;
  hinge::tool::DialSection section_;
  std::vector<std::string> section_notes_;    // choices that were not measured
  std::map<std::string, Selected> selected_;  // by the name of the choice
  std::vector<std::string> settings_;
  hinge::tool::DialReport report_;
};

}  // namespace biocd
