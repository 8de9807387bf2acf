// SPDX-License-Identifier: BSD-3-Clause
// Writes SRDF text. Names are escaped in attributes and comments.
#include "hinge/robotics/write_srdf.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "description/read_file.hpp"

namespace hinge::robotics {

namespace {

/// Escapes text for an attribute value.
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

/// Escapes text for a comment, where two hyphens in a row are not allowed.
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

/// Writes elements and comments of the matrix. file: the existing contents of the root element, or null.
void write_entries(const Robot& robot, const CollisionMatrix& matrix, std::ostream& out, UnseenPairs unseen,
                   const Srdf* file) {
  for (const std::string& link : robot.description().incomplete)
    out << "  <!-- incomplete model: link " << in_comment(link) << " lacks geometry -->\n";
  for (const MatrixEntry& entry : matrix.entries) {
    const std::string &a = robot.link_name(entry.link1), &b = robot.link_name(entry.link2), what = seen(entry);
    const std::string both = in_comment(a) + " and " + in_comment(b) + ": ";
    const bool disable = is_disabled(entry.kind, unseen);
    if (file != nullptr && file->disabled.contains(entry.link1, entry.link2)) {
      if (entry.kind != PairKind::sometimes) continue;
      out << "  <!-- disabled above, but seen in collision: " << both << what << " -->";
    } else if (disable && file != nullptr && file->enabled.contains(entry.link1, entry.link2)) {
      out << "  <!-- tested, because enabled above: " << both << reason(entry.kind) << (what.empty() ? "" : ", ")
          << what << " -->";
    } else if (disable) {
      out << "  <disable_collisions link1=\"" << escaped(a) << "\" link2=\"" << escaped(b) << "\" reason=\""
          << reason(entry.kind) << "\"/>";
      if (!what.empty()) out << "  <!-- " << what << " -->";
    } else {
      out << "  <!-- tested: " << both << what << " -->";
    }
    out << '\n';
  }
}

/// Returns the position of the root element's closing tag, or nothing if it has none. Comments may follow the tag.
std::optional<std::size_t> end_of_root(std::string_view xml) {
  std::optional<std::size_t> end;
  for (std::size_t at = xml.find('<'); at != std::string_view::npos; at = xml.find('<', at + 1)) {
    if (xml.substr(at).starts_with("<!--")) at = std::min(xml.find("-->", at), xml.size() - 1);
    if (xml.substr(at).starts_with("</")) end = at;
  }
  return end;
}

}  // namespace

void write_srdf(const Robot& robot, const CollisionMatrix& matrix, std::ostream& out, UnseenPairs unseen) {
  out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot name=\"" << escaped(robot.name()) << "\">\n";
  write_entries(robot, matrix, out, unseen, nullptr);
  out << "</robot>\n";
}

void merge_srdf(const std::filesystem::path& path, const Srdf& srdf, const Robot& robot, const CollisionMatrix& matrix,
                std::ostream& out, UnseenPairs unseen) {
  merge_srdf_text(read_file(path), srdf, robot, matrix, out, unseen);
}

void merge_srdf_text(const std::string& xml, const Srdf& srdf, const Robot& robot, const CollisionMatrix& matrix,
                     std::ostream& out, UnseenPairs unseen) {
  const auto end = end_of_root(xml);
  if (!end) {  // <robot/>: nothing to keep
    write_srdf(robot, matrix, out, unseen);
    return;
  }
  const std::string_view text = xml, kept = text.substr(0, *end);
  out << kept << (kept.ends_with('\n') ? "" : "\n");
  write_entries(robot, matrix, out, unseen, &srdf);
  out << text.substr(*end);
}

}  // namespace hinge::robotics
