#pragma once
#include <vector>

#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// What constraints and forces are bound to: a mesh, and what is known of its rows by then.
template <int D>
struct Binding {
  MeshedBeams<D> at;
  const Eigen::VectorXd& drawn;   ///< coordinates of the drawing
  const std::vector<bool>& held;  ///< riders whose place is held at its value in the plan
  int rows = 0;                   ///< those of the constraints that are bound
  std::vector<int> ties = {};     ///< per rider: first of the rows that tie its body to its beam

  bool holds(int rider) const { return rider < static_cast<int>(held.size()) && held[rider]; }
};

}  // namespace nurbeam
