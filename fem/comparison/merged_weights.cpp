#include "fem/comparison/merged_weights.h"

#include <Eigen/SVD>

namespace nurbeam {

std::array<double, 4> merged_weights(int dimension, const Eigen::Vector3d& r_a,
                                     const Eigen::Vector3d& slope_a, const Eigen::Vector3d& r_b,
                                     const Eigen::Vector3d& slope_b, const Eigen::Vector3d& r_h, double u) {
  const double v = 1 - u;
  Eigen::Matrix3d A;
  A.col(0) = v * v * v * (r_a - r_h) + u * v * v * slope_a;
  A.col(1) = 3 * u * v * v * (r_a - r_h);
  A.col(2) = 3 * u * u * v * (r_b - r_h);
  const Eigen::Vector3d B = u * u * v * slope_b - u * u * u * (r_b - r_h) - A.rowwise().sum();
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(A.topRows(dimension), Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-2);
  const Eigen::Vector3d x = svd.solve(Eigen::VectorXd(B.head(dimension)));
  if ((x.array() + 1 <= 0).any()) return {1, 1, 1, 1};
  return {x[0] + 1, x[1] + 1, x[2] + 1, 1};
}

}  // namespace nurbeam
