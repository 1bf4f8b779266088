#pragma once
#include <Eigen/Dense>

#include "solver/system/second_order_system.h"

namespace nurbeam::testing {

/// A small system given by dense matrices: fills the sparse tangent with a full pattern.
class DenseSystem : public SecondOrderSystem {
 public:
  const SparsePattern& tangent_pattern() const override {
    const int size = coordinate_count() + constraint_count();
    if (pattern_.size() != size) pattern_ = SparsePattern(Eigen::MatrixXd::Ones(size, size).sparseView());
    return pattern_;
  }

  void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override {
    const int n = coordinate_count();
    const int m = constraint_count();
    Eigen::Map<Eigen::MatrixXd> dense(kkt.valuePtr(), n + m, n + m);
    const Eigen::MatrixXd jacobian = constraint_jacobian(state);
    dense.setZero();
    dense.topLeftCorner(n, n) =
        w.mass * mass(state) + w.damping * damping(state) + w.stiffness * stiffness(state);
    dense.topRightCorner(n, m) = jacobian.transpose();
    dense.bottomLeftCorner(m, n) = jacobian;
  }

  Eigen::VectorXd constraint_product(const State& state, const Eigen::VectorXd& x) const override {
    return constraint_jacobian(state) * x;
  }
  Eigen::VectorXd constraint_rate(const State&) const override {
    return Eigen::VectorXd::Zero(constraint_count());
  }
  Eigen::VectorXd constraint_curvature(const State&) const override {
    return Eigen::VectorXd::Zero(constraint_count());
  }

 protected:
  /// (n x n) dF/da.
  virtual Eigen::MatrixXd mass(const State& state) const = 0;
  /// (n x n) dF/dv.
  virtual Eigen::MatrixXd damping(const State&) const {
    return Eigen::MatrixXd::Zero(coordinate_count(), coordinate_count());
  }
  /// (n x n) dF/dq.
  virtual Eigen::MatrixXd stiffness(const State& state) const = 0;
  /// (m x n) G.
  virtual Eigen::MatrixXd constraint_jacobian(const State&) const {
    return Eigen::MatrixXd::Zero(constraint_count(), coordinate_count());
  }

 private:
  mutable SparsePattern pattern_;
};

}  // namespace nurbeam::testing
