// SPDX-License-Identifier: BSD-3-Clause
// The set-ups of BioCD's Figures 9 and 10 on engine/lazy, brute force and FCL's manager, interleaved in one run, with
// equal answers checked. Structures are the stand-ins named in docs/explanation/benchmarks.md; without them 1UBQ takes
// their place.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hinge/hierarchy.hpp"
#include "hinge/molecular/bond_exclusions.hpp"
#include "hinge/molecular/molecule.hpp"
#include "hinge/molecular/radii.hpp"
#include "hinge/molecular/read_structure.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/selection.hpp"
#include "oracle/fcl_oracle.hpp"

namespace {

using namespace hinge;
using namespace hinge::molecular;
using Clock = std::chrono::steady_clock;
template <template <class, class, class> class E>
using Molecular = Hierarchy<Point, BondExclusions, TypedThresholds, E>;

constexpr std::uint64_t seed = 2005;
constexpr int repetitions = 3;  // one pre-emption spoils a mean, so the best of these counts for each conformation

struct Setup {
  const char* figure;
  std::string file;
  int residues;  // free, at regular intervals
};

/// Everything one set-up needs, all peers prepared on the same pairs.
class Scene {
 public:
  Scene(const Molecule& molecule, int residues)
      : thresholds_(make_thresholds(molecule.structure())),
        filter_(exempted(molecule)),
        selection_(molecule.select(select_torsions(molecule, "count:" + std::to_string(residues), true))),
        lazy_(molecule.model(), selection_, filter_, thresholds_.matrix),
        brute_(molecule.model(), selection_, filter_, thresholds_.matrix),
        fcl_(radii(molecule.structure()), [this](std::size_t i, std::size_t j) {
          const auto a = id<PrimitiveId>(i), b = id<PrimitiveId>(j);
          return filter_.admits(a, b) && !lazy_.model().constant(a, b);
        }) {
    for (std::size_t i = 0; i < molecule.structure().atoms.size(); ++i)
      if (lazy_.model().group_of(id<PrimitiveId>(i)) != GroupId{0}) moved_.push_back(i);
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  std::size_t dof_count() const { return lazy_.dof_count(); }

  /// Brings all peers to a configuration; forward kinematics and coordinates are nobody's time.
  void prepare(const std::vector<double>& q) {
    lazy_.update(q);
    brute_.update(q);
    brute_.placed();
    positions_.clear();
    for (const Point& p : lazy_.placed()) positions_.push_back({p.position[0], p.position[1], p.position[2]});
  }
  Molecular<Lazy>& lazy() { return lazy_; }
  Molecular<Brute>& brute() { return brute_; }
  oracle::FclSpheres& fcl() {
    fcl_.update(positions_, moved_);
    return fcl_;
  }

 private:
  /// Pairs closer than M + 0.05 angstrom in the native structure do not count.
  BondExclusions exempted(const Molecule& molecule) const {
    Molecular<Lazy> native(molecule.model(), molecule.select({}), BondExclusions(molecule.structure(), 4),
                           thresholds_.matrix);
    std::vector<Point> placed;
    for (const Vec3& x : molecule.structure().models.front()) placed.push_back(Point{x});
    native.update_placed(placed);
    std::vector<std::pair<PrimitiveId, PrimitiveId>> pairs;
    for (const Hit& hit : native.self_within(0.05)) pairs.emplace_back(hit.first, hit.second);
    return {molecule.structure(), 4, pairs};
  }
  /// Bondi's M is a sum of radii, so spheres of rho * r say the same.
  std::vector<double> radii(const Structure& structure) const {
    std::vector<double> radii;
    for (std::size_t i = 0; i < structure.atoms.size(); ++i)
      radii.push_back(thresholds_.matrix.threshold(id<PrimitiveId>(i), id<PrimitiveId>(i)) / 2);
    return radii;
  }

  Thresholds thresholds_;
  BondExclusions filter_;
  DofSelection selection_;
  Molecular<Lazy> lazy_;
  Molecular<Brute> brute_;
  oracle::FclSpheres fcl_;
  std::vector<std::size_t> moved_;
  std::vector<oracle::Position> positions_;
};

enum class Query { any, all, within, closest };
constexpr const char* query_names[] = {"any", "all", "within", "closest"};

/// Microseconds per conformation of lazy, brute, FCL (NaN where not asked), and how many verdicts differ.
struct Result {
  double lazy = 0.0, brute = 0.0, fcl = 0.0, colliding = 0.0;
  int differences = 0;
};

template <class Work>
double best_time(const Work& prepare, const Work& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repetitions; ++k) {
    prepare();
    const auto start = Clock::now();
    work();
    best = std::min(best, std::chrono::duration<double, std::micro>(Clock::now() - start).count());
  }
  return best;
}

Result run(Scene& scene, Query query, const Sampling& sampling, int conformations) {
  Result result;
  std::vector<double> away(scene.dof_count(), 0.0);
  for (int k = 0; k < conformations; ++k) {
    const auto q = sample_configuration(sampling, static_cast<std::uint64_t>(k), scene.dof_count());
    // A query at another configuration in between, so that every repetition pays for its update.
    const std::function<void()> prepare = [&] {
      scene.prepare(away);
      scene.lazy().self_collides();
      scene.fcl();
      scene.prepare(q);
    };
    std::size_t lazy = 0, brute = 0, fcl = 0;
    double lazy_gap = 0.0, brute_gap = 0.0;
    const auto ask = [&](auto& hierarchy, std::size_t& answer, double& gap) {
      switch (query) {
        case Query::any: answer = hierarchy.self_collides() ? 1 : 0; break;
        case Query::all: answer = hierarchy.self_collisions().size(); break;
        case Query::within: answer = hierarchy.self_within(1.0).size(); break;
        case Query::closest: gap = hierarchy.self_closest()->gap(); break;
      }
    };
    result.lazy += best_time<std::function<void()>>(prepare, [&] { ask(scene.lazy(), lazy, lazy_gap); });
    result.brute += best_time<std::function<void()>>(prepare, [&] { ask(scene.brute(), brute, brute_gap); });
    if (query == Query::any)
      result.fcl += best_time<std::function<void()>>(prepare, [&] { fcl = scene.fcl().any() ? 1 : 0; });
    if (query == Query::all)
      result.fcl += best_time<std::function<void()>>(prepare, [&] { fcl = scene.fcl().all().size(); });
    const bool fcl_asked = query == Query::any || query == Query::all;
    if (lazy != brute || lazy_gap != brute_gap || (fcl_asked && fcl != lazy)) ++result.differences;
    result.colliding += query == Query::any ? static_cast<double>(lazy) : 0.0;
  }
  for (double* value : {&result.lazy, &result.brute, &result.fcl, &result.colliding}) *value /= conformations;
  if (query != Query::any && query != Query::all) result.fcl = std::numeric_limits<double>::quiet_NaN();
  return result;
}

/// The largest sigma (rad, to 2 %) at which at most a quarter of 100 conformations collide.
double near_free_sigma(Scene& scene) {
  double low = 1e-6, high = 0.2;
  while (high / low > 1.02) {
    const double middle = std::sqrt(low * high);
    int colliding = 0;
    for (std::uint64_t k = 0; k < 100; ++k) {
      scene.lazy().update(sample_configuration({seed, middle}, k, scene.dof_count()));
      colliding += scene.lazy().self_collides() ? 1 : 0;
    }
    (colliding <= 25 ? low : high) = middle;
  }
  return low;
}

std::string find(const std::string& name) {
  const auto path = std::filesystem::path(HINGE_SHARED_DATA) / "molecules" / "paper" / name;
  return std::filesystem::exists(path) ? path.string() : std::string();
}

}  // namespace

int main(int argc, char** argv) {
  const int conformations = argc > 1 ? std::atoi(argv[1]) : 40;
  std::vector<Setup> setups;
  for (const int k : {1, 5, 10, 35, 153}) setups.push_back({"9", find("1mbn.pdb"), k});
  for (const auto& [file, k] : {std::pair("1vii_3frames.pdb", 36), std::pair("2axd.pdb.gz", 76),
                                std::pair("1be0.cif", 310), std::pair("2d0f.pdb", 637)})
    for (const int free : {10, k}) setups.push_back({"10", find(file), free});
  if (setups.front().file.empty()) {
    std::printf("shared data not found: 1UBQ takes the place of the paper's proteins\n");
    setups.clear();
    for (const int k : {1, 5, 10, 35, 76})
      setups.push_back({"9", std::string(HINGE_SOURCE_DIR) + "/molecular/data/1ubq.pdb", k});
  }
  std::printf(
      "one thread, %s, seed %llu, %d conformations, best of %d; microseconds per conformation, forward\n"
      "kinematics and coordinates excluded, each peer's own update included\n",
      __VERSION__, static_cast<unsigned long long>(seed), conformations, repetitions);
  std::printf("%-3s %-18s %4s %5s %-9s %-8s %9s %9s %9s %9s %9s %5s\n", "fig", "file", "free", "dof", "sampling",
              "query", "lazy", "brute", "fcl", "brute/lz", "fcl/lazy", "diff");
  int differences = 0, count = 0;
  double log_sum = 0.0;
  for (const Setup& setup : setups) {
    ReadOptions options;
    options.keep_hydrogens = false;
    options.model = 1;
    const Molecule molecule(read_structure(setup.file, options));
    Scene scene(molecule, setup.residues);
    const double sigma = near_free_sigma(scene);
    const std::pair<const char*, Sampling> samplings[] = {
        {"random", {seed, {}}}, {"5deg", {seed, 5 * std::numbers::pi / 180}}, {"near-free", {seed, sigma}}};
    for (const auto& [name, sampling] : samplings)
      for (const Query query : {Query::any, Query::all, Query::within, Query::closest}) {
        const int n = scene.dof_count() > 1000 ? std::max(4, conformations / 4) : conformations;
        const Result r = run(scene, query, sampling, n);
        differences += r.differences;
        std::printf("%-3s %-18s %4d %5zu %-9s %-8s %9.1f %9.1f %9.1f %9.2f %9.2f %5d", setup.figure,
                    std::filesystem::path(setup.file).filename().c_str(), setup.residues, scene.dof_count(), name,
                    query_names[static_cast<int>(query)], r.lazy, r.brute, r.fcl, r.brute / r.lazy, r.fcl / r.lazy,
                    r.differences);
        if (query == Query::any) std::printf("  %2.0f %% collide", 100 * r.colliding);
        std::printf("\n");
        std::fflush(stdout);
        if (setup.figure[0] == '9' && query == Query::any && std::string_view(name) == "near-free") {
          log_sum += std::log(r.fcl / r.lazy);
          ++count;
        }
      }
  }
  std::printf("ratio any near-free fcl %.2f (geometric mean over Figure 9's selections), %d differing answers\n",
              std::exp(log_sum / count), differences);
  return differences == 0 ? 0 : 1;
}
