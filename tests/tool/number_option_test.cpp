// SPDX-License-Identifier: BSD-3-Clause
// Tests numbers on the command line, JSON of arbitrary bytes, input files, and counting in bounded memory.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "hinge/core/error.hpp"
#include "hinge/core/philox.hpp"
#include "hinge_tools/frequent_keys.hpp"
#include "hinge_tools/input_file.hpp"
#include "hinge_tools/json_text.hpp"
#include "hinge_tools/json_writer.hpp"
#include "hinge_tools/number_option.hpp"

namespace hinge::tool {
namespace number_option_test {

template <class Number>
std::string refusal(const std::string& text, const NumberRange<Number>& range) {
  try {
    return "read as " + number_text(read_number("--n", text, range));
  } catch (const ModelError& error) {
    return error.what();
  }
}

TEST(ReadNumber, TakesNumbersInRangeAlone) {
  const NumberRange<std::uint64_t> counts{1, UINT64_MAX};
  EXPECT_EQ(read_number("--n", "18446744073709551615", counts), UINT64_MAX);
  EXPECT_EQ(read_number("--n", "+7", counts), 7U);
  EXPECT_EQ(read_number("--n", "010", counts), 10U);
  for (const char* text : {"-1", "0", "18446744073709551616", "1e3", "1.0", "0x10", "", " 1", "1 ", "+-1", "nan"})
    EXPECT_EQ(refusal(text, counts),
              "--n '" + std::string(text) + "': expected a whole number from 1 to 18446744073709551615");
  EXPECT_EQ(refusal("4294967296", NumberRange<unsigned>{0, UINT32_MAX}),
            "--n '4294967296': expected a whole number from 0 to 4294967295");
  const NumberRange<double> above{0.0, largest_length, true};
  EXPECT_EQ(read_number("--n", "+1e-300", above), 1e-300);
  for (const char* text : {"nan", "-nan", "inf", "-inf", "1e308", "1e999", "0", "-1", "0x10", "1,5", ""})
    EXPECT_EQ(refusal(text, above), "--n '" + std::string(text) + "': expected a number above 0, at most 1e+09");
  EXPECT_EQ(refusal("-0.5", NumberRange<double>{0.0, 1.0}), "--n '-0.5': expected a number from 0 to 1");
}

TEST(FrequentKeys, AreExactWhileTheyFit) {
  FrequentKeys keys(100);
  std::map<std::uint64_t, std::uint64_t> counts;
  for (std::uint64_t n = 0; n < 10000; ++n) {
    const std::uint64_t key = n * n % 100;
    keys.add(key);
    ++counts[key];
  }
  EXPECT_EQ(keys.count_error(), 0U);
  const auto top = keys.top(1000);
  ASSERT_EQ(top.size(), counts.size());
  for (std::size_t k = 0; k < top.size(); ++k) {
    EXPECT_EQ(top[k].second, counts[top[k].first]);
    if (k > 0) {
      EXPECT_TRUE(top[k - 1].second > top[k].second ||
                  (top[k - 1].second == top[k].second && top[k - 1].first < top[k].first));
    }
  }
}

TEST(FrequentKeys, MemoryIsBoundedAndWhatIsFrequentStays) {
  FrequentKeys keys(1000);
  constexpr std::uint64_t frequent = 10, rounds = 100000;
  SampleStream stream(1, 0);
  for (std::uint64_t n = 0; n < rounds; ++n) {
    keys.add(n % frequent);
    keys.add(1000 + static_cast<std::uint64_t>(stream.uniform() * 1e15));  // rarely repeated
    ASSERT_LE(keys.size(), 1000U);
  }
  EXPECT_GT(keys.count_error(), 0U);
  const auto top = keys.top(frequent);
  ASSERT_EQ(top.size(), frequent);
  for (const auto& [key, count] : top) {
    EXPECT_LT(key, frequent);
    EXPECT_LE(count, rounds / frequent);
    EXPECT_GE(count + keys.count_error(), rounds / frequent);
  }
}

TEST(JsonText, ReplacesWhatIsNoText) {
  const nlohmann::json json{{"name", "C\xff\xfe"}};
  testing::internal::CaptureStderr();
  EXPECT_EQ(json_text(json), "{\"name\":\"C\xEF\xBF\xBD\xEF\xBF\xBD\"}");
  EXPECT_EQ(json_text(json, 1), "{\n \"name\": \"C\xEF\xBF\xBD\xEF\xBF\xBD\"\n}");
  const std::string notes = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(notes.starts_with("note: ")) << notes;
  EXPECT_EQ(notes.find('\n'), notes.size() - 1) << "said once";
  EXPECT_EQ(json_text(nlohmann::json{{"name", "C\xC3\xA9"}}), "{\"name\":\"C\xC3\xA9\"}");
  EXPECT_EQ(json_string("\xff"), "\"\xEF\xBF\xBD\"");
}

std::string unreadable(const std::string& path) {
  try {
    read_whole(path, "a table");
  } catch (const LoadError& error) {
    return error.what();
  }
  return "";
}

TEST(InputFile, SaysWhyItCannotBeRead) {
  EXPECT_EQ(unreadable("/dev/zero"), "/dev/zero: is a device, expected a table");
  EXPECT_EQ(unreadable("/"), "/: is a directory, expected a table");
  EXPECT_EQ(unreadable("/nonexistent"), "/nonexistent: cannot be opened: No such file or directory");
  EXPECT_EQ(unreadable("/proc/self/mem"), "/proc/self/mem: cannot be read to its end: Input/output error");
}

}  // namespace number_option_test
}  // namespace hinge::tool
