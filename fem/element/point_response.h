#pragma once
#include <Eigen/Core>
#include <type_traits>

#include "fem/element/derivatives.h"
#include "fem/element/point_strain.h"
#include "fem/material/point_law.h"

/// The law at one point as vectors and matrices in z = (r_s, r_ss), for elements whose ends move.
namespace nurbeam {

/// A scalar strain measure at one material point with its gradient in z.
template <int D>
struct StrainGradient {
  double value;
  Eigen::Matrix<double, 2 * D, 1> gradient;
};

/// A strain measure with its Hessian besides.
template <int D>
struct StrainMeasure : StrainGradient<D> {
  Eigen::Matrix<double, 2 * D, 2 * D> hessian;
};

template <int D, Derivatives wanted>
using Strain = std::conditional_t<wanted == Derivatives::one, StrainGradient<D>, StrainMeasure<D>>;

template <int D>
Components<D, double> components(const Eigen::Matrix<double, D, 1>& x) {
  Components<D, double> c;
  for (int d = 0; d < D; ++d) c[d] = x[d];
  return c;
}

/// Green's axial strain [-].
template <int D, Derivatives wanted = Derivatives::two>
Strain<D, wanted> axial_strain(const Eigen::Matrix<double, D, 1>& rs) {
  Strain<D, wanted> e;
  e.value = (rs.squaredNorm() - 1) / 2;
  e.gradient.setZero();
  e.gradient.template head<D>() = rs;
  if constexpr (wanted == Derivatives::two) {
    e.hessian.setZero();
    e.hessian.template topLeftCorner<D, D>().setIdentity();
  }
  return e;
}

/// The curvature [1/m] of point_strain.h.
template <int D, Derivatives wanted = Derivatives::two>
Strain<D, wanted> curvature(const Eigen::Matrix<double, D, 1>& rs, const Eigen::Matrix<double, D, 1>& rss,
                            CurvatureMeasure measure) {
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  const bool material = measure == CurvatureMeasure::material;
  Strain<D, wanted> k;
  if constexpr (wanted == Derivatives::two) {
    const CurvatureDerivatives<D, double> K(components<D>(rs), components<D>(rss), material);
    k.value = K.value;
    k.gradient = Eigen::Map<const Pair>(K.gradient.data());
    k.hessian = Eigen::Map<const Eigen::Matrix<double, 2 * D, 2 * D>>(K.hessian[0].data());
  } else {
    const Curvature<D, double> K(components<D>(rs), components<D>(rss), material);
    k.value = K.value;
    for (int d = 0; d < D; ++d) {
      k.gradient[d] = K.by_rs[d];
      k.gradient[D + d] = K.by_rss[d];
    }
  }
  return k;
}

/// Strain energy per reference length psi(z) and its derivatives in z and kappa_0. eps_0 is 0 except with
/// Metric::label. The axial part counts only where the beam's axial strain is pointwise (point_law.h).
template <int D>
struct ElasticResponse {
  EnergyDensity energy;
  Eigen::Matrix<double, 2 * D, 1> gradient;         ///< d(psi)/dz
  Eigen::Matrix<double, 2 * D, 2 * D> hessian;      ///< d2(psi)/dz2; unset if one derivative is wanted
  double moment;                                    ///< -d(psi)/d(kappa_0) [N m]
  Eigen::Matrix<double, 2 * D, 1> moment_gradient;  ///< d(moment)/dz
  double moment_slope;                              ///< -d(moment)/d(kappa_0) [N m^2]
};

template <int D, Derivatives wanted = Derivatives::two>
ElasticResponse<D> elastic_response(const BeamProperties& beam, const Eigen::Matrix<double, D, 1>& rs,
                                    const Eigen::Matrix<double, D, 1>& rss, double kappa0, double eps0 = 0) {
  const PointLaw law(beam);
  const auto K = curvature<D, wanted>(rs, rss, beam.curvature);
  const double bend = K.value - kappa0;
  double square = bend * bend;
  if constexpr (D == 3)
    if (kappa0 == 0) square -= curvature_rounding * curvature_rounding;
  ElasticResponse<D> e;
  e.energy.bending = law.bending_energy(square);
  e.moment = law.moment(bend);
  e.moment_slope = law.bending_stiffness();
  e.moment_gradient = e.moment_slope * K.gradient;
  e.gradient = e.moment * K.gradient;
  if constexpr (wanted == Derivatives::two)
    e.hessian = e.moment_gradient * K.gradient.transpose() + e.moment * K.hessian;
  if (!law.stretches()) return e;
  const AxialPoint<double> axial = law.axial((rs.squaredNorm() - 1) / 2 - eps0);
  e.energy.axial = axial.energy;
  e.gradient.template head<D>() += axial.force * rs;
  if constexpr (wanted == Derivatives::two) {
    auto by_rs = e.hessian.template topLeftCorner<D, D>();
    by_rs += axial.stiffness * rs * rs.transpose();
    by_rs.diagonal().array() += axial.force;
  }
  return e;
}

/// Kelvin-Voigt stress y on z, with z' the rate at fixed material, plus eta r_s' on r_s, and its derivatives
/// at fixed eta [N s].
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
  const PointLaw law(beam);
  DampingResponse<D> d;
  d.stress.setZero();
  d.by_z.setZero();
  d.by_rate.setZero();
  d.power = 0;
  // `unit`: stress of a strain at rate 1; `stress`: its stress at the present rate p_rate.
  const auto add = [&](const StrainMeasure<D>& p, double unit, double stress, double p_rate) {
    d.stress += stress * p.gradient;
    d.by_z += stress * p.hessian + unit * p.gradient * (p.hessian * rate).transpose();
    d.by_rate += unit * p.gradient * p.gradient.transpose();
    d.power += stress * p_rate;
  };
  const auto K = curvature<D>(rs, rss, beam.curvature);
  const double bend_rate = K.gradient.dot(rate);
  add(K, law.viscous_moment(1.), law.viscous_moment(bend_rate), bend_rate);
  if (law.stretches()) {
    const double stretch_rate = rs.dot(rate.template head<D>());
    add(axial_strain<D>(rs), law.viscous_force(1.), law.viscous_force(stretch_rate), stretch_rate);
  }
  d.stress.template head<D>() += eta * rate.template head<D>();
  d.by_rate.diagonal().template head<D>().array() += eta;
  d.power += eta * rate.template head<D>().squaredNorm();
  return d;
}

}  // namespace nurbeam
