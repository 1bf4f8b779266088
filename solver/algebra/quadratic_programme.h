#pragma once
#include <Eigen/Dense>

namespace nurbeam {

struct QuadraticMinimum {
  Eigen::VectorXd x;
  Eigen::VectorXd pressures;  ///< per bound: the multiplier of the pressure against it, 0 without contact
};

/// The x that minimises f.x + x'Hx/2 with rows x >= bounds, to within `tolerance` of the bounds, by the dual
/// active set method of Goldfarb and Idnani (1983). Bounds may depend on one another. Where no x satisfies
/// all bounds, x is the minimum for the bounds found before. Precondition: H (n x n) is positive definite;
/// rows are m x n.
QuadraticMinimum least_quadratic(const Eigen::MatrixXd& H, const Eigen::VectorXd& f,
                                 const Eigen::MatrixXd& rows, const Eigen::VectorXd& bounds,
                                 double tolerance);

}  // namespace nurbeam
