// SPDX-License-Identifier: BSD-3-Clause
// TrajectoryWriter: numbers have this machine's byte order, which readers of DCD and NumPy files detect.
#include "hinge/molecular/write_trajectory.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/molecular/write_structure.hpp"
#include "io/pack_xtc.hpp"

namespace hinge::molecular {

namespace {

template <class Number>
void put(std::string& bytes, Number number) {
  const auto own = std::bit_cast<std::array<char, sizeof(Number)>>(number);
  bytes.append(own.data(), own.size());
}

void put_record(std::string& bytes, std::string_view content) {
  const auto size = static_cast<std::int32_t>(content.size());
  put(bytes, size);
  bytes += content;
  put(bytes, size);
}

/// The header of a DCD file, as DcdFile reads it; a version above 0 means CHARMM's flags, all 0 here.
std::string dcd_head(std::size_t frames, std::size_t atoms) {
  constexpr std::int32_t charmm_version = 24;
  std::array<std::int32_t, 20> numbers{};
  numbers[0] = static_cast<std::int32_t>(frames);
  numbers[1] = numbers[2] = 1;  // first step; steps between frames
  numbers[3] = static_cast<std::int32_t>(frames);
  numbers[19] = charmm_version;
  std::string head = "CORD", title, bytes;
  for (const std::int32_t n : numbers) put(head, n);
  put_record(bytes, head);
  put(title, std::int32_t{1});
  title += "REMARKS written by hinge";
  title.resize(4 + 80, ' ');
  put_record(bytes, title);
  std::string count;
  put(count, static_cast<std::int32_t>(atoms));
  put_record(bytes, count);
  return bytes;
}

/// The header of a NumPy file. shape: "10, 5, 3".
std::string npy_head(const std::string& shape, bool single) {
  std::string text = "{'descr': '";
  text += std::endian::native == std::endian::little ? '<' : '>';
  text += single ? "f4" : "f8";
  text += "', 'fortran_order': False, 'shape': (";
  text += shape;
  text += "), }";
  constexpr std::uint16_t length = 128 - 10;  // fits any number of frames, and aligns the data to 64 bytes
  text.resize(length - 1, ' ');
  text += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(length & 0xff);
  bytes += static_cast<char>(length >> 8);
  return bytes + text;
}

}  // namespace

std::optional<TrajectoryFormat> trajectory_format(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".pdb") return TrajectoryFormat::pdb;
  if (extension == ".cif") return TrajectoryFormat::cif;
  if (extension == ".dcd") return TrajectoryFormat::dcd;
  if (extension == ".xtc") return TrajectoryFormat::xtc;
  if (extension == ".npy") return TrajectoryFormat::npy;
  return std::nullopt;
}

TrajectoryWriter::TrajectoryWriter(std::ostream& out, TrajectoryFormat format, const Structure& molecule,
                                   std::size_t atom_count, bool single)
    : out_(out), format_(format), molecule_(molecule), atoms_(atom_count), single_(single) {
  if (format_ == TrajectoryFormat::pdb) check_fits_pdb(molecule_);
  write_head();
}

void TrajectoryWriter::write_head() {
  if (format_ == TrajectoryFormat::dcd) out_ << dcd_head(frames_, atoms_);
  if (format_ == TrajectoryFormat::npy)
    out_ << npy_head(std::to_string(frames_) + ", " + std::to_string(atoms_) + ", 3", single_);
}

void TrajectoryWriter::add(std::span<const Vec3> positions, int number) {
  if (positions.size() != atoms_)
    throw ModelError("a frame of " + std::to_string(positions.size()) + " atoms, expected " + std::to_string(atoms_));
  if (frames_ == 0 && format_ == TrajectoryFormat::pdb) write_pdb_head(out_, molecule_);
  if (frames_ == 0 && format_ == TrajectoryFormat::cif) write_cif_head(out_, molecule_);
  ++frames_;
  if (format_ == TrajectoryFormat::pdb) return write_pdb_model(out_, molecule_, positions, number);
  if (format_ == TrajectoryFormat::cif)
    return write_cif_model(out_, molecule_, positions, number, (frames_ - 1) * atoms_ + 1);
  std::string bytes;
  if (format_ == TrajectoryFormat::xtc) {
    bytes = xtc_frame(positions, frames_ - 1);
    out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return;
  }
  const auto put_single = [&](std::string& to, double x) {
    const auto value = static_cast<float>(x);
    if (!std::isfinite(value)) throw ModelError("a coordinate of " + number_text(x) + " does not fit a 32-bit float");
    put(to, value);
  };
  if (format_ == TrajectoryFormat::npy) {
    for (const Vec3& x : positions)
      for (const double c : {x[0], x[1], x[2]}) single_ ? put_single(bytes, c) : put(bytes, c);
  } else {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::string values;
      for (const Vec3& x : positions) put_single(values, x[axis]);
      put_record(bytes, values);
    }
  }
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void TrajectoryWriter::finish() {
  if (frames_ > 0 && format_ == TrajectoryFormat::pdb) write_pdb_tail(out_, molecule_);
  if (frames_ > 0 && format_ == TrajectoryFormat::cif) out_ << "#\n";
  if (!counts_frames(format_)) return;
  out_.seekp(0);
  write_head();
  out_.seekp(0, std::ios::end);
}

RowWriter::RowWriter(std::ostream& out, std::size_t columns) : out_(out), columns_(columns) {
  out_ << npy_head("0, " + std::to_string(columns_), false);
}

void RowWriter::add(std::span<const double> row) {
  if (row.size() != columns_)
    throw ModelError("a row of " + std::to_string(row.size()) + " numbers, expected " + std::to_string(columns_));
  ++rows_;
  std::string bytes;
  for (const double x : row) put(bytes, x);
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void RowWriter::finish() {
  out_.seekp(0);
  out_ << npy_head(std::to_string(rows_) + ", " + std::to_string(columns_), false);
  out_.seekp(0, std::ios::end);
}

}  // namespace hinge::molecular
