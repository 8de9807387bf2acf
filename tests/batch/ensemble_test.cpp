// SPDX-License-Identifier: BSD-3-Clause
// Many configurations: results and their order do not depend on the number of threads; exceptions reach the caller.
#include "hinge/batch/ensemble.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include "engine/random_mechanism.hpp"
#include "hinge/primitive/point.hpp"

namespace hinge {
namespace ensemble_test {

using test::Random;

Point any_point(Random& random, const Vec3&, const Vec3&) { return Point{random.vector(4.0)}; }

struct Arm {
  explicit Arm(std::uint64_t seed) : random(seed), model(test::random_model(random, 40, 8, false, any_point)) {}
  Random random;
  Model<Point> model;
};

TEST(Ensemble, HandsResultsOverInOrderWhateverTheThreads) {
  Arm arm(3);
  const Hierarchy hierarchy(arm.model, AdmitAll{}, UniformClearance{0.3});
  ASSERT_GT(hierarchy.dof_count(), 5U);
  constexpr std::size_t count = 500;
  std::vector<double> q(count * hierarchy.dof_count());
  for (double& value : q) value = arm.random.uniform(-0.3, 0.3);
  const auto configuration = [&](std::size_t k) {
    return std::span(q).subspan(k * hierarchy.dof_count(), hierarchy.dof_count());
  };
  std::vector<std::vector<Hit>> expected;
  auto alone = hierarchy;
  for (std::size_t k = 0; k < count; ++k) {
    alone.update(configuration(k));
    expected.push_back(alone.self_collisions());
  }
  for (const unsigned threads : {1U, 2U, 8U}) {
    std::size_t next = 0;
    Ensemble(hierarchy, threads)
        .run(
            count,
            [&](auto& own, std::size_t k) {
              own.update(configuration(k));
              return own.self_collisions();
            },
            [&](std::size_t k, const std::vector<Hit>& hits) {
              EXPECT_EQ(k, next++);
              EXPECT_EQ(hits, expected[k]);
            });
    EXPECT_EQ(next, count);
    const auto verdicts = self_collides(hierarchy, q, threads);
    ASSERT_EQ(verdicts.size(), count);
    for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(verdicts[k] != 0, !expected[k].empty());
  }
}

TEST(Ensemble, HoldsFewResultsAtATime) {
  // Results count their live copies; a run over many configurations must not keep all of them.
  static std::atomic<int> alive{0}, most{0};
  struct Counted {
    Counted() { most = std::max(most.load(), ++alive); }
    Counted(const Counted&) : Counted() {}
    Counted(Counted&&) noexcept : Counted() {}
    ~Counted() { --alive; }
  };
  Ensemble<int> ensemble(0, 2);
  ensemble.run(
      100000, [](int&, std::size_t) { return Counted{}; }, [](std::size_t, Counted&&) {});
  EXPECT_EQ(alive, 0);
  EXPECT_LE(most, 4 * 2 * 256 + 16);
}

TEST(Ensemble, PassesOnTheFirstException) {
  Ensemble<int> ensemble(0, 2);
  const auto fail_at = [](std::size_t bad) {
    return [bad](int&, std::size_t k) {
      if (k == bad) throw std::runtime_error("bad");
      return k;
    };
  };
  EXPECT_THROW(ensemble.run(1000, fail_at(700), [](std::size_t, std::size_t) {}), std::runtime_error);
  EXPECT_THROW(ensemble.run(
                   10, [](int&, std::size_t k) { return k; },
                   [](std::size_t, std::size_t) { throw std::runtime_error("full"); }),
               std::runtime_error);
  std::size_t taken = 0;
  ensemble.run(0, fail_at(0), [&](std::size_t, std::size_t) { ++taken; });
  EXPECT_EQ(taken, 0U);
}

TEST(Ensemble, TakesMoreThreadsThanCoresWithoutAWord) {
  const unsigned threads = 4 * std::thread::hardware_concurrency() + 1;
  testing::internal::CaptureStderr();
  std::size_t sum = 0;
  Ensemble<int>(0, threads)
      .run(
          10'000, [](int&, std::size_t k) { return k; }, [&](std::size_t, std::size_t k) { sum += k; });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(sum, 49'995'000U);
}

TEST(Ensemble, RefusesBadInput) {
  Arm arm(3);
  const Hierarchy hierarchy(arm.model, AdmitAll{}, UniformClearance{0.3});
  EXPECT_THROW(Ensemble(hierarchy, 0), ModelError);
  std::vector<double> q(2 * hierarchy.dof_count() + 1, 0.0);
  EXPECT_THROW(self_collides(hierarchy, q, 1), ConfigurationError);
  q.pop_back();
  EXPECT_EQ(self_collides(hierarchy, q, 1).size(), 2U);
  q.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(self_collides(hierarchy, q, 2), ConfigurationError);
}

}  // namespace ensemble_test
}  // namespace hinge
