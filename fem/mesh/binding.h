#pragma once
#include <vector>

#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// The mesh to which constraints and forces are bound, and the constraint rows bound so far.
template <int D>
struct Binding {
  MeshedBeams<D> at;
  const Eigen::VectorXd& drawn;   ///< coordinates of the drawing
  const std::vector<bool>& held;  ///< riders whose place is held at its value in the plan
  int rows = 0;                   ///< number of rows of the constraints bound so far
  std::vector<int> ties = {};     ///< per rider: first row of the constraint that ties its body to its beam

  bool holds(int rider) const { return rider < static_cast<int>(held.size()) && held[rider]; }
};

}  // namespace nurbeam
