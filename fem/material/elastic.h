#pragma once
#include <algorithm>
#include <cmath>

#include "fem/material/section.h"
#include "fem/material/strain.h"

namespace nurbeam {

/// Energies per reference length at one material point [J/m].
struct EnergyDensity {
  double axial = 0, bending = 0;
  double total() const { return axial + bending; }
};

/// Strain energy per reference length psi(z) = EA (eps - eps_0)^2/2 + EI (K - kappa_0)^2/2 and its
/// derivatives in z = (r_s, r_ss) and kappa_0. eps_0 = 0 but for Metric::label. EA counts only where the
/// beam's axial strain is pointwise: the energy of the assumed one is the element's (assumed_axial.h).
template <int D>
struct ElasticResponse {
  EnergyDensity energy;
  Eigen::Matrix<double, 2 * D, 1> gradient;         ///< d(psi)/dz
  Eigen::Matrix<double, 2 * D, 2 * D> hessian;      ///< d2(psi)/dz2; unset where one derivative is wanted
  double moment;                                    ///< EI (K - kappa_0) = -d(psi)/d(kappa_0) [N m]
  Eigen::Matrix<double, 2 * D, 1> moment_gradient;  ///< d(moment)/dz
  double bending_stiffness;                         ///< -d(moment)/d(kappa_0) [N m^2]
};

/// The constitutive law: with assumed_axial.h the only place that multiplies strain by stiffness.
template <int D, Derivatives wanted = Derivatives::two>
ElasticResponse<D> elastic_response(const BeamProperties& beam, const Eigen::Matrix<double, D, 1>& rs,
                                    const Eigen::Matrix<double, D, 1>& rss, double kappa0, double eps0 = 0) {
  const auto eps = axial_strain<D, wanted>(rs);
  const auto K = curvature<D, wanted>(rs, rss, beam.curvature);
  const double EA = beam.pointwise_axial_stiffness(), EI = beam.axis_bending_stiffness();
  const double stretch = eps.value - eps0, bend = K.value - kappa0;
  ElasticResponse<D> e;
  e.energy.axial = EA * stretch * stretch / 2;
  e.energy.bending = EI * bend * bend / 2;
  if constexpr (D == 3)
    if (kappa0 == 0) e.energy.bending -= EI * curvature_rounding * curvature_rounding / 2;
  e.moment = EI * bend;
  e.moment_gradient = EI * K.gradient;
  e.bending_stiffness = EI;
  e.gradient = EA * stretch * eps.gradient + e.moment * K.gradient;
  if constexpr (wanted == Derivatives::two)
    e.hessian = EA * (eps.gradient * eps.gradient.transpose() + stretch * eps.hessian) +
                e.moment_gradient * K.gradient.transpose() + e.moment * K.hessian;
  return e;
}

/// What a section carries at one material point, without damping.
struct SectionForces {
  double strain = 0;          ///< Green's axial strain against the unstressed length, without expansion [-]
  double curvature = 0;       ///< K by the beam's measure; signed in the plane [1/m]
  double axial_force = 0;     ///< d(axial energy)/d|r_s| = EA (eps - eps_0) |r_s|, tension positive [N]
  double bending_moment = 0;  ///< EI (K - kappa_0) [N m]
};

/// `eps`: the axial strain that the section carries; eps_0 the drawing's; `free` that without axial force. A
/// section that is compressed to nothing, eps <= -1/2, as the assumed strain of a coarse element can be,
/// carries no force.
template <int D>
SectionForces section_forces(const BeamProperties& beam, double eps, const Eigen::Matrix<double, D, 1>& rs,
                             const Eigen::Matrix<double, D, 1>& rss, double kappa0, double eps0 = 0,
                             double free = 0) {
  const double K = curvature<D, Derivatives::one>(rs, rss, beam.curvature).value;
  return {(eps - free) / (1 + 2 * beam.free_strain.constant), K,
          beam.axial_stiffness * (eps - eps0 - free) * std::sqrt(std::max(0.0, 1 + 2 * eps)),
          beam.axis_bending_stiffness() * (K - kappa0)};
}

/// Kelvin-Voigt stress y = c (EA eps' eps_z + EI K' K_z), with z' the rate at fixed material, plus eta r_s'
/// on r_s, and its derivatives at fixed eta [N s]; EA as above.
template <int D>
struct DampingResponse {
  Eigen::Matrix<double, 2 * D, 1> stress;       ///< y
  Eigen::Matrix<double, 2 * D, 2 * D> by_z;     ///< dy/dz at fixed z'
  Eigen::Matrix<double, 2 * D, 2 * D> by_rate;  ///< dy/dz'
  double power;                                 ///< y . z' [W/m]
};

template <int D>
DampingResponse<D> damping_response(const BeamProperties& beam, const Eigen::Matrix<double, D, 1>& rs,
                                    const Eigen::Matrix<double, D, 1>& rss,
                                    const Eigen::Matrix<double, 2 * D, 1>& rate, double eta = 0) {
  DampingResponse<D> d;
  d.stress.setZero();
  d.by_z.setZero();
  d.by_rate.setZero();
  d.power = 0;
  const auto add = [&](const StrainMeasure<D>& p, double stiffness) {
    const double viscosity = beam.damping * stiffness, p_rate = p.gradient.dot(rate);
    d.stress += viscosity * p_rate * p.gradient;
    d.by_z += viscosity * (p_rate * p.hessian + p.gradient * (p.hessian * rate).transpose());
    d.by_rate += viscosity * p.gradient * p.gradient.transpose();
    d.power += viscosity * p_rate * p_rate;
  };
  add(axial_strain<D>(rs), beam.pointwise_axial_stiffness());
  add(curvature(rs, rss, beam.curvature), beam.axis_bending_stiffness());
  d.stress.template head<D>() += eta * rate.template head<D>();
  d.by_rate.diagonal().template head<D>().array() += eta;
  d.power += eta * rate.template head<D>().squaredNorm();
  return d;
}

}  // namespace nurbeam
