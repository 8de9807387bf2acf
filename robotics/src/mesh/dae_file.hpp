// SPDX-License-Identifier: BSD-3-Clause
// DaeFile: finds elements of a COLLADA file by their ids, and reads numbers in them. read_dae_mesh: reads one <mesh>.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "description/parse_numbers.hpp"
#include "description/read_xml.hpp"
#include "hinge/core/vec3.hpp"
#include "mesh/mesh_builder.hpp"

namespace hinge::robotics {

// All functions throw LoadError, naming the line and the element.
class DaeFile {
 public:
  DaeFile(const std::filesystem::path& path, std::string bytes);

  const tinyxml2::XMLElement& root() const noexcept { return file_.root(); }

  /// Returns the only element of this name with the id in attribute="#id", in the file or else in the same <mesh>.
  const tinyxml2::XMLElement& find(const tinyxml2::XMLElement& from, const char* attribute,
                                   const std::string& name) const;

  /// Returns a whole number >= 0 that is at most the size of the file. Without default_value, it must be there.
  std::size_t whole(const tinyxml2::XMLElement& element, const char* attribute, std::int64_t default_value = -1) const;

  /// Returns the first `count` numbers in the text of an element.
  std::vector<double> numbers(const tinyxml2::XMLElement& element, std::size_t count) const;

  /// Returns all numbers in the text of an element, which must be whole.
  std::vector<std::size_t> whole_numbers(const tinyxml2::XMLElement& element) const;

  [[noreturn]] void refuse(const tinyxml2::XMLElement& element, const std::string& what) const;

 private:
  std::int64_t bytes_;
  XmlFile file_;
  std::multimap<std::pair<std::string, std::string>, const tinyxml2::XMLElement*> by_id_;  // by name and id
};

/// Polygons in the coordinates of the file.
struct DaeMesh {
  std::vector<Vec3> corners;
  std::vector<std::size_t> ends;  // of the corners of each polygon; they begin at the end of the one before
  std::size_t lines = 0;
};

/// Appends the polygons of a <mesh>. Strips and fans become triangles. Refuses what it does not know, indices that
/// exceed the vertices or do not match the count, and primitives without exactly one POSITION.
void read_dae_mesh(const DaeFile& file, const tinyxml2::XMLElement& mesh, DaeMesh& result);

}  // namespace hinge::robotics
