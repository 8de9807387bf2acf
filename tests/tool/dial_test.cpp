// SPDX-License-Identifier: BSD-3-Clause
// Tests the measurement of choices and its statistics with choices whose errors are known.
#include "hinge_tools/measure.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hinge_tools/statistics.hpp"

namespace hinge::tool {
namespace dial_test {

TEST(Statistics, ShareHasWilsonsInterval) {
  const Estimate ten = share_of(10, 100);  // Newcombe 1998, table I, method 3, has 0.0553 and 0.1744
  EXPECT_DOUBLE_EQ(ten.value, 0.1);
  EXPECT_NEAR(ten.low, 0.0552, 1e-4);
  EXPECT_NEAR(ten.high, 0.1744, 1e-4);
  EXPECT_EQ(share_of(0, 50).low, 0.0);
  EXPECT_NEAR(share_of(0, 50).high, 3.8415 / (50 + 3.8415), 1e-4);
  EXPECT_EQ(share_of(50, 50).high, 1.0);
}

TEST(Statistics, MedianHasAnIntervalOfOrderStatistics) {
  std::vector<double> values;
  for (int k = 20; k >= 1; --k) values.push_back(k);
  const Estimate median = median_of(values);
  EXPECT_EQ(median.value, 10.5);
  EXPECT_EQ(median.low, 5);
  EXPECT_EQ(median.high, 16);
  EXPECT_EQ(median_of({3.0, 1.0, 2.0}).low, 1.0);
  EXPECT_EQ(median_of({3.0, 1.0, 2.0}).high, 3.0);
}

TEST(Statistics, MeanHasTheNormalInterval) {
  const Estimate mean = mean_of({1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_DOUBLE_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.high - mean.value, 1.959964 * std::sqrt(2.5 / 5.0), 1e-6);
  EXPECT_EQ(mean_of({0.0, 0.0, 1.0}).low, 0.0);
  EXPECT_EQ(mean_of({2.0}).high, 2.0);
}

/// Question k collides if k is a multiple of 4. wrong(k): this answer is wrong.
template <class Wrong>
DialChoice choice(const std::string& name, Sound sound, std::chrono::microseconds time, const Wrong& wrong) {
  return {"kind",
          name,
          "--" + name,
          sound,
          [=](std::uint64_t first, std::span<Verdict3> verdicts) {
            for (Verdict3& verdict : verdicts) {
              const bool collides = (first % 4 == 0) != wrong(first);
              ++first;
              verdict = collides ? Verdict3::collides : Verdict3::free;
              const auto end = Clock::now() + time;
              while (Clock::now() < end) {
              }
            }
          },
          {},
          [](std::uint64_t k) { return static_cast<double>(k); }};
}

DialSection section() {
  using std::chrono::microseconds;
  const auto right = [](std::uint64_t) { return false; };
  DialSection s;
  s.title = "Numbers";
  s.choices = {
      choice("reference", Sound::exact, microseconds(40), right),
      choice("slower", Sound::exact, microseconds(400), right),  // by far, also on a busy machine
      choice("misses", Sound::unknown, microseconds(10), [](std::uint64_t k) { return k % 20 == 0; }),
      choice("encloses", Sound::no_false_accept, microseconds(20), [](std::uint64_t k) { return k % 100 == 1; }),
      choice("beaten", Sound::unknown, microseconds(20), [](std::uint64_t k) { return k % 4 == 0; })};
  s.choices[1].distance = [](std::uint64_t k) { return static_cast<double>(k) + (k == 7 ? 0.5 : 0.25); };
  return s;
}

TEST(Dial, CountsEveryError) {
  const DialResult result = measure(section(), {.seconds = 1.0, .count = 1000});
  ASSERT_EQ(result.rows.size(), 5U);
  for (const DialRow& row : result.rows) {
    EXPECT_EQ(row.count, 1000U);
    EXPECT_EQ(row.colliding, 250U);
    EXPECT_EQ(row.free, 750U);
  }
  EXPECT_EQ(result.rows[1].false_accepts + result.rows[1].false_rejects, 0U);
  EXPECT_EQ(result.rows[2].false_accepts, 50U);
  EXPECT_EQ(result.rows[3].false_rejects, 10U);
  EXPECT_EQ(result.rows[3].false_accepts, 0U);
  EXPECT_EQ(result.rows[4].false_accepts, 250U);
  EXPECT_NEAR(result.rows[1].mean_distance_error.value, 0.25, 0.01);
  EXPECT_LE(result.rows[1].mean_distance_error.low, result.rows[1].mean_distance_error.value);
  EXPECT_EQ(result.rows[1].largest_distance_error, 0.5);
  EXPECT_GE(result.rows[1].distances, 100U);
}

TEST(Dial, FrontAndLimits) {
  const DialResult result = measure(section(), {.seconds = 2.0});
  const std::vector<DialRow>& rows = result.rows;
  EXPECT_TRUE(rows[0].is_on_front);
  EXPECT_FALSE(rows[1].is_on_front);
  EXPECT_TRUE(rows[2].is_on_front);
  EXPECT_TRUE(rows[3].is_on_front);
  EXPECT_GT(rows[0].seconds.value, 20e-6);
  EXPECT_LE(rows[0].seconds.low, rows[0].seconds.value);
  EXPECT_GT(rows[2].speed.value, rows[1].speed.value);
  EXPECT_TRUE(keeps(rows[1], {0.0, 0.0}));
  EXPECT_FALSE(keeps(rows[2], {0.0, 0.5}));  // it may miss some
  EXPECT_TRUE(keeps(rows[2], {0.5, 0.5}));
  EXPECT_FALSE(keeps(rows[3], {0.0, 0.001}));
  EXPECT_TRUE(keeps(rows[3], {0.0, 0.05}));
  EXPECT_FALSE(keeps(rows[3], {0.0, 0.0}));
}

TEST(Dial, LeavesOutWhatIsTooSlowAndEndsInTime) {
  DialSection slow = section();
  slow.choices.push_back(
      choice("slow", Sound::exact, std::chrono::milliseconds(120), [](std::uint64_t) { return false; }));
  const auto start = Clock::now();
  const DialResult result = measure(std::move(slow), {.seconds = 1.0});
  EXPECT_EQ(result.rows.size(), 5U);
  ASSERT_EQ(result.notes.size(), 1U);
  EXPECT_EQ(result.notes[0], "slow: left out, one answer takes 0.1 s");
  EXPECT_LT(seconds_since(start), 10.0);
}

TEST(Dial, UndecidedAnswersAreNotCounted) {
  DialSection s = section();
  s.choices.resize(1);
  DialChoice undecided = s.choices[0];
  undecided.name = "undecided";
  undecided.ask = [](std::uint64_t, std::span<Verdict3> verdicts) {
    for (Verdict3& verdict : verdicts) verdict = Verdict3::undecided;
  };
  s.choices.push_back(undecided);
  const DialResult result = measure(std::move(s), {.seconds = 0.2, .count = 40});
  EXPECT_EQ(result.rows[1].count, 40U);
  EXPECT_EQ(result.rows[1].colliding + result.rows[1].free, 0U);
  EXPECT_FALSE(result.rows[1].accept_rate());
}

TEST(Dial, DistancesThatDoNotExistAreNotCompared) {
  DialSection s = section();
  s.choices.resize(2);
  const auto none = [](std::uint64_t k) { return k % 2 == 0 ? 1.0 : std::numeric_limits<double>::infinity(); };
  s.choices[0].distance = s.choices[1].distance = none;
  const DialResult result = measure(std::move(s), {.seconds = 0.2, .count = 40});
  EXPECT_EQ(result.rows[1].distances, 20U);
  EXPECT_EQ(result.rows[1].mean_distance_error.value, 0.0);
  EXPECT_EQ(result.rows[1].largest_distance_error, 0.0);
}

TEST(Dial, ConfirmsAChoiceThatIsFasterAndKeepsTheLimits) {
  const DialSection s = section();
  const DialEffort effort{.seconds = 0.5};
  const auto row = confirm(s.choices[0], s.choices[3], effort, {0.0, 0.05});
  ASSERT_TRUE(row);
  EXPECT_EQ(row->name, "encloses");
  EXPECT_EQ(row->distances, 0U);
  EXPECT_FALSE(confirm(s.choices[0], s.choices[1], effort, {0.0, 0.05}));  // slower
  EXPECT_FALSE(confirm(s.choices[0], s.choices[2], effort, {0.0, 0.05}));  // misses some
}

}  // namespace dial_test
}  // namespace hinge::tool
