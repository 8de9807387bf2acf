// SPDX-License-Identifier: BSD-3-Clause
// FreeSampler: random conformations without a collision, grown residue by residue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "hinge/core/api.hpp"
#include "hinge/core/philox.hpp"
#include "hinge/core/vec3.hpp"
#include "hinge/kinematics/closure_solver.hpp"
#include "hinge/molecular/checker.hpp"
#include "hinge/molecular/loop.hpp"
#include "hinge/molecular/sampler.hpp"
#include "hinge/molecular/torsion_prior.hpp"
#include "hinge/policy/collector.hpp"
#include "hinge/query/query_options.hpp"

namespace hinge::molecular {

/// Options of a FreeSampler.
struct FreeSampling {
  Sampling sampling{};                ///< the seed, and the distribution of torsions without statistics
  Prior prior = Prior::ramachandran;  ///< the distribution of torsions; independent if Sampling::sigma is given
  std::uint64_t most_starts = 1000;   ///< starts of one sample, at least 1
  std::uint32_t most_draws = 10;      ///< draws of one residue, or of a loop's end, before growth goes back
  std::uint32_t most_returns = 60;    ///< dead ends of one start after its furthest residue, before it ends
};

/// The result of one sample.
struct FreeSample {
  /// One value per selected DOF, relative to the reference, rad or angstrom; empty: no start gave a free conformation.
  std::vector<double> q;
  std::uint64_t unclosed = 0;   ///< starts that ended because cycles did not close
  std::uint64_t dead_ends = 0;  ///< starts that ended because of collisions
  /// If there is no conformation: the pairs that collide at the last dead end, sorted; empty if there was none.
  std::vector<Hit> blockers;
  bool stopped = false;  ///< stop() ended the search

  /// True if there is a conformation.
  bool found() const noexcept { return !q.empty(); }
  /// Number of starts.
  std::uint64_t starts() const noexcept { return unclosed + dead_ends + (found() ? 1 : 0); }
};

/// Draws free conformations. A start grows from the root of each molecule outwards: it draws the torsions of one
/// residue, tests the atoms that they place against all atoms placed before, and draws again if they collide. If all
/// draws of a residue collide, growth goes back one residue, later two and more. A start that gets no further for too
/// long ends, and the next one begins.
///
/// Loops (MoleculeOptions::loops) grow in the same way up to their last six residues. A draw is also rejected if the
/// rest of the loop, stretched, would not reach its end. The last six residues are drawn, closed by their own torsions
/// and tested; then their side chains are drawn one by one. If closures of other kinds are kept, a start draws and
/// closes the whole conformation first; torsions that are on no cycle, such as those of side chains, are then drawn
/// again residue by residue.
///
/// With statistics (Prior::ramachandran), a sample that fails moves towards the reference: in its start k, counted from
/// 0, a residue is drawn near its reference with probability min(0.8, k / 10): Gaussian, 10 degrees.
///
/// So in the first start a residue has the distribution of the prior, restricted to values that are free of the
/// residues before it. This is not the prior restricted to free conformations: growth does not see what is placed
/// later, and conformations in narrow places come out more often. Closing moves torsions away from their prior.
/// FreeSample::starts() tells how many starts a sample took. Sample `index` depends on the arguments and (seed, index)
/// alone. One per thread.
class HINGE_API FreeSampler {
 public:
  /// Keeps these closures (find_kept_closures), indices in the tree's. ranges: one per placed part. The checker is
  /// copied. Throws ModelError if nothing is free, a number of options is 0, statistics and a standard deviation are
  /// both given, or the ranges are wrong (sample_configuration).
  FreeSampler(const Checker& checker, const FreeSampling& options, const std::vector<std::size_t>& closures,
              std::span<const PlacementRange> ranges);

  /// Returns sample `index`. stop: called before each start; if it returns true, the search ends.
  FreeSample sample(std::uint64_t index, const std::function<bool()>& stop = {});

 private:
  /// Values that are drawn together. They decide the poses of the groups of the range, which follows the range of the
  /// unit before.
  struct Unit {
    GroupRange groups;
    std::optional<std::uint32_t> residue;  // of its torsions
    std::optional<std::size_t> part;       // placed part
    std::vector<std::size_t> positions;    // of its values in a configuration; of a placed part: as PlacedPart::dofs
    bool is_closed = false;                // its values come from a solver
    // In a loop: this atom must be able to reach the end of the loop.
    std::optional<std::uint32_t> atom{};
    Vec3 end = Vec3::Zero();
    double reach = 0.0;
  };
  /// The last residues of a loop: units first, ..., end - 1.
  struct LoopEnd {
    std::size_t first, end;
    ClosureSolver solver;  // changes their torsions only
  };
  struct Step {
    std::size_t unit;
    std::optional<std::size_t> loop;  // the unit begins the end of this loop
  };
  enum class Outcome : std::uint8_t { grown, blocked, open };

  void make_units(std::span<const std::size_t> closures);
  void add_loop(const Loop& loop, std::size_t closure);
  void draw(std::size_t unit, SampleStream& stream, std::span<double> q) const;
  /// Draws unit u until it is free.
  bool place(std::size_t u, SampleStream& stream, std::span<double> q);
  bool close_loop(LoopEnd& loop, SampleStream& stream, std::span<double> q, bool& closed);
  Outcome grow(SampleStream& stream, std::span<double> q);

  Checker checker_;
  FreeSampling options_;
  std::vector<PlacementRange> ranges_;
  std::optional<ClosureSolver> solver_;  // if closures other than those of loops are kept
  std::vector<Unit> units_;
  std::vector<LoopEnd> loop_ends_;
  std::vector<Step> steps_;
  std::optional<TorsionPrior> prior_;
  double reference_share_ = 0.0;  // of draws near the reference, in the present start
  GroupRange blocked_;
};

}  // namespace hinge::molecular
