// SPDX-License-Identifier: BSD-3-Clause
// assemble: from raw records to a Structure with one conformer, equal models and resolved records.
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "chemistry/counted.hpp"
#include "chemistry/recorded_bonds.hpp"
#include "chemistry/residue_table.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "io/conformer.hpp"
#include "io/read_file.hpp"

namespace hinge::molecular {

namespace {

class Assembler {
 public:
  Assembler(RawFile raw, const std::string& path, const ReadOptions& options)
      : raw_(std::move(raw)), path_(path), options_(options) {}

  Structure run() {
    s_.name = raw_.name;
    s_.notes = raw_.notes;
    std::vector<const RawModel*> chosen;
    for (const RawModel& model : raw_.models)
      if (!options_.model || model.number == *options_.model) chosen.push_back(&model);
    if (chosen.empty())
      throw LoadError(path_ + (options_.model ? ": has no model " + std::to_string(*options_.model) +
                                                    "; number of models: " + std::to_string(raw_.models.size())
                                              : ": has no atoms"));
    for (const RawResidue& residue : chosen.front()->residues)
      for (const RawAtom& atom : residue.atoms)
        s_.atom_records = std::max(s_.atom_records, std::size_t{atom.record} + 1);
    keep_what_is_there(*chosen.front());
    conformers_.emplace(*chosen.front(), options_);
    for (std::size_t m = 0; m < chosen.size(); ++m) add_model(*chosen[m], m == 0);
    if (s_.atoms.empty())
      throw LoadError(path_ + ": no atoms left (" + std::to_string(s_.waters_dropped) + " waters and " +
                      std::to_string(s_.hetero_dropped) +
                      " hetero atoms left out; --hetero keeps ligands and ions, --hetero waters also keeps waters)");
    resolve_records();
    resolve_conect();
    say_repairs();
    return std::move(s_);
  }

 private:
  /// Keeps hetero atoms in a model without a polymer, and waters in a model of waters alone.
  void keep_what_is_there(const RawModel& model) {
    bool has_hetero = false;
    for (std::size_t r = 0; r < model.residues.size(); ++r) {
      const ResidueKind kind = residue_kind(model.residues, r);
      if (kind == ResidueKind::amino_acid || kind == ResidueKind::nucleotide || is_cap(model.residues[r].name)) return;
      has_hetero = has_hetero || (kind == ResidueKind::other && !is_dummy(model.residues[r]));
    }
    bool& kept = has_hetero ? options_.hetero : options_.waters;
    if (kept) return;
    kept = true;
    s_.notes.emplace_back(has_hetero ? "the file holds no protein or nucleic acid: its ligands and ions are kept"
                                     : "the file holds only waters: they are kept");
  }

  /// Adds the atoms of one model, of the chosen conformer; the first model defines the topology.
  void add_model(const RawModel& model, bool first) {
    std::vector<Vec3> positions;
    difference_.clear();
    const auto& residues = model.residues;
    for (std::size_t begin = 0; begin < residues.size();) {
      std::size_t end = begin + 1;  // residue types that share the position
      while (end < residues.size() && residues[end].chain == residues[begin].chain &&
             residues[end].number == residues[begin].number &&
             residues[end].insertion_code == residues[begin].insertion_code && has_altlocs(residues[begin]) &&
             has_altlocs(residues[end]))
        ++end;
      std::size_t best = begin;
      for (std::size_t r = begin + 1; r < end; ++r)
        if (conformers_->preference(residues[r]) > conformers_->preference(residues[best])) best = r;
      if (first && end > begin + 1)
        s_.notes.push_back(name_of(residues[begin]) + ": " + std::to_string(end - begin) +
                           " residue types share the position, " + residues[best].name + " is used");
      const ResidueKind kind = residue_kind(residues, best);
      const bool may_lack_names = kind == ResidueKind::other && !is_cap(residues[best].name);
      const auto named = may_lack_names ? with_own_names(residues[best]) : std::nullopt;
      if (named && first) named_.add([&] { return name_of(residues[best]); });
      add_residue(named ? *named : residues[best], kind, first, positions);
      begin = end;
    }
    if (!difference_.empty() || (!first && positions.size() != s_.atoms.size()))
      throw OtherAtoms(path_ + ": model " + std::to_string(model.number) + " has other atoms than the first model");
    s_.models.push_back(std::move(positions));
    s_.model_numbers.push_back(model.number);
  }

  static bool has_altlocs(const RawResidue& residue) {
    return std::any_of(residue.atoms.begin(), residue.atoms.end(), [](const RawAtom& a) { return a.altloc != '\0'; });
  }
  static std::string name_of(const RawResidue& residue) {
    return (residue.chain.empty() ? "_" : residue.chain) + ":" + residue.name + std::to_string(residue.number) +
           (residue.insertion_code != '\0' ? std::string(1, residue.insertion_code) : "");
  }
  void add_residue(const RawResidue& raw, ResidueKind kind, bool first, std::vector<Vec3>& positions) {
    if (kind == ResidueKind::water && !options_.waters) {
      if (first) ++s_.waters_dropped;
      return;
    }
    if (kind == ResidueKind::other && !options_.hetero && !is_cap(raw.name)) {
      if (first) s_.hetero_dropped += raw.atoms.size();
      if (first) ++s_.hetero_residues_dropped[raw.name];
      return;
    }
    if (is_dummy(raw)) {
      if (first) s_.hetero_dropped += raw.atoms.size();
      if (first) dummies_.add([&] { return name_of(raw); }, raw.atoms.size());
      return;
    }
    const char altloc = conformers_->altloc_of(raw);
    if (first) conformers_->count(altloc, name_of(raw));
    Residue residue{raw.name, raw.number, raw.insertion_code, 0, static_cast<std::uint32_t>(s_.atoms.size()), 0, kind};
    std::map<std::string, int> seen;
    for (const RawAtom& atom : raw.atoms) {
      if (is_virtual_site(atom, raw, kind)) {
        if (first) virtual_sites_.add([&] { return name_of(raw) + ":" + atom.name; });
        continue;
      }
      if (atom.altloc != '\0' && atom.altloc != altloc) {
        if (first) conformers_->count_dropped(name_of(raw) + ":" + atom.name + " at " + atom.altloc);
        continue;
      }
      const std::string where = path_ + ": " + name_of(raw) + ":" + atom.name;
      if (!is_finite(atom.position)) throw LoadError(where + ": a coordinate is missing or not finite");
      const std::string element = element_of(atom, raw, where, first);
      if (element == "H" && !options_.keep_hydrogens) continue;
      if (++seen[atom.name] > 1) {
        if (first) repeated_.add([&] { return name_of(raw) + ":" + atom.name; });
        continue;
      }
      if (!first && difference_.empty() && !is_same(positions.size(), atom, raw))
        difference_ = name_of(raw) + ":" + atom.name;
      positions.push_back(atom.position);
      if (!first) continue;
      s_.atoms.push_back({atom.name, element, static_cast<std::uint32_t>(s_.residues.size()), atom.altloc, atom.serial,
                          atom.record, atom.b_factor});
    }
    if (!first || s_.atoms.size() == residue.first_atom) return;
    residue.last_atom = static_cast<std::uint32_t>(s_.atoms.size());
    if (s_.chains.empty() || s_.chains.back().name != raw.chain)
      s_.chains.push_back({raw.chain, static_cast<std::uint32_t>(s_.residues.size()), 0});
    residue.chain = static_cast<std::uint32_t>(s_.chains.size() - 1);
    s_.residues.push_back(std::move(residue));
    s_.chains.back().last_residue = static_cast<std::uint32_t>(s_.residues.size());
  }

  /// True if this atom of a later model has the name and residue of the first model's atom at this index.
  bool is_same(std::size_t position, const RawAtom& atom, const RawResidue& raw) const {
    if (position >= s_.atoms.size() || s_.atoms[position].name != atom.name) return false;
    const Residue& residue = s_.residues[s_.atoms[position].residue];
    return residue.sequence_number == raw.number && residue.insertion_code == raw.insertion_code;
  }

  /// Returns the atom's element; counts elements that differ from the file's.
  std::string element_of(const RawAtom& atom, const RawResidue& residue, const std::string& where, bool first) {
    std::string element = element_by_name(atom, residue);
    if (element.empty())
      throw LoadError(where +
                      ": neither the file nor the atom name gives the element, expected an element in the file");
    if (element != atom.element && first)
      repaired_.add([&] {
        return name_of(residue) + ":" + atom.name + ", in the file " + (atom.element.empty() ? "none" : atom.element);
      });
    return element;
  }

  void say_repairs() {
    if (std::string note = conformers_->note(); !note.empty()) s_.notes.push_back(std::move(note));
    const auto say = [&](const Counted& counted, const std::string& before, const std::string& after) {
      if (counted.number > 0)
        s_.notes.push_back(before + std::to_string(counted.number) + after + " (first: " + counted.first + ")");
    };
    say(dummies_, "", " dummy atoms are left out");
    say(virtual_sites_, "", " virtual sites, which have no mass, are left out");
    say(repaired_, "elements of ", " atoms taken from their names");
    say(repeated_, "atoms that repeat a name of their residue and are left out: ", "");
    say(named_, "residues with atoms named by their elements alone, which are numbered: ", "");
  }

  using Key = std::tuple<std::string, int, char>;
  void resolve_records() {
    std::map<Key, std::uint32_t> residues;
    for (std::uint32_t r = 0; r < s_.residues.size(); ++r) {
      const Residue& residue = s_.residues[r];
      residues.emplace(Key{s_.chains[residue.chain].name, residue.sequence_number, residue.insertion_code}, r);
    }
    const auto residue = [&](const RawAddress& a) -> std::optional<std::uint32_t> {
      const auto found = residues.find({a.chain, a.number, a.insertion_code});
      return found == residues.end() ? std::nullopt : std::optional(found->second);
    };
    const auto atom = [&](const RawAddress& a) -> std::optional<std::uint32_t> {
      const auto r = residue(a);
      if (!r) return std::nullopt;
      for (std::uint32_t i = s_.residues[*r].first_atom; i < s_.residues[*r].last_atom; ++i)
        if (s_.atoms[i].name == a.atom) return i;
      return std::nullopt;
    };
    std::size_t dangling = 0;
    for (const RawBondRecord& link : raw_.bond_records) {
      const auto a = atom(link.first), b = atom(link.second);
      if (a && b && *a != *b)
        s_.bond_records.push_back(
            {std::min(*a, *b), std::max(*a, *b), link.disulphide || joins_sg(s_, *a, *b), false, BondOrder::unknown});
      else
        ++dangling;
    }
    if (dangling > 0)
      s_.notes.push_back(std::to_string(dangling) + " recorded bonds name atoms that are missing or were left out");
    for (const RawElement& element : raw_.elements) {
      const auto a = residue(element.first), b = residue(element.last);
      if (a && b && *a <= *b)
        s_.secondary_structure.push_back(SecondaryStructure{element.kind, *a, *b});
      else
        s_.notes.emplace_back("a helix or strand record is ignored: its residues are missing or out of order");
    }
  }

  /// CONECT names serial numbers; a number that several atoms have is ignored. Pairs that other records list are not
  /// repeated.
  void resolve_conect() {
    if (raw_.conect.empty()) return;
    constexpr std::uint32_t several = std::numeric_limits<std::uint32_t>::max();
    std::unordered_map<int, std::uint32_t> atoms;
    for (std::uint32_t i = 0; i < s_.atoms.size(); ++i)
      if (const auto [at, is_new] = atoms.emplace(s_.atoms[i].serial, i); !is_new) at->second = several;
    std::set<std::pair<std::uint32_t, std::uint32_t>> known;
    for (const BondRecord& link : s_.bond_records) known.emplace(link.first, link.second);
    for (const RawConnection& pair : raw_.conect) {
      const auto a = atoms.find(pair.first), b = atoms.find(pair.second);
      if (a == atoms.end() || b == atoms.end() || a->second == several || b->second == several) continue;
      const auto [i, j] = std::minmax(a->second, b->second);
      if (!known.emplace(i, j).second) continue;
      s_.bond_records.push_back(
          {i, j, joins_sg(s_, i, j), true, pair.repeated ? BondOrder::multiple : BondOrder::unknown});
    }
  }

  RawFile raw_;
  const std::string& path_;
  ReadOptions options_;
  Structure s_;
  std::string difference_;  ///< first atom of the current model that differs from the first model's
  std::optional<ConformerChoice> conformers_;
  Counted dummies_, virtual_sites_, repaired_, repeated_;  // atoms
  Counted named_;                                          // residues
};

}  // namespace

Structure assemble(RawFile raw, const std::string& path, const ReadOptions& options) {
  return Assembler(std::move(raw), path, options).run();
}

}  // namespace hinge::molecular
