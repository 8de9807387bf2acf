// SPDX-License-Identifier: BSD-3-Clause
// JSON as text, whatever bytes names and paths have.
#pragma once

#include <cstdio>
#include <string>

namespace hinge::tool {

/// JSON is UTF-8. Bytes of a name or path that are not are written as U+FFFD, and the first time that happens a note on
/// standard error says so. json: of nlohmann's library; indent: as its dump takes it.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  try {
    return json.dump(indent);
  } catch (const typename Json::type_error&) {
    static const bool noted =
        std::fputs("note: a name or path is not UTF-8: JSON has U+FFFD for each of its bytes that are not\n", stderr) >=
        0;
    static_cast<void>(noted);
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
  }
}

}  // namespace hinge::tool
