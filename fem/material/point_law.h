#pragma once
#include <algorithm>
#include <cmath>

#include "fem/material/section.h"

namespace nurbeam {

/// Energies per reference length at one material point [J/m].
struct EnergyDensity {
  double axial = 0, bending = 0;
  double total() const { return axial + bending; }
};

/// The constitutive law of a beam's axis at a point: bending, and the axial strain where it is pointwise (the
/// energy of the assumed one is the element's, assumed_axial.h). A beam with torsion has no bending here
/// (section_moments.h). Damping is Kelvin and Voigt's: stress c times the elastic stiffness times the rate of
/// the strain.
class PointLaw {
 public:
  explicit PointLaw(const BeamProperties& beam)
      : beam_(beam),
        EA_(beam.pointwise_axial_stiffness()),
        EI_(beam.axis_bending_stiffness()),
        c_(beam.damping) {}

  /// stretches(): whether the pointwise strain carries; is_damped(): whether strain rates are damped.
  NURBEAM_WITHIN bool stretches() const { return EA_ > 0; }
  NURBEAM_WITHIN bool is_damped() const { return c_ > 0; }

  /// Bending as functions of K - kappa_0: energy [J/m], moment [N m] and stiffness [N m^2].
  template <class T>
  NURBEAM_WITHIN T bending_energy(const T& square_of_bend) const {
    return EI_ / 2 * square_of_bend;
  }
  template <class T>
  NURBEAM_WITHIN T moment(const T& bend) const {
    return EI_ * bend;
  }
  NURBEAM_WITHIN double bending_stiffness() const { return EI_; }
  /// The axial law at eps - eps_0; zeros without pointwise strain.
  template <class T>
  NURBEAM_WITHIN AxialPoint<T> axial(const T& strain) const {
    return axial_point(beam_.law, EA_, strain, 0);
  }

  /// Damping as functions of the rates of K and eps: moment [N m], d(psi)/d(eps) [N] and lost power [W/m].
  template <class T>
  NURBEAM_WITHIN T viscous_moment(const T& bend_rate) const {
    return c_ * EI_ * bend_rate;
  }
  template <class T>
  NURBEAM_WITHIN T viscous_force(const T& strain_rate) const {
    return c_ * EA_ * strain_rate;
  }

 private:
  const BeamProperties& beam_;
  double EA_, EI_, c_;
};

/// Forces of a section at one material point, without damping.
struct SectionForces {
  double strain = 0;       ///< Green's axial strain against the unstressed length, without expansion [-]
  double axial_force = 0;  ///< d(axial energy)/d|r_s| = d(psi)/d(eps) |r_s|, tension positive [N]
};

/// `eps`: the axial strain that the section carries; eps0: that of the drawing; `free`: the free strain. The
/// assumed strain of a coarse element can compress a section to nothing, eps <= -1/2: the section then
/// carries no force. `buckling`: see axial_means.
inline SectionForces section_forces(const BeamProperties& beam, double eps, double eps0, double free,
                                    double buckling = 0) {
  const double strain = eps - eps0 - free;
  const AxialPoint<double> point =
      beam.compression == Compression::buckles
          ? buckling_point(beam.law, beam.axial_stiffness, strain, free, buckling)
          : axial_point(beam.law, beam.axial_stiffness, strain, free);
  return {(eps - free) / (1 + 2 * beam.free_strain.constant),
          point.force * std::sqrt(std::max(0.0, 1 + 2 * eps))};
}

/// The viscosity eta = beta S of the tension S at a mean strain less the free strain, and d(eta)/d(strain) [N
/// s]. `taut`: 1 in tension, or where a solver prescribes it, else 0.
template <class T>
struct TensionDamping {
  T value, by_strain;

  NURBEAM_WITHIN TensionDamping(const BeamProperties& beam, const T& strain, double free, const T& taut) {
    const AxialPoint<T> point = axial_point(beam.law, beam.axial_stiffness, strain, free);
    value = beam.tension_damping * (taut * point.force);
    by_strain = beam.tension_damping * (taut * point.stiffness);
  }
};

}  // namespace nurbeam
