#pragma once
#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "fem/element/axial_sums.h"
#include "fem/element/fixed_lanes.h"
#include "fem/element/layout.h"
#include "fem/element/moving_basis.h"
#include "fem/element/point_pack.h"
#include "fem/element/point_response.h"
#include "fem/element/quadrature.h"
#include "fem/element/rancf_basis.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

struct ElementEnergy {
  double kinetic = 0, axial = 0, bending = 0, external = 0;  ///< [J]; external: potential of the dead loads
  double dissipation = 0;                                    ///< [W]

  ElementEnergy& operator+=(const ElementEnergy& other) {
    kinetic += other.kinetic;
    axial += other.axial;
    bending += other.bending;
    external += other.external;
    dissipation += other.dissipation;
    return *this;
  }
};

/// The rule by which the assumed axial strain of an element follows from the pointwise one, the compressive
/// strain at which it buckles, if its beam does, and the factor on its FoldResistance.
struct AxialRule {
  OwnSlopes own_slopes = {};
  double buckling_strain = 0, fold_resistance = 1;

  bool operator==(const AxialRule&) const = default;
};

/// Whether the ends of an element move over the material.
enum class Ends { fixed, moving };

template <int D>
class ElementBatch;

/// The data of one element that do not change between length-control events.
///
/// All forces are the Euler-Lagrange expressions of one discrete Lagrangian: T - U of the fields of
/// ElementBasis, summed over Gauss points. The points sit at fixed fractions of the element's reference arc
/// length, or of each part's where the element spans breaks of the drawing. With moving ends this is form V
/// of docs/theory.md.
///
/// Damping has three parts: c times the strain rates; alpha rho A v against the material velocity v; and beta
/// S dr_s/dt on r_s at fixed material. The stiffness S of tension is EA times the mean strain, and 0 in
/// compression.
template <int D>
class BeamElement {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// With fixed ends everything that depends on s_a, s_b is computed here, once. `curve` and `properties`
  /// must outlive the element. Throws std::invalid_argument for moving ends on a curve without metric.
  BeamElement(const ReferenceCurve& curve, const BeamProperties& properties, Chart chart, double s_a,
              double s_b, Ends ends, const AxialRule& axial_rule = {});

  /// This element on another curve that is drawn alike from end to end, with equal properties.
  BeamElement on(const ReferenceCurve& curve, const BeamProperties& properties) const {
    BeamElement element = *this;
    element.curve_ = &curve;
    element.properties_ = &properties;
    return element;
  }

  const ReferenceCurve& curve() const { return *curve_; }
  const BeamProperties& properties() const { return *properties_; }
  const Chart& chart() const { return chart_; }
  bool fixed() const { return ends_ == Ends::fixed; }
  const AxialRule& axial_rule() const { return axial_rule_; }
  const OwnSlopes& own_slopes() const { return axial_rule_.own_slopes; }
  /// Whether the element has fixed ends and lies on one part of the drawing, so that others can stand beside
  /// it.
  bool is_one_part() const { return beside_ || (own_ && own_->packs.size() == 1); }
  /// Moves the element's numbers into a lane, which must be the first free one. Precondition: is_one_part().
  void stand_beside(std::shared_ptr<FixedLanes> others, int lane);
  /// Whether the element's numbers stand in this lane, beside those of `first` in lane 0.
  bool stands_beside(const BeamElement& first, int lane) const {
    return beside_ && beside_ == first.beside_ && lane_ == lane && first.lane_ == 0;
  }

  /// d/dt(dT/dv) - dT/dq + dU/dq + damping - external potential; `load`: dead load per reference length
  /// [N/m], rho A g included.
  ElementVector<D> force(const ElementState<D>& x, const Vector& load) const;
  /// The data at the points from which the force of an element with moving ends is summed, for one place of
  /// each end.
  struct Points {
    struct Point {
      MovingRows rows;
      Jet s, weight;
    };
    std::array<double, 2> ends;
    MovingBasis basis;
    std::vector<Point> all;
  };
  Points points(const ElementVector<D>& q) const;
  /// The force, where `points` belong to the present places of the ends.
  ElementVector<D> force(const ElementState<D>& x, const Vector& load, const Points& points) const;
  /// w.mass dF/da + w.damping dF/dv + w.stiffness dF/dq of the force F.
  ElementMatrix<D> tangent(const ElementState<D>& x, const Vector& load, const TangentWeights& w) const;
  /// The tangents for two sets of weights.
  std::array<ElementMatrix<D>, 2> tangents(const ElementState<D>& x, const Vector& load,
                                           const std::array<TangentWeights, 2>& w) const;
  ElementEnergy energy(const ElementState<D>& x, const Vector& load) const;
  /// int rho A S_k v ds [kg m/s] for the rates of the nodes, of an element whose ends are fixed. The columns
  /// of the positions add up to the momentum of the whole.
  ElementNodes<D> nodal_momentum(const ElementNodes<D>& rates) const {
    return with_sums([&](const FixedSums& sums) { return ElementNodes<D>(rates * matrix_of(sums.mass)); });
  }
  /// Whether the element is in tension, as its damping sees it.
  bool is_taut(const ElementState<D>& x) const { return taut_viscosity(x).value > 0; }
  /// Deformed length [m].
  double length(const ElementVector<D>& q) const;
  /// The numbers that give the assumed strain, with their gradient in q.
  AxialSums<D> axial_sums(const ElementVector<D>& q) const;
  /// int S'_k S'_l ds for the end positions in q: int eps ds of the pointwise axial strain is e S e / 2 less
  /// strain_of_axis(q), e the nodes.
  Eigen::Matrix4d stretch(const ElementVector<D>& q) const;
  /// The matrix G of the Legendre coefficient e_k of the strain, k = 1..4: e G e / 2, e the nodes; without
  /// that of the drawing.
  Eigen::Matrix4d stretch_coefficient(const ElementVector<D>& q, int k) const;
  /// int (1/2 + eps_0) ds for the end positions in q [m].
  double strain_of_axis(const ElementVector<D>& q) const;
  /// Maximum difference of the pointwise axial strain from the assumed one, at the Gauss points. It tells how
  /// much bending between the nodes the element cannot follow without stretching.
  double axial_mismatch(const ElementVector<D>& q) const;
  /// The Legendre coefficients of the pointwise axial strain less that of the drawing. The fourth is the part
  /// that the assumed strain does not see, except for an odd part that moves no position.
  StrainCoefficients<double> strain_coefficients(const ElementVector<D>& q) const;
  /// R of FoldResistance: how far the element has folded.
  double strain_residue(const ElementVector<D>& q) const;
  /// The assumed axial strain; nothing where the strain is pointwise.
  std::optional<AssumedStrain> assumed_strain(const ElementVector<D>& q) const;

  /// Shape functions for the end positions in q.
  ElementBasis<double> basis(const ElementVector<D>& q) const;
  /// Shape functions at material point s.
  ShapeFunctions<double> shape(const ElementVector<D>& q, double s) const { return basis(q).at(s); }
  /// Shape functions and their derivatives as functions of the end positions.
  MovingBasis moving_basis(const ElementVector<D>& q, Derivatives wanted = Derivatives::two) const;
  /// The shape functions as series in the end positions, s fixed.
  ShapeFunctions<Jet> shape_series(const ElementVector<D>& q, double s) const;
  /// The weights w_0..w_3 of the element's rational cubic (Eq. 9) for the end positions in q.
  Eigen::Vector4d bezier_weights(const ElementVector<D>& q) const;
  /// Reference arc length [m] at parameter u in [0,1] of the element's rational cubic.
  double place(const ElementVector<D>& q, double u) const;

  /// Calls visit(shape, s, weight) at every Gauss point between the ends s_a and s_b (double, or Jet: series
  /// in both); a part between two breaks of the drawing has its own points.
  template <class T, class Visit>
  void for_each_point(const T& s_a, const T& s_b, Visit&& visit) const;
  /// Calls visit(shape, s, weight) at every Gauss point between the ends in q, as series in both.
  template <class Visit>
  void for_each_point(const ElementVector<D>& q, Visit&& visit) const {
    using Layout = ElementLayout<D>;
    for_each_point(Jet::variable(q[Layout::place(0)], 0), Jet::variable(q[Layout::place(1)], 1), visit);
  }

 private:
  friend class ElementBatch<D>;  // takes the numbers side by side
  // The numbers of an element with fixed ends that stands alone.
  struct Own {
    FixedSums sums;
    std::vector<PointPack> packs;  // one per part
  };
  // Calls use(sums), visit(pack) with the numbers of each part, of an element with fixed ends.
  template <class Use>
  auto with_sums(const Use& use) const {
    return own_ ? use(own_->sums) : use(beside_->sums(lane_));
  }
  template <class Visit>
  void for_each_pack(const Visit& visit) const {
    if (own_)
      for (const PointPack& pack : own_->packs) visit(pack);
    else
      visit(beside_->pack(lane_));
  }
  template <class T, class Visit>
  void for_each_place(const T& s_a, const T& s_b, Visit&& visit) const;
  void add_point(int point, const ShapeFunctions<double>& shape, double weight, double eps0,
                 const StrainCoefficients<double>& in_strain, Own& own) const;
  // Calls use(kernel), the FixedKernel of an element with fixed ends.
  template <class Use>
  auto with_kernel(double free_strain, std::optional<bool> taut, double stabilisation, const Use& use) const;
  ElementVector<D> fixed_force(const ElementState<D>& x, const Vector& load) const;
  ElementEnergy fixed_energy(const ElementState<D>& x, const Vector& load) const;
  ElementMatrix<D> fixed_tangent(const ElementState<D>& x, const TangentWeights& w) const;
  AxialSums<D> fixed_axial_sums(const ElementVector<D>& q) const;
  double fixed_length(const ElementVector<D>& q) const;
  double fixed_axial_mismatch(const ElementVector<D>& q, const AssumedStrain& assumed) const;
  bool assumes_strain() const;
  AssumedStrain ends_and_mean(const ElementVector<D>& q) const;
  double mass_viscosity() const { return properties_->mass_damping * properties_->mass_per_length; }
  TautViscosity<D> taut_viscosity(const ElementState<D>& x) const;

  const ReferenceCurve* curve_;
  const BeamProperties* properties_;
  Chart chart_;
  Ends ends_;
  AxialRule axial_rule_;
  int lane_ = 0;  // lane in beside_
  // For fixed elements only, one of own_ and beside_.
  std::shared_ptr<const Own> own_;
  std::shared_ptr<FixedLanes> beside_;
};

template <int D>
template <class T, class Visit>
void BeamElement<D>::for_each_point(const T& s_a, const T& s_b, Visit&& visit) const {
  const std::conditional_t<std::is_same_v<T, Jet>, MovingBasis, ElementBasis<T>> basis(*curve_, chart_, s_a,
                                                                                       s_b);
  for_each_place(s_a, s_b, [&](const T& s, const T& weight) { visit(basis.at(s), s, weight); });
}

// Calls visit(s, weight) at the places of the Gauss points.
template <int D>
template <class T, class Visit>
void BeamElement<D>::for_each_place(const T& s_a, const T& s_b, Visit&& visit) const {
  const auto visit_part = [&](const T& lo, const T& hi) {
    for (int g = 0; g < GaussRule::size; ++g)
      visit(T(lo + GaussRule::points[g] * (hi - lo)), T(GaussRule::weights[g] * (hi - lo)));
  };
  T lo = s_a;
  if (chart_.segment < 0)
    for (double s = curve_->next_break(value(s_a)); s < value(s_b); s = curve_->next_break(s)) {
      visit_part(lo, T(s));
      lo = T(s);
    }
  visit_part(lo, s_b);
}

extern template class BeamElement<2>;
extern template class BeamElement<3>;

}  // namespace nurbeam
