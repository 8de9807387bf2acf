// SPDX-License-Identifier: BSD-3-Clause
// From options to a robot and its pair rule.
#include <cstdio>
#include <filesystem>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "hinge/tool/check_output.hpp"
#include "options.hpp"

namespace robocd {

using namespace hinge::robotics;

void check_outputs(const Options& options) {
  std::vector<std::filesystem::path> inputs{options.urdf, options.srdf, options.csv_in};
  for (const auto* list : {&options.skip_pairs, &options.environment})
    inputs.insert(inputs.end(), list->begin(), list->end());
  hinge::tool::check_output("--out", options.out, inputs);
}

std::shared_ptr<const Robot> load_robot(const Options& options) {
  const std::filesystem::path path = options.urdf;
  if (path.extension() == ".xacro")
    throw hinge::LoadError(options.urdf + ": is a xacro file: run `xacro FILE > FILE.urdf` first and read its output");
  UrdfOptions urdf;
  for (const std::string& folder : options.package_folders) urdf.package_folders.emplace_back(folder);
  for (std::filesystem::path& folder : ros_package_path()) urdf.package_folders.push_back(std::move(folder));
  Tessellation tessellation;
  if (options.reference_primitives) tessellation.manner = Tessellation::Manner::inscribed;
  RobotDescription description = read_urdf(path, urdf);
  std::vector<std::filesystem::path> meshes;
  for (const LinkDescription& link : description.links)
    for (const PlacedShape& placed : link.geometry)
      if (const auto* mesh = std::get_if<MeshShape>(&placed.shape)) meshes.emplace_back(mesh->file);
  hinge::tool::check_output("--out", options.out, meshes);
  try {
    return std::make_shared<const Robot>(std::move(description), tessellation);
  } catch (const hinge::ModelError& error) {  // the file is at fault, not the command line
    throw hinge::LoadError(options.urdf + ": " + error.what());
  }
}

Job load(const Options& options) {
  Job job;
  job.robot = load_robot(options);
  const UnknownLinks unknown = options.note_unknown_links ? UnknownLinks::noted : UnknownLinks::refused;
  if (!options.srdf.empty()) job.srdf = read_srdf(options.srdf, *job.robot, unknown);
  job.disabled = options.srdf.empty() ? LinkPairs(job.robot->link_count()) : job.srdf.disabled;
  for (const std::string& file : options.skip_pairs) read_link_pairs(file, *job.robot, job.disabled);
  job.tested = tested_pairs(*job.robot, job.disabled);
  return job;
}

void print_notes(const Job& job) {
  for (const std::string& note : job.srdf.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
}

}  // namespace robocd
