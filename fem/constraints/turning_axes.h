#pragma once
#include <array>
#include <optional>
#include <vector>

#include "fem/constraints/node_section.h"
#include "fem/mesh/attitude.h"
#include "fem/structure/grip.h"

namespace nurbeam {

/// Axes that turn with a rigid body or with a section of a beam with torsion; those of space stay. They have
/// four coordinates or none.
class TurningAxes {
 public:
  /// Throws std::invalid_argument for a body or a beam that has no attitude.
  TurningAxes(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, const Grip& of);

  const std::vector<int>& dofs() const { return dofs_; }
  /// A direction of the drawing, in a state.
  Eigen::Vector3d turned(const State& state, const Eigen::Vector3d& a) const;
  /// (3 x 4) Its derivative by the coordinates.
  Eigen::Matrix<double, 3, 4> gradient(const State& state, const Eigen::Vector3d& a) const;
  /// (4 x 4) Hessian of y . turned(a).
  Eigen::Matrix4d hessian(const State& state, const Eigen::Vector3d& a, const Eigen::Vector3d& y) const;

 private:
  Eigen::Vector4d coordinates(const State& state) const;

  std::optional<NodeSection> section_;
  std::vector<int> dofs_;
};

}  // namespace nurbeam
