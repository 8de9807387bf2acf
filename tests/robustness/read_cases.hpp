// SPDX-License-Identifier: BSD-3-Clause
// read_cases: all cases of a folder of .jsonl files. Numbers are strings that hold hexadecimal doubles.
#pragma once

#include <filesystem>
#include <vector>

#include "robustness/case.hpp"

namespace hinge::robustness {

/// Files in the order of their names. LoadError, naming file and line: folder or file that cannot be read, no such
/// file, a line that is no case, an unknown kind. Lists of a wrong length are no error here, but the library's
/// business.
std::vector<Case> read_cases(const std::filesystem::path& folder);

}  // namespace hinge::robustness
