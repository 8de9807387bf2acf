// SPDX-License-Identifier: BSD-3-Clause
// Implements read_dae: follows the nodes of the scene that is shown. What it does not show is not checked.
#include <string_view>

#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/detail/core/sincos.hpp"
#include "mesh/dae_file.hpp"
#include "mesh/formats.hpp"

namespace hinge::robotics {

namespace {

using tinyxml2::XMLElement;

// Meshes of robots have about ten nodes on few levels. Instances of instances multiply them.
constexpr std::size_t most_nodes = 1'000'000;
constexpr std::size_t most_corners = 100'000'000;
constexpr std::size_t deepest = 500;

/// An affine map: x -> linear * x + shift.
struct Affine {
  Mat3 linear = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  Vec3 operator()(const Vec3& x) const { return product(linear, x) + shift; }
  Affine operator*(const Affine& inner) const { return {product(linear, inner.linear), (*this)(inner.shift)}; }
};

class SceneReader {
 public:
  SceneReader(const DaeFile& file, MeshBuilder& mesh) : file_(file), mesh_(mesh) {}

  void run() {
    const XMLElement* shown = nullptr;
    for_each_child(file_.root(), "scene", [&](const XMLElement& scene) {
      for_each_child(scene, "instance_visual_scene", [&](const XMLElement& instance) {
        if (shown != nullptr) file_.refuse(instance, " is the second one, expected one");
        shown = &instance;
      });
    });
    if (shown == nullptr) file_.refuse(file_.root(), " has no <scene> with an <instance_visual_scene>");
    place(file_.find(*shown, "url", "visual_scene"), {unit() * Mat3::Identity()}, 0);
  }

 private:
  template <class Visit>
  static void for_each_child(const XMLElement& element, const char* name, const Visit& visit) {
    for (const auto* child = element.FirstChildElement(name); child != nullptr; child = child->NextSiblingElement(name))
      visit(*child);
  }

  /// Returns the unit of length, m.
  double unit() const {
    const auto* asset = file_.root().FirstChildElement("asset");
    const auto* unit = asset != nullptr ? asset->FirstChildElement("unit") : nullptr;
    const char* text = unit != nullptr ? unit->Attribute("meter") : nullptr;
    if (text == nullptr) return 1.0;
    const auto meter = parse_number<double>(text);
    if (!meter || !(*meter > 0.0) || !is_finite(*meter))
      file_.refuse(*unit, std::string(" has meter=\"") + text + "\", expected a number above 0");
    return *meter;
  }

  /// Adds the faces of a node or scene and of the nodes below: first its own ones, then those of instances.
  void place(const XMLElement& node, const Affine& above, std::size_t depth) {
    if (depth > deepest) file_.refuse(node, ": its nodes contain themselves or are nested more than 500 levels deep");
    if (++nodes_ > most_nodes) file_.refuse(node, ": the scene expands to more than 10^6 nodes");
    const Affine here = above * transform_of(node);
    for_each_child(node, "instance_controller", [&](const XMLElement& instance) {
      file_.refuse(instance, " deforms or blends a mesh, expected <instance_geometry>");
    });
    for_each_child(node, "instance_geometry", [&](const XMLElement& instance) {
      add(instance, mesh_of(file_.find(instance, "url", "geometry")), here);
    });
    for_each_child(node, "node", [&](const XMLElement& child) { place(child, here, depth + 1); });
    for_each_child(node, "instance_node",
                   [&](const XMLElement& instance) { place(file_.find(instance, "url", "node"), here, depth + 1); });
  }

  const DaeMesh& mesh_of(const XMLElement& geometry) {
    const auto [mesh, is_new] = meshes_.try_emplace(&geometry);
    if (!is_new) return mesh->second;
    for (const auto* child = geometry.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "mesh") read_dae_mesh(file_, *child, mesh->second);
      if (name == "brep" || name == "convex_mesh") file_.refuse(*child, " is not supported, expected <mesh>");
    }
    return mesh->second;
  }

  void add(const XMLElement& instance, const DaeMesh& mesh, const Affine& transform) {
    if ((corners_ += mesh.corners.size()) > most_corners)
      file_.refuse(instance, ": the scene expands to more than 10^8 corners of polygons");
    std::vector<Vec3> polygon;
    std::size_t corner = 0;
    for (const std::size_t end : mesh.ends) {
      polygon.clear();
      for (; corner < end; ++corner) polygon.push_back(transform(mesh.corners[corner]));
      mesh_.add_polygon(polygon);
    }
    mesh_.leave_out(mesh.lines);
  }

  /// Returns the product of the transforms of a node, in their order.
  Affine transform_of(const XMLElement& node) const {
    Affine all;
    for (const auto* child = node.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      const std::string_view name = child->Name();
      if (name == "translate") all = all * Affine{Mat3::Identity(), vectors<1>(*child)[0]};
      if (name == "scale") all = all * Affine{vectors<1>(*child)[0].asDiagonal()};
      if (name == "rotate") all = all * Affine{rotation(*child)};
      if (name == "matrix") all = all * matrix(*child);
      if (name == "lookat") all = all * lookat(*child);
      if (name == "skew") file_.refuse(*child, " is not supported, expected <matrix>");
    }
    return all;
  }

  template <std::size_t N>
  std::array<Vec3, N> vectors(const XMLElement& element) const {
    const std::vector<double> numbers = file_.numbers(element, 3 * N);
    std::array<Vec3, N> result;
    for (std::size_t k = 0; k < N; ++k) result[k] = Vec3(&numbers[3 * k]);
    return result;
  }

  /// Rodrigues' formula. The axis may have any length.
  Mat3 rotation(const XMLElement& element) const {
    const std::vector<double> numbers = file_.numbers(element, 4);
    const double degrees = numbers[3], length = norm(Vec3(numbers.data()));
    if (degrees == 0.0) return Mat3::Identity();
    if (!(length > 0.0) || !is_finite(length) || !is_finite(degrees))
      file_.refuse(element, " has the axis " + number_text(numbers[0]) + " " + number_text(numbers[1]) + " " +
                                number_text(numbers[2]) + " and the angle " + number_text(degrees) +
                                ", expected a direction and a finite angle");
    const Vec3 axis = Vec3(numbers.data()) / length;
    const auto turn = detail::sincos(degrees * (3.141592653589793 / 180.0));
    Mat3 result;
    for (int c = 0; c < 3; ++c) {
      const Vec3 unit = Vec3::Unit(c);
      result.col(c) = turn.cos * unit + turn.sin * cross(axis, unit) + ((1.0 - turn.cos) * axis[c]) * axis;
    }
    return result;
  }

  Affine matrix(const XMLElement& element) const {
    const std::vector<double> m = file_.numbers(element, 16);
    if (m[12] != 0.0 || m[13] != 0.0 || m[14] != 0.0 || m[15] != 1.0)
      file_.refuse(element, " has a last row other than 0 0 0 1");
    Affine result;
    for (std::size_t r = 0; r < 3; ++r) {
      const double* row = &m[4 * r];
      result.linear.row(static_cast<Eigen::Index>(r)) = Vec3(row).transpose();
      result.shift[static_cast<Eigen::Index>(r)] = row[3];
    }
    return result;
  }

  /// The frame of an observer: x to the right, y up, z away from the point of interest.
  Affine lookat(const XMLElement& element) const {
    const auto [eye, interest, up] = vectors<3>(element);
    const Vec3 back = eye - interest, right = cross(up, back);
    if (!(norm(right) > 0.0)) file_.refuse(element, " gives no direction");
    Affine result{{}, eye};
    result.linear << right / norm(right), cross(back, right) / norm(cross(back, right)), back / norm(back);
    return result;
  }

  const DaeFile& file_;
  MeshBuilder& mesh_;
  std::map<const XMLElement*, DaeMesh> meshes_;  // by geometry
  std::size_t nodes_ = 0, corners_ = 0;
};

}  // namespace

void read_dae(const std::filesystem::path& path, std::string bytes, MeshBuilder& mesh) {
  const DaeFile file(path, std::move(bytes));
  SceneReader(file, mesh).run();
}

}  // namespace hinge::robotics
