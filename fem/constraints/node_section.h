#pragma once
#include <array>
#include <cmath>

#include "fem/element/section_frame.h"
#include "fem/mesh/mesh_elements.h"

namespace nurbeam {

/// The section at a node of a beam with torsion, seen from one of its sides.
struct NodeSection {
  Eigen::Matrix3d chart;
  Eigen::Matrix3d drawn;    ///< triad of the section in the drawing, columns
  std::array<int, 4> dofs;  ///< coordinates of (r_s, angle)

  NodeSection(const MeshElement<3>& e, int end) : chart(e.twist->element.chart(end)), dofs{} {
    const DrawnSection section = e.element.curve().section(end == 0 ? e.span->s_a : e.span->s_b, end == 1);
    drawn << section.d1, section.d2, section.t;
    for (int d = 0; d < 3; ++d) dofs[d] = e.twist->dofs[TwistLayout::slope(end) + d];
    dofs[3] = e.twist->dofs[TwistLayout::angle(end)];
  }
  /// The section at a node of a beam: seen from the element after the node, at the end of the beam from the
  /// one before.
  static NodeSection at(const MeshedBeams<3>& at, const Eigen::VectorXd& drawn, int beam, double s) {
    const MeshElement<3>& e = at.element_at(drawn, beam, s);
    const double place = e.element.curve().unrolled(s, (e.span->s_a + e.span->s_b) / 2);
    return {e, std::abs(place - e.span->s_a) <= std::abs(place - e.span->s_b) ? 0 : 1};
  }

  /// (4) Values of (r_s, angle) from the coordinates q of the mesh.
  Eigen::Vector4d coordinates(const Eigen::VectorXd& q) const {
    return {q[dofs[0]], q[dofs[1]], q[dofs[2]], q[dofs[3]]};
  }
  template <class T>
  SectionTriad<T> triad(const Eigen::Matrix<T, 4, 1>& x) const {
    return section_at_node<T>(chart, x.template head<3>(), x[3]);
  }
  /// Forces on (r_s, angle) from a moment on the section.
  template <class T>
  Eigen::Matrix<T, 4, 1> force(const Eigen::Matrix<T, 4, 1>& x, const Vector3<T>& moment) const {
    return node_force<T>(chart, x.template head<3>(), moment);
  }
};

}  // namespace nurbeam
