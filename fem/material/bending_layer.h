#pragma once
#include <Eigen/Core>

#include "fem/material/section.h"

namespace nurbeam {

/// The layer in which bending rounds the kink of a taut beam. Beyond it the beam is a string: with the angle
/// phi from there, EI phi'' = T sin(phi) along the layer, so that the angle decays with s as
/// exp(-s sqrt(T/EI)), and the greatest moment is 2 sqrt(EI T) sin(phi/2). All is exact for any angle, where
/// the layer is short beside the length in which T and the loads change.
struct BendingLayer {
  double reach;   ///< sqrt(EI/T), the longer of both sides [m]
  double moment;  ///< greatest moment, at the kink [N m]
};

/// How far bending reaches along a beam under a tension, sqrt(EI/T), about the stiffest axis [m]. The tension
/// must be positive.
double bending_reach(const BeamProperties& beam, double tension);

/// Whether an element of this length [m] under this axial force [N] is a part of a string: bending reaches
/// over a sixteenth of it at most. A kink then costs less than a slope that is one on both sides: the kink
/// sinks too far by half its angle times the reach, the smooth node too little by about its angle times a
/// thirtieth of the element (measured). What the ends bear across does not bend a string, and its moment is
/// elastic_moment().
bool is_string(const BeamProperties& beam, double length, double axial_force);
/// EI times a change of curvature [1/m], of a beam without torsion [N m].
double elastic_moment(const BeamProperties& beam, double bend);

/// The layer on both sides of a kink by an angle [rad], between tensions [N]: with equal ones the moment is
/// 2 sqrt(EI T) sin(angle/4), for small angles (angle/2) sqrt(EI T). `across`: components along the section's
/// axes d1 and d2 of the unit vector about which the beam turns, for a beam with torsion.
BendingLayer kink_layer(const BeamProperties& beam, double angle, double tension_before,
                        double tension_behind, const Eigen::Vector2d& across = Eigen::Vector2d::UnitX());
/// The layer at a clamp that holds the slope at an angle [rad] to the beam beyond the layer:
/// 2 sqrt(EI T) sin(angle/2), for small angles angle sqrt(EI T).
BendingLayer clamp_layer(const BeamProperties& beam, double angle, double tension,
                         const Eigen::Vector2d& across = Eigen::Vector2d::UnitX());

}  // namespace nurbeam
