// SPDX-License-Identifier: BSD-3-Clause
// TrajectoryWriter: writes conformations to PDB, mmCIF, DCD, XTC or NumPy files, one at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <span>

#include "hinge/core/api.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/molecular/structure.hpp"

namespace hinge::molecular {

/// File formats of conformations.
enum class TrajectoryFormat : std::uint8_t {
  pdb,  ///< one model per frame
  cif,  ///< mmCIF, one model per frame
  dcd,  ///< CHARMM's layout, 32-bit floats, no unit cell
  xtc,  ///< GROMACS' compressed coordinates, rounded to 0.01 angstrom (0.001 nm), no unit cell
  npy   ///< array of frames x atoms x 3, C order
};

/// Returns the format of a file extension, or nullopt for an unknown one.
HINGE_API std::optional<TrajectoryFormat> trajectory_format(const std::filesystem::path& path);
/// The known extensions, for messages.
inline constexpr const char* trajectory_extensions = ".pdb, .cif, .dcd, .xtc or .npy";
/// True if frames of the format name the molecule's atoms; frames of the other formats are numbers alone.
inline bool names_atoms(TrajectoryFormat format) {
  return format == TrajectoryFormat::pdb || format == TrajectoryFormat::cif;
}
/// True if the file begins with its number of frames: it needs a seekable stream, and may hold 0 frames.
inline bool counts_frames(TrajectoryFormat format) {
  return format == TrajectoryFormat::dcd || format == TrajectoryFormat::npy;
}

/// Writes frames to a stream. DCD and NumPy need a seekable stream: finish() rewrites the number of frames at its
/// start. Keeps references to the stream and the molecule. Not thread-safe.
class HINGE_API TrajectoryWriter {
 public:
  /// atom_count: atoms per frame; for PDB and mmCIF it must be the molecule's. single: NumPy coordinates are 32-bit
  /// floats. The stream and the molecule must outlive this object. Throws ModelError if the molecule does not fit the
  /// PDB format.
  TrajectoryWriter(std::ostream& out, TrajectoryFormat format, const Structure& molecule, std::size_t atom_count,
                   bool single = false);

  /// Writes one frame. positions: angstrom, atom_count of them. number: model number in PDB and mmCIF files. Throws
  /// ModelError if the number of positions is wrong or a coordinate does not fit the format.
  void add(std::span<const Vec3> positions, int number);
  /// Number of frames written.
  std::size_t size() const noexcept { return frames_; }
  /// Completes the file; call once, after the last frame. Without frames, DCD and NumPy files are valid and hold 0;
  /// nothing is written to PDB, mmCIF and XTC files, which cannot be empty.
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

/// Writes rows of numbers to a seekable stream as a NumPy array of rows x columns, 64-bit floats. The stream must
/// outlive this object.
class HINGE_API RowWriter {
 public:
  /// columns: numbers per row.
  RowWriter(std::ostream& out, std::size_t columns);
  /// Writes one row. Throws ModelError if its length is not `columns`.
  void add(std::span<const double> row);
  /// Completes the file; call once, after the last row. There may be no rows.
  void finish();

 private:
  std::ostream& out_;
  std::size_t columns_;
  std::size_t rows_ = 0;
};

}  // namespace hinge::molecular
