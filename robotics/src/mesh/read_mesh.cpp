// SPDX-License-Identifier: BSD-3-Clause
// Implements read_mesh with assimp as a reader only. Its processing steps are off, because all of them drop, join or
// move vertices.
#include "hinge/robotics/read_mesh.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "description/missing_mesh.hpp"
#include "description/read_file.hpp"
#include "hinge/core/error.hpp"
#include "hinge/core/finite.hpp"
#include "hinge/core/number_text.hpp"
#include "mesh/check_dae.hpp"
#include "mesh/check_ply.hpp"
#include "mesh/check_stl.hpp"
#include "mesh/cut_polygon.hpp"

namespace hinge::robotics {

namespace {

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// Removes the lines that name material libraries. assimp would read these files, and refuse the mesh if one is
/// damaged.
std::string without_materials(const std::string& obj) {
  std::string kept;
  bool continued = false;  // the previous line ends with a backslash
  for (std::size_t start = 0; start < obj.size();) {
    const std::size_t end = std::min(obj.find('\n', start), obj.size() - 1) + 1;
    const std::string_view line(obj.data() + start, end - start);
    const std::string_view text = line.substr(std::min(line.find_first_not_of(" \t"), line.size()));
    if (continued || !text.starts_with("mtllib")) kept += line;
    continued = line.ends_with("\\\n") || line.ends_with("\\\r\n");
    start = end;
  }
  return kept;
}

/// An affine map in double precision: x -> linear * x + shift.
struct Transform {
  Mat3 linear = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
  bool is_identity = true;  // coordinates keep their bits

  Vec3 operator()(const aiVector3D& v) const {
    const Vec3 x(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
    return is_identity ? x : Vec3(product(linear, x) + shift);
  }
  Transform then(const aiMatrix4x4& m) const {
    if (m == aiMatrix4x4()) return *this;
    Mat3 inner;
    Vec3 moved;
    for (unsigned r = 0; r < 3; ++r) {
      for (unsigned c = 0; c < 3; ++c) inner(static_cast<int>(r), static_cast<int>(c)) = static_cast<double>(m[r][c]);
      moved[static_cast<int>(r)] = static_cast<double>(m[r][3]);
    }
    return {product(linear, inner), product(linear, moved) + shift, false};
  }
};

/// Visits every face of every mesh of a node and of the nodes below.
template <class Visit>
void for_each_face(const aiScene& scene, const aiNode& node, const Transform& above, const Visit& visit) {
  const Transform here = above.then(node.mTransformation);
  for (unsigned k = 0; k < node.mNumMeshes; ++k) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[k]];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) visit(mesh, mesh.mFaces[f], here);
  }
  for (unsigned k = 0; k < node.mNumChildren; ++k) for_each_face(scene, *node.mChildren[k], here, visit);
}

class TriangleCollector {
 public:
  explicit TriangleCollector(const std::string& path) : path_(path) {}

  void operator()(const aiMesh& mesh, const aiFace& face, const Transform& transform) {
    if (face.mNumIndices < 3) {
      ++flat_;
      return;
    }
    polygon_.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      const unsigned index = face.mIndices[k];
      if (index >= mesh.mNumVertices || mesh.mVertices == nullptr)  // not all readers of assimp check this
        throw LoadError(path_ + ": face " + std::to_string(faces_) + " (from 0): it uses vertex " +
                        std::to_string(index) + " (from 0), but the mesh has " + std::to_string(mesh.mNumVertices) +
                        " vertices");
      const Vec3 vertex = transform(mesh.mVertices[index]);
      if (!is_finite(vertex))
        throw LoadError(path_ + ": face " + std::to_string(faces_) + " (from 0): vertex " + std::to_string(k) + " is " +
                        number_text(vertex[0]) + " " + number_text(vertex[1]) + " " + number_text(vertex[2]) +
                        ", expected finite coordinates");
      polygon_.push_back(vertex);
    }
    ++faces_;
    const std::vector<Triangle> triangles = cut_polygon(polygon_);
    mesh_.triangles.insert(mesh_.triangles.end(), triangles.begin(), triangles.end());
  }
  TriangleMesh take() { return std::move(mesh_); }
  std::size_t lines_and_points() const { return flat_; }

 private:
  const std::string& path_;
  std::size_t faces_ = 0;  // lines and points not counted
  std::size_t flat_ = 0;
  std::vector<Vec3> polygon_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_mesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  const std::string name = path.string(), extension = lower_case_extension(path);
  if (extension != ".stl" && extension != ".obj" && extension != ".dae" && extension != ".ply")
    throw MissingMesh(name + ": the mesh format is '" + extension + "', expected .stl, .obj, .dae or .ply");
  std::string bytes = read_file(path);
  const std::size_t announced = extension == ".stl" ? check_stl(bytes, name) : 0;
  if (extension == ".ply") check_ply(bytes, name);
  if (extension == ".dae" && !bytes.empty()) bytes = check_dae(path);
  if (extension == ".obj") bytes = without_materials(bytes);
  if (bytes.empty() || (extension == ".stl" && announced == 0)) throw MissingMesh(name + ": has no triangles");

  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  // assimp would add small pyramids for the nodes of a scene without meshes.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str() + 1);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string why = importer.GetErrorString();
    std::replace(why.begin(), why.end(), '\n', ' ');
    throw LoadError(name + ": " + (why.empty() ? "assimp cannot read this mesh" : why));
  }
  TriangleCollector collector(name);
  for_each_face(*scene, *scene->mRootNode, {}, [&](const aiMesh& mesh, const aiFace& face, const Transform& transform) {
    collector(mesh, face, transform);
  });
  TriangleMesh mesh = collector.take();
  const std::string left_out = std::to_string(collector.lines_and_points()) + " lines or points";
  if (mesh.triangles.empty())
    throw MissingMesh(name + ": has no triangles" +
                      (collector.lines_and_points() > 0 ? ", only " + left_out : std::string()));
  if (collector.lines_and_points() > 0 && notes != nullptr)
    notes->push_back(name + ": " + left_out + " are left out, because they have no surface");
  if (extension == ".stl" && mesh.triangles.size() != announced)
    throw LoadError(name + ": the file has " + std::to_string(announced) + " facets, but only " +
                    std::to_string(mesh.triangles.size()) + " could be read");
  return mesh;
}

}  // namespace hinge::robotics
