#pragma once
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Blocks of a tangent in the columns of some coordinates: in the rows of these coordinates, and in the rows
/// of constraints.
class TangentBlocks {
 public:
  TangentBlocks(const BeamSystem& system, const State& state, const TangentWeights& weights,
                const std::vector<int>& coordinates);

  /// (k, k), (m, k)
  const Eigen::MatrixXd& coordinates() const { return square_; }
  const Eigen::MatrixXd& gradient() const { return gradient_; }

 private:
  Eigen::MatrixXd square_, gradient_;
};

/// (k) The rows of M a - f + G'lambda of some coordinates.
Eigen::VectorXd residual_of(const BeamSystem& system, const State& state,
                            const std::vector<int>& coordinates);

}  // namespace nurbeam
