// SPDX-License-Identifier: BSD-3-Clause
// TrajectoryWriter: conformations to PDB, DCD or NumPy files, one at a time.
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
  dcd,  ///< floats of 32 bits, as CHARMM's, without unit cell
  npy   ///< frames x atoms x 3, C order
};

/// By extension; none: another one.
std::optional<TrajectoryFormat> trajectory_format(const std::filesystem::path& path);

/// Onto a stream that can be written again at its start, where the number of frames stands.
class TrajectoryWriter {
 public:
  /// Frames of atom_count atoms; PDB: those of the molecule, which must outlive this. single: NumPy's coordinates are
  /// floats of 32 bits.
  TrajectoryWriter(std::ostream& out, TrajectoryFormat format, const Structure& molecule, std::size_t atom_count,
                   bool single = false);

  /// positions: angstrom, atom_count of them. number: of a PDB model. ModelError: they do not fit the format.
  void add(std::span<const Vec3> positions, int number);
  /// Frames written.
  std::size_t size() const noexcept { return frames_; }
  /// Call once, behind the last frame.
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

}  // namespace hinge::molecular
