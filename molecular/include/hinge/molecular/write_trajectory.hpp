// SPDX-License-Identifier: BSD-3-Clause
// TrajectoryWriter: conformations to PDB, mmCIF, DCD or NumPy files, one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>

#include "hinge/core/vec3.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

enum class TrajectoryFormat : std::uint8_t {
  pdb,  ///< one model each
  cif,  ///< mmCIF, one model each
  dcd,  ///< floats of 32 bits, as CHARMM's, without unit cell
  npy   ///< frames x atoms x 3, C order
};

/// By extension; none: another one.
std::optional<TrajectoryFormat> trajectory_format(const std::filesystem::path& path);
/// ".pdb, .cif, .dcd or .npy".
inline constexpr const char* trajectory_extensions = ".pdb, .cif, .dcd or .npy";
/// Do its frames hold the molecule's atoms, by name? Frames of the others hold numbers alone.
inline bool names_atoms(TrajectoryFormat format) {
  return format == TrajectoryFormat::pdb || format == TrajectoryFormat::cif;
}

/// Onto a stream that can be written again at its start, where the number of frames stands.
class TrajectoryWriter {
 public:
  /// Frames of atom_count atoms; PDB and mmCIF: those of the molecule, which must outlive this. single: NumPy's
  /// coordinates are floats of 32 bits. ModelError: the molecule does not fit the format.
  TrajectoryWriter(std::ostream& out, TrajectoryFormat format, const Structure& molecule, std::size_t atom_count,
                   bool single = false);

  /// positions: angstrom, atom_count of them. number: of the model in PDB and mmCIF. ModelError: they do not fit the
  /// format.
  void add(std::span<const Vec3> positions, int number);
  /// Frames written.
  std::size_t size() const noexcept { return frames_; }
  /// Call once, behind the last frame. Without any frame DCD and NumPy files are valid and hold 0; nothing
  /// is written of PDB and mmCIF files, which cannot.
  void finish();

 private:
  void write_head();

  std::ostream& out_;
  TrajectoryFormat format_;
  const Structure& molecule_;
  std::size_t atoms_;
  bool single_;
  std::size_t frames_ = 0;
};

/// Rows of numbers as a NumPy array of rows x columns, 64-bit floats, onto such a stream.
class RowWriter {
 public:
  RowWriter(std::ostream& out, std::size_t columns);
  /// ModelError: another number of columns.
  void add(std::span<const double> row);
  /// Call once, behind the last row; there may be none.
  void finish();

 private:
  std::ostream& out_;
  std::size_t columns_;
  std::size_t rows_ = 0;
};

}  // namespace hinge::molecular
