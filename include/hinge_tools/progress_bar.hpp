// SPDX-License-Identifier: BSD-3-Clause
// ProgressBar: a progress bar on standard error, drawn only if standard error is a terminal.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <string>

namespace hinge::tool {

/// The destructor erases the bar.
class ProgressBar {
 public:
  /// total: number of work items; 0 draws a full bar.
  explicit ProgressBar(std::uint64_t total) : total_(total), shown_(isatty(STDERR_FILENO) != 0) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() {
    if (shown_) std::fputs("\r\033[K", stderr);
  }

  /// Redraws the bar for `done` of total items, at most once per 100 ms.
  void show(std::uint64_t done) {
    const auto now = std::chrono::steady_clock::now();
    if (!shown_ || now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    constexpr std::uint64_t width = 40;
    const std::uint64_t filled = total_ == 0 ? width : done * width / total_;
    std::string bar(filled, '#');
    bar.resize(width, '.');
    std::fprintf(stderr, "\r[%s] %llu / %llu", bar.c_str(), static_cast<unsigned long long>(done),
                 static_cast<unsigned long long>(total_));
  }

 private:
  std::uint64_t total_;
  bool shown_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace hinge::tool
