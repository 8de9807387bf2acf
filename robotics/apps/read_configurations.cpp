// SPDX-License-Identifier: BSD-3-Clause
// Implements the CSV reader line by line. The header assigns columns to joints.
#include "read_configurations.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>

#include "hinge/core/error.hpp"
#include "hinge/core/id.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge_tools/input_file.hpp"
#include "hinge_tools/number_option.hpp"

namespace robocd {

using hinge::robotics::JointDescription;
using hinge::robotics::JointType;
using hinge::robotics::Robot;

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // first bytes of UTF-8 files from spreadsheets

/// Splits a line at commas, and removes blanks and quotes around fields.
std::vector<std::string_view> split(std::string_view line) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t start = std::min(line.find_first_not_of(blanks), line.size());
    const bool is_quoted = start < line.size() && line[start] == '"';
    const std::size_t quote = is_quoted ? line.find('"', start + 1) : std::string_view::npos;
    const std::size_t comma = line.find(',', quote == std::string_view::npos ? 0 : quote);
    std::string_view field = line.substr(0, comma);
    field.remove_prefix(std::min(field.find_first_not_of(blanks), field.size()));
    field = field.substr(0, field.find_last_not_of(blanks) + 1);
    if (field.size() > 1 && field.front() == '"' && field.back() == '"') field = field.substr(1, field.size() - 2);
    fields.push_back(field);
    if (comma == std::string_view::npos) return fields;
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> parse(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) <= hinge::tool::largest_value))
    return {};
  return value;
}

class ConfigurationReader {
 public:
  ConfigurationReader(const std::filesystem::path& path, const Robot& robot, std::vector<std::string>& notes)
      : path_(path.string()), robot_(robot), notes_(notes) {}

  std::vector<std::vector<double>> read() {
    std::istringstream in(hinge::tool::read_whole(path_));
    std::string line;
    if (!std::getline(in, line)) throw hinge::LoadError(path_ + ": is empty, expected a header of joint names");
    if (line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    read_header(line);
    std::vector<std::vector<double>> rows;
    std::size_t blank = 0;  // number of the first blank line at the end
    while (std::getline(in, line)) {
      ++number_;
      if (line.find_first_not_of(" \t\r") == std::string::npos) {
        blank = blank == 0 ? number_ : blank;
        continue;
      }
      if (blank != 0) refuse(blank, "the line is blank, expected blank lines only at the end of the file");
      rows.push_back(read_row(line));
    }
    if (rows.empty()) throw hinge::LoadError(path_ + ": holds only a header, expected configurations below it");
    return rows;
  }

 private:
  [[noreturn]] void refuse(std::size_t line, const std::string& what) const {
    throw hinge::LoadError(path_ + ":" + std::to_string(line) + ": " + what);
  }

  /// Returns why a joint named in the header is not an independent joint.
  std::string fault_of(const std::string& name) const {
    const JointDescription& joint = robot_.description().joints[*robot_.find_joint(name)];
    if (joint.type == JointType::fixed) return "joint '" + name + "' is fixed and takes no value";
    return "joint '" + name + "' mimics joint '" + joint.mimic->joint + "' and takes no value";
  }

  void read_header(std::string_view line) {
    const std::size_t count = robot_.independent_joints().size();
    std::vector<bool> seen(count, false);
    std::string left_out;
    for (const std::string_view field : split(line)) {
      const std::string name(field), column = "column " + std::to_string(place_.size() + 1) + ": ";
      std::size_t k = 0;
      while (k < count && robot_.independent_name(k) != name) ++k;
      if (k == count && robot_.find_joint(name)) refuse(1, column + fault_of(name));
      if (k == count) {
        left_out += (left_out.empty() ? "'" : ", '") + name + "'";
        place_.push_back(count);
        continue;
      }
      if (seen[k]) refuse(1, column + "joint '" + name + "' occurs twice");
      seen[k] = true;
      place_.push_back(k);
    }
    for (std::size_t k = 0; k < count; ++k)
      if (!seen[k])
        refuse(1, "has no column for joint '" + robot_.independent_name(k) + "'" +
                      (left_out.empty() ? "" : "; columns without a known joint: " + left_out));
    if (!left_out.empty()) notes_.push_back(path_ + ": columns without a known joint are left out: " + left_out);
  }

  std::vector<double> read_row(std::string_view line) const {
    const std::vector<std::string_view> fields = split(line);
    if (fields.size() != place_.size())
      refuse(number_, std::to_string(fields.size()) + " columns, expected " + std::to_string(place_.size()));
    std::vector<double> q(robot_.independent_joints().size());
    for (std::size_t column = 0; column < fields.size(); ++column) {
      if (place_[column] == q.size()) continue;
      const auto value = parse(fields[column]);
      if (!value)
        refuse(number_, "column " + std::to_string(column + 1) + ": joint '" + robot_.independent_name(place_[column]) +
                            "' is '" + std::string(fields[column]) + "', expected a finite number, at most 1e+15");
      q[place_[column]] = *value;
    }
    if (const auto far = find_too_far(robot_, q)) {
      const auto column = std::find(place_.begin(), place_.end(), far->independent) - place_.begin();
      refuse(number_, "column " + std::to_string(column + 1) + ": " + far->what);
    }
    return q;
  }

  std::string path_;
  const Robot& robot_;
  std::vector<std::string>& notes_;
  std::vector<std::size_t> place_;  // by column: index into independent_joints(), or its size if skipped
  std::size_t number_ = 1;          // of the current line
};

}  // namespace

std::vector<std::vector<double>> read_configurations(const std::filesystem::path& path, const Robot& robot,
                                                     std::vector<std::string>& notes) {
  return ConfigurationReader(path, robot, notes).read();
}

std::vector<double> read_configuration(const std::string& what, std::string_view list, const Robot& robot) {
  const std::size_t count = robot.independent_joints().size();
  const std::vector<std::string_view> fields = split(list);
  if (fields.size() != count)
    throw hinge::ModelError(what + ": " + std::to_string(fields.size()) + " values, expected " + std::to_string(count) +
                            ", one for each independent joint");
  std::vector<double> q;
  for (std::size_t k = 0; k < count; ++k) {
    const auto value = parse(fields[k]);
    if (!value)
      throw hinge::ModelError(what + ": joint '" + robot.independent_name(k) + "' is '" + std::string(fields[k]) +
                              "', expected a finite number, at most 1e+15");
    q.push_back(*value);
  }
  if (const auto far = find_too_far(robot, q)) throw hinge::ModelError(what + ": " + far->what);
  return q;
}

std::optional<TooFar> find_too_far(const Robot& robot, std::span<const double> q) {
  const auto drives = robot.drives();
  for (std::size_t d = 0; d < drives.size(); ++d) {
    const double x = q[drives[d].independent], value = drives[d].multiplier * x + drives[d].offset;
    if (std::abs(value) <= hinge::tool::largest_value) continue;  // NaN goes on to the error
    const std::string& joint = robot.description().joints[robot.joint_of(hinge::id<hinge::DofId>(d))].name;
    const std::string& leader = robot.independent_name(drives[d].independent);
    return TooFar{drives[d].independent, "joint '" + leader + "' is " + hinge::number_text(x) +
                                             (joint == leader ? std::string()
                                                              : ", which moves the mimic joint '" + joint + "' to " +
                                                                    hinge::number_text(value)) +
                                             ", expected at most 1e+15"};
  }
  return {};
}

}  // namespace robocd
