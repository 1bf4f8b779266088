#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "fem/motion/rest/modes.h"

namespace nurbeam {

/// Adds buckling modes to `report`: the factors on `forces` under which its state at rest buckles, and their
/// shapes. `kkt` is the tangent in that state. K_g is the stiffness from the stresses of the linear response
/// to the loads, by central differences extrapolated once, and from the loads themselves. Factors for which
/// the linear response is no longer small are left out.
std::optional<Failure> find_buckling(const std::vector<Force>& forces, int count,
                                     const Eigen::SparseMatrix<double>& kkt,
                                     const std::function<void()>& between, ModesReport& report);

}  // namespace nurbeam
