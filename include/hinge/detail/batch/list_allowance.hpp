// SPDX-License-Identifier: BSD-3-Clause
// ListAllowance: how much more than the ways of the present configurations a list of near pairs should allow.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace hinge::detail {

/// Lists that allow more last longer, and cost more to make and to test. Which factor costs the fewest tests for each
/// block is learned; the others are tried again from time to time. Costs time, never an answer.
class ListAllowance {
 public:
  double factor() const noexcept { return factors[choice_]; }

  /// A list of `pairs` pairs has been made with so many tests.
  void made(std::uint64_t tests, std::size_t pairs) noexcept {
    making_ = tests;
    testing_ = lanes * pairs;
  }
  /// It served another block.
  void serve() noexcept { ++served_; }
  /// Has testing it cost so much more than making it that another one should be looked for?
  bool outlived() const noexcept { return served_ * testing_ > 16 * making_; }

  /// The list is given up.
  void settle() noexcept {
    if (served_ != 0) {
      const double tests = static_cast<double>(making_) / static_cast<double>(served_) + static_cast<double>(testing_);
      double& known = tests_of_[choice_];
      known = known == 0.0 ? tests : 0.5 * (known + tests);
      choice_ = ++lists_ % try_again == 0
                    ? lists_ / try_again % factors.size()
                    : static_cast<std::size_t>(std::ranges::min_element(tests_of_) - tests_of_.begin());
    }
    served_ = 0;
  }

 private:
  static constexpr std::array<double, 4> factors = {2.0, 1.0, 4.0, 8.0};
  static constexpr std::size_t try_again = 64;  // lists
  static constexpr std::uint64_t lanes = 16;

  std::array<double, factors.size()> tests_of_{};  // for each block; 0: not tried
  std::size_t choice_ = 0, lists_ = 0;
  std::uint64_t making_ = 0, testing_ = 0, served_ = 0;
};

}  // namespace hinge::detail
