// SPDX-License-Identifier: BSD-3-Clause
// MeshBuilder: collects the polygons of one mesh file as triangles.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/core/vec3.hpp"
#include "hinge/robotics/shape.hpp"

namespace hinge::robotics {

/// Returns at most 40 characters of the word in quotes, for messages.
std::string quoted(std::string_view word);

class MeshBuilder {
 public:
  explicit MeshBuilder(std::string path) : path_(std::move(path)) {}

  /// Adds n - 2 triangles for n >= 3 corners (m), as cut_polygon() does. Fewer corners are a line or a point. Throws
  /// LoadError if a coordinate is not finite. line: of the file, 0 if it has none.
  void add_polygon(std::span<const Vec3> corners, std::size_t line = 0);

  /// Counts lines and points, which have no surface.
  void leave_out(std::size_t lines_and_points) noexcept { left_out_ += lines_and_points; }

  void note(const std::string& what) { notes_.push_back(path_ + ": " + what); }

  /// Throws LoadError "path:line: what", without the line if it is 0.
  [[noreturn]] void refuse(std::size_t line, const std::string& what) const;

  /// Returns the mesh. Throws MissingMesh if there is no triangle. Appends the notes, and one about lines and points.
  TriangleMesh finish(std::vector<std::string>* notes);

 private:
  std::string path_;
  std::size_t faces_ = 0, left_out_ = 0;
  std::vector<std::string> notes_;
  TriangleMesh mesh_;
};

}  // namespace hinge::robotics
