#pragma once
#include <Eigen/Core>

#include "fem/element/layout.h"

namespace nurbeam {

/// Value g, gradient and contracted Hessian y . d2g/dx2 of one constraint of at most D rows. The coordinates
/// x are the dofs of the constraint, at most as many as two elements have; columns beyond them are zero.
template <int D>
struct ConstraintTerms {
  static constexpr int size = 2 * element_size<D>;
  using Multipliers = Eigen::Matrix<double, D, 1>;  ///< y; rows beyond the constraint's are zero

  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, D, 1> value;
  Eigen::Matrix<double, Eigen::Dynamic, size, 0, D, size> gradient;
  Eigen::Matrix<double, size, size> hessian;  ///< unset unless it was asked for

  ConstraintTerms(int rows, bool with_hessian) {
    value.setZero(rows);
    gradient.setZero(rows, size);
    if (with_hessian) hessian.setZero();
  }
};

}  // namespace nurbeam
