// SPDX-License-Identifier: BSD-3-Clause
// UnpackedFile: unpacks gzip members with zlib's inflate.
#include "io/unpacked_file.hpp"

#include <algorithm>
#include <new>
#include <string_view>

#include "hinge/core/error.hpp"

namespace hinge::molecular {

namespace {

/// The first bytes of formats that may hold a structure and are not read.
struct Format {
  std::string_view start, name;
};
constexpr Format unread_formats[] = {{"BZh", "packed by bzip2"},
                                     {"\xfd\x37zXZ", "packed by xz"},
                                     {"\x28\xb5\x2f\xfd", "packed by zstd"},
                                     {"PK\x03\x04", "a zip archive"},
                                     {"\x83\xa7", "BinaryCIF"}};

}  // namespace

UnpackedFile::UnpackedFile(const std::filesystem::path& path)
    : file_(path, "a PDB or mmCIF file"), packed_(std::size_t{1} << 16U) {
  constexpr int gzip_alone = 15 + 16;  // inflateInit2's window bits for gzip only
  fill();
  const std::string_view start(packed_.data(), stream_.avail_in);
  for (const Format& format : unread_formats)
    if (start.starts_with(format.start))
      throw LoadError(path.string() + ": is " + std::string(format.name) + ", expected text, plain or gzipped");
  is_gzipped_ = start.size() >= 2 && starts_gzip(start[0], start[1]);
  if (is_gzipped_ && inflateInit2(&stream_, gzip_alone) != Z_OK) throw std::bad_alloc();
}

UnpackedFile::~UnpackedFile() {
  if (is_gzipped_) inflateEnd(&stream_);
}

bool UnpackedFile::fill() {
  if (stream_.avail_in > 0) return true;
  stream_.avail_in = static_cast<uInt>(file_.read(packed_));
  stream_.next_in = reinterpret_cast<Bytef*>(packed_.data());
  return stream_.avail_in > 0;
}

std::size_t UnpackedFile::read(std::span<char> to) {
  if (is_gzipped_) return unpack(to);
  if (!fill()) return 0;
  const std::size_t count = std::min<std::size_t>(to.size(), stream_.avail_in);
  std::copy_n(stream_.next_in, count, to.begin());
  stream_.next_in += count;
  stream_.avail_in -= static_cast<uInt>(count);
  return count;
}

std::size_t UnpackedFile::unpack(std::span<char> to) {
  stream_.next_out = reinterpret_cast<Bytef*>(to.data());
  stream_.avail_out = static_cast<uInt>(to.size());
  while (stream_.avail_out == to.size()) {
    if (!fill()) {
      if (in_member_) refuse("the file ends inside a gzip member; it may be cut short");
      break;
    }
    if (!in_member_ && *stream_.next_in == 0 && members_ > 0) {
      while (fill()) {
        if (*stream_.next_in != 0) refuse("expected only zeros after the last gzip member");
        ++stream_.next_in;
        --stream_.avail_in;
      }
      break;
    }
    if (!in_member_) {
      inflateReset(&stream_);
      in_member_ = true;
      ++members_;
    }
    const int status = inflate(&stream_, Z_NO_FLUSH);
    if (status == Z_STREAM_END)
      in_member_ = false;
    else if (status == Z_MEM_ERROR)
      throw std::bad_alloc();
    else if (status != Z_OK && status != Z_BUF_ERROR)
      refuse(std::string("gzip data is damaged: ") + (stream_.msg != nullptr ? stream_.msg : "needs a dictionary") +
             (members_ > 1 && stream_.total_out == 0 ? "; expected a gzip member or the end of the file" : ""));
  }
  return to.size() - stream_.avail_out;
}

void UnpackedFile::refuse(const std::string& what) const {
  throw LoadError(file_.name() + ": cannot be read to its end: byte " + std::to_string(packed()) + ": " + what);
}

}  // namespace hinge::molecular
