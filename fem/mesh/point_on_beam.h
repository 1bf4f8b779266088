#pragma once
#include <array>
#include <optional>

#include "fem/mesh/mesh_elements.h"
#include "fem/mesh/widened.h"

namespace nurbeam {

/// Position and slope of one element at one material point, as combinations of its nodal coordinates.
template <int D>
struct PointShape {
  ElementNodes<D> nodes;
  std::array<Jet, 4> value, d1;

  PointField<D> position() const { return {value, nodes}; }
  PointField<D> slope() const { return {d1, nodes}; }
};

/// Position and slope at a material point, and the derivative of the slope by s.
template <int D>
struct CurvedPointShape : PointShape<D> {
  std::array<Jet, 4> d2;

  PointField<D> slope_s() const { return {d2, this->nodes}; }
};

/// Shape of the element's material point at s, for the coordinates q.
template <int D>
CurvedPointShape<D> point_shape(const MeshElement<D>& e, const Eigen::VectorXd& q, double s) {
  const ElementVector<D> x = gather<D>(e, q);
  const ElementNodes<D> nodes = ElementLayout<D>::nodes(x);
  if (!e.element.fixed()) {
    const ShapeFunctions<Jet> shape = e.element.shape_series(x, e.local(x, s));
    return {{nodes, shape.value, shape.d1}, shape.d2};
  }
  // Nothing asks for derivatives by ends that stay.
  const ShapeFunctions<double> shape = e.element.shape(x, e.local(x, s));
  const auto still = [](const std::array<double, 4>& values) {
    return std::array<Jet, 4>{Jet(values[0]), Jet(values[1]), Jet(values[2]), Jet(values[3])};
  };
  return {{nodes, still(shape.value), still(shape.d1)}, still(shape.d2)};
}

/// A material point that stays in one element as long as the mesh stands.
template <int D>
class PointOnBeam {
 public:
  PointOnBeam(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int beam, double s)
      : element_(find_span(at.structure, at.mesh, drawn, beam, s)), s_(s) {
    const MeshElement<D>& e = at.elements[element_];
    const MeshSpan& span = *e.span;
    const int node = s == span.s_a && span.place_a < 0 ? 0 : s == span.s_b && span.place_b < 0 ? 1 : -1;
    if (node >= 0)
      fixed_ = at_node(node);
    else if (e.element.fixed())
      fixed_ = point_shape<D>(e, drawn, s);
  }

  double s() const { return s_; }
  /// Whether its shape is equal in all states.
  bool is_fixed() const { return fixed_.has_value(); }
  const MeshElement<D>& element(const MeshedBeams<D>& at) const { return at.elements[element_]; }
  std::vector<int> dofs(const MeshedBeams<D>& at) const {
    const auto& dofs = element(at).dofs;
    return {dofs.begin(), dofs.end()};
  }
  PointShape<D> shape(const MeshedBeams<D>& at, const Eigen::VectorXd& q) const {
    if (!fixed_) return point_shape<D>(element(at), q, s_);
    return {ElementLayout<D>::nodes(gather<D>(element(at), q)), fixed_->value, fixed_->d1};
  }

 private:
  // The shape at a fixed node of the element itself.
  static PointShape<D> at_node(int node) {
    PointShape<D> shape;
    shape.value[2 * node] = shape.d1[2 * node + 1] = 1;
    return shape;
  }

  int element_;
  double s_;                            // [m]
  std::optional<PointShape<D>> fixed_;  // where the shape does not change with the element's ends
};

}  // namespace nurbeam
