// SPDX-License-Identifier: BSD-3-Clause
// Loads the robot, the bodies and the tested pairs that the options name.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hinge/core/error.hpp"
#include "hinge/core/number_text.hpp"
#include "hinge/robotics/read_urdf.hpp"
#include "hinge/robotics/solid_meshes.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge/robotics/tested_pairs.hpp"
#include "hinge/robotics/tiers.hpp"
#include "hinge_tools/check_output.hpp"
#include "hinge_tools/digest.hpp"
#include "hinge_tools/parts_option.hpp"
#include "options.hpp"
#include "path_end.hpp"

namespace robocd {

using namespace hinge::robotics;

std::vector<std::filesystem::path> input_files(const Options& options) {
  std::vector<std::filesystem::path> inputs{options.urdf, options.srdf, options.csv_in, options.waypoints};
  for (const std::string& end : {options.from, options.to})
    if (end.starts_with('@')) inputs.emplace_back(file_of_end(end).first);
  inputs.insert(inputs.end(), options.skip_pairs.begin(), options.skip_pairs.end());
  inputs.insert(inputs.end(), options.settings.begin(), options.settings.end());
  for (const std::string& body : options.environment) inputs.push_back(parse_body(body).file);
  return inputs;
}

void check_outputs(const Options& options) {
  hinge::tool::check_parts(options.parts, options.output == Output::table,
                           !options.out.empty()      ? "--out"
                           : !options.report.empty() ? "--report"
                           : options.max_pairs       ? "--max-pairs"
                                                     : nullptr);
  const std::vector<std::filesystem::path> inputs = input_files(options);
  hinge::tool::check_output("--out", options.out, inputs);
  hinge::tool::check_report(options.report, options.out, inputs);
  hinge::tool::check_output("--apply", options.dial.apply, inputs);
}

namespace {

std::vector<Body> read_bodies(const Options& options, const Robot& robot) {
  std::vector<Body> bodies;
  for (const std::string& text : options.environment) {
    Body body = parse_body(text);
    const auto same = [&](const Body& other) { return other.name == body.name && (other.is_named || body.is_named); };
    if (std::any_of(bodies.begin(), bodies.end(), same))
      throw hinge::ModelError("--env '" + text + "': another body already has the name '" + body.name + "'");
    if (body.is_named && robot.find_link(body.name))
      throw hinge::ModelError("--env '" + text + "': a link already has the name '" + body.name + "'");
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// Returns a link and a body given in either order, or nothing.
std::optional<std::pair<std::string, std::string>> link_and_body(const Job& job, const std::string& a,
                                                                 const std::string& b) {
  const auto is_body = [&](const std::string& name) {
    return std::any_of(job.bodies.begin(), job.bodies.end(), [&](const Body& body) { return body.name == name; });
  };
  if (job.robot->find_link(a) && is_body(b)) return std::pair(a, b);
  if (job.robot->find_link(b) && is_body(a)) return std::pair(b, a);
  return {};
}

void read_allowed(const Options& options, Job& job) {
  for (const std::string& file : options.skip_pairs)
    for (const hinge::robotics::NamedPair& pair : read_named_pairs(file)) {
      const auto first = job.robot->find_link(pair.first), second = job.robot->find_link(pair.second);
      if (first && second) {
        job.disabled.insert(*first, *second);
        continue;
      }
      const auto allowed = link_and_body(job, pair.first, pair.second);
      if (!allowed)
        throw hinge::LoadError(file + ":" + std::to_string(pair.line) + ": '" + (first ? pair.second : pair.first) +
                               "' is neither a link of robot '" + job.robot->name() + "' nor a body of --env");
      job.allowed.push_back(*allowed);
    }
  for (const auto& [link, body] : options.allowed) {
    const auto allowed = link_and_body(job, link, body);
    if (!allowed) {
      const bool has_link = job.robot->find_link(link).has_value();
      throw hinge::ModelError("--allow " + link + " " + body + ": " +
                              (has_link ? "'" + body + "' is not a body of --env"
                                        : "robot '" + job.robot->name() + "' has no link '" + link + "'"));
    }
    job.allowed.push_back(*allowed);
  }
}

/// Sets the holders of bodies.
void read_attached(const Options& options, Job& job) {
  for (const auto& [link, name] : options.attached) {
    const std::string start = "--attach " + link + " " + name + ": ";
    if (!job.robot->find_link(link))
      throw hinge::ModelError(start + "robot '" + job.robot->name() + "' has no link '" + link + "'");
    bool found = false;
    for (Body& body : job.bodies) {
      if (body.name != name) continue;
      if (body.holder) throw hinge::ModelError(start + "link '" + *body.holder + "' holds the body already");
      body.holder = link;
      found = true;
    }
    if (!found) throw hinge::ModelError(start + "'" + name + "' is not a body of --env");
  }
}

/// Reads the words of --tier. Throws ModelError for a bad word, and for a link or "all links" named twice.
Tiers read_tiers(const Options& options) {
  Tiers tiers;
  bool has_all = false;
  for (const std::string& word : options.tiers) {
    const std::size_t equals = word.rfind('=');
    try {
      const bool is_new = equals == std::string::npos
                              ? !std::exchange(has_all, true)
                              : tiers.links.emplace(word.substr(0, equals), tier_named(word.substr(equals + 1))).second;
      if (equals == std::string::npos) tiers.all = tier_named(word);
      if (!is_new)
        throw hinge::ModelError(equals == std::string::npos ? "a second tier for all links, expected LINK=TIER"
                                                            : "the link has a tier already");
    } catch (const hinge::ModelError& error) {
      throw hinge::ModelError("--tier '" + word + "': " + error.what());
    }
  }
  return tiers;
}

/// Leaves out the pairs of --proved-apart. Throws ModelError for an unknown link.
void read_proved(const Options& options, Job& job) {
  for (const auto& [a, b] : options.proved_apart) {
    const auto first = job.robot->find_link(a), second = job.robot->find_link(b);
    if (!first || !second)
      throw hinge::ModelError("--proved-apart " + a + " " + b + ": robot '" + job.robot->name() + "' has no link '" +
                              (first ? b : a) + "'");
    job.disabled.insert(*first, *second);
  }
}

/// A floating robot may be anywhere, so with bodies of the world the user must choose its base.
void check_floating_base(const Options& options, const RobotDescription& robot) {
  const std::string joint = options.urdf + ": joint '" + robot.floating_base + "' is a floating base";
  if (options.floating_base.empty())
    throw hinge::ModelError(joint +
                            ": --env needs --floating-base fixed, which places the robot at the origin of this joint");
  if (options.floating_base == "free")
    throw hinge::ModelError(joint + ": --floating-base free is not supported, expected fixed; for a moving base, " +
                            "replace the joint by three prismatic and three continuous ones");
}

}  // namespace

std::string model_digest(const Options& options, const RobotDescription& robot) {
  std::string text = "robot " + hinge::tool::sha256_of(options.urdf) + '\n';
  for (const LinkDescription& link : robot.links)
    for (const PlacedShape& placed : link.geometry)
      if (const auto* mesh = std::get_if<MeshShape>(&placed.shape); mesh != nullptr && !mesh->file.empty())
        text += "mesh " + hinge::tool::sha256_of(mesh->file) + '\n';
  text += "clearance " + hinge::number_text(options.clearance) + " contained " + (options.contained ? "1" : "0") +
          " primitives " + (options.reference_primitives ? "reference" : "exact") + '\n';
  return hinge::tool::sha256_of_text(text);
}

std::shared_ptr<const Robot> load_robot(const Options& options, std::vector<std::string>& notes) {
  const std::filesystem::path path = options.urdf;
  if (path.extension() == ".xacro")
    throw hinge::LoadError(options.urdf + ": is a xacro file: run `xacro FILE > FILE.urdf` first and read its output");
  UrdfOptions urdf;
  for (const std::string& folder : options.package_folders) urdf.package_folders.emplace_back(folder);
  for (std::filesystem::path& folder : ros_package_path()) urdf.package_folders.push_back(std::move(folder));
  Tessellation tessellation;
  if (options.reference_primitives) tessellation.manner = Tessellation::Manner::inscribed;
  urdf.skip_missing_meshes = options.skip_missing_meshes;
  RobotDescription description = read_urdf(path, urdf);
  notes = description.notes;
  if (!options.environment.empty() && !description.floating_base.empty()) check_floating_base(options, description);
  std::vector<std::filesystem::path> meshes;
  for (const LinkDescription& link : description.links)
    for (const PlacedShape& placed : link.geometry)
      if (const auto* mesh = std::get_if<MeshShape>(&placed.shape)) meshes.emplace_back(mesh->file);
  hinge::tool::check_output("--out", options.out, meshes);
  hinge::tool::check_output("--report", options.report, meshes);
  if (options.contained)
    for (std::string& note : fill_closed_meshes(description)) notes.push_back(std::move(note));
  // The proofs are about the shapes of the URDF, which tiers enclose.
  if (!options.made_for.empty() && options.made_for != model_digest(options, description))
    throw hinge::LoadError(
        "--made-for: the settings were made for another URDF file, mesh, --clearance, --contained or --primitives; "
        "'robocd dial --apply FILE' makes new ones");
  if (!options.tiers.empty()) {
    try {
      description = with_tiers(std::move(description), read_tiers(options));
    } catch (const hinge::ModelError& error) {
      throw hinge::ModelError(std::string(error.what()).starts_with("--") ? error.what()
                                                                          : "--tier: " + std::string(error.what()));
    }
  }
  try {
    return std::make_shared<const Robot>(std::move(description), tessellation);
  } catch (const hinge::ModelError& error) {  // the fault is in the file, not in the command line
    throw hinge::LoadError(options.urdf + ": " + error.what());
  }
}

Job load(const Options& options) {
  Job job;
  job.robot = load_robot(options, job.notes);
  job.bodies = read_bodies(options, *job.robot);
  const UnknownLinks unknown = options.note_unknown_links ? UnknownLinks::noted : UnknownLinks::refused;
  if (!options.srdf.empty()) job.srdf = read_srdf(options.srdf, *job.robot, unknown);
  if (options.srdf.empty()) job.srdf.disabled = job.srdf.enabled = LinkPairs(job.robot->link_count());
  job.disabled = job.srdf.disabled;
  job.notes.insert(job.notes.end(), job.srdf.notes.begin(), job.srdf.notes.end());
  read_allowed(options, job);
  read_attached(options, job);
  read_proved(options, job);
  job.tested = tested_pairs(*job.robot, job.disabled);
  return job;
}

void print_notes(const Job& job) {
  for (const std::string& note : job.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
}

std::string incomplete(const Robot& robot) {
  const std::size_t links = robot.description().incomplete.size();
  if (links == 0) return "";
  return " (incomplete model: " + std::to_string(links) + (links == 1 ? " link lacks" : " links lack") + " geometry)";
}

void print_incomplete(const Robot& robot) {
  std::string names;
  for (const std::string& link : robot.description().incomplete) names += (names.empty() ? "" : ", ") + link;
  if (!names.empty())
    std::fprintf(stderr, "note: incomplete model: geometry is missing and was not tested for: %s\n", names.c_str());
}

}  // namespace robocd
