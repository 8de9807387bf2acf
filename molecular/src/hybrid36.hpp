// SPDX-License-Identifier: BSD-3-Clause
// Numbers in five columns of a PDB file.
#pragma once

#include <cstddef>
#include <string>

namespace hinge::molecular {

/// Hybrid-36 (Grosse-Kunstleve): decimal up to 99999, then A0000 ... ZZZZZ, a0000 ... in base 36.
inline std::string hybrid36(std::size_t value) {
  if (value < 100000) return std::to_string(value);
  constexpr std::size_t block = 26UL * 36 * 36 * 36 * 36;
  value -= 100000;
  const bool lower = value >= block;
  if (lower) value -= block;
  const char* digits = lower ? "0123456789abcdefghijklmnopqrstuvwxyz" : "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
  value += 10UL * 36 * 36 * 36 * 36;
  std::string text(5, '0');
  for (std::size_t k = 5; k-- > 0; value /= 36) text[k] = digits[value % 36];
  return text;
}

}  // namespace hinge::molecular
