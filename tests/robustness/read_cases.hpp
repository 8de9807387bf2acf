// SPDX-License-Identifier: BSD-3-Clause
// Reads all cases in a folder of .jsonl files. Numbers are strings with hexadecimal doubles.
#pragma once

#include <filesystem>
#include <vector>

#include "robustness/case.hpp"

namespace hinge::robustness {

/// Reads the files in the order of their names. Throws LoadError with file and line: an unreadable folder or file, no
/// .jsonl file, a line that is no case, an unknown kind. Lists of a wrong length are no error here: the library must
/// reject them.
std::vector<Case> read_cases(const std::filesystem::path& folder);

}  // namespace hinge::robustness
