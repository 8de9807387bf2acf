// SPDX-License-Identifier: BSD-3-Clause
// Tests that JsonWriter writes the bytes of nlohmann's dump().
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <string_view>

#include "hinge_tools/json_writer.hpp"

namespace hinge::tool {
namespace json_writer_test {

TEST(JsonWriter, NumbersHaveTheBytesOfTheLibrary) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> usual(0.0, 5.0);
  JsonWriter all;
  std::string expected;
  const auto add = [&](double value) {
    all.number(value);
    all.repeated_number(value);
    all.put(" ");
    const std::string text = nlohmann::json(value).dump();
    expected += text + text + ' ';
  };
  for (int k = 0; k < 100'000; ++k) {
    add(std::bit_cast<double>(random()));
    add(usual(random));
    add(std::round(usual(random) * 1e3) / 1e3);
    add(0.1 * static_cast<double>(k % 50));
  }
  for (const double value : {0.0, -0.0, 1.0, 1e15, 1e16, 1e-5, 1e300, std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    add(value);
  EXPECT_EQ(all.take(), expected);
}

TEST(JsonWriter, IntegersHaveTheBytesOfTheLibrary) {
  JsonWriter text;
  text.number(std::uint64_t{18'446'744'073'709'551'615U});
  text.put(",");
  text.number(-7);
  EXPECT_EQ(text.take(), "18446744073709551615,-7");
  text.number(1);
  EXPECT_EQ(text.take(), "1");
}

TEST(JsonWriter, StringsHaveTheBytesOfTheLibrary) {
  std::mt19937_64 random(6);
  for (int k = 0; k < 20'000; ++k) {
    std::string text;
    for (std::uint64_t n = random() % 12; n > 0; --n)
      text += static_cast<char>(k % 2 == 0 ? random() % 128 : 'A' + random() % 60);
    EXPECT_EQ(json_string(text), nlohmann::json(text).dump());
  }
  EXPECT_EQ(json_string("\xc3\xa5"), "\"\xc3\xa5\"");
}

TEST(JsonWriter, LongTexts) {
  JsonWriter text;
  std::string expected;
  for (int k = 0; k < 5000; ++k) {
    const std::string part(static_cast<std::size_t>(k % 300), static_cast<char>('a' + k % 26));
    text.put(part);
    text.number(k);
    expected += part + std::to_string(k);
  }
  EXPECT_EQ(text.take(), expected);
}

}  // namespace json_writer_test
}  // namespace hinge::tool
