// SPDX-License-Identifier: BSD-3-Clause
// NpyFile: the header is a Python dictionary of three entries.
#include "io/npy_file.hpp"

#include <array>
#include <bit>
#include <charconv>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

constexpr std::string_view npy_magic = "\x93NUMPY";
constexpr std::size_t longest_header = 65536;  // longer than any that NumPy writes for three dimensions

/// Returns the text after "'key':" and blanks; empty if the key is missing.
std::string_view behind(std::string_view header, std::string_view key) {
  for (const char quote : {'\'', '"'}) {
    std::size_t at = header.find(quote + std::string(key) + quote);
    if (at == std::string_view::npos) continue;
    at = header.find_first_not_of(" \t", at + key.size() + 2);
    if (at == std::string_view::npos || header[at] != ':') continue;
    at = header.find_first_not_of(" \t", at + 1);
    return at == std::string_view::npos ? std::string_view() : header.substr(at);
  }
  return {};
}

/// Reads "(10, 5, 3)"; false if the text is not a tuple of integers.
bool read_tuple(std::string_view text, std::vector<std::uint64_t>& numbers) {
  if (!text.starts_with('(')) return false;
  text.remove_prefix(1);
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (text.starts_with(')')) return true;
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return false;
    numbers.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(" \tL"), text.size()));
    if (text.starts_with(','))
      text.remove_prefix(1);
    else if (!text.starts_with(')'))
      return false;
  }
}

}  // namespace

bool NpyFile::is_one(const BinaryFile& file) {
  std::array<char, npy_magic.size()> start{};
  return file.read(0, start) == npy_magic.size() && std::string_view(start.data(), start.size()) == npy_magic;
}

NpyFile::NpyFile(BinaryFile file) : file_(std::move(file)) {
  const auto refuse = [&](const std::string& what) { throw LoadError(file_.name() + ": NumPy array: " + what); };
  constexpr bool is_big = std::endian::native == std::endian::big;
  const std::vector<char> start = file_.read_all(0, 10, "its header");
  const int version = static_cast<unsigned char>(start[6]);
  if (version < 1 || version > 3) refuse("format version " + std::to_string(version) + ", expected 1 to 3");
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  const std::vector<char> length = file_.read_all(8, length_bytes, "its header");
  const std::size_t size =
      version == 1 ? number_at<std::uint16_t>(length.data(), is_big) : number_at<std::uint32_t>(length.data(), is_big);
  if (size > longest_header)
    refuse("a header of " + std::to_string(size) + " bytes, expected at most " + std::to_string(longest_header));
  data_at_ = 8 + length_bytes + size;
  const std::vector<char> text = file_.read_all(8 + length_bytes, size, "its header");
  const std::string_view header(text.data(), text.size());

  const std::string_view type = behind(header, "descr");
  if (type.size() < 4 || (type[0] != '\'' && type[0] != '"') || type[2] != 'f' || (type[3] != '4' && type[3] != '8') ||
      std::string_view("<>=").find(type[1]) == std::string_view::npos || type.substr(4, 1) != type.substr(0, 1))
    refuse("type " + std::string(type.substr(0, type.find(','))) + ", expected float32 or float64");
  width_ = type[3] == '4' ? 4 : 8;
  reversed_ = type[1] != '=' && (type[1] == '>') != is_big;
  const std::string_view order = behind(header, "fortran_order");
  fortran_ = order.starts_with("True");
  if (!fortran_ && !order.starts_with("False")) refuse("its header has no fortran_order, expected True or False");
  std::vector<std::uint64_t> shape;
  const std::string_view tuple = behind(header, "shape");
  const bool is_tuple = read_tuple(tuple, shape);
  constexpr std::uint64_t most = std::uint64_t{1} << 48;  // larger than any file; products of these stay below 2^64
  if (shape.size() == 2) shape.insert(shape.begin(), 1);
  if (!is_tuple || shape.size() != 3 || shape[2] != 3 || shape[1] == 0 || shape[0] > most || shape[1] > most / 3 / 8)
    refuse("shape " + std::string(tuple.substr(0, tuple.find(')') + 1)) + ", expected frames x atoms x 3");
  atoms_ = static_cast<std::size_t>(shape[1]);

  const std::uint64_t frame_bytes = 3 * width_ * shape[1], rest = file_.size() - data_at_;
  const std::uint64_t begun = (rest + frame_bytes - 1) / frame_bytes;
  if (begun > shape[0] || (begun == shape[0] && rest > shape[0] * frame_bytes) ||
      (fortran_ && rest < shape[0] * frame_bytes))  // in a short file every frame lacks numbers
    refuse(std::to_string(rest) + " bytes of data, expected " + std::to_string(shape[0]) + " frames of " +
           std::to_string(frame_bytes));
  // Count an incomplete frame too: reading it throws.
  frames_ = static_cast<std::size_t>(std::min(shape[0], rest / frame_bytes + 1));
}

std::vector<Vec3> NpyFile::frame(std::size_t k) const {
  const std::string what = "frame " + std::to_string(k);
  const std::size_t size = 3 * width_ * atoms_;
  std::vector<char> bytes(size);
  if (!fortran_) {
    file_.read_all(data_at_ + k * std::uint64_t{size}, bytes, what);
  } else {
    // Frames change fastest, then atoms: the numbers of a frame are far apart.
    for (std::uint64_t n = 0; n < 3 * atoms_; ++n) {
      const std::uint64_t atom = n / 3, axis = n % 3;
      file_.read_all(data_at_ + width_ * (k + frames_ * (atom + atoms_ * axis)),
                     std::span(bytes).subspan(n * width_, width_), what);
    }
  }
  std::vector<Vec3> positions(atoms_);
  const char* at = bytes.data();
  for (Vec3& x : positions)
    for (Eigen::Index axis = 0; axis < 3; ++axis, at += width_)
      x[axis] = width_ == 4 ? static_cast<double>(number_at<float>(at, reversed_)) : number_at<double>(at, reversed_);
  return positions;
}

}  // namespace hinge::molecular
