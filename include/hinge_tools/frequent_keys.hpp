// SPDX-License-Identifier: BSD-3-Clause
// FrequentKeys: counts the most frequent keys of a stream in bounded memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace hinge::tool {

/// Counts are exact for at most `most` different keys. At each overflow, the median count is subtracted from all
/// counts, and keys that reach 0 are removed (Misra and Gries): frequent keys stay. The result depends only on the keys
/// and their order.
class FrequentKeys {
 public:
  /// most: maximum number of keys in memory. 2^19 keys take about 25 MB.
  explicit FrequentKeys(std::size_t most = std::size_t{1} << 19U) : most_(std::max<std::size_t>(most, 1)) {}

  /// Counts occurrences of the key.
  void add(std::uint64_t key, std::uint64_t times = 1) {
    counts_[key] += times;
    if (counts_.size() > most_) lower();
  }

  /// Number of different keys in memory.
  std::size_t size() const noexcept { return counts_.size(); }
  /// Maximum amount by which a count is too low. Counts are never too high; 0 means that all are exact.
  std::uint64_t count_error() const noexcept { return count_error_; }

  /// Returns up to n pairs (key, count) with the highest counts, highest first; ties by the lower key first.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> top(std::size_t n) const {
    std::vector<std::pair<std::uint64_t, std::uint64_t>> all(counts_.begin(), counts_.end());
    n = std::min(n, all.size());
    std::partial_sort(
        all.begin(), all.begin() + static_cast<std::ptrdiff_t>(n), all.end(),
        [](const auto& a, const auto& b) { return a.second != b.second ? a.second > b.second : a.first < b.first; });
    all.resize(n);
    return all;
  }

 private:
  void lower() {
    std::vector<std::uint64_t> counts;
    counts.reserve(counts_.size());
    for (const auto& [key, count] : counts_) counts.push_back(count);
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    const std::uint64_t by = *middle;
    std::erase_if(counts_, [by](const auto& entry) { return entry.second <= by; });
    for (auto& [key, count] : counts_) count -= by;
    count_error_ += by;
  }

  std::size_t most_;
  std::uint64_t count_error_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> counts_;
};

}  // namespace hinge::tool
