// SPDX-License-Identifier: BSD-3-Clause
// Tests the stored cases with exact answers on every engine.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "robustness/case.hpp"
#include "robustness/expect_right.hpp"
#include "robustness/read_cases.hpp"

namespace hinge::robustness {
namespace shared_files_test {

TEST(SharedFiles, AgreeWithStoredExactAnswers) {
  const std::filesystem::path folder = std::string(HINGE_SHARED_DATA) + "/robustness";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no folder " << folder;
  std::map<std::string, std::size_t> cases;
  for (const Case& one : read_cases(folder)) {
    ASSERT_TRUE(one.truth.has_value()) << one.id;
    EXPECT_TRUE(expect_right(one)) << one.id;
    ++cases[one.kind];
  }
  for (const auto& [kind, count] : cases) std::cout << count << " cases of " << kind << "\n";
}

}  // namespace shared_files_test
}  // namespace hinge::robustness
