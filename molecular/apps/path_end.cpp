// SPDX-License-Identifier: BSD-3-Clause
// Reads an end of a path: a list of degrees, or torsions measured from a model.
#include "path_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge_tools/input_file.hpp"
#include "hinge_tools/number_option.hpp"
#include "report.hpp"
#include "scene.hpp"

namespace biocd {

using namespace hinge::molecular;

namespace {

/// Reads numbers separated by blanks, by one comma, or by both. Calls refuse(message), which must throw, on a bad
/// number or if there are not `count` of them.
template <class Refuse>
std::vector<double> read_degrees(std::string_view text, std::size_t count, const Refuse& refuse) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<double> turns;
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    if (text.empty()) break;
    std::string_view word = text.substr(0, text.find_first_of(", \t\r\n"));
    text.remove_prefix(word.size());
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    const bool comma = text.starts_with(',');
    if (comma) text.remove_prefix(1);
    if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !(std::abs(value) <= hinge::tool::largest_value))
      refuse(
          fmt::format("value {} is '{}', expected a finite number of degrees, at most 1e+15", turns.size() + 1, word));
    turns.push_back(value);
    if (comma && text.find_first_not_of(blanks) == std::string_view::npos)
      refuse("ends with a comma, expected a value after it");
  }
  if (turns.size() != count)
    refuse(
        fmt::format("{} values, expected {}: the change from the reference, in degrees, for each DOF of the selection "
                    "(translations of placed parts in angstrom)",
                    turns.size(), count));
  return turns;
}

std::size_t find_model(const std::string& option, std::string_view number, const Structure& s) {
  int wanted = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), wanted);
  const auto found = std::find(s.model_numbers.begin(), s.model_numbers.end(), wanted);
  if (error == std::errc{} && end == number.data() + number.size() && found != s.model_numbers.end())
    return static_cast<std::size_t>(found - s.model_numbers.begin());
  throw hinge::ModelError(
      fmt::format("{} model '{}': expected the number of a model: {}{}", option, number, s.model_numbers.front(),
                  s.model_numbers.size() > 1 ? fmt::format(" ... {}", s.model_numbers.back()) : ""));
}

/// Returns the configuration (rad, angstrom) that fits the model: first its torsions, then the placements, because a
/// part is superposed after its own torsions are set.
std::vector<double> fit(const Job& job, const std::vector<hinge::Vec3>& model) {
  const Molecule& molecule = *job.molecule;
  const auto dofs = job.checker.selection().dofs();
  std::vector<double> q(dofs.size(), 0.0);
  for (std::size_t k = 0; k < q.size(); ++k)
    if (const std::size_t torsion = molecule.torsion_of(dofs[k]); torsion != Molecule::no_torsion)
      q[k] = turn_of(molecule, torsion, model);
  if (molecule.placed_parts().empty()) return q;
  Checker rebuilt = job.checker;
  rebuilt.check(q, Mode{Mode::Kind::any});
  const auto placements = fit_placements(molecule, rebuilt.positions(), model);
  for (std::size_t part = 0; part < placements.size(); ++part)
    for (std::size_t c = 0; c < 6; ++c)
      q[position_of(job, molecule.placed_parts()[part].dofs[c])] = placements[part][c];
  return q;
}

/// Converts the values of revolute DOF from degrees to rad.
std::vector<double> turned(const Job& job, std::vector<double> values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (turns(job, job.checker.selection().dofs()[k])) values[k] *= degree;
  return values;
}

}  // namespace

PathEnd read_path_end(const char* option, const std::string& text, const Job& job) {
  PathEnd end{text, {}, {}};
  const std::size_t count = job.checker.dof_count();
  if (text == "reference") {
    end.turns.assign(count, 0.0);
  } else if (text.starts_with("model:")) {
    const Structure& s = job.molecule->structure();
    const std::vector<hinge::Vec3>& model = s.models[find_model(option, std::string_view(text).substr(6), s)];
    try {
      end.turns = fit(job, model);
    } catch (const hinge::LoadError& error) {
      throw hinge::LoadError(fmt::format("{} {}: {}", option, text, error.what()));
    }
    Checker rebuilt = job.checker;
    rebuilt.check(end.turns, Mode{Mode::Kind::any});
    end.from_model = superpose(rebuilt.positions(), model);
  } else if (text.starts_with('@')) {
    const std::string path = text.substr(1);
    end.turns = turned(job, read_degrees(hinge::tool::read_whole(path), count,
                                         [&](const std::string& what) { throw hinge::LoadError(path + ": " + what); }));
  } else {
    end.turns = turned(job, read_degrees(text, count, [&](const std::string& what) {
                         throw hinge::ModelError(fmt::format("{} '{}': {}", option, text, what));
                       }));
  }
  return end;
}

std::string note_of(const PathEnd& end, const Job& job) {
  if (!end.from_model) return "";
  const Superposition& found = *end.from_model;
  return fmt::format(
      "{} is rebuilt from its selected torsions, with bond lengths, bond angles and other torsions of the reference: "
      "{:.3f} angstrom RMSD from the model, at most {:.3f} ({})",
      end.text, found.rmsd, found.farthest, label(job.molecule->structure(), found.atom));
}

}  // namespace biocd
