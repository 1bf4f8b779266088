#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// (n+m) x (n+m) The tangent of `system` at `state`, in a matrix of its own.
inline Eigen::SparseMatrix<double> tangent_matrix(const SecondOrderSystem& system, const State& state,
                                                  const TangentWeights& w) {
  Eigen::SparseMatrix<double> kkt = system.tangent_pattern().matrix();
  system.tangent(state, w, kkt);
  return kkt;
}

}  // namespace nurbeam
