#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "fem/element/beam_element.h"
#include "fem/element/inertia.h"
#include "fem/element/twist_element.h"
#include "fem/mesh/mesh.h"
#include "solver/system/state.h"

namespace nurbeam {

/// The sections of an element of a beam with torsion.
struct MeshTwist {
  std::array<int, TwistLayout::size> dofs;  ///< global coordinates; -1 where there is none
  TwistElement element;
};

/// The element of a span of the mesh.
template <int D>
struct MeshElement {
  const MeshSpan* span;
  int index;                              ///< of the span
  std::array<int, element_size<D>> dofs;  ///< global coordinates; -1 where a fixed end has none
  /// Offset of the slope at the right end from the node's slope, which belongs to the element after it: the
  /// small angle of the drawing there, kept so that the drawn shape is exact. It is fixed in space, so under
  /// rotation it is right only to first order of the angle.
  Eigen::Matrix<double, D, 1> slope_offset;
  BeamElement<D> element;
  std::unique_ptr<const MeshTwist> twist = nullptr;  ///< on a beam with torsion, else null

  /// Place s as the element counts it: on a ring without the full turns in between.
  double local(const ElementVector<D>& q_element, double s) const {
    using Layout = ElementLayout<D>;
    return element.curve().unrolled(s, (q_element[Layout::place(0)] + q_element[Layout::place(1)]) / 2);
  }
};

/// The mesh of a structure and its elements, as constraints and forces see them.
template <int D>
struct MeshedBeams {
  const Structure& structure;
  const Mesh& mesh;
  const std::vector<MeshElement<D>>& elements;

  const MeshElement<D>& element_at(const Eigen::VectorXd& q, int beam, double s) const {
    return elements[find_span(structure, mesh, q, beam, s)];
  }
};

/// The elements of a mesh, in the order of its spans. The structure and these spans must outlive them.
/// `like`: another mesh of the same structure, or a mesh of a neighbouring structure. Numbers that elements
/// have in common with elements of that mesh are taken from there.
template <int D>
std::vector<MeshElement<D>> make_elements(const Structure& structure, const Mesh& mesh,
                                          const std::optional<MeshedBeams<D>>& like = {});

/// First of the nodal coordinates where they follow one another, else -1.
template <int D>
int first_coordinate(const MeshElement<D>& e) {
  for (int k = 1; k < ElementLayout<D>::nodal; ++k)
    if (e.dofs[k] != e.dofs[0] + k) return -1;
  return e.dofs[0];
}

/// Rates of the element's nodal values.
template <int D>
ElementNodes<D> node_rates(const MeshElement<D>& e, const Eigen::VectorXd& v) {
  ElementNodes<D> rates;
  for (int k = 0; k < ElementLayout<D>::nodal; ++k) rates.reshaped()[k] = v[e.dofs[k]];
  return rates;
}

/// The free strain of an element's beam, as State::load scales it.
template <int D>
double free_strain(const MeshElement<D>& e, const State& state) {
  const FreeStrain& strain = e.element.properties().free_strain;
  return strain.is_none() ? 0 : strain.of_tension + state.load * strain.at(state.t);
}

/// Coordinates and rates of one element.
template <int D>
ElementState<D> gather(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::VectorXd& a);
template <int D>
ElementState<D> gather(const MeshElement<D>& e, const State& state) {
  ElementState<D> x = gather(e, state.q, state.v, state.a);
  x.free_strain = free_strain(e, state);
  x.stabilisation = state.stabilisation;
  if (state.sides.size() > 0) x.taut = state.sides[e.index] != 0;
  return x;
}
/// Coordinates of one element without rates.
template <int D>
ElementVector<D> gather(const MeshElement<D>& e, const Eigen::VectorXd& q);

/// Whether two elements of one mesh of neighbouring models have the same axis, to round-off. They lie on one
/// segment that both models draw alike, with equal properties. Elements with moving ends are compared at
/// corresponding places, anywhere on the segment.
template <int D>
bool same_axis(const MeshElement<D>& e, const MeshElement<D>& other, const Beam& beam,
               const Beam& other_beam);

/// Coordinates and rates of the sections of an element of a beam with torsion.
TwistState gather_twist(const MeshElement<3>& e, const State& state);
TwistLayout::Coordinates gather_twist(const MeshElement<3>& e, const Eigen::VectorXd& q);

/// Position and material velocity fields at one material point; on a ring s may be any number of full turns
/// away.
template <int D>
struct MaterialPoint {
  Eigen::Matrix<double, D, 1> r, rs, rss;            ///< [m], [-], [1/m]
  Eigen::Matrix<double, D, 1> velocity, velocity_s;  ///< material velocity and its s-derivative [m/s], [1/s]
  double kappa0;                                     ///< curvature of the stress-free shape [1/m]
};
template <int D>
MaterialPoint<D> material_point(const MeshElement<D>& e, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                double s);
/// The material point of an element with fixed ends where the shape functions were evaluated.
template <int D>
MaterialPoint<D> material_point(const ElementState<D>& x, const ShapeFunctions<double>& shape);

}  // namespace nurbeam
