#pragma once
#include <Eigen/Core>
#include <optional>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// (n) A motion that nothing resists at an equilibrium, its largest component over its coordinate's scale 1.
/// For this motion K x = 0, G x = 0, and another equilibrium exists some way along x, under the same loads.
///
/// Nothing where there is none, and where more than ten thousand coordinates hide it in round-off. Of several
/// motions any one, or a sum. Exceptions of the system arrive unchanged.
std::optional<Eigen::VectorXd> find_mechanism(const SecondOrderSystem& system, const State& equilibrium);

/// (n) The motion that the tangent resists least, its largest component over its coordinate's scale 1, where
/// the tangent is singular to round-off; nothing elsewhere.
std::optional<Eigen::VectorXd> softest_motion(const SecondOrderSystem& system, const State& state);

}  // namespace nurbeam
