// SPDX-License-Identifier: BSD-3-Clause
// Computes clearances, with normals and depths, and their derivatives.
#include <algorithm>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "approximation/between.hpp"
#include "checking/closeness.hpp"
#include "hinge/core/error.hpp"
#include "hinge/kinematics/kinematic_tree.hpp"
#include "hinge/primitive/triangle.hpp"
#include "hinge/robotics/environment.hpp"
#include "hinge/robotics/robot_checker.hpp"

namespace hinge::robotics {

namespace {

/// Copies the numbers of distances().
template <class Closest>
void copy_numbers(const Closest& from, Clearance& to) {
  to.distance = from.distance;
  to.gap = from.gap;
  to.point1 = from.point1;
  to.point2 = from.point2;
}

/// Fills the normal and, for inflated triangles that overlap, the depth. `clearance` holds the numbers of distances().
/// points(): the nearest points of the triangles without their radii.
template <class Points>
void add_direction(Clearance& clearance, double radius1, double radius2, const Points& points) {
  const double radii = radius1 + radius2;
  const auto [p, q] = radii > 0.0 ? points() : std::pair(clearance.point1, clearance.point2);
  const Vec3 way = q - p;
  const double between = norm(way);
  clearance.is_signed = radii > 0.0 && between > 0.0;
  // At distance 0 with surfaces apart, one is inside a solid of the other.
  if (clearance.distance == 0.0 && between > radii) clearance.is_signed = false;
  if (!(between > 0.0) || (clearance.distance == 0.0 && !clearance.is_signed)) return;
  clearance.normal = way / between;
  if (clearance.distance > 0.0) return;
  clearance.distance = std::min(between - radii, 0.0);
  clearance.point1 = p + clearance.normal * radius1;
  clearance.point2 = q - clearance.normal * radius2;
}

/// Returns the last link on the way from link a to the root that is on the way from link b, too.
LinkId common_ancestor(const KinematicTree& tree, LinkId a, LinkId b) {
  while (a != b) (a < b ? b : a) = tree.parent(std::max(a, b));  // parents have smaller indices
  return a;
}

/// Adds the derivative of sign * normal . x to a row, for a point x of the link that is at `at`. Joints from `until` to
/// the root are left out.
void add_slopes(RobotChecker& checker, LinkId link, LinkId until, const Vec3& at, const Vec3& normal, double sign,
                Eigen::Ref<Eigen::RowVectorXd> row) {
  const Robot& robot = checker.robot();
  const KinematicTree& tree = robot.model().tree();
  for (; link != until; link = tree.parent(link)) {
    const Joint& joint = tree.joint(link);
    if (!joint.has_dof()) continue;
    const Robot::Drive& drive = robot.drives()[index(tree.dof_of(link))];
    const Pose pose = checker.link_pose(link);
    const Vec3 axis = product(pose.rotation, joint.axis);
    const double slope =
        joint.kind == JointKind::revolute ? dot(normal, cross(axis, Vec3(at - pose * joint.point))) : dot(normal, axis);
    row[static_cast<Eigen::Index>(drive.independent)] += sign * drive.multiplier * slope;
  }
}

/// Returns the derivatives of the distances. links(row): the links that hold the first and the second point.
template <class Row, class Links>
ClearanceJacobian derivatives(RobotChecker& checker, std::span<const Row> rows, const Links& links) {
  const Robot& robot = checker.robot();
  ClearanceJacobian result = ClearanceJacobian::Zero(static_cast<Eigen::Index>(rows.size()),
                                                     static_cast<Eigen::Index>(robot.independent_joints().size()));
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto [first, second] = links(rows[k]);
    for (const LinkId link : {first, second}) static_cast<void>(checker.link_pose(link));  // throws for unknown links
    // Joints before both links move both alike.
    const LinkId common = common_ancestor(robot.model().tree(), first, second);
    Eigen::Ref<Eigen::RowVectorXd> row = result.row(static_cast<Eigen::Index>(k));
    add_slopes(checker, second, common, rows[k].point2, rows[k].normal, 1.0, row);
    add_slopes(checker, first, common, rows[k].point1, rows[k].normal, -1.0, row);
  }
  return result;
}

}  // namespace

std::vector<LinkClearance> RobotChecker::clearances(double influence) {
  std::vector<LinkClearance> rows;
  for (const ClosestLinks& closest : distances(influence)) {
    LinkClearance row;
    row.link1 = closest.link1;
    row.link2 = closest.link2;
    copy_numbers(closest, row);
    std::visit(
        [&](auto& hierarchy) {
          add_direction(row, margins_.radius(closest.triangle1), margins_.radius(closest.triangle2), [&] {
            return closest_points(triangle_at(hierarchy, closest.triangle1), triangle_at(hierarchy, closest.triangle2));
          });
        },
        *hierarchy_);
    rows.push_back(row);
  }
  return rows;
}

std::vector<BodyClearance> RobotChecker::clearances(Environment& environment, double influence) {
  std::vector<BodyClearance> rows;
  for (const ClosestBody& closest : distances(environment, influence)) {
    BodyClearance row;
    row.link = closest.link;
    row.held = closest.held;
    row.body = closest.body;
    copy_numbers(closest, row);
    Environment::Body& body = environment.at(closest.body);
    if (Environment::held_by(body, robot_.get())) row.body_holder = body.attachment->link;
    AnyHierarchy& mine = closest.held ? environment.at(*closest.held).hierarchy : *hierarchy_;
    with_same_engine(mine, body.hierarchy, [&](auto& first, auto& second) {
      add_direction(row, first.matrix().radius(closest.triangle1), second.matrix().radius(closest.triangle2), [&] {
        return closest_points(triangle_at(first, closest.triangle1), triangle_at(second, closest.triangle2));
      });
    });
    rows.push_back(row);
  }
  return rows;
}

ClearanceJacobian RobotChecker::jacobian(std::span<const LinkClearance> rows) {
  return derivatives(*this, rows, [](const LinkClearance& row) { return std::pair(row.link1, row.link2); });
}

ClearanceJacobian RobotChecker::jacobian(std::span<const BodyClearance> rows) {
  return derivatives(*this, rows,
                     [](const BodyClearance& row) { return std::pair(row.link, row.body_holder.value_or(LinkId{0})); });
}

}  // namespace hinge::robotics
