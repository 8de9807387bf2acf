// SPDX-License-Identifier: BSD-3-Clause
// Motions between two configurations. Robots among boxes: plan(), whose motions are proved free, against RRT-Connect of
// OMPL that tests states by FCL or by RobotChecker at 1 % (OMPL's default) and 0.1 % of the space's diagonal. Every
// motion found is judged by PathChecker::certify(). Molecules: plan() alone. One thread.
// Arguments: number of seeds, and the most seconds per motion (ten times as many for adenylate kinase).
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/fit_coordinates.hpp"
#include "hinge/molecular/free_sampler.hpp"
#include "hinge/molecular/kept_closures.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/plan.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/selection.hpp"
#include "hinge/molecular/trajectory.hpp"
#include "hinge/robotics/path_checker.hpp"
#include "hinge/robotics/plan.hpp"
#include "hinge/robotics/tessellate.hpp"
#include "hinge_tools/clock.hpp"
#include "looped_molecule.hpp"
#include "robotics/planning_scenes.hpp"
#include "robots/ompl_planner.hpp"
#include "robots/subject.hpp"

namespace {

using namespace hinge;
using tool::Clock;
using tool::seconds_since;

struct Row {
  std::size_t asked = 0, found = 0, colliding = 0, undecided = 0;
  std::vector<double> seconds, lengths, tested;  // tested: motions of plan(), states of OMPL

  /// Adds a motion that was asked for. length: if it was found.
  void add(double taken, std::uint64_t tests, std::optional<double> length) {
    ++asked;
    seconds.push_back(taken);
    tested.push_back(static_cast<double>(tests));
    if (!length) return;
    ++found;
    lengths.push_back(*length);
  }
  static double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
  }
  void print(const std::string& scene, const std::string& way) const {
    std::printf("%-18s %-24s %4zu/%-4zu %9.4f %9.4f %9.0f %8.3f %10zu %10zu\n", scene.c_str(), way.c_str(), found,
                asked, median(seconds), seconds.empty() ? 0.0 : *std::ranges::max_element(seconds), median(tested),
                median(lengths), colliding, undecided);
    std::fflush(stdout);
  }
};

void print_header(const char* tested, const char* unit) {
  std::printf("%-18s %-24s %9s %9s %9s %9s %8s %10s %10s\n", "", "", "found", "median s", "max s", tested, unit,
              "colliding", "undecided");
}

/// FCL compiled for this machine, with poses from Hinge's forward kinematics.
class FclScene {
 public:
  explicit FclScene(const test::PlanningScene& scene)
      : subject_(make(scene.robot)),
        groups_(std::make_shared<const RigidGroups>(tree(), DofSelection::all(tree()))),
        kinematics_(groups_, tree().dof_count()),
        robot_(subject_.meshes(), subject_.pairs()),
        around_(boxes(scene)),
        placements_(1, std::vector<oracle::Placement>(tree().link_count())) {
    around_.place(oracle::placement(Pose{}));
  }
  bool is_free(std::span<const double> q) {
    kinematics_.set_configuration(subject_.robot().expand(q));
    for (std::size_t l = 0; l < placements_[0].size(); ++l) {
      const auto link = id<LinkId>(l);
      placements_[0][l] = oracle::placement(kinematics_.pose(groups_->group_of(link)) * groups_->link_in_group(link));
    }
    robot_.set_postures(placements_);
    robot_.take(0);
    return !robot_.any(oracle::FclManner::manager) && !robot_.hits(around_, oracle::FclManner::manager);
  }

 private:
  static bench::Subject make(const std::string& name) {
    test::LoadedRobot loaded = test::load_shared(name);
    return {name, std::move(loaded.robot), loaded.disabled, 0};
  }
  static std::vector<oracle::Mesh> boxes(const test::PlanningScene& scene) {
    std::vector<oracle::Mesh> meshes;
    for (const auto& box : scene.boxes) {
      oracle::Mesh& mesh = meshes.emplace_back();
      for (const Triangle& t : robotics::tessellate(robotics::BoxShape{box.size}, {}).triangles)
        mesh.push_back(oracle::corners(t.placed({Mat3::Identity(), box.at})));
    }
    return meshes;
  }
  const KinematicTree& tree() const { return subject_.robot().model().tree(); }

  bench::Subject subject_;
  std::shared_ptr<const RigidGroups> groups_;
  detail::ForwardKinematics kinematics_;
  oracle::FclRobot<oracle::FclBuild::native> robot_;
  oracle::FclScene<oracle::FclBuild::native> around_;
  std::vector<std::vector<oracle::Placement>> placements_;
};

void run_robot(const test::PlanningScene& scene, std::uint64_t seeds, double seconds) {
  const robotics::RobotChecker checker = scene.checker();
  const robotics::Environment around = scene.environment();
  robotics::PathChecker paths(checker, around);
  const auto judge = [&](const std::vector<std::vector<double>>& waypoints, Row& row) {
    bool collides = false, undecided = false;
    for (std::size_t w = 1; w < waypoints.size() && !collides; ++w) {
      const PathVerdict verdict = paths.certify(waypoints[w - 1], waypoints[w]).verdict;
      collides = verdict == PathVerdict::colliding;
      undecided = undecided || verdict == PathVerdict::undecided;
    }
    if (collides)
      ++row.colliding;
    else if (undecided)
      ++row.undecided;
  };

  Row proved;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Clock::time_point start = Clock::now();
    const robotics::PlannedMotion motion = plan(paths, scene.from, scene.to, {.most_motions = UINT64_MAX, .seed = seed},
                                                [&] { return seconds_since(start) > seconds; });
    const double taken = seconds_since(start);
    double length = 0.0;
    for (std::size_t w = 1; w < motion.waypoints.size(); ++w)
      length += bench::euclidean(motion.waypoints[w - 1], motion.waypoints[w]);
    proved.add(taken, motion.motions, motion.reached ? std::optional(length) : std::nullopt);
    if (motion.reached) judge(motion.waypoints, proved);
  }
  proved.print(scene.name, "plan(), proved");

  // OMPL moves the joints that differ at the ends, as a planning group of MoveIt does.
  const robotics::Robot& robot = checker.robot();
  std::vector<std::size_t> moving;
  for (std::size_t k = 0; k < scene.from.size(); ++k)
    if (scene.from[k] != scene.to[k]) moving.push_back(k);
  const auto of_group = [&](std::span<const double> q) {
    std::vector<double> part;
    for (const std::size_t k : moving) part.push_back(q[k]);
    return part;
  };
  std::vector<double> q = scene.from;
  const auto all_joints = [&](std::span<const double> part) -> const std::vector<double>& {
    for (std::size_t k = 0; k < moving.size(); ++k) q[moving[k]] = part[k];
    return q;
  };
  FclScene fcl(scene);
  const auto ask = [&](const std::string& way, const bench::OmplPlanner::IsFree& is_free, double resolution) {
    const bench::OmplPlanner planner(of_group(robot.lower()), of_group(robot.upper()), is_free, resolution);
    Row row;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const Clock::time_point start = Clock::now();
      const bench::OmplMotion motion = planner.plan(of_group(scene.from), of_group(scene.to), seed, seconds);
      const double taken = seconds_since(start);
      const bool reached = !motion.waypoints.empty();
      row.add(taken, motion.states, reached ? std::optional(motion.length) : std::nullopt);
      std::vector<std::vector<double>> waypoints;
      for (const std::vector<double>& part : motion.waypoints) waypoints.push_back(all_joints(part));
      judge(waypoints, row);
    }
    row.print(scene.name, way);
    return Row::median(row.seconds);
  };
  const double plan_seconds = Row::median(proved.seconds);
  for (const double resolution : {0.01, 0.001}) {
    const std::string at = resolution == 0.01 ? ", 1 %" : ", 0.1 %";
    const double with_fcl = ask(
        "OMPL, FCL" + at, [&](std::span<const double> part) { return fcl.is_free(all_joints(part)); }, resolution);
    ask(
        "OMPL, RobotChecker" + at, [&](std::span<const double> part) { return paths.is_free(all_joints(part)); },
        resolution);
    std::printf("ratio plan %s fcl%s %.1f\n", scene.name.c_str(), resolution == 0.01 ? "-1%" : "-0.1%",
                with_fcl / plan_seconds);
  }
}

/// From the file's conformation to others that grow without collisions (FreeSampler), one per seed.
void run_molecule(const std::filesystem::path& file, const std::string& name, const std::string& loop,
                  const std::string& free, std::uint64_t seeds, double seconds) {
  using namespace hinge::molecular;
  const bench::LoopedMolecule subject(file, loop, free);
  const KeptClosures kept = subject.grown();
  const Checker checker = subject.checker(kept);
  FreeSampler sampler(checker, {}, kept.closures, {});
  PlanOptions how;
  how.closures = kept.closures;
  how.most_motions = UINT64_MAX;
  Row row;
  for (std::uint64_t k = 0; row.asked < seeds && k < 100 * seeds; ++k) {
    const FreeSample end = sampler.sample(k);
    if (!end.found()) continue;
    const Clock::time_point start = Clock::now();
    how.seed = k + 1;
    const PlannedMotion motion = plan(checker, {std::vector<double>(checker.dof_count(), 0.0)}, {end.q}, how,
                                      [&] { return seconds_since(start) > seconds; });
    row.add(seconds_since(start), motion.motions, motion.reached ? std::optional(motion.length) : std::nullopt);
  }
  row.print(name, std::to_string(checker.dof_count()) + " DOF");
}

/// Adenylate kinase with all torsions free, from the closed form to the coordinates of the open one.
void run_kinase(const std::filesystem::path& folder, double seconds) {
  using namespace hinge::molecular;
  const Structure structure = read_structure(folder / "adk_closed.pdb");
  const auto molecule = std::make_shared<const Molecule>(structure);
  const Checker checker(molecule, molecule->select(select_torsions(*molecule, "all", false)), {});
  const Trajectory trajectory(folder / "adk_dims.dcd", structure, {}, true);
  MotionEnd open;
  open.target.positions = trajectory.kept(trajectory.frame(97));
  for (std::uint32_t a = 0; a < open.target.positions.size(); ++a) open.target.atoms.push_back(a);
  const Clock::time_point start = Clock::now();
  open.q = fit_coordinates(checker, open.target).q;
  const double fitted = seconds_since(start);
  const PlannedMotion motion = plan(checker, {std::vector<double>(checker.dof_count(), 0.0)}, open, {},
                                    [&] { return seconds_since(start) > seconds; });
  Row row;
  row.add(seconds_since(start), motion.motions, motion.reached ? std::optional(motion.length) : std::nullopt);
  row.print("adenylate kinase", std::to_string(checker.dof_count()) + " DOF");
  std::printf("adenylate kinase: %.1f s of it fit the open coordinates; straight %.2f A, end %.2f A from them\n",
              fitted, motion.straight, motion.end_rmsd);
}

}  // namespace

int main(int argc, char** argv) {
  const auto seeds = static_cast<std::uint64_t>(argc > 1 ? std::atoi(argv[1]) : 20);
  const double seconds = argc > 2 ? std::atof(argv[2]) : 60.0;
  const std::filesystem::path root = HINGE_SOURCE_DIR, shared = HINGE_SHARED_DATA;
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(1);  // of the simplifier
  std::printf("flags: %s; seeds 1 to %llu; at most %.0f s per motion\n", HINGE_BENCH_FLAGS,
              static_cast<unsigned long long>(seeds), seconds);
  print_header("tested", "rad");
  for (const test::PlanningScene& scene : test::planning_scenes()) {
    if (!std::filesystem::exists(test::shared_folder(scene.robot))) {
      std::printf("%s is left out: there is no shared robot %s\n", scene.name.c_str(), scene.robot.c_str());
      continue;
    }
    run_robot(scene, seeds, seconds);
  }
  print_header("motions", "A");
  const std::filesystem::path ubiquitin = root / "molecular/data/1ubq.pdb";
  run_molecule(ubiquitin, "1UBQ loop A:7-13", "A:7-13", "", seeds, seconds);
  run_molecule(ubiquitin, "1UBQ loop A:5-16", "A:5-16", "", seeds, seconds);
  run_molecule(ubiquitin, "1UBQ A:70-76", "", "A:70-76", seeds, seconds);
  if (std::filesystem::exists(shared / "molecules/adk_dims.dcd"))
    run_kinase(shared / "molecules", 10 * seconds);
  else
    std::printf("adenylate kinase is left out: there is no adk_dims.dcd\n");
  return 0;
}
