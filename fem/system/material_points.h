#pragma once
#include <array>
#include <limits>
#include <optional>

#include "fem/mesh/mesh_elements.h"
#include "fem/system/beam_system.h"
#include "fem/system/stress_resultants.h"

namespace nurbeam {

/// Position and velocity fields at material point s [m] of a beam; on a ring s may be any number of full
/// turns away. A rigid guide stays where it is drawn.
MaterialPoint<3> material_point(const BeamSystem& system, const State& state, int beam, double s);
/// Position and velocity fields by the element in span `span`: at a node, from its side.
MaterialPoint<3> material_point_in(const BeamSystem& system, const State& state, int span, double s);
/// The acceleration of material point s of a beam [m/s^2]; 0 on a rigid guide.
Eigen::Vector3d material_acceleration(const BeamSystem& system, const State& state, int beam, double s);

/// The section at material point s of a beam with torsion, and its moments; at a node by the element after it
/// (the last element at the end of an open beam). Throws std::invalid_argument for a beam without torsion.
SectionPoint section_point(const BeamSystem& system, const State& state, int beam, double s);
/// material_spin(): spin of the material section at s about its tangent [rad/s]; section_twist(): present
/// twist of the beam there [rad/m]; both 0 without torsion.
double material_spin(const BeamSystem& system, const State& state, int beam, double s);
double section_twist(const BeamSystem& system, const State& state, int beam, double s);
/// Strains, forces and stresses of one section of a beam.
struct SectionRecord {
  double strain = 0;          ///< Green's axial strain, as it gives the axial force [-]
  double curvature = 0;       ///< [1/m], by the model's measure; signed in a planar model
  double axial_force = 0;     ///< elastic, tension positive [N]
  double bending_moment = 0;  ///< [N m]; signed in a planar model, in space as the change of curvature is
  double torque = 0;  ///< [N m]; signed in a planar model; in space with the sign of the change of curvature
  double shear_force = 0;   ///< [N]; in a planar model the force of the part beyond the section, along the
                            ///< normal n = e_z x t; in space its magnitude
  double stress = 0;        ///< at the fibre where it is largest [Pa]; NaN where the section does not give it
  double displacement = 0;  ///< distance of the axis from the drawing [m]
  /// For a beam with torsion, else NaN: bending moments about the section's own axes d1 and d2 [N m]; the
  /// twist of the section since the drawing, against the start of its span [rad]; the maximum von Mises
  /// stress [Pa] (NaN where the section does not give it).
  double moment_1 = no_number, moment_2 = no_number, twist = no_number, von_mises = no_number;

  static constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
};
/// The section at material point s [m] of the element in a span, whose stress resultants are `carried`.
SectionRecord section_at(const BeamSystem& system, const State& state, int span,
                         const SpanResultants& carried, double s);

/// The element in a span as a rational cubic, with the values of SectionRecord at the parameters u = 0, 1/3,
/// 2/3, 1 (`sample`).
struct ElementRecord {
  Eigen::Matrix4d control_points;  ///< homogeneous, deformed [m]
  /// The same element where it is drawn: with the weights of `control_points`, not homogeneous [m]; NaN in
  /// results of earlier versions.
  Eigen::Matrix<double, 3, 4> drawn_points = no_axes();
  double s_start = 0, s_end = 0;  ///< reference arc length [m]
  double axial_mismatch = 0;  ///< maximum of pointwise less assumed axial strain; large on a coarse mesh [-]
  double folded = 0;          ///< R of FoldResistance over |r_s|^2 where the element is longest
  Eigen::Vector4d strain, curvature, axial_force, bending_moment,
      torque = Eigen::Vector4d::Zero(), shear_force = Eigen::Vector4d::Zero(),
      stress = Eigen::Vector4d::Zero(), displacement = Eigen::Vector4d::Zero();
  Eigen::Matrix<double, 3, 4> velocity;  ///< of the material [m/s]
  Eigen::Vector4d moment_1 = no_numbers(), moment_2 = no_numbers(), twist = no_numbers(),
                  von_mises = no_numbers();
  /// The section's own axes, of unit length; NaN without torsion.
  Eigen::Matrix<double, 3, 4> d1 = no_axes(), d2 = no_axes();

 private:
  static Eigen::Vector4d no_numbers() { return Eigen::Vector4d::Constant(SectionRecord::no_number); }
  static Eigen::Matrix<double, 3, 4> no_axes() {
    return Eigen::Matrix<double, 3, 4>::Constant(SectionRecord::no_number);
  }
};
ElementRecord record_element(const BeamSystem& system, const State& state, int span,
                             const SpanResultants& carried);

/// span_control_points(): the control points of an ElementRecord; span_twist(): the twist of the span's end
/// against its start since the drawing [rad], NaN without torsion.
Eigen::Matrix4d span_control_points(const BeamSystem& system, const State& state, int span);
double span_twist(const BeamSystem& system, const State& state, int span);

/// Contribution of the element in a span to the estimated error of positions [m]: its length times its
/// quartic strain times quartic_strain_to_error. The factor was measured with the mean over the elements. The
/// models were cantilevers under loads of 1 and 10 EI/L^2, a beam rolled up to a circle and a cable of twice
/// its span, on meshes of 5 to 40 elements. Their errors are 1.1 to 2.4 times the quartic strain times the
/// length.
///
/// Where the drawing's parameter is uneven, a second term is added: the length of the beam times the angle by
/// which the element turns too little. This angle is its curvature times its length times the part of the
/// bending energy that its shapes do not reach.
double position_error(const BeamSystem& system, const State& state, int span);
inline constexpr double quartic_strain_to_error = 2.5;

/// The slopes that belong to the element in a span alone.
OwnSlopes own_slopes(const BeamSystem& system, int span);
/// The assumed axial strain of the element in a span; nothing where the strain is pointwise.
std::optional<AssumedStrain> assumed_strain(const BeamSystem& system, const State& state, int span);

/// int eps ds of the pointwise axial strain over a span [m], and its gradients in r and r_s of its ends.
struct StrainIntegral {
  double value;
  std::array<Eigen::Vector3d, 2> by_position, by_slope;
};
/// The strain integral of a span for all states of a system in which the span has the same ends. With k = 1,
/// 2: the Legendre coefficient e_k of the strain times the length of the span, for a drawing without strain.
class SpanStrain {
 public:
  SpanStrain(const BeamSystem& system, const State& state, int span, int k = 0);
  StrainIntegral at(const State& state) const;

 private:
  const BeamSystem& system_;
  int span_;
  Eigen::Matrix4d stretch_;
  double of_axis_;
};

/// The weights w_0..w_3 of the element in a span.
Eigen::Vector4d element_weights(const BeamSystem& system, const State& state, int span);

}  // namespace nurbeam
