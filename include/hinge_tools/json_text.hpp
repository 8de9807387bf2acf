// SPDX-License-Identifier: BSD-3-Clause
// json_text: writes JSON as text, even if names and paths contain invalid UTF-8.
#pragma once

#include <cstdio>
#include <string>

namespace hinge::tool {

/// Returns the JSON as UTF-8 text. Invalid bytes of names and paths are written as U+FFFD; the first time, a note is
/// printed on standard error. json: an nlohmann::json; indent: as for its dump().
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  try {
    return json.dump(indent);
  } catch (const typename Json::type_error&) {
    static const bool noted =
        std::fputs("note: a name or path is not UTF-8: JSON has U+FFFD in place of each invalid byte\n", stderr) >= 0;
    static_cast<void>(noted);
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
  }
}

}  // namespace hinge::tool
