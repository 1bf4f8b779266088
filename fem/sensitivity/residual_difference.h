#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// By what the residuals of two neighbouring systems of one mesh differ at the same state. Elements that are
/// the same in both, as those out of reach of a control point that moves, are left out.
class ResidualDifference {
 public:
  /// `near`: any state that both can have. Both systems must outlive it.
  ResidualDifference(const BeamSystem& more, const BeamSystem& less, const State& near);

  /// A coordinate, and by how much it changes with the parameter.
  using Shift = std::pair<int, double>;
  /// Half the difference over `step`: more at a time step x `later` after that of `at`, and with coordinates
  /// that are shifted so far; less as much before it, and as far the other way. Into `dynamics` (n) and
  /// `constraints` (m).
  void find(const State& at, double step, double later, const std::vector<Shift>& shifts,
            Eigen::Ref<Eigen::VectorXd> dynamics, Eigen::Ref<Eigen::VectorXd> constraints);

  /// The share of the elements' forces that is evaluated, where the same loads act in both systems.
  double share() const;

 private:
  const BeamSystem *more_, *less_;
  std::vector<bool> unlike_;
  State above_, below_;
  Eigen::VectorXd dynamics_, constraints_;
};

}  // namespace nurbeam
