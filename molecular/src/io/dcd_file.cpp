// SPDX-License-Identifier: BSD-3-Clause
// DcdFile: reads records, headers and frames.
#include "io/dcd_file.hpp"

#include <array>
#include <string_view>
#include <tuple>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

constexpr std::string_view dcd_magic = "CORD";
constexpr std::size_t header_bytes = 84, cell_bytes = 48;
/// Indices in the twenty integers after the magic.
constexpr std::size_t frame_count_at = 0, fixed_count_at = 8, has_cell_at = 10, has_fourth_at = 11, version_at = 19;

/// Returns the size of a record marker and whether its bytes are reversed; size 0: not a DCD file.
std::pair<std::size_t, bool> markers(const BinaryFile& file) {
  std::array<char, 12> start{};
  const std::size_t got = file.read(0, start);
  for (const std::size_t size : {std::size_t{4}, std::size_t{8}})
    for (const bool reversed : {false, true}) {
      if (got < size + dcd_magic.size() || std::string_view(start.data() + size, dcd_magic.size()) != dcd_magic)
        continue;
      const std::uint64_t length = size == 4 ? number_at<std::uint32_t>(start.data(), reversed)
                                             : number_at<std::uint64_t>(start.data(), reversed);
      if (length == header_bytes) return {size, reversed};
    }
  return {0, false};
}

}  // namespace

bool DcdFile::is_one(const BinaryFile& file) { return markers(file).first != 0; }

std::uint64_t DcdFile::marker(const char* bytes) const noexcept {
  return marker_size_ == 4 ? number_at<std::uint32_t>(bytes, reversed_) : number_at<std::uint64_t>(bytes, reversed_);
}

std::uint64_t DcdFile::record(std::uint64_t offset, std::uint64_t& next, const std::string& what) const {
  std::array<char, 8> bytes{};
  const std::span<char> length(bytes.data(), marker_size_);
  file_.read_all(offset, length, what);
  const std::uint64_t size = marker(bytes.data());
  if (size > file_.size()) file_.read_all(offset + marker_size_, std::size_t{size}, what);  // throws
  file_.read_all(offset + marker_size_ + size, length, what);
  if (marker(bytes.data()) != size)
    throw LoadError(file_.name() + ": " + what + ": a record of " + std::to_string(size) + " bytes at byte " +
                    std::to_string(offset) + " ends with the length " + std::to_string(marker(bytes.data())));
  next = offset + 2 * marker_size_ + size;
  return size;
}

std::uint64_t DcdFile::frame_bytes(std::uint64_t atoms) const noexcept {
  const std::uint64_t axis = 2 * marker_size_ + 4 * atoms;
  return (has_cell_ ? 2 * marker_size_ + cell_bytes : 0) + (has_fourth_ ? 4 : 3) * axis;
}

DcdFile::DcdFile(BinaryFile file) : file_(std::move(file)) {
  std::tie(marker_size_, reversed_) = markers(file_);
  const auto refuse = [&](const std::string& what) { throw LoadError(file_.name() + ": DCD header: " + what); };
  std::uint64_t next = 0;
  record(0, next, "its header");
  const std::vector<char> header =
      file_.read_all(marker_size_ + dcd_magic.size(), header_bytes - dcd_magic.size(), "its header");
  const bool is_charmm = integer(header, version_at) != 0;  // X-PLOR stores a double at the position of CHARMM's flags
  has_cell_ = is_charmm && integer(header, has_cell_at) != 0;
  has_fourth_ = is_charmm && integer(header, has_fourth_at) != 0;

  record(next, next, "its title");
  const std::uint64_t count_at = next + marker_size_;
  if (const std::uint64_t size = record(next, next, "its number of atoms"); size != 4)
    refuse("the number of atoms has " + std::to_string(size) + " bytes, expected 4");
  const std::int32_t atoms = integer(file_.read_all(count_at, 4, "its number of atoms"), 0);
  const std::int32_t fixed = integer(header, fixed_count_at);
  if (atoms <= 0) refuse(std::to_string(atoms) + " atoms, expected at least one");
  if (fixed < 0 || fixed >= atoms)
    refuse(std::to_string(fixed) + " fixed atoms of " + std::to_string(atoms) + ", expected fewer");
  atoms_ = static_cast<std::size_t>(atoms);
  if (fixed > 0) {
    const std::size_t moving = atoms_ - static_cast<std::size_t>(fixed);
    const std::uint64_t list_at = next + marker_size_;
    if (const std::uint64_t size = record(next, next, "its list of moving atoms"); size != 4 * moving)
      refuse("the list of moving atoms has " + std::to_string(size) + " bytes, expected " + std::to_string(4 * moving));
    const std::vector<char> list = file_.read_all(list_at, 4 * moving, "its list of moving atoms");
    for (std::size_t k = 0; k < moving; ++k) {
      const std::int32_t number = integer(list, k);  // counted from 1
      if (number < 1 || number > atoms)
        refuse("moving atom " + std::to_string(number) + ", expected 1 to " + std::to_string(atoms));
      moving_.push_back(static_cast<std::uint32_t>(number - 1));
    }
  }
  frames_at_ = next;
  if (frames_at_ == file_.size()) {
    if (integer(header, frame_count_at) == 0) return;  // a writer without frames leaves such a file
    throw LoadError(file_.name() + ": holds no frame, expected the number in its header: " +
                    std::to_string(integer(header, frame_count_at)));
  }

  const std::uint64_t first = frame_bytes(atoms_), later = frame_bytes(moving_.empty() ? atoms_ : moving_.size());
  const std::uint64_t rest = file_.size() - frames_at_;
  const std::uint64_t whole = rest < first ? 0 : 1 + (rest - first) / later;
  const bool cut = rest < first || (rest - first) % later != 0;
  frames_ = static_cast<std::size_t>(whole + (cut ? 1 : 0));
  const std::int32_t claimed = integer(header, frame_count_at);
  if (claimed < 0 || static_cast<std::uint64_t>(claimed) != whole)
    notes_.push_back(file_.name() + ": its header says " + std::to_string(claimed) + " frames, the file holds " +
                     std::to_string(whole) + (cut ? " and a part of another frame" : ""));
  if (!moving_.empty()) first_ = frame(0);
}

void DcdFile::read_axes(std::size_t k, std::uint64_t offset, std::vector<Vec3>& positions, bool all) const {
  const std::string what = "frame " + std::to_string(k);
  const std::uint64_t count = all ? atoms_ : moving_.size();
  const std::vector<char> bytes = file_.read_all(offset, static_cast<std::size_t>(frame_bytes(count)), what);
  if (all) positions.resize(atoms_);  // after read_all, so that a damaged count allocates nothing
  const char* at = bytes.data();
  const auto enter = [&](std::uint64_t expected) {
    const std::uint64_t open = marker(at), closed = marker(at + marker_size_ + expected);
    if (open != expected || closed != expected)
      throw LoadError(file_.name() + ": " + what + ": a record of " + std::to_string(open) + " bytes at byte " +
                      std::to_string(offset + static_cast<std::uint64_t>(at - bytes.data())) + ", expected " +
                      std::to_string(expected));
    return std::exchange(at, at + 2 * marker_size_ + expected) + marker_size_;
  };
  if (has_cell_) enter(cell_bytes);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char* values = enter(4 * count);
    for (std::size_t i = 0; i < count; ++i)
      positions[all ? i : moving_[i]][axis] = static_cast<double>(number_at<float>(values + 4 * i, reversed_));
  }
  if (has_fourth_) enter(4 * count);
}

std::vector<Vec3> DcdFile::frame(std::size_t k) const {
  if (k == 0 || moving_.empty()) {
    std::vector<Vec3> positions;
    read_axes(k, frames_at_ + k * frame_bytes(atoms_), positions, true);
    return positions;
  }
  std::vector<Vec3> positions = first_;
  read_axes(k, frames_at_ + frame_bytes(atoms_) + (k - 1) * frame_bytes(moving_.size()), positions, false);
  return positions;
}

}  // namespace hinge::molecular
