#pragma once
#include <optional>

#include "fem/mesh/mesh_elements.h"
#include "fem/mesh/widened.h"

namespace nurbeam {

/// The shape functions of one element at one material point, and its nodal coordinates.
template <int D>
struct PointShape {
  ElementNodes<D> nodes;
  ShapeFunctions<Jet> shape;

  PointField<D> position() const { return {shape.value, nodes}; }
  PointField<D> slope() const { return {shape.d1, nodes}; }
  PointField<D> slope_s() const { return {shape.d2, nodes}; }
};

/// At material point s of the element, for the coordinates q.
template <int D>
PointShape<D> point_shape(const MeshElement<D>& e, const Eigen::VectorXd& q, double s) {
  const ElementVector<D> x = gather<D>(e, q);
  return {ElementLayout<D>::nodes(x), e.element.shape_series(x, e.local(x, s))};
}

/// A material point that stays in one element as long as the mesh stands.
template <int D>
class PointOnBeam {
 public:
  PointOnBeam(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam, double s)
      : element_(find_span(at.structure, at.mesh, drawn, beam, s)), s_(s) {
    const MeshElement<D>& e = at.elements[element_];
    if (e.element.fixed()) fixed_ = point_shape<D>(e, drawn, s).shape;
  }

  double s() const { return s_; }
  const MeshElement<D>& element(const MeshedBeams<D>& at) const { return at.elements[element_]; }
  std::vector<int> dofs(const MeshedBeams<D>& at) const {
    const auto& dofs = element(at).dofs;
    return {dofs.begin(), dofs.end()};
  }
  PointShape<D> shape(const MeshedBeams<D>& at, const Eigen::VectorXd& q) const {
    if (!fixed_) return point_shape<D>(element(at), q, s_);
    return {ElementLayout<D>::nodes(gather<D>(element(at), q)), *fixed_};
  }

 private:
  int element_;
  double s_;                                  // [m]
  std::optional<ShapeFunctions<Jet>> fixed_;  // where the element's ends do not move
};

}  // namespace nurbeam
