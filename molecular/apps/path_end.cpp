// SPDX-License-Identifier: BSD-3-Clause
// Reads an end of a path: a list of degrees, or coordinates that the torsions are fitted to.
#include "path_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/molecular/fit_torsions.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "hinge_tools/counted.hpp"
#include "hinge_tools/input_file.hpp"
#include "hinge_tools/number_option.hpp"
#include "report.hpp"

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

/// A file of coordinates, and a number after it.
struct NamedFile {
  std::string path, number;
};

bool has_structure(const std::string& path) {
  return std::ranges::any_of(std::array{".pdb", ".ent", ".cif", ".mmcif", ".pqr"}, [&](const char* extension) {
    return path.ends_with(extension) || path.ends_with(std::string(extension) + ".gz");
  });
}
bool has_trajectory(const std::string& path) {
  return std::ranges::any_of(std::array{".dcd", ".xtc", ".npy"}, [&](const char* extension) {
    return path.ends_with(extension) || path.ends_with(std::string(extension) + ".gz");
  });
}

/// Returns the file that the text names by an extension of a structure or trajectory; nothing for other texts.
std::optional<NamedFile> named_file(const std::string& text) {
  NamedFile named{text, ""};
  if (const std::size_t colon = text.rfind(':');
      colon != std::string::npos && text.find_first_not_of("0123456789", colon + 1) == std::string::npos)
    named = {text.substr(0, colon), text.substr(colon + 1)};
  if (!has_structure(named.path) && !has_trajectory(named.path)) return std::nullopt;
  return named;
}

TargetCoordinates read_target(const std::string& option, const NamedFile& named, const Options& options,
                              const Job& job) {
  const Structure& s = job.molecule->structure();
  if (has_structure(named.path)) {
    ReadOptions read = options.read;
    read.model.reset();
    read.first_model = true;
    int number = 0;
    const auto [end, error] = std::from_chars(named.number.data(), named.number.data() + named.number.size(), number);
    if (!named.number.empty() && error != std::errc{})
      throw hinge::ModelError(fmt::format("{} model '{}': expected the number of a model", option, named.number));
    if (!named.number.empty()) read.model = number;
    return match_atoms(s, read_structure(named.path, read), named.path);
  }
  const Trajectory file(named.path, s, options.read, true);
  std::size_t frame = 0;
  const auto [end, error] = std::from_chars(named.number.data(), named.number.data() + named.number.size(), frame);
  if (error != std::errc{} ? file.size() != 1 : frame >= file.size())
    throw hinge::ModelError(fmt::format("{} {}{}{}: the file has {}, expected one of them as in {}:0", option,
                                        named.path, named.number.empty() ? "" : ":", named.number,
                                        hinge::tool::counted(file.size(), "frame"), named.path));
  return all_atoms(file.kept(file.frame(frame)));
}

/// Converts the values of revolute DOF from degrees to rad.
std::vector<double> turned(const Job& job, std::vector<double> values) {
  for (std::size_t k = 0; k < values.size(); ++k)
    if (turns(job, job.checker.selection().dofs()[k])) values[k] *= degree;
  return values;
}

}  // namespace

PathEnd read_path_end(const char* option, const std::string& text, const Options& options, const Job& job,
                      const FitOptions& fit, const std::function<bool()>& stop) {
  PathEnd end{text, {}};
  const std::size_t count = job.checker.dof_count();
  const std::optional<NamedFile> named = named_file(text);
  if (text == "reference") {
    end.turns.assign(count, 0.0);
  } else if (text.starts_with("model:") || named) {
    const Structure& s = job.molecule->structure();
    end.target = named ? read_target(option, *named, options, job)
                       : all_atoms(s.models[find_model(option, std::string_view(text).substr(6), s)]);
    end.fitted = fit_coordinates(job.checker, end.target, fit, stop);
    end.turns = end.fitted->q;
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

void take_shorter_way(const Job& job, PathEnd& from, PathEnd& to) {
  PathEnd& end = to.fitted ? to : from;
  const PathEnd& near = to.fitted ? from : to;
  if (!end.fitted) return;
  for (std::size_t k = 0; k < end.turns.size(); ++k)
    if (turns(job, job.checker.selection().dofs()[k]))
      hinge::molecular::take_shorter_way(std::span(near.turns).subspan(k, 1), std::span(end.turns).subspan(k, 1));
}

std::string shown(const PathEnd& end) {
  constexpr std::size_t most = 30;  // characters shown of a list
  return end.text.size() > most ? end.text.substr(0, most) + "..." : end.text;
}

Json end_json(const Job& job, const PathEnd& end) {
  Json json{{"given", end.text},
            {"turns", in_degrees(job, end.turns)},
            {"model_rmsd", Json()},
            {"model_farthest", Json()},
            {"model_atoms", Json()}};
  if (end.fitted) {
    json["model_rmsd"] = rounded(end.fitted->rmsd);
    json["model_farthest"] = rounded(end.fitted->farthest);
    json["model_atoms"] = end.target.atoms.size();
  }
  return json;
}

std::string file_of_end(const std::string& text) {
  if (text.starts_with('@')) return text.substr(1);
  const std::optional<NamedFile> named = named_file(text);
  return named ? named->path : "";
}

std::string note_of(const PathEnd& end, const Job& job) {
  if (!end.fitted) return "";
  const Structure& s = job.molecule->structure();
  return fmt::format(
      "{} is fitted by the selected torsions; bond lengths, bond angles and other torsions are those of the reference: "
      "{:.3f} angstrom RMSD over {} of {}, at most {:.3f} ({})",
      end.text, end.fitted->rmsd, end.target.atoms.size(), hinge::tool::counted(s.atoms.size(), "atom"),
      end.fitted->farthest, label(s, end.fitted->atom));
}

}  // namespace biocd
