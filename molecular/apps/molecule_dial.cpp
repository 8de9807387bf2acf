// SPDX-License-Identifier: BSD-3-Clause
// Implements MoleculeDial.
#include "molecule_dial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <thread>
#include <utility>

#include "dial_extremes.hpp"
#include "dial_scene.hpp"
#include "hinge/core/error.hpp"
#include "hinge/molecular/clash_rules.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge_tools/measure.hpp"
#include "hinge_tools/settings_file.hpp"
#include "scene.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::DialReport;
using hinge::tool::DialRow;
using hinge::tool::options_text;
using hinge::tool::Sound;

namespace {

constexpr double smallest_gain = 1.03;  // a choice must win this much to be recommended
constexpr double conformations_share = 0.55, paths_share = 0.2, check_share = 0.25;  // of --time
constexpr std::size_t most_candidates = 3;    // for the recommendation, tried in turn
constexpr double usual_sigma = 5.0 * degree;  // rad, for a reference that collides
constexpr const char* reference_name = "the given options";

}  // namespace

MoleculeDial::MoleculeDial(const Options& options, const Job& job, std::vector<std::string> ensemble)
    : options_(options), job_(job), ensemble_(std::move(ensemble)) {
  report_.seed = options.seed;
  report_.seconds = options.dial.seconds;
  report_.limits = options.dial.limits();
}

DialReport MoleculeDial::run() {
  std::string how = "uniform over the full turn";
  if (!options_.uniform) {
    sigma_ =
        options_.sigma_degrees ? std::optional(*options_.sigma_degrees * degree) : balanced_sigma(job_, options_.seed);
    if (!sigma_) {
      section_notes_.emplace_back(
          "the reference collides, so sigma was not chosen for it; --exempt-reference leaves "
          "its pairs out");
      sigma_ = usual_sigma;
    }
    how = fmt::format("about the reference, sigma {:.3g} degrees", *sigma_ / degree);
  }
  report_.requirements = study_scene(job_);
  conformations_ = std::make_shared<Conformations>(job_, sampling(options_.seed));
  section_.title = "Conformations";
  section_.unit = {"conformation", "conformations"};
  section_.population = fmt::format("{}, seed {}", how, options_.seed);
  section_.length_unit = "angstrom";
  add("rules", reference_name, reference());
  add_engines();
  add_all_rules();
  add_hydrogens();
  add_fewer_torsions();
  add_rigid_groups();
  report_.sections.push_back(
      measure(std::move(section_), {options_.dial.seconds * conformations_share, options_.dial.count}));
  for (std::string& note : section_notes_) report_.sections.back().notes.push_back(std::move(note));
  if (job_.kept.closures.empty() && options_.loop.empty())
    report_.sections.push_back(measure(path_section(job_, sampling(options_.seed)),
                                       {options_.dial.seconds * paths_share, options_.dial.count}));
  else
    report_.sections.back().notes.emplace_back(
        "paths: not measured, because a straight path does not keep cycles closed");
  recommend();
  if (options_.dial.extremes) report_.extremes = find_extremes(job_, sampling(options_.seed));
  return std::move(report_);
}

Sampling MoleculeDial::sampling(std::uint64_t seed) const { return {seed, sigma_}; }

MoleculeDial::Selected MoleculeDial::reference() const {
  return {make_variant(job_, job_.checker), {}, Sound::exact, {}};
}

std::vector<std::string> MoleculeDial::lines_of(const Selected& selected) const {
  std::vector<std::string> lines = selected.lines;
  if (selected.manner.in_blocks) lines.emplace_back("--mode any");
  if (selected.manner.threads > 1) lines.push_back(fmt::format("--threads {}", selected.manner.threads));
  return lines;
}

std::string MoleculeDial::sentence(const Selected& selected, const DialRow& row) const {
  std::string what = options_text(selected.lines);
  const auto append = [&](const std::string& part) { what += (what.empty() ? "" : "; ") + part; };
  if (selected.manner.in_blocks) append("sixteen conformations at a time");
  if (selected.manner.threads > 1) append(fmt::format("{} threads", selected.manner.threads));
  what += fmt::format(": {:.2f} times faster, ", row.speed.value);
  what += selected.sound == Sound::exact
              ? "exact"
              : fmt::format("{} false accepts, {} false rejects", hinge::tool::rate_text(row.accept_rate()),
                            hinge::tool::rate_text(row.reject_rate()));
  return what + "; no other measured choice is faster with " + hinge::tool::limits_text(report_.limits);
}

void MoleculeDial::add(const char* kind, std::string name, const Selected& selected) {
  selected_.emplace(name, selected);
  section_.choices.push_back(make_choice(kind, std::move(name), options_text(lines_of(selected)), selected.sound,
                                         selected.variant, conformations_, selected.manner));
}

void MoleculeDial::add_rules(const char* kind, std::string name, std::string line, CheckOptions check) {
  try {
    check.scope = read_scope(options_, job_.molecule->structure());
    Checker checker(job_.molecule, job_.checker.selection(), check);
    add(kind, std::move(name), {make_variant(job_, std::move(checker)), {std::move(line)}, Sound::unknown, {}});
  } catch (const hinge::ModelError& error) {
    section_notes_.push_back(fmt::format("{}: left out: {}", name, error.what()));
  }
}

void MoleculeDial::add_engines() {
  for (const char* engine : {"simd", "lazy", "brute"}) {
    if (options_.check.engine == engine) continue;
    CheckOptions check = options_.check;
    check.engine = engine;
    check.scope = read_scope(options_, job_.molecule->structure());
    Selected other = reference();
    other.variant.checker = Checker(job_.molecule, job_.checker.selection(), check);
    section_.choices.push_back(make_choice("engine", fmt::format("engine {}", engine),
                                           fmt::format("--engine {}", engine), Sound::exact, other.variant,
                                           conformations_));
    section_.choices.back().distance = {};
  }
  Selected blocks = reference();
  blocks.manner.in_blocks = true;
  add("block", "sixteen at a time", blocks);
  for (unsigned threads = 2; threads <= std::thread::hardware_concurrency(); threads *= 2) {
    Selected shared = reference();
    shared.manner.threads = threads;
    add("threads", fmt::format("{} threads", threads), shared);
  }
}

void MoleculeDial::add_all_rules() {
  const Thresholds& used = job_.checker.thresholds();
  const bool biocd_rules = used.rules->name == std::string_view("biocd");
  const CheckOptions given = options_.check;
  if (biocd_rules) {
    for (const RadiiSet& set : radii_sets()) {
      if (set.name == used.radii) continue;
      CheckOptions check = given;
      check.thresholds.radii = std::string(set.name);
      add_rules("radii", fmt::format("radii {}", set.name), fmt::format("--radii {}", set.name), check);
    }
    for (const double rho : {0.7, 0.75, 0.8, 0.85, 0.9}) {
      if (used.rho && std::abs(*used.rho - rho) < 1e-9) continue;
      CheckOptions check = given;
      check.thresholds.rho = rho;
      add_rules("rho", fmt::format("rho {}", rho), fmt::format("--rho {}", rho), check);
    }
    CheckOptions check = given;
    check.thresholds.hydrogen_bonds = !used.hydrogen_bonds;
    const char* word = used.hydrogen_bonds ? "off" : "on";
    add_rules("hydrogen bonds", fmt::format("hydrogen-bond rule {}", word), fmt::format("--hbond {}", word), check);
  }
  for (const ClashRules& rules : all_clash_rules()) {
    if (rules.name == used.rules->name) continue;
    CheckOptions check = given;
    check.thresholds = {};
    check.thresholds.rules = std::string(rules.name);
    check.min_bonds.reset();
    add_rules("rules", fmt::format("rules {}", rules.name), fmt::format("--rules {}", rules.name), check);
  }
}

void MoleculeDial::add_hydrogens() {
  const Structure& s = job_.molecule->structure();
  const bool has_hydrogens = std::ranges::any_of(s.atoms, [](const auto& atom) { return atom.element == "H"; });
  if (!has_hydrogens || !job_.kept.closures.empty()) return;
  for (const char* radii : {"bondi", "probe-united"}) {
    const std::string name = fmt::format("without hydrogens, radii {}", radii);
    Options other = options_;
    other.read.keep_hydrogens = false;
    other.check.thresholds = {};
    other.check.thresholds.radii = radii;
    other.check.min_bonds.reset();
    try {
      const Job job = load(other);
      add("hydrogens", name,
          {make_variant(job_, job.checker),
           {"--hydrogens drop", fmt::format("--radii {}", radii)},
           Sound::unknown,
           {}});
    } catch (const hinge::ModelError& error) {
      section_notes_.push_back(fmt::format("{}: left out: {}", name, error.what()));
    }
  }
}

void MoleculeDial::recommend() {
  std::vector<std::pair<double, Selected>> models;  // by speed
  Manner best;
  double fastest_threads = 0.0;
  for (const DialRow& row : report_.sections.front().rows) {
    const auto found = selected_.find(row.name);
    if (found == selected_.end() || row.speed.low < smallest_gain || !keeps(row, report_.limits)) continue;
    const Manner& manner = found->second.manner;
    if (row.kind == "block") best.in_blocks = true;
    if (row.kind == "threads" && row.speed.value > fastest_threads) {
      fastest_threads = row.speed.value;
      best.threads = manner.threads;
    }
    if (row.kind != "block" && row.kind != "threads") models.emplace_back(row.speed.value, found->second);
  }
  std::ranges::sort(models, [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Selected> candidates;
  for (const auto& [speed, model] : models) {
    candidates.push_back(model);
    candidates.back().manner = best;
  }
  if (best.in_blocks || best.threads > 1) {
    candidates.push_back(reference());
    candidates.back().manner = best;
  }
  if (best.in_blocks && best.threads > 1) {
    candidates.push_back(reference());
    candidates.back().manner.threads = best.threads;
  }
  candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(std::min(most_candidates, candidates.size())),
                   candidates.end());
  for (const Selected& candidate : candidates)
    if (try_advice(candidate, check_share / static_cast<double>(candidates.size()))) return;
  report_.advice.text = fmt::format("keep {}, one conformation at a time: no other measured choice is faster with {}",
                                    reference_name, hinge::tool::limits_text(report_.limits));
}

bool MoleculeDial::try_advice(const Selected& selected, double share) {
  const auto fresh = std::make_shared<Conformations>(job_, sampling(options_.seed + 1));
  const std::vector<std::string> lines = lines_of(selected);
  const auto row = confirm(make_choice("rules", reference_name, "", Sound::exact, reference().variant, fresh),
                           make_choice("recommended", "recommended", options_text(lines), selected.sound,
                                       selected.variant, fresh, selected.manner),
                           {options_.dial.seconds * share, options_.dial.count}, report_.limits);
  if (!row) return false;
  report_.advice = {sentence(selected, *row), options_text(lines), row, fmt::format("seed {}", options_.seed + 1)};
  settings_ = lines;
  return true;
}

}  // namespace biocd
