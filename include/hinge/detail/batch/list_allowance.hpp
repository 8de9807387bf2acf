// SPDX-License-Identifier: BSD-3-Clause
// ListAllowance: learns by which factor a list of near pairs should exceed the present displacements.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace hinge::detail {

/// A larger allowance makes a list last longer, but it costs more to make and to test. The class learns the factor with
/// the fewest tests per block, and retries the other factors from time to time. It affects time, never answers.
class ListAllowance {
 public:
  double factor() const noexcept { return factors[choice_]; }

  /// A list of `pairs` pairs was made at a cost of `tests` tests.
  void made(std::uint64_t tests, std::size_t pairs) noexcept {
    making_ = tests;
    testing_ = lanes * pairs;
  }
  /// The list served another block.
  void serve() noexcept { ++served_; }
  /// True if testing the list has cost much more than making it: a new one should be tried.
  bool outlived() const noexcept { return served_ * testing_ > 16 * making_; }

  /// The list is dropped: updates the cost of its factor and chooses the next factor.
  void settle() noexcept {
    if (served_ != 0) {
      const double tests = static_cast<double>(making_) / static_cast<double>(served_) + static_cast<double>(testing_);
      double& known = tests_of_[choice_];
      known = known == 0.0 ? tests : 0.5 * (known + tests);
      choice_ =
          ++lists_ % try_again == 0
              ? lists_ / try_again % factors.size()
              : static_cast<std::size_t>(std::min_element(tests_of_.begin(), tests_of_.end()) - tests_of_.begin());
    }
    served_ = 0;
  }

 private:
  static constexpr std::array<double, 4> factors = {2.0, 1.0, 4.0, 8.0};
  static constexpr std::size_t try_again = 64;  // lists
  static constexpr std::uint64_t lanes = 16;

  std::array<double, factors.size()> tests_of_{};  // per block; 0: not tried
  std::size_t choice_ = 0, lists_ = 0;
  std::uint64_t making_ = 0, testing_ = 0, served_ = 0;
};

}  // namespace hinge::detail
