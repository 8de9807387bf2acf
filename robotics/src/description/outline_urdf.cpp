// SPDX-License-Identifier: BSD-3-Clause
// Reads names, lines and origins in one pass over the XML tree and normalises the tree for urdfdom.
#include "description/outline_urdf.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <sstream>
#include <string_view>

#include "description/parse_numbers.hpp"
#include "description/read_xml.hpp"
#include "hinge/robotics/rpy.hpp"

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

Vec3 vector_of(const XmlFile& file, const XMLElement& element, const char* name) {
  const char* text = element.Attribute(name);
  if (text == nullptr) return Vec3::Zero();
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 3)
    file.refuse(element.GetLineNum(),
                "<origin> has " + std::string(name) + "=\"" + text + "\", expected three finite numbers");
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

/// Returns the pose in <origin>.
Pose origin_of(const XmlFile& file, const XMLElement& parent) {
  const XMLElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return {};
  file.refuse_xacro_in(*origin);
  return {rotation_of_rpy(vector_of(file, *origin, "rpy")), vector_of(file, *origin, "xyz")};
}

bool is_xacro_element(const XMLElement& element) { return std::string_view(element.Name()).starts_with("xacro:"); }

/// Deletes all children with other names. Refuses xacro elements, which could stand for a child that is kept.
void keep_only(const XmlFile& file, XMLElement& parent, std::initializer_list<std::string_view> kept) {
  XMLElement* next = nullptr;
  for (XMLElement* child = parent.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    if (is_xacro_element(*child)) file.refuse_xacro(*child);
    if (std::find(kept.begin(), kept.end(), child->Name()) == kept.end()) parent.DeleteChild(child);
  }
}

/// Normalises numbers for urdfdom: one blank between them, none around them.
void tidy_numbers(XMLElement& element, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    std::istringstream words(text_of(element, name));
    std::string tidy;
    for (std::string word; words >> word;) tidy += (tidy.empty() ? "" : " ") + word;
    if (element.Attribute(name) != nullptr) element.SetAttribute(name, tidy.c_str());
  }
}

/// Keeps what urdfdom reads: type, axis, limits and mimic.
void tidy_joint(const XmlFile& file, XMLElement& joint) {
  const std::string type = text_of(joint, "type");
  const bool turns = type == "revolute", slides = type == "prismatic", endless = type == "continuous";
  keep_only(file, joint, {"parent", "child", "axis", "limit", "mimic"});
  const auto drop = [&](const char* name) {
    while (XMLElement* child = joint.FirstChildElement(name)) joint.DeleteChild(child);
  };
  if (!turns && !slides && !endless) {
    drop("axis");
    drop("mimic");
  }
  XMLElement* mimic = joint.FirstChildElement("mimic");
  if (!turns && !slides) drop("limit");
  // A mimic joint needs no limits of its own, but urdfdom requires them.
  if (mimic != nullptr && (turns || slides) && joint.FirstChildElement("limit") == nullptr)
    joint.InsertNewChildElement("limit");
  if (XMLElement* limit = joint.FirstChildElement("limit")) {
    limit->SetAttribute("effort", 0);
    limit->SetAttribute("velocity", 0);
    tidy_numbers(*limit, {"lower", "upper"});
  }
  if (XMLElement* axis = joint.FirstChildElement("axis")) tidy_numbers(*axis, {"xyz"});
  if (mimic != nullptr) tidy_numbers(*mimic, {"multiplier", "offset"});
}

OutlinedJoint outline_joint(const XmlFile& file, XMLElement& joint) {
  OutlinedJoint outlined{file.attribute(joint, "name"), joint.GetLineNum(), origin_of(file, joint), "", ""};
  const auto link = [&](const char* role) {
    const XMLElement* element = joint.FirstChildElement(role);
    if (element == nullptr) file.refuse(outlined.line, "joint '" + outlined.name + "' has no <" + role + ">");
    return file.attribute(*element, "link");
  };
  outlined.parent = link("parent");
  outlined.child = link("child");
  tidy_joint(file, joint);
  return outlined;
}

/// Reads <capsule radius="" length="">, with the length without the caps: an extension that Bullet and Drake also read.
CapsuleShape capsule_of(const XmlFile& file, const XMLElement& shape) {
  file.refuse_xacro_in(shape);
  const auto size = [&](const char* name) {
    const std::string text = file.attribute(shape, name);
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() != 1)
      file.refuse(shape.GetLineNum(),
                  "<capsule> has " + std::string(name) + "=\"" + text + "\", expected a finite number");
    return numbers->front();
  };
  return {size("radius"), size("length")};
}

/// Returns the first shape, or null if there is none. Deletes all others with a note.
XMLElement* first_shape(const XmlFile& file, XMLElement& collision, const std::string& link, UrdfOutline& outline) {
  keep_only(file, collision, {"origin", "geometry"});
  XMLElement* geometry = collision.FirstChildElement("geometry");
  XMLElement* shape = geometry != nullptr ? geometry->FirstChildElement() : nullptr;
  if (shape == nullptr) return nullptr;
  if (shape->NextSiblingElement() != nullptr)
    outline.notes.push_back(file.at(geometry->GetLineNum()) + "link '" + link +
                            "': a <geometry> has several shapes, only the first, " + tag(*shape) + ", is read");
  while (XMLElement* other = shape->NextSiblingElement()) geometry->DeleteChild(other);
  if (is_xacro_element(*shape)) file.refuse_xacro(*shape);
  tidy_numbers(*shape, {"size", "radius", "length", "scale"});
  return shape;
}

OutlinedLink outline_link(const XmlFile& file, XMLElement& link, UrdfOutline& outline) {
  constexpr std::array<std::string_view, 4> known{"box", "sphere", "cylinder", "mesh"};
  OutlinedLink outlined{file.attribute(link, "name"), link.GetLineNum(), {}};
  keep_only(file, link, {"collision"});
  for (auto* c = link.FirstChildElement("collision"); c != nullptr; c = c->NextSiblingElement("collision")) {
    outlined.collisions.push_back({c->GetLineNum(), origin_of(file, *c)});
    XMLElement* shape = first_shape(file, *c, outlined.name, outline);
    if (shape == nullptr || std::find(known.begin(), known.end(), shape->Name()) != known.end()) continue;
    if (shape->Name() == std::string_view("capsule"))
      outlined.collisions.back().capsule = capsule_of(file, *shape);
    else
      outlined.collisions.back().unread = tag(*shape);
    shape->SetName("sphere");
    shape->SetAttribute("radius", 1);
  }
  return outlined;
}

/// Notes a macro call that was not expanded and that urdfdom ignores. Refuses calls with child elements, and elements
/// that occur only in xacro input.
void note_xacro(const XmlFile& file, const XMLElement& element, UrdfOutline& outline) {
  const std::string_view name = element.Name();
  for (const char* own : {"xacro:include", "xacro:macro", "xacro:if", "xacro:unless", "xacro:insert_block",
                          "xacro:call", "xacro:element"})
    if (name == own) file.refuse_xacro(element);
  if (element.FirstChildElement() != nullptr) file.refuse_xacro(element);
  outline.notes.push_back(file.at(element.GetLineNum()) + tag(element) + " is left out, it was not expanded by xacro");
}

}  // namespace

UrdfOutline outline_urdf(const std::filesystem::path& path, const std::string& text) {
  XmlFile file(path, text, "robot");
  UrdfOutline outline;
  if (text_of(file.root(), "name").empty()) {
    file.root().SetAttribute("name", path.stem().string().c_str());
    outline.notes.push_back(file.at(0) + "the robot has no name, it is named after its file: '" + path.stem().string() +
                            "'");
  }
  file.root().DeleteAttribute("version");
  XMLElement* next = nullptr;
  for (XMLElement* element = file.root().FirstChildElement(); element != nullptr; element = next) {
    next = element->NextSiblingElement();
    const std::string_view name = element->Name();
    if (name == "joint") {
      outline.joints.push_back(outline_joint(file, *element));
    } else if (name == "link") {
      outline.links.push_back(outline_link(file, *element, outline));
    } else {
      if (is_xacro_element(*element)) note_xacro(file, *element, outline);
      file.root().DeleteChild(element);
    }
  }
  file.refuse_xacro_in(file.root());
  outline.geometry_only = file.text();
  return outline;
}

}  // namespace hinge::robotics
