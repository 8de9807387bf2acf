// SPDX-License-Identifier: BSD-3-Clause
// Reads SRDF with tinyxml2 and resolves groups to joints.
#include "hinge/robotics/read_srdf.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "description/parse_numbers.hpp"
#include "description/read_file.hpp"
#include "description/read_xml.hpp"
#include "hinge/core/error.hpp"

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

template <class Visit>
void for_each(const XMLElement& parent, const char* name, const Visit& visit) {
  for (const auto* child = parent.FirstChildElement(name); child != nullptr; child = child->NextSiblingElement(name))
    visit(*child);
}

class SrdfReader {
 public:
  SrdfReader(const std::filesystem::path& path, const std::string& text, const Robot& robot, UnknownLinks unknown)
      : file_(path, text, "robot"), robot_(robot), unknown_(unknown) {
    file_.refuse_xacro_in(file_.root());
    const auto& joints = robot.description().joints;
    for (std::size_t k = 0; k < joints.size(); ++k) above_[joints[k].child] = k;
    for (std::size_t k = 0; k < robot.independent_joints().size(); ++k) independent_[robot.independent_joints()[k]] = k;
  }

  Srdf read() {
    srdf_.disabled = LinkPairs(robot_.link_count());
    srdf_.enabled = LinkPairs(robot_.link_count());
    const std::string name = text_of(file_.root(), "name");
    if (!name.empty() && name != robot_.name())
      srdf_.notes.push_back(file_.at(0) + "the file is for robot '" + name + "', but the robot is '" + robot_.name() +
                            "'");
    read_disabled();
    for_each(file_.root(), "virtual_joint", [&](const XMLElement& joint) { virtual_.insert(text_of(joint, "name")); });
    for_each(file_.root(), "group", [&](const XMLElement& group) { groups_[name_of(group)] = &group; });
    for_each(file_.root(), "group", [&](const XMLElement& group) {
      std::set<std::size_t> joints;
      std::set<std::string> open;
      collect(group, joints, open);
      srdf_.groups.push_back({name_of(group), {joints.begin(), joints.end()}});
    });
    for_each(file_.root(), "group_state", [&](const XMLElement& state) { read_configuration(state); });
    note(unknown_joints_, "joint", "left out of groups and states");
    note(unknown_links_, "link", "left out of groups, together with the chains that end at it");
    note(unknown_groups_, "subgroup", "left out of groups");
    note(twice_, "joint", "given twice in a state, the last value is used");
    if (skipped_pairs_ > 0)
      srdf_.notes.push_back(file_.at(0) + std::to_string(skipped_pairs_) +
                            " pairs name links that the robot does not have; the first is " + first_skipped_);
    return std::move(srdf_);
  }

 private:
  std::string name_of(const XMLElement& element) const { return file_.attribute(element, "name"); }

  /// Elements of one kind that were skipped for one reason. They share a note.
  struct Noted {
    int line = 0;  // of the first element
    std::string first;
    std::set<std::string> names{};

    void add(const XMLElement& element, const std::string& name) {
      if (names.empty()) line = element.GetLineNum();
      if (names.empty()) first = name;
      names.insert(name);
    }
  };

  void note(const Noted& noted, const std::string& kind, const std::string& what) {
    if (noted.names.empty()) return;
    std::string text = file_.at(noted.line).append(kind).append(" '").append(noted.first).append("'");
    if (noted.names.size() > 1) text.append(" and ").append(std::to_string(noted.names.size() - 1)).append(" more");
    const bool absent = &noted != &twice_;
    srdf_.notes.push_back(text + ": " + (absent ? "unknown, " : "") + what);
  }

  /// Returns nothing only for an unknown link that is to be noted.
  std::optional<LinkId> link(const XMLElement& element, const char* attribute) {
    const std::string name = file_.attribute(element, attribute);
    const auto found = robot_.find_link(name);
    if (found) return found;
    const std::string what = tag(element) + " names link '" + name + "'";
    if (unknown_ == UnknownLinks::refused)
      file_.refuse(element.GetLineNum(),
                   what + ", which robot '" + robot_.name() + "' does not have; --note-unknown-links skips such pairs");
    if (first_skipped_.empty())
      first_skipped_ = "line " + std::to_string(element.GetLineNum()) + ", link '" + name + "'";
    return {};
  }

  void set_pair(const XMLElement& element, bool disabled) {
    const auto a = link(element, "link1"), b = link(element, "link2");
    if (!a || !b) {
      ++skipped_pairs_;
    } else if (disabled) {
      srdf_.disabled.insert(*a, *b);
      srdf_.enabled.erase(*a, *b);
    } else {
      srdf_.disabled.erase(*a, *b);
      srdf_.enabled.insert(*a, *b);
    }
  }

  /// Precedence: disable_default_collisions first, then enable_collisions, then disable_collisions.
  void read_disabled() {
    for_each(file_.root(), "disable_default_collisions", [&](const XMLElement& element) {
      const auto off = link(element, "link");
      skipped_pairs_ += off ? 0U : 1U;
      for (std::size_t l = 1; off && l < robot_.link_count(); ++l) srdf_.disabled.insert(*off, id<LinkId>(l));
    });
    for_each(file_.root(), "enable_collisions", [&](const XMLElement& element) { set_pair(element, false); });
    for_each(file_.root(), "disable_collisions", [&](const XMLElement& element) { set_pair(element, true); });
  }

  bool is_movable(std::size_t joint) const { return robot_.description().joints[joint].type != JointType::fixed; }

  /// Returns the movable joints between a link and the root.
  std::set<std::size_t> joints_above(const std::string& link_name) const {
    std::set<std::size_t> joints;
    for (auto above = above_.find(link_name); above != above_.end();
         above = above_.find(robot_.description().joints[above->second].parent))
      if (is_movable(above->second)) joints.insert(above->second);
    return joints;
  }

  std::optional<std::size_t> joint(const XMLElement& element) {
    const std::string name = name_of(element);
    const auto found = robot_.find_joint(name);
    if (!found && !virtual_.contains(name)) unknown_joints_.add(element, name);
    return found;
  }

  std::optional<std::string> known_link(const XMLElement& element, const char* attribute) {
    std::string name = file_.attribute(element, attribute);
    if (robot_.find_link(name)) return name;
    unknown_links_.add(element, name);
    return {};
  }

  /// SRDF: a link stands for the joint above it, a chain for the joints between its two ends, a subgroup for its
  /// joints.
  void collect(const XMLElement& group, std::set<std::size_t>& joints, std::set<std::string>& open) {
    const std::string name = name_of(group);
    if (!open.insert(name).second) file_.refuse(group.GetLineNum(), "group '" + name + "' contains itself");
    for_each(group, "joint", [&](const XMLElement& element) {
      const auto found = joint(element);
      if (found && is_movable(*found)) joints.insert(*found);
    });
    for_each(group, "link", [&](const XMLElement& element) {
      const auto known = known_link(element, "name");
      const auto above = known ? above_.find(*known) : above_.end();
      if (above != above_.end() && is_movable(above->second)) joints.insert(above->second);
    });
    for_each(group, "chain", [&](const XMLElement& chain) {
      // The path goes through the lowest common ancestor of both ends, so joints above both ends cancel.
      const auto base_link = known_link(chain, "base_link"), tip_link = known_link(chain, "tip_link");
      if (!base_link || !tip_link) return;
      std::set<std::size_t> base = joints_above(*base_link);
      for (const std::size_t k : joints_above(*tip_link))
        if (base.erase(k) == 0) base.insert(k);
      joints.merge(base);
    });
    for_each(group, "group", [&](const XMLElement& element) {
      const auto sub = groups_.find(name_of(element));
      if (sub == groups_.end())
        unknown_groups_.add(element, name_of(element));
      else
        collect(*sub->second, joints, open);
    });
    open.erase(name);
  }

  void read_configuration(const XMLElement& state) {
    NamedConfiguration configuration{name_of(state), text_of(state, "group"), {}};
    std::set<std::string> named;
    for_each(state, "joint", [&](const XMLElement& element) {
      const auto found = joint(element);
      if (!found) return;
      if (!named.insert(name_of(element)).second) twice_.add(element, name_of(element));
      const auto position = independent_.find(*found);
      if (position == independent_.end()) return;  // a fixed or mimicking joint: its value has no effect
      const auto values = parse_numbers(file_.attribute(element, "value"));
      if (!values || values->size() != 1 || !(std::abs(values->front()) <= largest_joint_value))
        file_.refuse(element.GetLineNum(), "joint '" + name_of(element) + "' has value \"" +
                                               element.Attribute("value") +
                                               "\", expected one finite number of at most 1e15");
      configuration.values.emplace_back(position->second, values->front());
    });
    srdf_.configurations.push_back(std::move(configuration));
  }

  XmlFile file_;
  const Robot& robot_;
  UnknownLinks unknown_;
  std::map<std::string, std::size_t> above_;        // link to the joint above it
  std::map<std::size_t, std::size_t> independent_;  // joint index to its index in independent_joints()
  std::map<std::string, const XMLElement*> groups_;
  std::set<std::string> virtual_;  // joints between the robot and the world; the URDF file does not have them
  Srdf srdf_;
  Noted unknown_joints_, unknown_links_, unknown_groups_, twice_;
  std::size_t skipped_pairs_ = 0;
  std::string first_skipped_;
};

}  // namespace

Srdf read_srdf(const std::filesystem::path& path, const Robot& robot, UnknownLinks unknown) {
  return parse_srdf(read_file(path), path, robot, unknown);
}

Srdf parse_srdf(const std::string& text, const std::filesystem::path& path, const Robot& robot, UnknownLinks unknown) {
  return SrdfReader(path, text, robot, unknown).read();
}

std::vector<NamedPair> read_named_pairs(const std::filesystem::path& path) {
  std::vector<NamedPair> pairs;
  std::istringstream in(read_file(path));
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line.resize(std::min(line.find('#'), line.size()));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<std::string> names;
    for (std::string name; words >> name;) names.push_back(name);
    if (names.empty()) continue;
    if (names.size() != 2)
      throw LoadError(path.string() + ":" + std::to_string(number) + ": " + std::to_string(names.size()) +
                      " names, expected two");
    pairs.push_back({names[0], names[1], number});
  }
  return pairs;
}

void read_link_pairs(const std::filesystem::path& path, const Robot& robot, LinkPairs& pairs) {
  for (const NamedPair& pair : read_named_pairs(path)) {
    const auto link = [&](const std::string& name) {
      const auto found = robot.find_link(name);
      if (!found)
        throw LoadError(path.string() + ":" + std::to_string(pair.line) + ": no link '" + name + "' in robot '" +
                        robot.name() + "'");
      return *found;
    };
    const LinkId first = link(pair.first);
    pairs.insert(first, link(pair.second));
  }
}

}  // namespace hinge::robotics
