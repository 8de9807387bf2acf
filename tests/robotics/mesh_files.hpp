// SPDX-License-Identifier: BSD-3-Clause
// Reading meshes from text and bytes written in tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "hinge/robotics/read_mesh.hpp"
#include "robotics/robots.hpp"

namespace hinge::test {

/// Reads a mesh file with these bytes.
inline robotics::TriangleMesh read_mesh_from(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  return robotics::read_mesh(folder.write(name, bytes));
}

/// Returns the message, without the folder's path, with which a mesh file is refused; "" if it is read.
inline std::string mesh_refusal(const std::string& name, const std::string& bytes) {
  const TemporaryFolder folder;
  const auto file = folder.write(name, bytes);
  std::string what = refusal(folder, [&] { robotics::read_mesh(file); });
  EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  return what;
}

/// Returns the notes of a read, without the folder's path.
inline std::vector<std::string> notes_of(const std::string& name, const std::string& bytes, std::size_t triangles) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  EXPECT_EQ(robotics::read_mesh(folder.write(name, bytes), &notes).triangles.size(), triangles) << name;
  for (std::string& note : notes) note.erase(0, folder.path().string().size() + 1);
  return notes;
}

/// One triangle (0 0 0) (1 0 0) (0 1 2), instanced by two nodes. One node is translated by (10 20 30), inside a node
/// that scales by 2.
inline std::string collada(const std::string& unit, const std::string& axis) {
  return "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>" +
         unit + "<up_axis>" + axis +
         "</up_axis></asset><library_geometries><geometry id='g'><mesh><source id='p'><float_array id='pa' count='9'>"
         "0 0 0 1 0 0 0 1 2</float_array><technique_common><accessor source='#pa' count='3' stride='3'><param name='X' "
         "type='float'/><param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common>"
         "</source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices><triangles count='1'><input "
         "semantic='VERTEX' source='#v' offset='0'/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>"
         "<library_visual_scenes><visual_scene id='s'><node id='n'><instance_geometry url='#g'/></node><node id='m'>"
         "<scale>2 2 2</scale><node id='k'><translate>10 20 30</translate><instance_geometry url='#g'/></node></node>"
         "</visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>";
}

/// Returns the sum of the areas, m^2. Overlapping triangles, or triangles outside a polygon, have more than it.
inline double area(const std::vector<Triangle>& triangles) {
  double twice = 0.0;
  for (const Triangle& t : triangles) twice += cross(Vec3(t.b - t.a), Vec3(t.c - t.a)).norm();
  return twice / 2;
}

}  // namespace hinge::test
