// SPDX-License-Identifier: BSD-3-Clause
// XtcFile: reads the headers of frames and passes their coordinates to unpack_xtc.
#include "io/xtc_file.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "io/frame_index.hpp"
#include "io/xtc_coordinates.hpp"

namespace hinge::molecular {

namespace {

constexpr std::int32_t xtc_magic = 1995, magic_of_large_systems = 2023;  // the latter: 64-bit data lengths
constexpr bool swaps_bytes = std::endian::native == std::endian::little;
/// Bytes of magic, atoms, step, time, box of nine, atoms again.
constexpr std::size_t plain_head = 56;
/// Adds precision, smallest and largest coordinates, small range, data length.
constexpr std::size_t packed_head = plain_head + 4 + 12 + 12 + 4 + 4;
/// Frames of so few atoms are stored as plain floats.
constexpr std::int32_t most_plain_atoms = 9;

std::int32_t integer(const char* bytes) noexcept { return number_at<std::int32_t>(bytes, swaps_bytes); }
double real(const char* bytes) noexcept { return static_cast<double>(number_at<float>(bytes, swaps_bytes)); }

}  // namespace

bool XtcFile::is_one(const BinaryFile& file) {
  std::array<char, 8> start{};
  if (file.read(0, start) < start.size()) return false;
  const std::int32_t word = integer(start.data());
  return (word == xtc_magic || word == magic_of_large_systems) && integer(start.data() + 4) > 0;
}

XtcFile::XtcFile(BinaryFile file, const std::filesystem::path& index_folder) : file_(std::move(file)) {
  const FrameIndex index(index_folder, file_);
  frames_at_ = index.read();
  if (frames_at_.empty()) {
    find_frames();
    index.write(frames_at_);
  } else {
    atoms_ = static_cast<std::size_t>(head(0).atoms);
  }
  if (atoms_ == 0) frame(0);  // the first header is damaged: throws
}

void XtcFile::find_frames() {
  for (std::uint64_t offset = 0; offset < file_.size();) {
    frames_at_.push_back(offset);
    Head h;
    try {
      h = head(offset);
    } catch (const LoadError&) {
      break;  // frame() reports the error when this frame is read
    }
    if (frames_at_.size() == 1) atoms_ = static_cast<std::size_t>(h.atoms);
    const std::uint64_t padded = (static_cast<std::uint64_t>(h.data_size) + 3) / 4 * 4;
    if (padded > file_.size() - h.data_at) break;
    offset = h.data_at + padded;
  }
}

XtcFile::Head XtcFile::head(std::uint64_t offset) const {
  const auto refuse = [&](const std::string& why) {
    throw LoadError(file_.name() + ": frame at byte " + std::to_string(offset) + ": " + why);
  };
  Head h;
  h.bytes.resize(packed_head + 4);
  const std::size_t got = file_.read(offset, h.bytes);
  const auto need = [&](std::size_t size) {
    if (got < size) refuse("the file ends inside the header of the frame; it may be cut short");
  };
  need(plain_head);
  const char* at = h.bytes.data();
  h.magic = integer(at);
  h.atoms = integer(at + 4);
  if (h.magic != xtc_magic && h.magic != magic_of_large_systems)
    refuse("starts with " + std::to_string(h.magic) + ", expected 1995 or 2023");
  if (h.atoms <= 0 || (atoms_ != 0 && static_cast<std::size_t>(h.atoms) != atoms_))
    refuse(std::to_string(h.atoms) + " atoms, expected " +
           (atoms_ != 0 ? std::to_string(atoms_) + " as in the first frame" : "at least one"));
  if (integer(at + plain_head - 4) != h.atoms)
    refuse(std::to_string(h.atoms) + " atoms, but coordinates of " + std::to_string(integer(at + plain_head - 4)) +
           " atoms");
  if (h.atoms <= most_plain_atoms) {
    h.data_at = offset + plain_head;
    h.data_size = 12 * std::int64_t{h.atoms};
    return h;
  }
  const std::size_t size = packed_head + (h.magic == xtc_magic ? 0 : 4);
  need(size);
  h.data_at = offset + size;
  h.data_size =
      h.magic == xtc_magic ? integer(at + packed_head - 4) : number_at<std::int64_t>(at + packed_head - 4, swaps_bytes);
  // Every atom takes at least two bits.
  if (h.data_size <= 0 || h.atoms / 4 > h.data_size)
    refuse(std::to_string(h.data_size) + " bytes of coordinates for " + std::to_string(h.atoms) +
           " atoms, expected more");
  return h;
}

std::vector<Vec3> XtcFile::frame(std::size_t k) const {
  const std::string what = "frame " + std::to_string(k);
  const Head h = head(frames_at_.at(k));
  std::vector<char> data = file_.read_all(h.data_at, static_cast<std::size_t>(h.data_size), what);
  if (h.atoms <= most_plain_atoms) {
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < data.size(); i += 12)
      positions.emplace_back(10.0 * real(&data[i]), 10.0 * real(&data[i + 4]), 10.0 * real(&data[i + 8]));
    return positions;
  }
  const char* at = h.bytes.data() + plain_head;
  XtcBlock block;
  block.per_nanometre = real(at);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block.least[axis] = integer(at + 4 + 4 * axis);
    block.most[axis] = integer(at + 16 + 4 * axis);
  }
  block.small = integer(at + 28);
  const std::string where = file_.name() + ": " + what;
  if (!(block.per_nanometre > 0.0) || !std::isfinite(block.per_nanometre))
    throw LoadError(where + ": precision " + number_text(block.per_nanometre) + ", expected a finite number above 0");
  data.resize(data.size() + xtc_padding);
  return unpack_xtc(block, data, static_cast<std::size_t>(h.atoms), where);
}

}  // namespace hinge::molecular
