// SPDX-License-Identifier: BSD-3-Clause
// JointSpace: the configurations of a MotionProblem as a state space of OMPL.
#pragma once

#include <ompl/base/StateSampler.h>
#include <ompl/base/StateSpace.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "hinge/core/philox.hpp"
#include "hinge_planning/motion_problem.hpp"

namespace hinge::planning {

/// Derived from the base class, not from RealVectorStateSpace: that one holds Eigen matrices, whose layout differs
/// between instruction sets. The problem must outlive the space.
class JointSpace : public ompl::base::StateSpace {
 public:
  /// seed: of the configurations that samplers draw.
  JointSpace(const MotionProblem& problem, std::uint64_t seed) : problem_(problem), seed_(seed) {}

  /// The values of a state.
  static std::span<double> values(ompl::base::State* state) { return static_cast<Values*>(state)->span(); }
  /// The same.
  static std::span<const double> values(const ompl::base::State* state) {
    return static_cast<const Values*>(state)->span();
  }

  unsigned int getDimension() const override { return static_cast<unsigned>(problem_.dof_count); }
  double getMaximumExtent() const override { return problem_.largest_distance; }
  double getMeasure() const override { return 1.0; }
  void enforceBounds(ompl::base::State*) const override {}  // draws are within the bounds
  bool satisfiesBounds(const ompl::base::State*) const override { return true; }
  void copyState(ompl::base::State* destination, const ompl::base::State* source) const override {
    std::ranges::copy(values(source), values(destination).begin());
  }
  double distance(const ompl::base::State* a, const ompl::base::State* b) const override {
    return problem_.distance(values(a), values(b));
  }
  bool equalStates(const ompl::base::State* a, const ompl::base::State* b) const override {
    return std::ranges::equal(values(a), values(b));
  }
  void interpolate(const ompl::base::State* from, const ompl::base::State* to, double t,
                   ompl::base::State* state) const override {
    const std::span<const double> start = values(from), end = values(to);
    std::vector<double> q(start.size());  // `state` may be one of the two
    problem_.go(start, end, t, q);
    std::ranges::copy(q, values(state).begin());
  }
  ompl::base::StateSamplerPtr allocDefaultStateSampler() const override {
    return std::make_shared<Sampler>(this, problem_, SampleStream(seed_, samplers_++));
  }
  ompl::base::State* allocState() const override { return new Values(problem_.dof_count); }
  void freeState(ompl::base::State* state) const override { delete static_cast<Values*>(state); }

 private:
  class Values : public ompl::base::State {
   public:
    explicit Values(std::size_t count) : values_(count, 0.0) {}
    std::span<double> span() { return values_; }
    std::span<const double> span() const { return values_; }

   private:
    std::vector<double> values_;
  };

  class Sampler : public ompl::base::StateSampler {
   public:
    Sampler(const ompl::base::StateSpace* space, const MotionProblem& problem, const SampleStream& stream)
        : ompl::base::StateSampler(space), problem_(problem), stream_(stream) {}
    void sampleUniform(ompl::base::State* state) override { problem_.draw(stream_, values(state)); }
    // RRT-Connect draws with sampleUniform only.
    void sampleUniformNear(ompl::base::State* state, const ompl::base::State*, double) override {
      sampleUniform(state);
    }
    void sampleGaussian(ompl::base::State* state, const ompl::base::State*, double) override { sampleUniform(state); }

   private:
    const MotionProblem& problem_;
    SampleStream stream_;
  };

  const MotionProblem& problem_;
  std::uint64_t seed_;
  mutable std::uint64_t samplers_ = 0;
};

}  // namespace hinge::planning
