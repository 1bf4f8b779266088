#pragma once

namespace nurbeam {

enum class CurvatureMeasure {
  material,  ///< |r_s x r_ss| / |r_s|^2: rotation per unit reference length, conjugate to the bending moment
  spatial    ///< |r_s x r_ss| / |r_s|^3: the papers' measure
};

/// How the forces on moving elements follow from the fields (theory.md: forms V and P).
enum class Form {
  variational,  ///< Euler-Lagrange expressions of T - U with moving limits: conserves energy
  virtual_work  ///< virtual work at fixed material points inside moving limits, Eqs. 18-19 of Ding & Ouyang,
                ///< for comparison: drifts
};

/// Plain numbers in SI: what the constitutive law needs of a cross section and its material.
struct BeamProperties {
  double axial_stiffness = 0;    ///< EA [N]
  double bending_stiffness = 0;  ///< EI [N m^2]
  double mass_per_length = 0;    ///< rho A [kg/m]
  double damping = 0;            ///< c [s]: stress = E (strain + c d(strain)/dt)
  CurvatureMeasure curvature = CurvatureMeasure::material;
  Form form = Form::variational;
};

}  // namespace nurbeam
