// SPDX-License-Identifier: BSD-3-Clause
// PDB format 3.3. Numbers are converted to text first: the stream's locale could group digits.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "chemistry/recorded_bonds.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "io/hybrid36.hpp"

namespace hinge::molecular {

namespace {

std::string right(std::string text, std::size_t width) {
  if (text.size() < width) text.insert(0, width - text.size(), ' ');
  return text;
}

std::string left(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

std::string fixed(double value, int digits, std::size_t width) { return right(fixed_text(value, digits), width); }

/// The atom name's columns: a name of fewer than four characters starts in column 14 if its element has one letter.
std::string atom_field(const Atom& atom) {
  return left(atom.name.size() < 4 && atom.element.size() < 2 ? " " + atom.name : atom.name, 4);
}

std::string element_field(std::string element) {
  for (char& c : element)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return right(std::move(element), 2);
}

char chain_of(const Structure& s, const Residue& residue) {
  const std::string& name = s.chains[residue.chain].name;
  return name.empty() ? ' ' : name.front();
}

/// Four columns of residue number and one of insertion code.
std::string number_field(const Residue& residue) {
  const int number = residue.sequence_number;
  return right(number < 0 ? std::to_string(number) : hybrid36(static_cast<std::size_t>(number), 4), 4) +
         (residue.insertion_code == '\0' ? ' ' : residue.insertion_code);
}

/// "CYS A". A fourth letter of the residue's name takes the place of the blank.
std::string name_field(const Structure& s, const Residue& residue) {
  return left(right(residue.name, 3), 4) + chain_of(s, residue);
}

/// "CYS A  32 ", the form of residues in SSBOND and HELIX.
std::string residue_field(const Structure& s, const Residue& residue) {
  return name_field(s, residue) + ' ' + number_field(residue);
}

bool is_hetero(const Residue& residue) {
  return residue.kind == ResidueKind::other || residue.kind == ResidueKind::water;
}

std::string serial_field(std::uint32_t atom) { return right(hybrid36(std::size_t{atom} + 1), 5); }

void write_elements(std::ostream& out, const Structure& s) {
  int helices = 0, strands = 0;
  for (const SecondaryStructure& element : s.secondary_structure) {
    const Residue &first = s.residues[element.first], &last = s.residues[element.last];
    if (element.kind == SecondaryStructure::Kind::helix) {
      const std::string name = right(std::to_string(++helices % 1000), 3);
      out << "HELIX  " << name << ' ' << name << ' ' << residue_field(s, first) << ' ' << residue_field(s, last) << " 1"
          << right("", 30) << ' ' << right(std::to_string(element.last - element.first + 1), 5) << "\n";
    } else {
      const std::string name = right(std::to_string(++strands % 1000), 3);  // every strand is a sheet of its own
      out << "SHEET    1 " << name << " 1 " << name_field(s, first) << number_field(first) << ' ' << name_field(s, last)
          << number_field(last) << " 0\n";
    }
  }
}

void write_links(std::ostream& out, const Structure& s) {
  const std::string symmetry = right("1555", 6) + right("1555", 7) + ' ';
  const auto length = [&](const Bond& bond) {
    return fixed(norm(Vec3(s.models.front()[bond.first] - s.models.front()[bond.second])), 2, 5);
  };
  int count = 0;
  std::string links;
  for (const Bond& bond : s.bonds) {
    const Atom &a = s.atoms[bond.first], &b = s.atoms[bond.second];
    if (a.residue == b.residue || joins_neighbours(s, bond)) continue;
    const Residue &r = s.residues[a.residue], &t = s.residues[b.residue];
    if (bond.origin == BondOrigin::disulphide && joins_sg(s, bond.first, bond.second)) {
      out << "SSBOND " << right(std::to_string(++count % 1000), 3) << ' ' << residue_field(s, r) << "   "
          << residue_field(s, t) << right("", 23) << symmetry << length(bond) << "\n";
    } else {
      const auto partner = [&](const Atom& atom, const Residue& residue) {
        return atom_field(atom) + ' ' + name_field(s, residue) + number_field(residue);
      };
      links += "LINK        " + partner(a, r) + right("", 15) + partner(b, t) + "  " + symmetry + length(bond) + "\n";
    }
  }
  out << links;
}

/// Writes "REMARK 999 SINGLE  1     2     1     3", five pairs per line.
void write_pairs(std::ostream& out, std::string_view word, const std::vector<RecordedBond>& bonds, bool bonded) {
  std::size_t count = 0;
  for (const RecordedBond& bond : bonds) {
    if (bond.bonded != bonded || (bonded && bond.order != BondOrder::single)) continue;
    if (count % 5 == 0) out << (count > 0 ? "\n" : "") << "REMARK 999 " << word;
    out << ' ' << serial_field(bond.first) << ' ' << serial_field(bond.second);
    ++count;
  }
  if (count > 0) out << "\n";
}

}  // namespace

void check_fits_pdb(const Structure& s) {
  const auto refuse = [](const std::string& what) {
    throw ModelError(what + " does not fit the PDB format; write a .cif file instead");
  };
  for (const Chain& chain : s.chains)
    if (chain.name.size() > 1) refuse("chain name " + chain.name + " of more than one character");
  for (const Residue& residue : s.residues) {
    const auto where = [&] { return " (" + label(s, residue.first_atom) + ")"; };
    if (residue.name.size() > 4) refuse("residue name " + residue.name + where());
    if (residue.sequence_number < -999 || residue.sequence_number > 9999 + 2 * 26 * 36 * 36 * 36)
      refuse("residue number " + std::to_string(residue.sequence_number) + where());
  }
  for (std::uint32_t i = 0; i < s.atoms.size(); ++i)
    if (s.atoms[i].name.size() > 4) refuse("atom name " + s.atoms[i].name + " (" + label(s, i) + ")");
}

void write_pdb_head(std::ostream& out, const Structure& structure) {
  check_fits_pdb(structure);
  const RecordedBonds recorded = record_bonds(structure);
  const auto pairs =
      std::count_if(recorded.bonds.begin(), recorded.bonds.end(), [](const RecordedBond& bond) { return bond.bonded; });
  out << "REMARK 999 BONDS RECORDED BY HINGE 1: " << std::to_string(recorded.atoms) << " ATOMS, "
      << std::to_string(pairs) << " CONECT PAIRS\n";
  write_pairs(out, "SINGLE", recorded.bonds, true);
  write_pairs(out, "BREAK", recorded.bonds, false);
  write_elements(out, structure);
  write_links(out, structure);
}

void write_pdb_model(std::ostream& out, const Structure& structure, std::span<const Vec3> positions, int number) {
  check_fits_pdb(structure);
  const std::vector<std::uint32_t> copies = copies_of_residues(structure);
  std::string text = "MODEL " + right(std::to_string(number), 8) + "\n";
  std::uint32_t i = 0;
  for (const Chain& chain : structure.chains) {
    std::uint32_t polymer_end = chain.first_residue;
    for (std::uint32_t r = chain.first_residue; r < chain.last_residue; ++r)
      if (!is_hetero(structure.residues[r])) polymer_end = r + 1;
    for (std::uint32_t r = chain.first_residue; r < chain.last_residue; ++r) {
      const Residue& residue = structure.residues[r];
      const std::string ends = name_field(structure, residue) + number_field(residue);
      for (i = residue.first_atom; i < residue.last_atom; ++i) {
        const Atom& atom = structure.atoms[i];
        text += (is_hetero(residue) ? "HETATM" : "ATOM  ") + serial_field(i) + ' ' + atom_field(atom) + ' ' + ends;
        text += "   ";
        for (int k = 0; k < 3; ++k) {
          const double x = positions[i][k];
          if (!(x > -999.9995 && x < 9999.9995))
            throw ModelError(label(structure, i) + ": coordinate " + number_text(x) +
                             " does not fit the PDB columns; write a .cif file instead");
          text += fixed(x, 3, 8);
        }
        text += "  1.00" + fixed(std::clamp(atom.b_factor, -99.99, 999.99), 2, 6) + "      ";
        text += left(copies[r] == 0 ? "" : hybrid36(copies[r], 4), 4) + element_field(atom.element) + "\n";
      }
      if (r + 1 == polymer_end) text += "TER\n";
    }
  }
  out << text << "ENDMDL\n";
}

void write_pdb_tail(std::ostream& out, const Structure& structure) {
  std::vector<std::vector<std::uint32_t>> partners(structure.atoms.size());
  for (const RecordedBond& bond : record_bonds(structure).bonds) {
    if (!bond.bonded) continue;
    for (int k = 0; k < (bond.order == BondOrder::multiple ? 2 : 1); ++k) {
      partners[bond.first].push_back(bond.second);
      partners[bond.second].push_back(bond.first);
    }
  }
  for (std::uint32_t i = 0; i < partners.size(); ++i) {
    std::sort(partners[i].begin(), partners[i].end());
    for (std::size_t k = 0; k < partners[i].size(); ++k) {
      if (k % 4 == 0) out << (k > 0 ? "\n" : "") << "CONECT" << serial_field(i);
      out << serial_field(partners[i][k]);
    }
    if (!partners[i].empty()) out << "\n";
  }
  out << "END\n";
}

}  // namespace hinge::molecular
