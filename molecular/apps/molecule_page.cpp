// SPDX-License-Identifier: BSD-3-Clause
// Writes the data of the page: docs/reference/report.md.
#include "molecule_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "hinge/core/id.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge_tools/counted.hpp"
#include "report.hpp"

namespace biocd {

using namespace hinge::molecular;
using hinge::tool::counted;
using hinge::tool::packed;

namespace {

constexpr std::size_t most_atoms = 20000;  // more are slow to draw
constexpr std::size_t most_rows = 1000;    // pairs of one conformation
constexpr std::uint32_t not_shown = ~std::uint32_t{0};

/// The shown atoms in order, and the place of each atom of the structure among them.
struct Subset {
  std::vector<std::uint32_t> atoms;
  std::vector<std::uint32_t> place;  // or not_shown
  std::string sentence;              // how the subset was made; empty: all atoms
};

bool is_trace(const Structure& s, std::uint32_t atom) {
  const ResidueKind kind = s.residues[s.atoms[atom].residue].kind;
  return (kind == ResidueKind::amino_acid && s.atoms[atom].name == "CA") ||
         (kind == ResidueKind::nucleotide && s.atoms[atom].name == "P");
}

Subset subset_of(const Structure& s, const std::vector<PageFrame>& frames) {
  Subset subset;
  std::vector<bool> shown(s.atoms.size(), s.atoms.size() <= most_atoms);
  if (s.atoms.size() > most_atoms) {
    std::size_t traces = 0, count = 0;
    for (std::uint32_t i = 0; i < s.atoms.size(); ++i) traces += is_trace(s, i) ? 1U : 0U;
    const std::size_t stride = traces / (most_atoms / 2) + 1;  // half of the atoms go to residues with clashes
    traces = 0;
    for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
      if (is_trace(s, i) && traces++ % stride == 0) {
        shown[i] = true;
        ++count;
      }
    const auto show_residue_of = [&](hinge::PrimitiveId i) {
      const Residue& residue = s.residues[s.atoms[hinge::index(i)].residue];
      for (std::uint32_t a = residue.first_atom; a < residue.last_atom; ++a) {
        count += shown[a] ? 0U : 1U;
        shown[a] = true;
      }
    };
    for (const PageFrame& frame : frames)
      for (const Contact& pair : frame.pairs) {
        if (count >= most_atoms) break;
        show_residue_of(pair.hit.first);
        show_residue_of(pair.hit.second);
      }
    subset.sentence =
        fmt::format("{} of {} are shown: {} CA and P atom, and residues with colliding pairs", count,
                    counted(s.atoms.size(), "atom"), stride == 1 ? "every" : fmt::format("one in {}", stride));
  }
  subset.place.assign(s.atoms.size(), not_shown);
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
    if (shown[i]) {
      subset.place[i] = static_cast<std::uint32_t>(subset.atoms.size());
      subset.atoms.push_back(i);
    }
  return subset;
}

/// The grid of the coordinates: x = origin + unit * integer.
struct Grid {
  hinge::Vec3 origin = hinge::Vec3::Zero();
  double unit = 0.01;  // angstrom
};

Grid grid_of(const std::vector<PageFrame>& frames, const Subset& subset) {
  hinge::Vec3 low = hinge::Vec3::Zero(), high = low;
  bool first = true;
  for (const PageFrame& frame : frames)
    for (const std::uint32_t i : subset.atoms) {
      const hinge::Vec3& p = frame.positions[i];
      low = first ? p : hinge::Vec3(low.cwiseMin(p));
      high = first ? p : hinge::Vec3(high.cwiseMax(p));
      first = false;
    }
  Grid grid;
  grid.origin = 0.5 * (low + high);
  grid.unit = std::max(grid.unit, 0.5 * (high - low).maxCoeff() / 32767.0);
  return grid;
}

Json molecule_json(const Job& job, const Subset& subset, const Grid& grid) {
  const Structure& s = job.molecule->structure();
  Json residues = Json::array(), names = Json::array(), elements = Json::array();
  for (const Residue& residue : s.residues) {
    const std::string& chain = s.chains[residue.chain].name;
    std::string number = std::to_string(residue.sequence_number);
    if (residue.insertion_code != '\0') number += residue.insertion_code;
    residues.push_back({chain.empty() ? "_" : chain, residue.name, number, residue.kind == ResidueKind::other ? 1 : 0});
  }
  std::vector<std::uint32_t> of_atom;
  std::vector<std::uint8_t> moving;
  for (const std::uint32_t i : subset.atoms) {
    names.push_back(s.atoms[i].name);
    elements.push_back(s.atoms[i].element);
    of_atom.push_back(s.atoms[i].residue);
    moving.push_back(job.checker.group_of(i) == hinge::GroupId{} ? 0 : 1);
  }
  std::vector<std::uint32_t> bonds;
  for (const Bond& bond : s.bonds)
    if (subset.place[bond.first] != not_shown && subset.place[bond.second] != not_shown)
      for (const std::uint32_t end : {bond.first, bond.second}) bonds.push_back(subset.place[end]);
  Json json{{"residues", std::move(residues)},
            {"atoms", {{"names", std::move(names)}, {"elements", std::move(elements)}, {"residues", packed(of_atom)}}},
            {"bonds", packed(bonds)},
            {"moving", packed(moving)},
            {"origin", {grid.origin.x(), grid.origin.y(), grid.origin.z()}},
            {"unit", grid.unit}};
  json["cut"] = subset.sentence.empty() ? Json() : Json(subset.sentence);
  return json;
}

Json frame_json(const Job& job, const PageFrame& frame, std::size_t place, const Subset& subset, const Grid& grid) {
  std::vector<std::int16_t> coordinates;
  coordinates.reserve(3 * subset.atoms.size());
  for (const std::uint32_t i : subset.atoms)
    for (int axis = 0; axis < 3; ++axis)
      coordinates.push_back(
          static_cast<std::int16_t>(std::lround((frame.positions[i][axis] - grid.origin[axis]) / grid.unit)));
  std::vector<const Contact*> rows;
  for (const Contact& pair : frame.pairs)
    if (subset.place[hinge::index(pair.hit.first)] != not_shown &&
        subset.place[hinge::index(pair.hit.second)] != not_shown)
      rows.push_back(&pair);
  std::ranges::stable_sort(rows, {}, [](const Contact* pair) { return pair->hit.distance - pair->hit.threshold; });
  rows.resize(std::min(rows.size(), most_rows));
  Json pairs = Json::array();
  for (const Contact* pair : rows)
    pairs.push_back({subset.place[hinge::index(pair->hit.first)], subset.place[hinge::index(pair->hit.second)],
                     rounded(pair->hit.distance), rounded(pair->hit.threshold), pair->collides ? 1 : 0,
                     rounded(severity_of(job.checker.thresholds(), pair->hit, pair->collides).overlap)});
  return {{"index", place},
          {"name", frame.name},
          {"collides", frame.collides},
          {"coordinates", packed(coordinates)},
          {"values", nullptr},
          {"pairs", std::move(pairs)},
          {"pairs_left_out", frame.pairs.size() - rows.size()}};
}

std::size_t colliding(const std::vector<Contact>& pairs) {
  return static_cast<std::size_t>(std::ranges::count_if(pairs, [](const Contact& pair) { return pair.collides; }));
}

}  // namespace

hinge::tool::ReportWords page_words(const Options& options, const Job& job) {
  hinge::tool::ReportWords words;
  words.title = options.file;
  words.tool = options.command_line.substr(0, options.command_line.find(' ', options.command_line.find(' ') + 1));
  words.command = options.command_line;
  words.question = question_words(options, job);
  words.files = input_files(options);
  words.notes = all_notes(job);
  return words;
}

MoleculePage::MoleculePage(const Options& options, const Job& job, bool is_path, bool counts_pairs)
    : options_(options),
      job_(job),
      file_(options.report),
      choice_(counts_pairs, is_path ? hinge::tool::ReportChoice::all : hinge::tool::ReportChoice::usual) {
  if (!wanted()) return;
  words_ = page_words(options, job);
  words_.is_path = is_path;
  words_.numbers_from = is_path ? 1 : 0;
  words_.frame_word = {"conformation", "conformations"};
}

void MoleculePage::offer(std::uint64_t index, const Verdict& verdict) {
  if (wanted()) choice_.offer(index, verdict.collides, colliding(verdict.pairs));
}

std::vector<std::uint64_t> MoleculePage::chosen() const {
  std::vector<std::uint64_t> list;
  for (const auto& shown : choice_.shown()) list.push_back(shown.index);
  return list;
}

void MoleculePage::add(PageFrame frame) {
  if (wanted()) frames_.push_back(std::move(frame));
}

void MoleculePage::add_next(PageFrame frame) {
  if (!wanted()) return;
  choice_.offer(frame.index, frame.collides, colliding(frame.pairs));
  add(std::move(frame));
}

void MoleculePage::write(const char* state, const std::string& verdict) {
  if (!wanted()) return;
  words_.state = state;
  words_.verdict = verdict;
  const Subset subset = subset_of(job_.molecule->structure(), frames_);
  const Grid grid = grid_of(frames_, subset);
  auto data = hinge::tool::report_head<Json>(words_, "molecule");
  choice_.describe(data, words_.numbers_from);
  data["frames"] = Json::array();
  const auto shown = choice_.shown();
  for (std::size_t k = 0; k < frames_.size(); ++k)
    data["frames"].push_back(frame_json(job_, frames_[k], shown[k].place, subset, grid));
  data["molecule"] = molecule_json(job_, subset, grid);
  hinge::tool::write_report_page(file_, hinge::tool::molecule_page(), data);
  fmt::print(options_.output == Output::table ? stdout : stderr, "{}report: {} shows {}\n",
             options_.output == Output::table ? "" : "note: ", options_.report,
             counted(frames_.size(), words_.frame_word[0], words_.frame_word[1]));
}

}  // namespace biocd
