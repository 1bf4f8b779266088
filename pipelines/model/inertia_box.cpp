#include "pipelines/model/inertia_box.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace nurbeam {

InertiaBox inertia_box(const Body& body) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> found(body.rigid->inertia);
  InertiaBox box{.principal = found.eigenvalues(), .sides = {}, .axes = found.eigenvectors()};
  if (box.axes.determinant() < 0) box.axes.col(2) *= -1;
  const Eigen::Vector3d& J = box.principal;
  for (int k = 0; k < 3; ++k) box.sides[k] = std::sqrt(std::max(6 * (J.sum() - 2 * J[k]) / body.mass, 0.0));
  return box;
}

}  // namespace nurbeam
