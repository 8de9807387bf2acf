// SPDX-License-Identifier: BSD-3-Clause
// Writes degrees of freedom: their names, and their values in degrees and angstrom.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "report.hpp"

namespace biocd {

std::string dof_label(const Job& job, hinge::DofId dof) {
  const std::size_t torsion = job.molecule->torsion_of(dof);
  if (torsion != hinge::molecular::Molecule::no_torsion)
    return torsion_label(job.molecule->structure(), job.molecule->torsions()[torsion]);
  const hinge::KinematicTree& tree = job.molecule->model().tree();
  return tree.joint(tree.link_of(dof)).name;
}

bool turns(const Job& job, hinge::DofId dof) {
  const hinge::KinematicTree& tree = job.molecule->model().tree();
  return tree.joint(tree.link_of(dof)).kind == hinge::JointKind::revolute;
}

std::vector<double> in_degrees(const Job& job, std::vector<double> q) {
  for (std::size_t k = 0; k < q.size(); ++k)
    if (turns(job, job.checker.selection().dofs()[k])) q[k] /= degree;
  return q;
}

std::vector<double> torsion_values(const Job& job, std::vector<double> q) {
  for (std::size_t k = 0; k < q.size(); ++k) {
    const hinge::DofId dof = job.checker.selection().dofs()[k];
    const std::size_t torsion = job.molecule->torsion_of(dof);
    if (torsion != hinge::molecular::Molecule::no_torsion) {
      const double angle = std::remainder((q[k] + job.molecule->torsions()[torsion].reference) / degree, 360.0);
      q[k] = angle <= -180.0 ? 180.0 : angle;
    } else if (turns(job, dof)) {
      q[k] /= degree;
    }
  }
  return q;
}

Json dofs_json(const Job& job) {
  Json list = Json::array();
  for (const hinge::DofId dof : job.checker.selection().dofs()) {
    const std::size_t torsion = job.molecule->torsion_of(dof);
    const bool places = torsion == hinge::molecular::Molecule::no_torsion;
    list.push_back(
        Json{{"torsion", dof_label(job, dof)},
             {"reference_degrees",
              places ? Json() : Json(job.molecule->torsions()[torsion].reference * 180.0 / std::numbers::pi)}});
  }
  return list;
}

}  // namespace biocd
