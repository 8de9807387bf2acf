// SPDX-License-Identifier: BSD-3-Clause
// The choices that robocd dial measures, and the questions that they answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "answer.hpp"
#include "configurations.hpp"
#include "hinge/robotics/tiers.hpp"
#include "hinge_tools/dial.hpp"
#include "options.hpp"

namespace robocd {

/// The configurations of one round, which all choices share.
class Questions {
 public:
  /// all: at least as many configurations as are asked for, or the rows of a file, which are repeated.
  explicit Questions(Configurations all) : all_(std::move(all)) {}

  /// Makes questions first .. first + count - 1 available to at().
  void prepare(std::uint64_t first, std::size_t count);
  /// Returns one value per independent joint for each of the `count` questions from `first`, one after the other.
  std::span<const double> at(std::uint64_t first, std::size_t count) const;
  std::span<const double> at(std::uint64_t k) const { return at(k, 1); }
  /// Returns the number of different configurations.
  std::uint64_t count() const { return all_.count; }
  const Configurations& all() const { return all_; }

 private:
  Configurations all_;
  std::uint64_t first_ = 0;
  std::size_t count_ = 0, length_ = 0;  // length_: values per question
  std::vector<double> values_;
};

/// The shapes of every link, by a tier for each link.
class LinkShapes {
 public:
  /// Fits all tiers.
  explicit LinkShapes(const hinge::robotics::Robot& robot);

  /// Returns the tiers other than the mesh that can be fitted to every link.
  std::vector<hinge::robotics::Tier> fitted() const;
  /// Returns a sentence for each tier that cannot be fitted.
  const std::vector<std::string>& notes() const { return notes_; }

  /// Returns the robot with these tiers. tiers: one for each link of the description.
  std::shared_ptr<const hinge::robotics::Robot> robot(const std::vector<hinge::robotics::Tier>& tiers) const;
  /// Returns the same tier for all links.
  std::vector<hinge::robotics::Tier> all(hinge::robotics::Tier tier) const;
  /// Returns the words of --tier for these tiers, as few as possible.
  std::vector<std::string> words(const std::vector<hinge::robotics::Tier>& tiers) const;
  /// Returns the number of links, and the name of one.
  std::size_t size() const { return descriptions_.begin()->second.links.size(); }
  const std::string& name(std::size_t link) const { return descriptions_.begin()->second.links[link].name; }

 private:
  hinge::robotics::Tessellation tessellation_;
  std::map<hinge::robotics::Tier, hinge::robotics::RobotDescription> descriptions_;  // the mesh is the first
  std::vector<std::string> notes_;
};

/// Returns a worker for another robot with the same links, or another engine.
Worker make_worker(const Options& options, const Job& job, std::shared_ptr<const hinge::robotics::Robot> robot,
                   const std::string& engine = "simd");

/// Makes a choice that answers yes or no as `robocd check --mode any` does.
hinge::tool::DialChoice make_choice(std::string kind, std::string name, std::string options, hinge::tool::Sound sound,
                                    Worker worker, std::shared_ptr<Questions> questions, unsigned threads = 1);

/// Makes an exact choice that asks a worker with shapes that enclose the links, and only where these collide the exact
/// one.
hinge::tool::DialChoice make_cascade(std::string name, Worker enclosing, Worker exact,
                                     std::shared_ptr<Questions> questions);

/// Returns those of the first `count` questions that the worker calls free.
std::vector<std::uint64_t> free_questions(Worker& exact, Questions& questions, std::size_t count);

/// Finds a tier for each link, `cheap` where it serves and meshes elsewhere, so that no more than `share` of the
/// questions `free`, which the exact shapes call free, are called colliding. Returns nothing if all links would need
/// meshes. The questions are those of the last free_questions().
std::vector<hinge::robotics::Tier> find_mixture(const Options& options, const Job& job, const LinkShapes& shapes,
                                                hinge::robotics::Tier cheap, const Questions& questions,
                                                const std::vector<std::uint64_t>& free, double share);

/// Returns the choices about straight motions: a proof, and samples at several distances.
hinge::tool::DialSection path_section(const Options& options, const Worker& worker);

}  // namespace robocd
