// The forces of an element with torsion and fixed ends.
#include "fem/element/twist_element.h"
#include "fem/element/twist_inertia.h"
#include "fem/element/twist_rows.h"
#include "fem/element/twist_stiffness.h"

namespace nurbeam {

template <class T>
auto TwistElement::fields(const Reduced<T>& x) const -> twist::Fields<T, points> {
  return twist::fields_of<T>(drawing_, charts_, turn_, x);
}

namespace {

std::array<SectionStrain<double>, GaussRule::size> rates_of(
    const twist::Fields<Dual<1>, GaussRule::size>& moving) {
  std::array<SectionStrain<double>, GaussRule::size> rates;
  for (int g = 0; g < GaussRule::size; ++g)
    rates[g] = {moving.at[g].k1.d[0], moving.at[g].k2.d[0], moving.at[g].gamma.d[0]};
  return rates;
}

}  // namespace

// Elastic moments, plus viscous ones where the element is damped.
twist::Moments TwistElement::section_moments_at(const FixedFields& at,
                                                const twist::Viscosity* viscous) const {
  std::array<SectionStrain<double>, points> rates{};
  const double damping = viscous ? viscous->damping : 0;
  if (viscous) rates = rates_of(viscous->moving);
  twist::Moments moments;
  for (int g = 0; g < points; ++g) {
    SectionStrain<double> strain{at.at[g].k1 - drawing_.points[g].k1, at.at[g].k2 - drawing_.points[g].k2,
                                 at.at[g].gamma};
    if (viscous) {
      strain.bend_1 += damping * rates[g].bend_1;
      strain.bend_2 += damping * rates[g].bend_2;
      strain.twist += damping * rates[g].twist;
    }
    moments[g] = section_moments<double>(*properties_->sections, strain);
  }
  return moments;
}

// The viscosity of a damped element; nothing without damping.
std::optional<twist::Viscosity> TwistElement::viscosity(const Reduced<double>& q,
                                                        const Reduced<double>& v) const {
  if (!(properties_->damping > 0)) return {};
  return twist::Viscosity{fields<Dual<1>>(twist::moving<double>(q, v)), properties_->damping};
}

TwistElement::Reduced<double> TwistElement::section_force(const Reduced<double>& q,
                                                          const Reduced<double>& v) const {
  const FixedFields at = fields<double>(q);
  const std::optional<twist::Viscosity> viscous = viscosity(q, v);
  return twist::gradient_of<double>(drawing_, charts_, at,
                                    section_moments_at(at, viscous ? &*viscous : nullptr), 0.0);
}

// Forces of the spin inertia: p = M w, with the spins of both ends and the bubble's rate w.
TwistElement::Reduced<double> TwistElement::spin_force(const Reduced<double>& q, const Reduced<double>& v,
                                                       const Reduced<double>& a) const {
  const std::array<twist::NodeSpin<double>, 2> nodes{twist::NodeSpin<double>(charts_[0], 0, q, v, a),
                                                     twist::NodeSpin<double>(charts_[1], 1, q, v, a)};
  const Eigen::Vector3d p = spin_mass_ * Eigen::Vector3d(nodes[0].spin, nodes[1].spin, v[twist::bubble]);
  const Eigen::Vector3d p_rate = spin_mass_ * Eigen::Vector3d(nodes[0].rate, nodes[1].rate, a[twist::bubble]);
  Reduced<double> force = Reduced<double>::Zero();
  for (const int end : {0, 1}) nodes[end].add_force(end, p[end], p_rate[end], force);
  force[twist::bubble] = p_rate[2];
  return force;
}

TwistElement::Coordinates TwistElement::fixed_force(const TwistState& x) const {
  const auto q = twist::reduced_of<fixed_rows>(x.q), v = twist::reduced_of<fixed_rows>(x.v),
             a = twist::reduced_of<fixed_rows>(x.a);
  const Reduced<double> force = section_force(q, v) + spin_force(q, v, a);
  return twist::spread_out<fixed_rows>(force);
}

TwistElement::Matrix TwistElement::fixed_tangent(const TwistState& x, const TangentWeights& w) const {
  const auto q = twist::reduced_of<fixed_rows>(x.q), v = twist::reduced_of<fixed_rows>(x.v),
             a = twist::reduced_of<fixed_rows>(x.a);
  Eigen::Matrix<double, fixed_rows, fixed_rows> K = twist::spin_tangent(charts_, spin_mass_, q, v, a, w);
  const std::optional<twist::Viscosity> viscous = viscosity(q, v);
  if (w.stiffness != 0 || (viscous && w.damping != 0)) {
    const FixedFields at = fields<double>(q);
    const twist::Viscosity* const damps = viscous ? &*viscous : nullptr;
    K += twist::section_tangent(drawing_, charts_, *properties_->sections, at, section_moments_at(at, damps),
                                w, damps);
  }
  return twist::spread_out<fixed_rows>(K);
}

TwistEnergy TwistElement::fixed_energy(const TwistState& x) const {
  const auto q = twist::reduced_of<fixed_rows>(x.q), v = twist::reduced_of<fixed_rows>(x.v);
  const FixedFields at = fields<double>(q);
  TwistEnergy sum;
  std::array<SectionStrain<double>, points> rates{};
  if (const auto viscous = viscosity(q, v)) rates = rates_of(viscous->moving);
  for (int g = 0; g < points; ++g)
    sum.add({at.at[g].k1 - drawing_.points[g].k1, at.at[g].k2 - drawing_.points[g].k2, at.at[g].gamma},
            rates[g], drawing_.weights[g], *properties_);
  const Eigen::Vector3d spins(spin(x, 0), spin(x, 1), v[twist::bubble]);
  sum.kinetic = spins.dot(spin_mass_ * spins) / 2;
  return sum;
}

void TwistEnergy::add(const SectionStrain<double>& strain, const SectionStrain<double>& rate, double weight,
                      const BeamProperties& properties) {
  const SectionMoments<double> M = section_moments(*properties.sections, strain),
                               viscous = section_moments(*properties.sections, rate);
  bending += weight / 2 * (M.bending_1 * strain.bend_1 + M.bending_2 * strain.bend_2);
  torsion += weight / 2 * M.torque * strain.twist;
  dissipation +=
      properties.damping * weight *
      (viscous.bending_1 * rate.bend_1 + viscous.bending_2 * rate.bend_2 + viscous.torque * rate.twist);
}

}  // namespace nurbeam
