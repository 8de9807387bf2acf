// SPDX-License-Identifier: BSD-3-Clause
// A distance matrix of your own: the gripper may come closer to the arm than the arm to itself.
#include <hinge/hinge.hpp>
#include <vector>

class ArmAndGripper {
 public:
  // in_gripper: one entry per primitive. Lengths in metres.
  explicit ArmAndGripper(std::vector<bool> in_gripper) : in_gripper_(std::move(in_gripper)) {}

  double threshold(hinge::PrimitiveId i, hinge::PrimitiveId j) const noexcept {
    return in_gripper_[index(i)] || in_gripper_[index(j)] ? 0.01 : 0.05;
  }
  // BioCD eq. (2): reach(i) + reach(j) >= threshold(i, j). Boxes are inflated by it, so it should be small.
  double reach(hinge::PrimitiveId i) const noexcept { return in_gripper_[index(i)] ? 0.005 : 0.025; }
  // Optional: lets Hierarchy check that the matrix was made for its model.
  std::size_t size() const noexcept { return in_gripper_.size(); }

 private:
  std::vector<bool> in_gripper_;
};
static_assert(hinge::DistanceMatrix<ArmAndGripper>);

int main() {
  hinge::ModelBuilder<hinge::Capsule> build;
  const hinge::Pose elbow{hinge::Mat3::Identity(), {0.5, 0, 0}};
  const auto upper = build.add_link(hinge::world, hinge::Revolute{}, {{{0, 0, 0}, {0.4, 0, 0}, 0.05}});
  const auto lower =
      build.add_link(upper, hinge::Revolute{{0, 0, 1}, {0, 0, 0}, elbow, "elbow"}, {{{0.1, 0, 0}, {0.4, 0, 0}, 0.05}});
  build.add_link(lower, hinge::Fixed{}, {{{0.5, 0, 0}, {0.5, 0.1, 0}, 0.01}});
  const auto model = build.finish();

  const ArmAndGripper matrix({false, false, true});
  if (!hinge::laws::check_distance_matrix(matrix, model.size()).empty()) return 1;
  hinge::Hierarchy arm(model, hinge::AdmitAll{}, matrix);
  arm.update({0.0, 2.9});  // rad: folded back
  const auto closest = arm.self_closest();
  return closest && closest->threshold >= 0.01 && arm.self_collides() ? 0 : 1;
}
