#pragma once
#include <functional>

#include "solver/algebra/equilibrated_kkt.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// Derivatives of quantities of a rest, R(x; p) = 0 with x = (q, lambda), by its adjoint:
///   dQ/dp = Q_p - mu . R_p,  R_x' mu = Q_x,
/// with one solution for each quantity, for any number of parameters; Q_x by rates_by_unknowns.
class RestAdjoint {
 public:
  using Matrix = MotionTangents::Matrix;
  /// The quantities in a state.
  using Quantities = std::function<Eigen::VectorXd(const State&)>;

  /// `rest`: (n, m); `scale` (n): typical sizes of its coordinates; `tangent`: R_x ((n + m) x (n + m)).
  RestAdjoint(State rest, Eigen::VectorXd scale, const Eigen::SparseMatrix<double>& tangent);
  /// Whether the tangent is regular.
  bool regular() const { return transposed_.regular(); }

  /// (quantities x parameters) -mu . R_p, with R_p in `dynamics` (n rows) and `constraints` (m rows), a
  /// column for each parameter. Q_p, the direct effect of parameters on the quantities, is not included.
  /// Precondition: regular().
  Eigen::MatrixXd through_rest(const Quantities& quantities, const Matrix& dynamics,
                               const Matrix& constraints) const;

 private:
  State rest_;
  Eigen::VectorXd steps_;  // difference of each unknown (n + m)
  EquilibratedKkt transposed_;
};

}  // namespace nurbeam
