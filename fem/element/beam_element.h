#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/element/quadrature.h"
#include "fem/element/rancf_basis.h"
#include "fem/material/elastic.h"
#include "solver/second_order_system.h"

namespace nurbeam {

/// Number of generalised coordinates q = (r_A, r_sA, r_B, r_sB, s_A, s_B) of an element (Eq. 11 of Ding &
/// Ouyang with arc-length gradients and positions instead of r_x and x); D numbers each but the last two.
template <int D>
inline constexpr int element_size = 4 * D + 2;

template <int D>
using ElementVector = Eigen::Matrix<double, element_size<D>, 1>;
template <int D>
using ElementMatrix = Eigen::Matrix<double, element_size<D>, element_size<D>>;

/// Coordinates and their rates of one element.
template <int D>
struct ElementState {
  ElementVector<D> q, v, a;
};

template <int D>
struct ElementResponse {
  ElementVector<D> force;    ///< d/dt(dT/dv) - dT/dq + dU/dq + damping - external potential
  ElementMatrix<D> tangent;  ///< w.mass dF/da + w.damping dF/dv + w.stiffness dF/dq
};

struct ElementEnergy {
  double kinetic = 0, axial = 0, bending = 0, external = 0;  ///< [J]; external: potential of the dead loads
  double dissipation = 0;                                    ///< [W]
  double length = 0;                                         ///< deformed [m]
};

/// What does not change in one element between length-control events.
///
/// All forces are the Euler-Lagrange expressions of one discrete Lagrangian: T - U of the fields of
/// ElementBasis, summed over Gauss points that sit at fixed fractions of the element's reference arc length
/// (of each part, where the element spans breaks of the drawing). With moving ends this is form V of
/// docs/theory.md; Form::virtual_work is form P.
template <int D>
class BeamElement {
 public:
  /// `fixed`: neither end moves over the material; then everything that depends on s_a, s_b is computed here,
  /// once. `straight`: the stress-free shape has no curvature. Throws std::invalid_argument for an element
  /// with moving ends on a curve without metric.
  BeamElement(const ReferenceCurve& curve, const BeamProperties& properties, Chart chart, double s_a,
              double s_b, bool fixed, bool straight);

  const ReferenceCurve& curve() const { return *curve_; }
  const Chart& chart() const { return chart_; }
  bool fixed() const { return fixed_; }

  /// Force and tangent; `load`: dead load per reference length [N/m], rho A g included.
  void respond(const ElementState<D>& x, const Eigen::Matrix<double, D, 1>& load,
               const TangentWeights* weights, ElementResponse<D>& response) const;
  ElementEnergy energy(const ElementState<D>& x, const Eigen::Matrix<double, D, 1>& load) const;

  /// Shape functions at material point s for the end positions in q.
  ShapeFunctions<double> shape(const ElementVector<D>& q, double s) const;
  /// The same as series in the end positions, s fixed.
  ShapeFunctions<Jet> shape_series(const ElementVector<D>& q, double s) const;
  /// The weights w_0..w_3 of the element's rational cubic (Eq. 9) for the end positions in q.
  Eigen::Vector4d bezier_weights(const ElementVector<D>& q) const;
  /// Reference arc length [m] at parameter u in [0,1] of the element's rational cubic.
  double place(const ElementVector<D>& q, double u) const;
  /// Length of the chart parameter over the element and stretch J at both ends: r_u = J r_s.
  std::array<double, 3> chart_lengths(const ElementVector<D>& q) const;

 private:
  struct FixedPoint {
    Eigen::Vector4d S, S1, S2;
    double weight, kappa0, eps0;
  };
  // Calls visit(shape, s, weight) at every Gauss point; a part between two breaks of the drawing has its own
  // points.
  template <class T, class Visit>
  void for_each_point(const T& s_a, const T& s_b, Visit&& visit) const;
  void respond_fixed(const ElementState<D>& x, const Eigen::Matrix<double, D, 1>& load,
                     const TangentWeights* weights, ElementResponse<D>& response) const;
  void respond_moving(const ElementState<D>& x, const Eigen::Matrix<double, D, 1>& load,
                      const TangentWeights* weights, ElementResponse<D>& response) const;
  void respond_virtual_work(const ElementState<D>& x, const Eigen::Matrix<double, D, 1>& load,
                            const TangentWeights* weights, ElementResponse<D>& response) const;

  const ReferenceCurve* curve_;
  const BeamProperties* properties_;
  Chart chart_;
  bool fixed_, straight_;
  std::vector<FixedPoint> points_;  // fixed elements only
  Eigen::Matrix4d mass_;            // fixed elements only: rho A int S_k S_l ds
  Eigen::Vector4d load_factor_;     // fixed elements only: int S_k ds
};

extern template class BeamElement<2>;
extern template class BeamElement<3>;

}  // namespace nurbeam
