#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "fem/element/beam_element.h"
#include "fem/element/layout.h"
#include "fem/element/placed_section.h"
#include "fem/element/quadrature.h"
#include "fem/element/section_frame.h"
#include "fem/element/twist_drawing.h"
#include "fem/element/twist_stiffness.h"
#include "fem/material/section_moments.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Coordinates of an element with torsion, and their rates.
struct TwistState {
  TwistLayout::Coordinates q, v, a;
};

struct TwistEnergy {
  double kinetic = 0, bending = 0, torsion = 0;  ///< [J]; kinetic: of the spin about the tangent
  double dissipation = 0;                        ///< [W]

  /// The strain energy and dissipation of a point of this weight [m].
  void add(const SectionStrain<double>& strain, const SectionStrain<double>& rate, double weight,
           const BeamProperties& properties);
};

/// A moment on a section [N m], fixed in space. With `follower` its components along the section's axes
/// stay those that `value` has along the drawn axes. With an arm y1 d1 + y2 d2 [m] it is the moment of a
/// force `value` [N], fixed in space, at the end of the arm.
struct SectionMoment {
  Eigen::Vector3d value;
  bool follower = false;
  std::optional<Eigen::Vector2d> arm = {};
};

/// A section in motion, with its strain and moments.
struct SectionPoint {
  SectionTriad<double> triad;
  SectionStrain<double> strain;    ///< against the drawing [1/m]
  SectionMoments<double> moments;  ///< elastic [N m]
};

/// The sections of one element: bending about their own axes and torsion, with the inertia of the spin about
/// the tangent. Their forces add to those of a BeamElement<3> whose axis alone does not bend. With moving
/// ends both have form V of docs/theory.md.
///
/// Inside the element the section is carried from end A by parallel transport. It is turned by the drawn
/// twist and by the twist since the drawing, theta(xi) = theta_B xi + beta 4 xi (1 - xi), xi = (s - s_A)/h.
/// So the strain of twist is theta'/h, only relative directions count, and the drawn shape is free of stress
/// to round-off (docs/theory.md, "Torsion").
class TwistElement {
 public:
  using Coordinates = TwistLayout::Coordinates;
  using Matrix = TwistLayout::Matrix;
  /// A chart of a node: fixed axes M1, M2, m, columns.
  using SectionChart = Eigen::Matrix3d;

  /// `curve`, with sections, and `properties`, with theirs, must outlive the element. `s_a`, `s_b`: places of
  /// the ends; for moving ends the first ones. `charts`: of both ends, in any present orientation. `turn`: an
  /// approximate turn of the section at B against that at A, to choose between angles 2 pi apart [rad];
  /// default: as drawn.
  ///
  /// Throws std::invalid_argument without sections, for a stiffness that is not positive definite and for a
  /// spatial measure of curvature.
  TwistElement(const ReferenceCurve& curve, const BeamProperties& properties, const Chart& chart, double s_a,
               double s_b, Ends ends, const std::array<SectionChart, 2>& charts, std::optional<double> turn);
  /// An element in the charts of the drawing.
  TwistElement(const ReferenceCurve& curve, const BeamProperties& properties, const Chart& chart, double s_a,
               double s_b, Ends ends = Ends::fixed);

  /// This element in other charts, with another turn. Precondition: fixed().
  TwistElement in_charts(const std::array<SectionChart, 2>& charts, double turn) const;

  const SectionChart& chart(int end) const { return charts_[end]; }

  bool fixed() const { return ends_ == Ends::fixed; }

  /// d/dt(dT/dv) - dT/dq + dU/dq + damping of the sections; zero in the rows of fixed places.
  Coordinates force(const TwistState& x) const;
  /// w.mass dF/da + w.damping dF/dv + w.stiffness dF/dq of the force F.
  Matrix tangent(const TwistState& x, const TangentWeights& w) const;
  TwistEnergy energy(const TwistState& x) const;

  /// Whether a step may end in this state: No tangent may be near the opposite of its chart's tangent or of
  /// the tangent at A. The turn must be near enough to its reference to be told from the next one.
  bool admissible(const Coordinates& q) const;
  /// Whether the charts should soon be replaced by those of the present sections.
  bool should_recentre(const Coordinates& q) const;
  /// The section at an end.
  SectionTriad<double> end_section(const Coordinates& q, int end) const;
  /// The moment [N m] that corresponds to forces conjugate to r_s and the angle of an end.
  Eigen::Vector3d end_moment(const Coordinates& q, int end, const Eigen::Vector3d& on_slope,
                             double on_angle) const;
  /// The turn of the section at B against the section at A [rad].
  double turn(const Coordinates& q) const;
  /// Spin of the section at an end about its tangent [rad/s].
  double spin(const TwistState& x, int end) const;

  /// The section at material point s.
  SectionPoint section(const Coordinates& q, double s) const;
  /// The strain of twist at both ends, between which it is linear [rad/m].
  std::array<double, 2> twist_strain(const Coordinates& q) const;
  /// The turn of the section at material point s against the section at A [rad].
  double turn_to(const Coordinates& q, double s) const;
  /// Spin of the material section at s about its tangent [rad/s].
  double material_spin(const TwistState& x, double s) const;
  /// Rows of derivatives of the material spin in the velocities, at places of one shape.
  class MaterialSpinRows {
   public:
    MaterialSpinRows(const TwistElement& element, const Coordinates& q);
    Coordinates at(double s) const;

   private:
    double s_a_, h_;
    // Rows of the nodes' spins, without their turns as they move over the drawing.
    std::array<Coordinates, 2> ends_;
    std::array<double, 2> strain_ = {0, 0};  // strain of twist at moving ends
  };
  /// A vector that turns with the section at s from where it is drawn, and its derivative in q.
  struct TurnedWithSection {
    Eigen::Vector3d value;
    Eigen::Matrix<double, 3, TwistLayout::size> gradient;
  };
  TurnedWithSection turned(const Coordinates& q, double s, const Eigen::Vector3d& drawn) const;
  /// The section at the place x.tail(1), for the coordinates before it.
  PlacedSection placed(const PlacedSection::Coordinates<double>& x) const {
    return {*curve_, chart_, charts_, turn_, x};
  }
  /// moment_force(): generalised force of a moment on the section at s; moment_gradient(): its derivative in
  /// q.
  Coordinates moment_force(const Coordinates& q, double s, const SectionMoment& moment) const;
  Matrix moment_gradient(const Coordinates& q, double s, const SectionMoment& moment) const;
  /// Generalised force of a unit torque about the present tangent along the element [N m/m], and its
  /// derivative in q.
  Coordinates torque_force(const Coordinates& q) const;
  Matrix torque_gradient(const Coordinates& q) const;

 private:
  static constexpr int points = GaussRule::size;
  // Number of the coordinates that count: with fixed ends, and with the places.
  static constexpr int fixed_rows = twist::reduced, moving_rows = twist::reduced + 2;
  template <class T>
  using Reduced = twist::Reduced<T>;
  using FixedPoint = twist::Point<double, points>;
  using FixedFields = twist::Fields<double, points>;

  // The section at a place, for n coordinates that count, n = fixed_rows or moving_rows.
  template <class T>
  struct At {
    SectionTriad<T> a;  // at the start of the element
    twist::PointField<T> point;
    SectionStrain<T> strain;  // against the drawing
  };
  template <class T, int n>
  At<T> at_place(const Eigen::Matrix<T, n, 1>& x, double s) const;
  At<double> at_place(const Coordinates& q, double s) const;
  template <class T, int n>
  Eigen::Matrix<T, n, 1> moment_on(const Eigen::Matrix<T, n, 1>& q, double s,
                                   const SectionMoment& moment) const;
  SectionMoment along_axes(double s, const SectionMoment& moment) const;
  template <class T>
  Reduced<T> fixed_torque(const Reduced<T>& q) const;
  template <int n>
  TurnedWithSection turned_on(const Coordinates& q, double s, const Eigen::Vector3d& components) const;
  Eigen::Vector3d drawn_components(double s, const Eigen::Vector3d& vector) const;

  bool near_charts(const Coordinates& q, double cosine, double turn_reach) const;
  template <class P>
  twist::DrawnElement<P> drawn_element(const Coordinates& q) const {
    return {*curve_, chart_, q[TwistLayout::place(0)], q[TwistLayout::place(1)]};
  }
  void set_fixed(const twist::DrawnElement<Dual<2>>& drawn);
  static FixedPoint fixed_point(const twist::AnyPoint<double>& p);
  FixedPoint fixed_point(double s) const;
  template <class T>
  twist::Fields<T, points> fields(const Reduced<T>& x) const;

  Reduced<double> section_force(const Reduced<double>& q, const Reduced<double>& v) const;
  twist::Moments section_moments_at(const FixedFields& at, const twist::Viscosity* viscous) const;
  std::optional<twist::Viscosity> viscosity(const Reduced<double>& q, const Reduced<double>& v) const;
  Reduced<double> spin_force(const Reduced<double>& q, const Reduced<double>& v,
                             const Reduced<double>& a) const;
  Coordinates fixed_force(const TwistState& x) const;
  Matrix fixed_tangent(const TwistState& x, const TangentWeights& w) const;
  TwistEnergy fixed_energy(const TwistState& x) const;

  Coordinates moving_force(const TwistState& x) const;
  Matrix moving_tangent(const TwistState& x, const TangentWeights& w) const;
  Matrix moving_mass(const Coordinates& q) const;
  TwistEnergy moving_energy(const TwistState& x) const;

  const ReferenceCurve* curve_;
  const BeamProperties* properties_;
  Chart chart_;
  Ends ends_;
  double s_a_, s_b_;  // places when the element was made
  std::array<SectionChart, 2> charts_;
  double turn_;                                   // Theta_ref
  twist::Drawing<double, points> drawing_;        // fixed ends only
  Eigen::Matrix<double, points, 1> drawn_rates_;  // fixed ends only: rates of transport in the drawing
  Eigen::Matrix3d spin_mass_;  // fixed ends only: on the spins of both ends and the bubble's rate
};

}  // namespace nurbeam
