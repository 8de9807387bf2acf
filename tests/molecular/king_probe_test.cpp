// SPDX-License-Identifier: BSD-3-Clause
// Compares overlaps in real proteins, nucleic acids, glycans and ligands with king-probe (Debian's Probe, which shares
// no code), radius by radius and pair by pair, and clashes with its results for MolProbity. Skipped if it is not
// installed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/severity.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "molecular/test_files.hpp"
#include "tool/run_tool.hpp"

namespace hinge::molecular {
namespace king_probe_test {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

constexpr int bonds_left_out = 3;      // Probe's -3: atoms joined by up to three bonds make no contact
constexpr double probe_radius = 0.25;  // angstrom, Probe's default: contacts have gaps up to twice this
constexpr double dots_per_area = 32;   // dots per square angstrom on the sphere of an atom
constexpr double default_dots_per_area = 16;
constexpr double many_dots_per_area = 64;
constexpr double bad_overlap = 0.4;  // angstrom, Probe's -DIVLow: overlap of a MolProbity clash

/// Error of a gap in Probe's output (angstrom): half of the last printed digit, and five float roundings of numbers
/// below 4.
constexpr double printed = 0.0005 + 5 * 0x1p-23;

std::string trimmed(const std::string& text, std::size_t at, std::size_t size) {
  const std::string field = text.substr(std::min(at, text.size()), size);
  const std::size_t first = field.find_first_not_of(' ');
  return first == std::string::npos ? "" : field.substr(first, field.find_last_not_of(' ') - first + 1);
}

/// Returns the fields of a line of Probe's -unformated output, which uses colons.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream parts(line);
  for (std::string field; std::getline(parts, field, ':');) fields.push_back(field);
  return fields;
}

/// Probe's result for a pair in contact, from both sides.
struct ProbeContact {
  double gap = 0.0;            ///< distance minus both radii, angstrom
  bool dots_inside = false;    ///< a dot of one atom is inside the other
  bool hydrogen_bond = false;  ///< a dot counts as a hydrogen bond
};

/// Probe's result for a pair at MolProbity's settings.
struct ProbeClash {
  double gap = 0.0;            ///< distance minus both radii, angstrom
  bool bad = false;            ///< a dot of one atom is deeper than bad_overlap inside the other
  bool bad_if_denser = false;  ///< the same with many more dots
  bool hydrogen_bond = false;
};

/// One conformer of a real structure, as given to both programs.
class Subject {
 public:
  Subject(const std::string& file, bool hetero) : pdb_(""), dump_("") {
    ReadOptions options;
    options.model = 1;
    options.hetero = hetero;
    const Structure whole = read_structure(test::molecule_file(file), options);
    {
      std::ofstream out(pdb_.path());
      write_pdb_head(out, whole);  // records of bonds that distances cannot find
      write_pdb_model(out, whole, whole.models.front(), 1);
      write_pdb_tail(out, whole);
    }
    molecule_ = std::make_shared<const Molecule>(read_structure(pdb_.path(), options));
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
  /// Returns the radius of our radii set, angstrom.
  double radius(std::uint32_t i) const {
    const auto type = checker_->thresholds().matrix.type(id<PrimitiveId>(i));
    return checker_->thresholds().between(type, type) / 2;
  }
  double probe_radius_of(std::uint32_t i) const { return radii_.at(i); }
  const std::map<Pair, ProbeContact>& contacts() const { return contacts_; }
  const std::map<Pair, ProbeClash>& clashes() const { return clashes_; }
  /// Returns a checker with --rules molprobity.
  Checker molprobity() const {
    CheckOptions rules;
    rules.thresholds.rules = "molprobity";
    return {molecule_, molecule_->select({}), rules};
  }

 private:
  /// Returns an atom's name in Probe's order: chain, number, insertion code, residue, atom.
  std::string name(std::uint32_t i) const {
    const Atom& atom = structure().atoms[i];
    const Residue& residue = structure().residues[atom.residue];
    return structure().chains[residue.chain].name + '/' + std::to_string(residue.sequence_number) +
           (residue.insertion_code != '\0' ? std::string(1, residue.insertion_code) : "") + '/' + residue.name + '/' +
           atom.name;
  }
  std::uint32_t atom(const std::string& text, std::size_t chain, std::size_t number, std::size_t residue,
                     std::size_t name) const {
    const std::string key = trimmed(text, chain, 2) + '/' + trimmed(text, number, 5) + '/' + trimmed(text, residue, 3) +
                            '/' + trimmed(text, name, 4);
    const auto found = atoms_.find(key);
    if (found == atoms_.end()) throw std::out_of_range("no atom " + key + " for '" + text + "'");
    return found->second;
  }
  void ask_probe();
  /// Runs Probe and calls use(pair, kind, gap) for each line of its output; gap: angstrom.
  template <class Use>
  void read_contacts(const std::string& arguments, const Use& use);

  test::TemporaryFile pdb_, dump_;
  std::shared_ptr<const Molecule> molecule_;
  std::map<std::string, std::uint32_t> atoms_;
  std::map<std::uint32_t, double> radii_;
  std::map<Pair, ProbeContact> contacts_;
  std::map<Pair, ProbeClash> clashes_;
  std::optional<Checker> checker_;
};

template <class Use>
void Subject::read_contacts(const std::string& arguments, const Use& use) {
  std::istringstream said(
      test::run_tool("king-probe", "-quiet -mc -unformated -condense " + arguments + " 2>/dev/null").out);
  for (std::string line; std::getline(said, line);) {
    const std::vector<std::string> fields = fields_of(line);
    ASSERT_GT(fields.size(), 6U) << line;
    // fields 3 and 4 look like " A   1 ASN  CA "
    const std::uint32_t i = atom(fields[3], 0, 2, 7, 11), j = atom(fields[4], 0, 2, 7, 11);
    use(Pair(std::minmax(i, j)), fields[2], std::stod(fields[6]));
  }
}

void Subject::ask_probe() {
  std::ostringstream all;
  all << "-3 -het -nolimit -nofacehbond -density" << dots_per_area << " -dumpatoms " << dump_.path().string()
      << " -self all " << pdb_.path().string();
  // Kinds: wc wide contact, cc close contact, so small overlap, bo bad overlap, hb hydrogen bond.
  read_contacts(all.str(), [&](const Pair& pair, const std::string& kind, double gap) {
    ProbeContact& contact = contacts_[pair];
    contact.gap = gap;
    contact.dots_inside = contact.dots_inside || kind == "so" || kind == "bo" || kind == "hb";
    contact.hydrogen_bond = contact.hydrogen_bond || kind == "hb";
  });
  for (const double density : {default_dots_per_area, many_dots_per_area}) {
    std::ostringstream arguments;
    arguments << "-4H -het -density" << density << " -self all " << pdb_.path().string();
    read_contacts(arguments.str(), [&](const Pair& pair, const std::string& kind, double gap) {
      ProbeClash& clash = clashes_[pair];
      clash.gap = gap;
      (density == default_dots_per_area ? clash.bad : clash.bad_if_denser) |= kind == "bo";
      clash.hydrogen_bond = clash.hydrogen_bond || kind == "hb";
    });
  }
  // A line looks like " A ASN  46 HD22 B  13.813   2.856  14.433  1.05 ...". It has no insertion code, so atoms are
  // identified by their coordinates.
  std::map<std::array<long, 3>, std::uint32_t> places;
  for (std::uint32_t i = 0; i < size(); ++i)
    places.emplace(std::array{std::lround(1000 * position(i)[0]), std::lround(1000 * position(i)[1]),
                              std::lround(1000 * position(i)[2])},
                   i);
  std::ifstream dump(dump_.path());
  for (std::string line; std::getline(dump, line);) {
    const auto place = [&](std::size_t column) { return std::lround(1000 * std::stod(line.substr(column, 8))); };
    radii_[places.at({place(17), place(25), place(33)})] = std::stod(line.substr(41, 6));
  }
}

/// Estimates the number of Probe's dots that a pair should have on the sphere of one of its atoms. A dot counts if the
/// probe sphere that touches there also touches the other atom, no third atom is deeper at the dot, and no atom too few
/// bonds away covers it.
class Dots {
 public:
  /// per_area: dots per square angstrom. left_out: pairs with fewer bonds between them make no contact.
  Dots(const Subject& subject, double per_area, MinBonds left_out)
      : subject_(subject), per_area_(per_area), left_out_(left_out) {
    // Fibonacci lattice: directions with equal areas, independent of Probe's dots.
    const double golden = std::numbers::pi * (1.0 + std::sqrt(5.0));
    for (std::size_t k = 0; k < count; ++k) {
      const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / count, r = std::sqrt(1.0 - z * z);
      const double turn = golden * (static_cast<double>(k) + 0.5);
      directions_.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
    }
  }

  /// Returns the expected number of dots at least `deep` angstrom inside the other atom: the larger number of both
  /// spheres.
  double expected(const Pair& pair, double deep) const {
    return std::max(expected(pair.first, pair.second, deep), expected(pair.second, pair.first, deep));
  }

 private:
  static constexpr std::size_t count = 20000;

  double expected(std::uint32_t on, std::uint32_t with, double deep) const {
    const std::vector<Neighbour> neighbours = around(on, with);
    std::size_t seen = 0;
    for (const Vec3& direction : directions_) seen += sees(on, with, neighbours, direction, deep) ? 1 : 0;
    const double r = subject_.radius(on);
    return per_area_ * 4 * std::numbers::pi * r * r * static_cast<double>(seen) / count;
  }

  struct Neighbour {
    std::uint32_t atom;
    bool bonded;
  };

  double gap(const Vec3& x, std::uint32_t i) const { return (x - subject_.position(i)).norm() - subject_.radius(i); }
  /// Returns the other atoms that the probe sphere can touch.
  std::vector<Neighbour> around(std::uint32_t on, std::uint32_t with) const {
    std::vector<Neighbour> found;
    for (std::uint32_t i = 0; i < subject_.size(); ++i)
      if (i != on && i != with && gap(subject_.position(on), i) <= subject_.radius(on) + 2 * probe_radius)
        found.push_back(
            {i, bond_distance(subject_.structure(), on, i, left_out_.of(subject_.structure(), on, i)) >= 0});
    return found;
  }
  bool sees(std::uint32_t on, std::uint32_t with, const std::vector<Neighbour>& neighbours, const Vec3& direction,
            double deep) const {
    const Vec3 dot = subject_.position(on) + subject_.radius(on) * direction;
    const Vec3 probe = dot + probe_radius * direction;
    if (gap(probe, with) > probe_radius) return false;
    const double depth = gap(dot, with);
    if (depth > -deep) return false;
    return std::none_of(neighbours.begin(), neighbours.end(), [&](const Neighbour& n) {
      return n.bonded ? gap(dot, n.atom) <= 0.0 : gap(dot, n.atom) < depth && gap(probe, n.atom) <= probe_radius;
    });
  }

  const Subject& subject_;
  double per_area_;
  MinBonds left_out_;
  std::vector<Vec3> directions_;
};

constexpr double any_depth = -1.0;  // angstrom: includes dots outside the other atom

/// Compares one structure; each function reports the differences.
class Comparison {
 public:
  Comparison(const std::string& file, bool hetero)
      : subject_(file, hetero),
        dots_(subject_, dots_per_area, bonds_left_out),
        precision_(hetero ? printed + 0x1p-16 : printed) {}

  void radii() {
    for (std::uint32_t i = 0; i < subject_.size(); ++i)
      EXPECT_NEAR(subject_.radius(i), subject_.probe_radius_of(i), 1e-9) << name(i);
    std::printf("%zu radii\n", subject_.size());
  }

  void overlaps() {
    std::map<Pair, double> ours;  // distance minus both radii
    const Mode mode{Mode::Kind::within, 2 * probe_radius};
    const Verdict verdict = subject_.checker().check_coordinates(subject_.structure().models.front(), mode);
    for (const Contact& pair : verdict.pairs) {
      const auto i = static_cast<std::uint32_t>(index(pair.hit.first)),
                 j = static_cast<std::uint32_t>(index(pair.hit.second));
      ours[{i, j}] = pair.hit.gap();
    }
    std::size_t metals = 0;
    for (const auto& [pair, contact] : subject_.contacts()) {
      const auto same = ours.find(pair);
      if (same == ours.end() && joined_by_metals(pair))
        ++metals;
      else if (same == ours.end())
        ADD_FAILURE() << "Probe alone: " << name(pair.first) << ' ' << name(pair.second) << ' ' << contact.gap;
      else
        EXPECT_NEAR(same->second, contact.gap, precision_) << name(pair.first) << ' ' << name(pair.second);
    }
    std::size_t overlapping = 0, hidden = 0;
    double deepest = 0.0, most_dots = 0.0;
    for (const auto& [pair, gap] : ours) {
      if (gap >= 0.0) continue;
      ++overlapping;
      if (subject_.contacts().contains(pair)) continue;
      ++hidden;
      const double dots = dots_.expected(pair, any_depth);
      // Probe's dots can miss an area of less than this many dots.
      EXPECT_LT(dots, 2.0) << "without a dot: " << name(pair.first) << ' ' << name(pair.second) << ' ' << gap;
      deepest = std::min(deepest, gap);
      most_dots = std::max(most_dots, dots);
    }
    EXPECT_GT(overlapping, has_hydrogens(subject_.structure()) ? 100U : 40U);
    std::printf(
        "%zu contacts with the same gap; %zu of Probe alone around metals; of %zu overlaps %zu have no dot, the "
        "deepest "
        "of %.3f A; %.1f dots were to be expected of one at most\n",
        subject_.contacts().size() - metals, metals, overlapping, hidden, -deepest, most_dots);
  }

  /// Without hydrogens our rule is about donor and acceptor atoms, so there is nothing to compare.
  void hydrogen_bonds() {
    if (!has_hydrogens(subject_.structure())) return;
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
      // If all dots inside are hidden, Probe has no dot to count as a hydrogen bond.
      if (ours && !contact.dots_inside)
        ++shallow;
      else
        EXPECT_EQ(ours, contact.hydrogen_bond) << name(pair.first) << ' ' << name(pair.second) << ' ' << contact.gap;
    }
    EXPECT_GT(bonds, 0U);
    std::printf("%zu overlaps with a threshold lowered for hydrogen bonds, %zu without a dot inside\n", bonds, shallow);
  }

  /// Clashes of both programs, and the reasons for clashes that only one program has.
  struct Clashes {
    std::size_t both = 0;
    std::size_t between_dots = 0;    ///< only ours: Probe finds it with many more dots
    std::size_t hidden = 0;          ///< only ours: other atoms cover the deepest dots
    std::size_t hydrogen_bonds = 0;  ///< both: it also has dots of a hydrogen bond, which MolProbity takes as one

    friend bool operator==(const Clashes&, const Clashes&) = default;
    friend std::ostream& operator<<(std::ostream& out, const Clashes& c) {
      return out << c.both << " both, " << c.between_dots << " between dots, " << c.hidden << " hidden, "
                 << c.hydrogen_bonds << " hydrogen bonds";
    }
  };

  Clashes clashes() {
    Checker checker = subject_.molprobity();
    const Thresholds& t = checker.thresholds();
    const Verdict verdict = checker.check_coordinates(subject_.structure().models.front(), Mode::parse("all"));
    const Dots dots(subject_, default_dots_per_area, {bonds_left_out, bonds_left_out + 1});
    Clashes counted;
    std::map<Pair, Contact> ours;
    for (const Contact& contact : verdict.pairs) {
      const Pair pair(static_cast<std::uint32_t>(index(contact.hit.first)),
                      static_cast<std::uint32_t>(index(contact.hit.second)));
      ours.emplace(pair, contact);
      const double overlap = severity_of(t, contact.hit, true).overlap;
      EXPECT_GE(overlap, bad_overlap - printed);
      const auto probes = subject_.clashes().find(pair);
      const double allowance =
          t.allowance[t.matrix.type(contact.hit.first) * t.type_names.size() + t.matrix.type(contact.hit.second)];
      if (probes != subject_.clashes().end()) {
        EXPECT_NEAR(-probes->second.gap, overlap + allowance, precision_);
      }
      if (probes != subject_.clashes().end() && probes->second.bad) {
        ++counted.both;
        counted.hydrogen_bonds += probes->second.hydrogen_bond ? 1 : 0;
        continue;
      }
      ++(probes != subject_.clashes().end() && probes->second.bad_if_denser ? counted.between_dots : counted.hidden);
      // Probe's dots can miss an area of less than this many dots.
      EXPECT_LT(dots.expected(pair, bad_overlap + allowance), 2.0)
          << name(pair.first) << ' ' << name(pair.second) << ' ' << overlap;
    }
    for (const auto& [pair, clash] : subject_.clashes()) {
      if (!clash.bad || ours.contains(pair)) continue;
      ADD_FAILURE() << "Probe alone: " << name(pair.first) << ' ' << name(pair.second) << ' ' << clash.gap;
    }
    return counted;
  }

 private:
  std::string name(std::uint32_t i) const { return label(subject_.structure(), i); }
  /// Returns true if only coordination bonds exclude the pair: they are bonds for us, but not for Probe.
  bool joined_by_metals(const Pair& pair) const {
    Structure without = subject_.structure();
    std::erase_if(without.bonds, [](const Bond& bond) { return bond.order == BondOrder::coordination; });
    return bond_distance(without, pair.first, pair.second, bonds_left_out) < 0;
  }

  Subject subject_;
  Dots dots_;
  /// Error of Probe's gaps, angstrom. Ligand files lie far from the origin: float coordinates below 128 are off by
  /// 2^-18 each.
  double precision_;
};

/// Returns a PDB file: a polar hydrogen of SER or LYS, and an oxygen of another chain at distance `apart` (angstrom).
std::string polar_pair(const char* donor, const char* hydrogen, const char* bearer, const char* acceptor,
                       const char* oxygen, double apart) {
  std::string text;
  const auto add = [&](const char* name, const char* residue, char chain, double x, double y) {
    std::array<char, 100> line{};
    std::snprintf(line.data(), line.size(), "ATOM      1 %-4s %3s %c   1    %8.3f%8.3f%8.3f  1.00  0.00\n", name,
                  residue, chain, x, y, 0.0);
    text += line.data();
  };
  add(hydrogen, donor, 'A', 0.0, 0.0);
  add(bearer, donor, 'A', -0.98, 0.0);
  add(bearer[1] == 'O' ? " CB" : " CE", donor, 'A', -1.5, 1.35);
  add(oxygen, acceptor, 'B', apart, 0.0);
  return text + "END\n";
}

TEST(BesideKingProbe, HydrogenBondsThatAreTooShortAreClashes) {
  if (test::run_tool("king-probe", "-version 2>/dev/null").status != 0) GTEST_SKIP() << "king-probe is not installed";
  const auto expect = [](const std::string& text, bool clash) {
    const test::TemporaryFile file(text);
    const auto molecule = std::make_shared<const Molecule>(read_structure(file.path()));
    CheckOptions rules;
    rules.thresholds.rules = "molprobity";
    Checker checker(molecule, molecule->select({}), rules);
    const Verdict verdict = checker.check_coordinates(molecule->structure().models.front(), Mode::parse("all"));
    const bool ours = std::any_of(verdict.pairs.begin(), verdict.pairs.end(), [&](const Contact& pair) {
      return index(pair.hit.first) == 0 && index(pair.hit.second) == 3;
    });
    const auto said = test::run_tool(
        "king-probe", "-quiet -4H -mc -unformated -density256 -self all " + file.path().string() + " 2>/dev/null");
    bool probes = false;
    std::istringstream lines(said.out);
    for (std::string line; std::getline(lines, line);)
      probes = probes || (line.find(":bo:") != std::string::npos && line.find(" H") != std::string::npos &&
                          line.find(": B ") != std::string::npos && line.find(" C") == std::string::npos);
    EXPECT_EQ(ours, clash) << text;
    EXPECT_EQ(probes, clash) << text << said.out;
  };
  // Thresholds: 1.05 + 1.40 - 0.6 - 0.4 = 1.45; 1.25 between opposite charges.
  expect(polar_pair("SER", " HG", " OG", "ALA", " O", 1.46), false);
  expect(polar_pair("SER", " HG", " OG", "ALA", " O", 1.44), true);
  expect(polar_pair("LYS", " HZ1", " NZ", "ASP", " OD1", 1.46), false);
  expect(polar_pair("LYS", " HZ1", " NZ", "ASP", " OD1", 1.24), true);
}

/// An atom of a monomer of refmac-dictionary, at its position there (angstrom).
struct MonomerAtom {
  std::string name, element;
  Vec3 position;
};

std::vector<MonomerAtom> monomer_atoms(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> tags;
  std::vector<MonomerAtom> atoms;
  const std::string category = "_chem_comp_atom.";
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<std::string> row;
    for (std::string word; words >> word;) {
      if (word.size() > 2 && word.front() == '"' && word.back() == '"') word = word.substr(1, word.size() - 2);
      row.push_back(word);
    }
    if (row.empty() || row[0][0] == '#') continue;
    if (row[0] == "loop_" || row[0][0] == '_') {
      if (row[0] == "loop_") tags.clear();
      if (row[0][0] == '_') tags.push_back(row[0]);
      continue;
    }
    if (tags.empty() || tags[0].compare(0, category.size(), category) != 0 || row.size() != tags.size()) continue;
    const auto field = [&](const char* tag) {
      return row[static_cast<std::size_t>(std::find(tags.begin(), tags.end(), category + tag) - tags.begin())];
    };
    atoms.push_back({field("atom_id"), field("type_symbol"),
                     Vec3(std::stod(field("x")), std::stod(field("y")), std::stod(field("z")))});
  }
  return atoms;
}

/// Compares radii and hydrogen-bond roles of each atom of bases, nucleotides, modified nucleotides, sugars and ligands,
/// and the gaps between two stacked monomers.
TEST(BesideKingProbe, NucleotidesSugarsAndLigandsAreWhatProbeSees) {
  if (test::run_tool("king-probe", "-version 2>/dev/null").status != 0) GTEST_SKIP() << "king-probe is not installed";
  const std::filesystem::path dictionary = "/usr/share/refmac/monomers";
  if (!std::filesystem::exists(dictionary)) GTEST_SKIP() << "refmac-dictionary is not installed";
  std::string text;
  char chain = 'A';
  std::size_t written = 0;
  for (const char* name : {"A",   "G",   "C",   "U",   "DA",  "DG",  "DC",  "DT",  "PSU", "H2U", "5MC", "2MG", "7MG",
                           "1MA", "M2G", "OMC", "OMG", "5MU", "ATP", "YYG", "HEM", "NAG", "MAN", "FUC", "KNI", "MSE"}) {
    const std::string lower(1, static_cast<char>(std::tolower(static_cast<unsigned char>(name[0]))));
    for (const MonomerAtom& atom : monomer_atoms(dictionary / lower / (std::string(name) + ".cif"))) {
      std::array<char, 100> line{};
      const bool wide = atom.name.size() == 4 || atom.element.size() == 2;
      // Chains form pairs: the two monomers of a pair are 3.4 A apart and overlap; the pairs are far apart.
      const int k = chain - 'A';
      std::snprintf(line.data(), line.size(),
                    "HETATM%5zu %-4s %3s %c   1    %8.3f%8.3f%8.3f  1.00  0.00          %2s\n", ++written,
                    (wide ? atom.name : " " + atom.name).c_str(), name, chain,
                    atom.position[0] - 100 + 40 * (k / 2 % 6), atom.position[1] - 50 + 40 * std::floor(k / 12.0),
                    atom.position[2] + 3.4 * (k % 2), atom.element.c_str());
      text += line.data();
    }
    ++chain;
  }
  const test::TemporaryFile pdb(text + "END\n"), dump("");
  ReadOptions options;
  options.hetero = true;
  options.dictionary = dictionary;
  const Structure s = read_structure(pdb.path(), options);
  ASSERT_EQ(s.atoms.size(), written);
  ThresholdOptions probe;
  probe.radii = "probe";
  probe.rho = 1.0;
  probe.hydrogen_bonds = false;
  const Thresholds plain = make_thresholds(s, probe);
  ThresholdOptions molprobity;
  molprobity.rules = "molprobity";
  const Thresholds named = make_thresholds(s, molprobity);
  std::map<std::string, std::uint32_t> atoms;
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i) {
    const Residue& residue = s.residues[s.atoms[i].residue];
    atoms.emplace(s.chains[residue.chain].name + '/' + residue.name + '/' + s.atoms[i].name, i);
  }
  const auto radius = [&](std::uint32_t i) {
    const auto type = plain.matrix.type(id<PrimitiveId>(i));
    return plain.between(type, type) / 2;
  };
  const auto said =
      test::run_tool("king-probe", "-quiet -mc -unformated -condense -3 -nolimit -het -dumpatoms " +
                                       dump.path().string() + " -self all " + pdb.path().string() + " 2>/dev/null");
  std::ifstream dumped(dump.path());
  std::size_t seen = 0;
  for (std::string line; std::getline(dumped, line); ++seen) {
    const std::uint32_t i = atoms.at(trimmed(line, 0, 2) + '/' + trimmed(line, 3, 3) + '/' + trimmed(line, 11, 4));
    EXPECT_NEAR(radius(i), std::stod(line.substr(line.find("cceptor") - 8, 6)), 1e-9) << label(s, i) << line;
    const std::string& type = named.type_names[named.matrix.type(id<PrimitiveId>(i))];
    EXPECT_EQ(type.find(".acceptor") != std::string::npos, line.find("isAcceptor") != std::string::npos)
        << label(s, i) << ' ' << type;
    EXPECT_EQ(type.find(".donor") != std::string::npos, line.find("isDonor") != std::string::npos)
        << label(s, i) << ' ' << type;
  }
  EXPECT_EQ(seen, written);
  std::istringstream lines(said.out);
  std::size_t contacts = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> fields = fields_of(line);
    ASSERT_GT(fields.size(), 6U) << line;
    const auto find = [&](const std::string& name) {
      return atoms.at(trimmed(name, 0, 2) + '/' + trimmed(name, 7, 3) + '/' + trimmed(name, 11, 4));
    };
    const std::uint32_t i = find(fields[3]), j = find(fields[4]);
    const double d = (s.models.front()[i] - s.models.front()[j]).norm();
    // Probe's float coordinates below 128 are off by 2^-18 each.
    EXPECT_NEAR(d - radius(i) - radius(j), std::stod(fields[6]), printed + 0x1p-16)
        << label(s, i) << ' ' << label(s, j);
    ++contacts;
  }
  EXPECT_GT(contacts, 1000U);
  std::printf("%zu atoms, %zu contacts with the same gap\n", seen, contacts);
}

/// The default rules find every overlap that Probe measures as 0.9 A or more beyond its hydrogen-bond allowance, in
/// deposited structures and in clashing conformations.
TEST(BesideKingProbe, SevereOverlapsAreAllFound) {
  if (test::run_tool("king-probe", "-version 2>/dev/null").status != 0) GTEST_SKIP() << "king-probe is not installed";
  constexpr double severe = 0.9;
  std::size_t severe_of_probe = 0, ours = 0;
  for (const char* file : {"1l2y.pdb", "paper/nmr_neopetrosiamide.pdb", "paper/1vii_3frames.pdb", "5pti.pdb"}) {
    if (!std::filesystem::exists(test::molecule_file(file))) continue;
    ReadOptions first;
    first.model = 1;
    const auto molecule = std::make_shared<const Molecule>(read_structure(test::molecule_file(file), first));
    const Structure& s = molecule->structure();
    Checker checker(molecule, molecule->select(select_torsions(*molecule, "all", false)), CheckOptions{});
    ASSERT_EQ(checker.thresholds().rules->name, "severe");
    const Thresholds& t = checker.thresholds();
    std::map<std::string, std::uint32_t> atoms;
    for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
      atoms.emplace(
          trimmed(std::to_string(s.residues[s.atoms[i].residue].sequence_number), 0, 5) + '/' + s.atoms[i].name, i);
    for (std::uint64_t k = 0; k < 4; ++k) {
      std::vector<Vec3> x = s.models.front();
      if (k > 0) {  // k = 1: full turns, which collide everywhere; k > 1: small turns, with few collisions
        const std::optional<double> sigma = k == 1 ? std::nullopt : std::optional(k == 2 ? 0.3 : 0.05);
        checker.check(sample_configuration({7, sigma}, k, checker.dof_count()), Mode::parse("any"));
        x = checker.positions();
      }
      const test::TemporaryFile pdb("");
      {
        std::ofstream out(pdb.path());
        write_pdb_model(out, s, x, 1);
        out << "END\n";
      }
      const std::vector<Vec3> written = read_structure(pdb.path()).models.front();
      std::set<Pair> found;
      for (const Contact& pair : checker.check_coordinates(written, Mode::parse("all")).pairs)
        found.emplace(static_cast<std::uint32_t>(index(pair.hit.first)),
                      static_cast<std::uint32_t>(index(pair.hit.second)));
      ours += found.size();
      const auto said = test::run_tool(
          "king-probe", "-quiet -4H -mc -het -unformated -condense -self all " + pdb.path().string() + " 2>/dev/null");
      std::set<Pair> probes;
      std::istringstream lines(said.out);
      for (std::string line; std::getline(lines, line);) {
        const std::vector<std::string> fields = fields_of(line);
        ASSERT_GT(fields.size(), 6U) << line;
        const auto find = [&](const std::string& name) {
          return atoms.at(trimmed(name, 2, 4) + '/' + trimmed(name, 11, 4));
        };
        const auto [i, j] = std::minmax({find(fields[3]), find(fields[4])});
        const std::size_t pair =
            t.matrix.type(id<PrimitiveId>(i)) * t.type_names.size() + t.matrix.type(id<PrimitiveId>(j));
        if (-std::stod(fields[6]) - t.allowance[pair] < severe + printed) continue;
        // Probe finds bonds by distance, so it misses disulphides that a sample breaks.
        if (!checker.exclusions().admits(id<PrimitiveId>(i), id<PrimitiveId>(j))) continue;
        probes.emplace(i, j);
        EXPECT_TRUE(found.contains({i, j})) << file << ' ' << k << ' ' << line;
      }
      severe_of_probe += probes.size();
    }
  }
  EXPECT_GT(severe_of_probe, 400U);  // the committed files alone have 403
  std::printf("%zu pairs that overlap by 0.9 A or more in Probe are found, %zu in all\n", severe_of_probe, ours);
}

/// A file and its expected clashes with Probe version 2.21.
struct Case {
  const char* file;
  Comparison::Clashes clashes;
  bool hetero = false;

  friend std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.file; }
};

class ProteinBesideKingProbe : public testing::TestWithParam<Case> {};

TEST_P(ProteinBesideKingProbe, RadiiOverlapsHydrogenBondsAndClashesAreTheSame) {
  if (test::run_tool("king-probe", "-version 2>/dev/null").status != 0) GTEST_SKIP() << "king-probe is not installed";
  if (!std::filesystem::exists(test::molecule_file(GetParam().file))) GTEST_SKIP() << "shared data not found";
  Comparison comparison(GetParam().file, GetParam().hetero);
  if (HasFatalFailure()) return;
  comparison.radii();
  comparison.overlaps();
  comparison.hydrogen_bonds();
  EXPECT_EQ(comparison.clashes(), GetParam().clashes);
}

constexpr std::array<Case, 6> proteins{{{"1l2y.pdb", {0, 0, 0, 0}},
                                        {"1ejg.pdb", {5, 1, 1, 0}},
                                        {"paper/nmr_neopetrosiamide.pdb", {14, 0, 2, 0}},
                                        {"5pti.pdb", {8, 1, 0, 0}},
                                        {"paper/1vii_3frames.pdb", {90, 5, 3, 0}},
                                        {"paper/2axd.pdb.gz", {8, 3, 1, 0}}}};
/// DNA, RNA with modified bases, DNA with a protein and metals, ligands, glycans: as deposited, with polar hydrogens at
/// most.
constexpr std::array<Case, 6> others{{{"1bna.pdb", {1, 0, 0, 0}, true},
                                      {"1ehz.pdb.gz", {6, 0, 0, 0}, true},
                                      {"1d66.pdb", {22, 0, 1, 0}, true},
                                      {"1hpx.pdb", {1, 0, 0, 0}, true},
                                      {"1a4w.pdb", {19, 2, 0, 0}, true},
                                      {"1igy.cif.gz", {223, 14, 18, 0}, true}}};

INSTANTIATE_TEST_SUITE_P(Others, ProteinBesideKingProbe, testing::ValuesIn(others),
                         [](const auto& parameter) { return "n" + std::to_string(parameter.index); });
INSTANTIATE_TEST_SUITE_P(Proteins, ProteinBesideKingProbe, testing::ValuesIn(proteins),
                         [](const auto& parameter) { return "n" + std::to_string(parameter.index); });

}  // namespace king_probe_test
}  // namespace hinge::molecular
