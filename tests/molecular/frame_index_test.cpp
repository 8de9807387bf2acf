// SPDX-License-Identifier: BSD-3-Clause
// Tests the index of the frames of XTC files: the frames are the same with it, whatever happens to it.
#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "molecular/test_files.hpp"
#include "molecular/trajectory_files.hpp"
#include "tool/temporary_folder.hpp"

namespace hinge::molecular {
namespace frame_index_test {

using test::Frame;
using test::XtcPacker;

/// Frames of `count` atoms at whole angstroms.
std::vector<Frame> frames(std::size_t number, std::size_t count) {
  std::vector<Frame> all(number);
  for (std::size_t k = 0; k < number; ++k)
    for (std::size_t i = 0; i < count; ++i)
      all[k].emplace_back(static_cast<double>(7 * i % 31), static_cast<double>(i + k), static_cast<double>(k % 5));
  return all;
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

TEST(FrameIndex, GivesTheFramesOfTheFile) {
  const test::TemporaryFolder folder, indices;
  ReadOptions options;
  options.index_folder = indices.path();
  const auto expect = [&](const std::filesystem::path& file, const std::vector<Frame>& expected) {
    const Structure molecule = test::carbons(expected[0].size());
    const Trajectory trajectory(file, molecule, options);
    ASSERT_EQ(trajectory.size(), expected.size());
    EXPECT_EQ(trajectory.atom_count(), expected[0].size());
    for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_TRUE(trajectory.frame(k) == expected[k]) << k;
  };
  const auto first = frames(20, 40);
  const std::string bytes = XtcPacker().file(first);
  const std::filesystem::path file = folder.write("a.xtc", bytes);
  expect(file, first);
  ASSERT_EQ(files_of(indices.path()).size(), 1U);
  const std::filesystem::path index = files_of(indices.path())[0];
  EXPECT_EQ(std::filesystem::file_size(index), 8 * (3 + 20 + 1));
  expect(file, first);
  // A damaged index is not used, and is written again.
  std::ifstream in(index, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(in), {});
  for (std::size_t k = 0; k < whole.size(); ++k) {
    std::string damaged = whole;
    damaged[k] = static_cast<char>(damaged[k] + 1);
    std::ofstream(index, std::ios::binary) << damaged;
    expect(file, first);
  }
  for (const std::size_t length : {0U, 8U, 40U, 190U}) {
    std::ofstream(index, std::ios::binary) << whole.substr(0, length);
    expect(file, first);
  }
  EXPECT_EQ(std::filesystem::file_size(index), whole.size());
  // Another file of the same name and size, written later, has an index of its own.
  std::vector<Frame> second(first.rbegin(), first.rend());
  const std::string other = XtcPacker().file(second);
  folder.write("a.xtc", other);
  std::filesystem::last_write_time(file, std::filesystem::last_write_time(file) + std::chrono::seconds(5));
  expect(file, second);
  EXPECT_EQ(files_of(indices.path()).size(), 2U);
  // A folder that is not there is no error.
  options.index_folder = indices.path() / "none";
  expect(file, second);
  EXPECT_FALSE(std::filesystem::exists(options.index_folder));
}

TEST(FrameIndex, KeepsErrorsWhereTheyAre) {
  const test::TemporaryFolder folder, indices;
  ReadOptions options;
  options.index_folder = indices.path();
  const auto all = frames(5, 40);
  const std::string bytes = XtcPacker().file(all);
  const std::filesystem::path file = folder.write("a.xtc", bytes.substr(0, bytes.size() - 30));
  const Structure molecule = test::carbons(40);
  for (int time = 0; time < 2; ++time) {
    const Trajectory trajectory(file, molecule, options);
    ASSERT_EQ(trajectory.size(), 5U);
    EXPECT_TRUE(trajectory.frame(3) == all[3]);
    EXPECT_THROW(trajectory.frame(4), LoadError);
  }
  EXPECT_THROW(Trajectory(folder.write("b.xtc", std::string("\0\0\x07\xcb\0\0\0\x28", 8)), molecule, options),
               LoadError);
}

}  // namespace frame_index_test
}  // namespace hinge::molecular
