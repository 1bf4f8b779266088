#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "fem/motion/rest/modes.h"

namespace nurbeam {

/// Puts the factors on `forces` under which the state at rest of `report` buckles, and their shapes, into its
/// modes. `kkt` is the tangent there. K_g is by what the stresses of the linear response to the loads stiffen
/// it, by central differences extrapolated once, with the stiffness of the loads themselves; factors with
/// which that response is no small one are left out.
std::optional<Failure> find_buckling(const std::vector<Force>& forces, int count,
                                     const Eigen::SparseMatrix<double>& kkt,
                                     const std::function<void()>& between, ModesReport& report);

}  // namespace nurbeam
