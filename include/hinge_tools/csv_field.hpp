// SPDX-License-Identifier: BSD-3-Clause
// csv_field: formats a text as a field of a CSV file.
#pragma once

#include <string>

namespace hinge::tool {

/// Returns the text, in quotes if it contains a comma, quote or line end (RFC 4180).
inline std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

}  // namespace hinge::tool
