// SPDX-License-Identifier: BSD-3-Clause
// SRDF as text; names are escaped, comments hold none.
#include "hinge/robotics/write_srdf.hpp"

#include <charconv>
#include <ostream>
#include <string>
#include <string_view>

namespace hinge::robotics {

namespace {

/// As an attribute's value.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\n': result += "&#10;"; break;
      case '\t': result += "&#9;"; break;
      case '\r': result += "&#13;"; break;
      default: result += c;
    }
  }
  return result;
}

/// Inside a comment: two hyphens in a row would end it.
std::string in_comment(std::string_view text) {
  std::string result;
  for (const char c : escaped(text)) result += c == '-' && result.ends_with('-') ? "&#45;" : std::string(1, c);
  return result;
}

const char* reason(PairKind kind) {
  switch (kind) {
    case PairKind::adjacent: return "Adjacent";
    case PairKind::always: return "Always";
    case PairKind::in_default: return "Default";
    case PairKind::never: return "Never";
    case PairKind::unseen: return "NotSeen";
    case PairKind::sometimes: break;
  }
  return "Sometimes";
}

std::string number(double x) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, x, std::chars_format::general, 6).ptr;
  return {digits, end};
}

std::string seen(const MatrixEntry& entry) {
  const std::string of = " of " + std::to_string(entry.samples) + " samples";
  const std::string cells = std::to_string(entry.cells) + (entry.cells == 1 ? " box" : " boxes");
  const std::string gap = entry.smallest_gap ? ", smallest gap computed " + number(*entry.smallest_gap) + " m" : "";
  switch (entry.kind) {
    case PairKind::adjacent: return "";
    case PairKind::always: return "in " + std::to_string(entry.hits) + of;
    case PairKind::in_default: return "in the default configuration and " + std::to_string(entry.hits) + of;
    case PairKind::never: return "proved within the limits, " + cells + " of joint values" + gap;
    case PairKind::unseen:
      return "not seen in " + std::to_string(entry.samples) + " samples, not proved with " + cells +
             " of joint values" + gap;
    case PairKind::sometimes:
      return "in " + std::to_string(entry.hits) + of +
             (entry.hits == 0 ? ", and in a configuration found by search" : "");
  }
  return "";
}

}  // namespace

void write_srdf(const Robot& robot, const CollisionMatrix& matrix, std::ostream& out, UnseenPairs unseen) {
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot name=\"" << escaped(robot.name()) << "\">\n";
  for (const std::string& link : robot.description().incomplete)
    out << "  <!-- incomplete model: link " << in_comment(link) << " lacks geometry -->\n";
  for (const MatrixEntry& entry : matrix.entries) {
    const std::string &a = robot.link_name(entry.link1), &b = robot.link_name(entry.link2), what = seen(entry);
    if (is_disabled(entry.kind, unseen)) {
      out << "  <disable_collisions link1=\"" << escaped(a) << "\" link2=\"" << escaped(b) << "\" reason=\""
          << reason(entry.kind) << "\"/>";
      if (!what.empty()) out << "  <!-- " << what << " -->";
    } else {
      out << "  <!-- tested: " << in_comment(a) << " and " << in_comment(b) << ": " << what << " -->";
    }
    out << '\n';
  }
  out << "</robot>\n";
}

}  // namespace hinge::robotics
