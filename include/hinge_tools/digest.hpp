// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 digests of files and texts.
#pragma once

#include <sha2.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"

namespace hinge::tool {

/// Returns the SHA-256 digest of a file in hexadecimal digits, as sha256sum prints it; empty for what is not a regular
/// file, because a pipe can be read only once. Throws LoadError if the file cannot be read.
inline std::string sha256_of(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::array<char, SHA256_DIGEST_STRING_LENGTH> digest{};
  if (SHA256File(path.c_str(), digest.data()) == nullptr)
    throw LoadError(path + ": cannot be read: " + std::strerror(errno));
  return digest.data();
}

/// A running digest.
class Digest {
 public:
  Digest() { SHA256Init(&state_); }
  void add(std::string_view text) {
    SHA256Update(&state_, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
  std::string text() {
    std::array<char, SHA256_DIGEST_STRING_LENGTH> digits{};
    SHA256End(&state_, digits.data());
    return digits.data();
  }

 private:
  SHA2_CTX state_{};
};

/// Returns the digest of a text.
inline std::string sha256_of_text(std::string_view text) {
  Digest digest;
  digest.add(text);
  return digest.text();
}

}  // namespace hinge::tool
