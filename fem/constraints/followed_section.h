#pragma once
#include "fem/constraints/node_section.h"
#include "fem/element/placed_section.h"

namespace nurbeam {

/// The section of its node that a sliding body follows: coordinates (r_s, angle).
class FollowedNode {
 public:
  static constexpr int size = 4;

  FollowedNode(const MeshedBeams<3>& at, const Eigen::VectorXd&, int rider)
      : node_(at.elements[at.mesh.first_span[at.structure.riders[rider].beam] + at.mesh.riders[rider].node],
              0) {}

  const std::array<int, size>& dofs() const { return node_.dofs; }
  Eigen::Vector4d coordinates(const MeshedBeams<3>&, const Eigen::VectorXd& q) const {
    return node_.coordinates(q);
  }
  const NodeSection& here(const MeshedBeams<3>&, const Eigen::Vector4d&) const { return node_; }

 private:
  NodeSection node_;
};

/// The section that a sliding body follows where it is carried as a point of an element: coordinates of the
/// element with its sections, then the place.
class FollowedPoint {
 public:
  static constexpr int size = PlacedSection::size;
  using Coordinates = PlacedSection::Coordinates<double>;

  FollowedPoint(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, int rider)
      : element_(find_span(at.structure, at.mesh, drawn, at.structure.riders[rider].beam,
                           at.mesh.plan.places[rider])) {
    const auto& dofs = at.elements[element_].twist->dofs;
    std::copy(dofs.begin(), dofs.end(), dofs_.begin());
    dofs_[size - 1] = at.mesh.riders[rider].place;
  }

  int element() const { return element_; }
  const std::array<int, size>& dofs() const { return dofs_; }
  Coordinates coordinates(const MeshedBeams<3>& at, const Eigen::VectorXd& q) const {
    const MeshElement<3>& e = at.elements[element_];
    Coordinates x;
    x.head<TwistLayout::size>() = gather_twist(e, q);
    x[size - 1] = e.local(x.head<element_size<3>>(), q[dofs_.back()]);
    return x;
  }
  PlacedSection here(const MeshedBeams<3>& at, const Coordinates& x) const {
    return at.elements[element_].twist->element.placed(x);
  }

 private:
  int element_;
  std::array<int, size> dofs_;
};

/// Values of some coordinates; zero for those that a mesh does not have (-1).
template <std::size_t n>
Eigen::Matrix<double, static_cast<int>(n), 1> gathered(const std::array<int, n>& dofs,
                                                       const Eigen::VectorXd& values) {
  Eigen::Matrix<double, static_cast<int>(n), 1> x;
  for (std::size_t i = 0; i < n; ++i) x[static_cast<Eigen::Index>(i)] = dofs[i] >= 0 ? values[dofs[i]] : 0;
  return x;
}

}  // namespace nurbeam
