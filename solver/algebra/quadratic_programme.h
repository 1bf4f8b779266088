#pragma once
#include <Eigen/Dense>

namespace nurbeam {

struct QuadraticMinimum {
  Eigen::VectorXd x;
  Eigen::VectorXd
      pressures;  ///< per bound: the multiplier with which it is pressed against, 0 where it is not
};

/// The x that is least in f.x + x'Hx/2 with rows x >= bounds to within `tolerance` of them, by the dual
/// active set method of Goldfarb and Idnani (1983). Bounds may depend on one another. Where no x is within
/// all of them, it is so for those found before. Precondition: H (n x n) is positive definite; rows are m x
/// n.
QuadraticMinimum least_quadratic(const Eigen::MatrixXd& H, const Eigen::VectorXd& f,
                                 const Eigen::MatrixXd& rows, const Eigen::VectorXd& bounds,
                                 double tolerance);

}  // namespace nurbeam
