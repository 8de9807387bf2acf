// SPDX-License-Identifier: BSD-3-Clause
// Overlapping atoms of real proteins with hydrogens beside those of king-probe (Debian's Probe, which shares no code):
// radius by radius and pair by pair, where it is installed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "molecular/test_files.hpp"
#include "tool/run_tool.hpp"

namespace hinge::molecular {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

constexpr int bonds_left_out = 3;      // Probe's -3: what up to three bonds join is no contact
constexpr double probe_radius = 0.25;  // angstrom, Probe's default: pairs up to twice as far apart are contacts
constexpr double dots_per_area = 32;   // on each atom's sphere, per square angstrom; Probe's default is 16

/// Angstrom: half of the last digit of a gap as Probe prints it, and its floats: five roundings of numbers below 4.
constexpr double printed = 0.0005 + 5 * 0x1p-23;

std::string trimmed(const std::string& text, std::size_t at, std::size_t size) {
  const std::string field = text.substr(std::min(at, text.size()), size);
  const std::size_t first = field.find_first_not_of(' ');
  return first == std::string::npos ? "" : field.substr(first, field.find_last_not_of(' ') - first + 1);
}

/// What Probe says of a pair in contact, from either side.
struct ProbeContact {
  double gap = 0.0;            ///< distance less both radii, angstrom
  bool dots_inside = false;    ///< a dot of one atom is inside the other
  bool hydrogen_bond = false;  ///< one of them is excused as a hydrogen bond
};

/// One conformer of a real protein, with hydrogens, as both programs are handed it.
class Subject {
 public:
  explicit Subject(const std::string& file) : pdb_(""), dump_("") {
    ReadOptions options;
    options.model = 1;
    const Structure whole = read_structure(test::shared_molecules() / file, options);
    {
      std::ofstream out(pdb_.path());
      write_pdb_model(out, whole, whole.models.front(), 1);
      out << "END\n";
    }
    molecule_ = std::make_shared<const Molecule>(read_structure(pdb_.path()));
    for (std::uint32_t i = 0; i < size(); ++i) atoms_.emplace(name(i), i);
    ask_probe();
    CheckOptions rules;
    rules.thresholds.radii = "probe";
    rules.thresholds.rho = 1.0;
    rules.thresholds.hydrogen_bonds = false;
    rules.min_bonds = bonds_left_out + 1;
    checker_.emplace(molecule_, molecule_->select({}), rules);
  }

  const Structure& structure() const { return molecule_->structure(); }
  std::size_t size() const { return structure().atoms.size(); }
  const Vec3& position(std::uint32_t i) const { return structure().models.front()[i]; }
  Checker& checker() { return *checker_; }
  /// Of our own set, angstrom.
  double radius(std::uint32_t i) const {
    const auto type = checker_->thresholds().matrix.type(id<PrimitiveId>(i));
    return checker_->thresholds().between(type, type) / 2;
  }
  double probe_radius_of(std::uint32_t i) const { return radii_.at(i); }
  const std::map<Pair, ProbeContact>& contacts() const { return contacts_; }

 private:
  /// As Probe prints an atom: chain, number, insertion code, residue, atom.
  std::string name(std::uint32_t i) const {
    const Atom& atom = structure().atoms[i];
    const Residue& residue = structure().residues[atom.residue];
    return structure().chains[residue.chain].name + '/' + std::to_string(residue.sequence_number) +
           (residue.insertion_code != '\0' ? std::string(1, residue.insertion_code) : "") + '/' + residue.name + '/' +
           atom.name;
  }
  std::uint32_t atom(const std::string& text, std::size_t chain, std::size_t number, std::size_t residue,
                     std::size_t name) const {
    return atoms_.at(trimmed(text, chain, 2) + '/' + trimmed(text, number, 5) + '/' + trimmed(text, residue, 3) + '/' +
                     trimmed(text, name, 4));
  }
  void ask_probe();

  test::TemporaryFile pdb_, dump_;
  std::shared_ptr<const Molecule> molecule_;
  std::map<std::string, std::uint32_t> atoms_;
  std::map<std::uint32_t, double> radii_;
  std::map<Pair, ProbeContact> contacts_;
  std::optional<Checker> checker_;
};

void Subject::ask_probe() {
  std::ostringstream arguments;
  arguments << "-quiet -3 -mc -nolimit -nofacehbond -unformated -condense -density" << dots_per_area << " -dumpatoms "
            << dump_.path().string() << " -self all " << pdb_.path().string() << " 2>/dev/null";
  std::istringstream said(test::run_tool("king-probe", arguments.str()).out);
  for (std::string line; std::getline(said, line);) {
    std::vector<std::string> fields;
    std::istringstream parts(line);
    for (std::string field; std::getline(parts, field, ':');) fields.push_back(field);
    ASSERT_GT(fields.size(), 6U) << line;
    // " A   1 ASN  CA "
    const std::uint32_t i = atom(fields[3], 0, 2, 7, 11), j = atom(fields[4], 0, 2, 7, 11);
    ProbeContact& contact = contacts_[std::minmax(i, j)];
    contact.gap = std::stod(fields[6]);
    const std::string& kind = fields[2];  // wide contact, close contact, small overlap, bad overlap, hydrogen bond
    contact.dots_inside = contact.dots_inside || kind == "so" || kind == "bo" || kind == "hb";
    contact.hydrogen_bond = contact.hydrogen_bond || kind == "hb";
  }
  std::ifstream dump(dump_.path());
  for (std::string line; std::getline(dump, line);)  // " A ASN  46 HD22 B  13.813   2.856  14.433  1.05 ..."
    radii_[atom(line, 0, 6, 3, 11)] = std::stod(line.substr(41, 6));
}

/// Probe's dots, recounted: how many of them a pair should have on the sphere of one of its atoms. A dot is put where
/// the small probe that touches the sphere there touches the other atom too, no atom is deeper over it than the other,
/// and no atom that is bonds_left_out bonds away or nearer covers it.
class Dots {
 public:
  explicit Dots(const Subject& subject) : subject_(subject) {
    // A Fibonacci lattice: equal areas, and not Probe's dots.
    const double golden = std::numbers::pi * (1.0 + std::sqrt(5.0));
    for (std::size_t k = 0; k < count; ++k) {
      const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / count, r = std::sqrt(1.0 - z * z);
      const double turn = golden * (static_cast<double>(k) + 0.5);
      directions_.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
  }

  double expected(std::uint32_t on, std::uint32_t with) const {
    const std::vector<Neighbour> neighbours = around(on, with);
    std::size_t seen = 0;
    for (const Vec3& direction : directions_) seen += sees(on, with, neighbours, direction) ? 1 : 0;
    const double r = subject_.radius(on);
    return dots_per_area * 4 * std::numbers::pi * r * r * static_cast<double>(seen) / count;
  }

 private:
  static constexpr std::size_t count = 20000;

  struct Neighbour {
    std::uint32_t atom;
    bool bonded;
  };

  double gap(const Vec3& x, std::uint32_t i) const { return (x - subject_.position(i)).norm() - subject_.radius(i); }
  /// Atoms that the small probe can touch, but for the two.
  std::vector<Neighbour> around(std::uint32_t on, std::uint32_t with) const {
    std::vector<Neighbour> found;
    for (std::uint32_t i = 0; i < subject_.size(); ++i)
      if (i != on && i != with && gap(subject_.position(on), i) <= subject_.radius(on) + 2 * probe_radius)
        found.push_back({i, bond_distance(subject_.structure(), on, i, bonds_left_out) >= 0});
    return found;
  }
  bool sees(std::uint32_t on, std::uint32_t with, const std::vector<Neighbour>& neighbours,
            const Vec3& direction) const {
    const Vec3 dot = subject_.position(on) + subject_.radius(on) * direction;
    const Vec3 probe = dot + probe_radius * direction;
    if (gap(probe, with) > probe_radius) return false;
    const double depth = gap(dot, with);
    return std::none_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& n) {
      return n.bonded ? gap(dot, n.atom) <= 0.0 : gap(dot, n.atom) < depth && gap(probe, n.atom) <= probe_radius;
    });
  }

  const Subject& subject_;
  std::vector<Vec3> directions_;
};

/// The parts of the comparison; each says what differs.
class Comparison {
 public:
  explicit Comparison(const std::string& file) : subject_(file), dots_(subject_) {}

  void radii() {
    std::size_t carbonyls_of_other_residues = 0;
    const auto classes = classify_atoms(subject_.structure());
    for (std::uint32_t i = 0; i < subject_.size(); ++i) {
      // Probe knows carbonyls of the residues it knows; bonds tell us about all.
      const bool excused = classes[i] == AtomClass::carbon_carbonyl && !standard(i);
      carbonyls_of_other_residues += excused ? 1 : 0;
      EXPECT_NEAR(subject_.radius(i), subject_.probe_radius_of(i) - (excused ? 0.05 : 0.0), 1e-9) << name(i);
    }
    std::printf("%zu radii, %zu of them carbonyls of residues Probe does not know\n", subject_.size(),
                carbonyls_of_other_residues);
  }

  void overlaps() {
    std::map<Pair, double> ours;                                  // distance less Probe's radii
    const Mode mode{Mode::Kind::within, 2 * probe_radius + 0.1};  // carbonyls of both atoms included
    const Verdict verdict = subject_.checker().check_coordinates(subject_.structure().models.front(), mode);
    for (const Contact& pair : verdict.pairs) {
      const auto i = static_cast<std::uint32_t>(index(pair.hit.first)),
                 j = static_cast<std::uint32_t>(index(pair.hit.second));
      ours[{i, j}] = pair.hit.gap() + subject_.radius(i) - subject_.probe_radius_of(i) + subject_.radius(j) -
                     subject_.probe_radius_of(j);
    }
    for (const auto& [pair, contact] : subject_.contacts()) {
      const auto same = ours.find(pair);
      if (same == ours.end())
        ADD_FAILURE() << "Probe alone: " << name(pair.first) << ' ' << name(pair.second) << ' ' << contact.gap;
      else
        EXPECT_NEAR(same->second, contact.gap, printed) << name(pair.first) << ' ' << name(pair.second);
    }
    std::size_t overlapping = 0, hidden = 0;
    double deepest = 0.0, most_dots = 0.0;
    for (const auto& [pair, gap] : ours) {
      if (gap >= 0.0) continue;
      ++overlapping;
      if (subject_.contacts().contains(pair)) continue;
      ++hidden;
      const double dots = std::max(dots_.expected(pair.first, pair.second), dots_.expected(pair.second, pair.first));
      // Less than the area of this many dots may lie between them.
      EXPECT_LT(dots, 2.0) << "without a dot: " << name(pair.first) << ' ' << name(pair.second) << ' ' << gap;
      deepest = std::min(deepest, gap);
      most_dots = std::max(most_dots, dots);
    }
    EXPECT_GT(overlapping, 100U);
    std::printf(
        "%zu contacts with the same gap; of %zu overlaps %zu have no dot, the deepest of %.3f A; %.1f dots were to be "
        "expected of one at most\n",
        subject_.contacts().size(), overlapping, hidden, -deepest, most_dots);
  }

  void hydrogen_bonds() {
    ThresholdOptions options{"probe", 1.0, true};
    const Thresholds lowered = make_thresholds(subject_.structure(), options);
    const Thresholds& plain = subject_.checker().thresholds();
    std::size_t bonds = 0, shallow = 0;
    for (const auto& [pair, contact] : subject_.contacts()) {
      const auto s = plain.matrix.type(id<PrimitiveId>(pair.first)),
                 t = plain.matrix.type(id<PrimitiveId>(pair.second));
      const bool ours = lowered.between(s, t) < plain.between(s, t);
      if (contact.gap >= 0.0) continue;
      bonds += ours ? 1 : 0;
      // Where all that is inside is hidden, Probe has nothing to excuse.
      if (ours && !contact.dots_inside)
        ++shallow;
      else
        EXPECT_EQ(ours, contact.hydrogen_bond) << name(pair.first) << ' ' << name(pair.second) << ' ' << contact.gap;
    }
    EXPECT_GT(bonds, 0U);
    std::printf("%zu overlaps with a threshold lowered for hydrogen bonds, %zu without a dot inside\n", bonds, shallow);
  }

 private:
  std::string name(std::uint32_t i) const { return label(subject_.structure(), i); }
  bool standard(std::uint32_t i) const {
    static const std::string names =
        " ALA ARG ASN ASP CYS GLN GLU GLY HIS ILE LEU LYS MET PHE PRO SER THR TRP TYR VAL ";
    const std::string& residue = subject_.structure().residues[subject_.structure().atoms[i].residue].name;
    return names.find(' ' + residue + ' ') != std::string::npos;
  }

  Subject subject_;
  Dots dots_;
};

class BesideKingProbe : public testing::TestWithParam<const char*> {};

TEST_P(BesideKingProbe, RadiiOverlapsAndHydrogenBondsAreTheSame) {
  if (test::run_tool("king-probe", "-version 2>/dev/null").status != 0) GTEST_SKIP() << "king-probe is not installed";
  if (!std::filesystem::exists(test::shared_molecules() / GetParam())) GTEST_SKIP() << "shared data not found";
  Comparison comparison(GetParam());
  if (HasFatalFailure()) return;
  comparison.radii();
  comparison.overlaps();
  comparison.hydrogen_bonds();
}

std::vector<const char*> proteins() {
  std::vector<const char*> files{"1l2y.pdb", "1ejg.pdb", "paper/nmr_neopetrosiamide.pdb"};
  if (std::getenv("HINGE_TEST_ALL") != nullptr)
    files.insert(files.end(), {"5pti.pdb", "paper/1vii_3frames.pdb", "paper/2axd.pdb.gz"});
  return files;
}

INSTANTIATE_TEST_SUITE_P(Proteins, BesideKingProbe, testing::ValuesIn(proteins()),
                         [](const auto& parameter) { return "n" + std::to_string(parameter.index); });

}  // namespace
}  // namespace hinge::molecular
