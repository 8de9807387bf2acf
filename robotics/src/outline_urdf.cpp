// SPDX-License-Identifier: BSD-3-Clause
// One pass over the XML tree.
#include "outline_urdf.hpp"

#include <string_view>

#include "hinge/kinematics/joint.hpp"
#include "parse_numbers.hpp"
#include "read_xml.hpp"

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

/// Roll, pitch, yaw about the fixed axes x, y, z, in this order (URDF).
Pose origin_of(const XmlFile& file, const XMLElement& parent) {
  const XMLElement* origin = parent.FirstChildElement("origin");
  if (origin == nullptr) return {};
  const Vec3 rpy = vector_of(file, *origin, "rpy");
  const Mat3 roll = rotation_about(Vec3::UnitX(), rpy[0]);
  const Mat3 pitch = rotation_about(Vec3::UnitY(), rpy[1]);
  const Mat3 yaw = rotation_about(Vec3::UnitZ(), rpy[2]);
  return {product(yaw, product(pitch, roll)), vector_of(file, *origin, "xyz")};
}

OutlinedJoint outline_joint(const XmlFile& file, const XMLElement& joint) {
  OutlinedJoint outlined{file.attribute(joint, "name"), joint.GetLineNum(), origin_of(file, joint), "", ""};
  const auto link = [&](const char* role) {
    const XMLElement* element = joint.FirstChildElement(role);
    if (element == nullptr) file.refuse(outlined.line, "joint '" + outlined.name + "' has no <" + role + ">");
    return file.attribute(*element, "link");
  };
  outlined.parent = link("parent");
  outlined.child = link("child");
  return outlined;
}

void keep_only(XMLElement& parent, std::string_view first, std::string_view second) {
  XMLElement* next = nullptr;
  for (XMLElement* child = parent.FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    if (child->Name() != first && child->Name() != second) parent.DeleteChild(child);
  }
}

/// <capsule radius="" length="">, the length without the caps: an extension that Bullet and Drake read alike.
CapsuleShape capsule_of(const XmlFile& file, const XMLElement& shape) {
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

OutlinedLink outline_link(const XmlFile& file, XMLElement& link) {
  OutlinedLink outlined{file.attribute(link, "name"), link.GetLineNum(), {}};
  for (auto* c = link.FirstChildElement("collision"); c != nullptr; c = c->NextSiblingElement("collision")) {
    XMLElement* geometry = c->FirstChildElement("geometry");
    XMLElement* shape = geometry != nullptr ? geometry->FirstChildElement() : nullptr;
    if (shape != nullptr && shape->NextSiblingElement() != nullptr)
      file.refuse(geometry->GetLineNum(), "link '" + outlined.name + "': a <geometry> of several shapes, expected one");
    outlined.collisions.push_back({c->GetLineNum(), origin_of(file, *c)});
    if (shape == nullptr || shape->Name() != std::string_view("capsule")) continue;
    outlined.collisions.back().capsule = capsule_of(file, *shape);
    shape->SetName("sphere");
    shape->SetAttribute("radius", 1);
  }
  return outlined;
}

}  // namespace

UrdfOutline outline_urdf(const std::filesystem::path& path) {
  XmlFile file(path, "robot");
  UrdfOutline outline;
  keep_only(file.root(), "link", "joint");
  for (XMLElement* element = file.root().FirstChildElement(); element != nullptr;
       element = element->NextSiblingElement()) {
    if (element->Name() == std::string_view("joint")) {
      outline.joints.push_back(outline_joint(file, *element));
    } else {
      keep_only(*element, "collision", "collision");
      outline.links.push_back(outline_link(file, *element));
    }
  }
  outline.geometry_only = file.text();
  return outline;
}

}  // namespace hinge::robotics
