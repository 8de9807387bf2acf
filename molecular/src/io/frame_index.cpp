// SPDX-License-Identifier: BSD-3-Clause
// Implements FrameIndex. The file has the numbers 'magic number, size of the first file, count, offsets, sum' of 64
// bits each.
#include "io/frame_index.hpp"

#include <unistd.h>

#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>

namespace hinge::molecular {

namespace {

constexpr std::uint64_t index_magic = 0x68696e6765786931;  // another byte order gives another number
constexpr std::size_t index_head = 3;                      // numbers in front of the offsets

/// FNV-1a of the numbers.
std::uint64_t sum_of(const std::vector<std::uint64_t>& numbers, std::size_t count) {
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  for (std::size_t k = 0; k < count; ++k) sum = (sum ^ numbers[k]) * 0x100000001b3ULL;
  return sum;
}

}  // namespace

FrameIndex::FrameIndex(const std::filesystem::path& folder, const BinaryFile& of) : size_(of.size()) {
  std::error_code error;
  if (folder.empty() || !std::filesystem::is_directory(folder, error)) return;
  const auto time = std::filesystem::last_write_time(of.name(), error);
  if (error) return;
  std::vector<std::uint64_t> name{size_, static_cast<std::uint64_t>(time.time_since_epoch().count())};
  for (const char c : std::filesystem::absolute(of.name(), error).string())
    name.push_back(static_cast<unsigned char>(c));
  path_ = folder / ("frames-" + std::to_string(sum_of(name, name.size())) + ".index");
}

std::vector<std::uint64_t> FrameIndex::read() const {
  std::ifstream in(path_, std::ios::binary);
  std::error_code error;
  const std::uint64_t bytes = path_.empty() ? 0 : std::filesystem::file_size(path_, error);
  if (!in || error || bytes < 8 * (index_head + 1) || bytes % 8 != 0) return {};
  std::vector<std::uint64_t> numbers(static_cast<std::size_t>(bytes / 8));
  in.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(bytes));
  const bool fits = in && numbers[0] == index_magic && numbers[1] == size_ &&
                    numbers[2] == numbers.size() - index_head - 1 &&
                    numbers.back() == sum_of(numbers, numbers.size() - 1);
  if (!fits) return {};
  return {numbers.begin() + index_head, numbers.end() - 1};
}

void FrameIndex::write(const std::vector<std::uint64_t>& offsets) const {
  if (path_.empty()) return;
  std::vector<std::uint64_t> numbers{index_magic, size_, offsets.size()};
  numbers.insert(numbers.end(), offsets.begin(), offsets.end());
  numbers.push_back(sum_of(numbers, numbers.size()));
  const std::filesystem::path temporary = path_.string() + "." + std::to_string(::getpid()) + ".partial";
  std::ofstream out(temporary, std::ios::binary);
  out.write(reinterpret_cast<const char*>(numbers.data()), static_cast<std::streamsize>(8 * numbers.size()));
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, path_, error);
  if (!out || error) std::filesystem::remove(temporary, error);
}

}  // namespace hinge::molecular
