// The forces of an element with torsion whose ends are fixed.
#include "fem/element/twist_element.h"
#include "fem/element/twist_inertia.h"
#include "fem/element/twist_rows.h"
#include "fem/element/twist_stiffness.h"

namespace nurbeam {

template <class T>
auto TwistElement::fields(const Reduced<T>& x) const -> twist::Fields<T, points> {
  return twist::fields_of<T>(drawing_, charts_, turn_, x);
}

template <class T>
auto TwistElement::strain_rates(const Reduced<T>& q, const Reduced<T>& v) const
    -> std::array<SectionStrain<T>, points> {
  const auto moving = fields<Dual<1, T>>(twist::moving<T>(q, v));
  std::array<SectionStrain<T>, points> rates;
  for (int g = 0; g < points; ++g) {
    const twist::PointField<Dual<1, T>>& p = moving.at[g];
    rates[g] = {p.k1.d[0], p.k2.d[0], p.gamma.d[0]};
  }
  return rates;
}

template <class T>
TwistElement::Reduced<T> TwistElement::section_force(const Reduced<T>& q, const Reduced<T>& v) const {
  const twist::Fields<T, points> at = fields<T>(q);
  const double damping = properties_->damping;
  std::array<SectionStrain<T>, points> rates{};
  if (damping > 0) rates = strain_rates<T>(q, v);
  std::array<SectionMoments<T>, points> moments;
  for (int g = 0; g < points; ++g) {
    SectionStrain<T> strain{at.at[g].k1 - drawing_.points[g].k1, at.at[g].k2 - drawing_.points[g].k2,
                            at.at[g].gamma};
    if (damping > 0) {
      strain.bend_1 += damping * rates[g].bend_1;
      strain.bend_2 += damping * rates[g].bend_2;
      strain.twist += damping * rates[g].twist;
    }
    moments[g] = section_moments<T>(*properties_->sections, strain);
  }
  return twist::gradient_of<T>(drawing_, charts_, at, moments, T(0.0));
}

// With the spins of both ends and the bubble's rate w, p = M w.
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
  const Reduced<double> force = section_force<double>(q, v) + spin_force(q, v, a);
  return twist::spread_out<fixed_rows>(force);
}

TwistElement::Matrix TwistElement::fixed_tangent(const TwistState& x, const TangentWeights& w) const {
  using D = Dual<fixed_rows>;
  const auto q = twist::reduced_of<fixed_rows>(x.q), v = twist::reduced_of<fixed_rows>(x.v),
             a = twist::reduced_of<fixed_rows>(x.a);
  Eigen::Matrix<double, fixed_rows, fixed_rows> K = twist::spin_tangent(charts_, spin_mass_, q, v, a, w);
  if (properties_->damping > 0 && (w.stiffness != 0 || w.damping != 0))
    K += twist::derivatives<fixed_rows>(section_force<D>(twist::variables<fixed_rows, double>(q, w.stiffness),
                                                         twist::variables<fixed_rows, double>(v, w.damping)));
  else if (w.stiffness != 0)
    K += w.stiffness * twist::stiffness_of(drawing_, charts_, *properties_->sections, fields<double>(q));
  return twist::spread_out<fixed_rows>(K);
}

TwistEnergy TwistElement::fixed_energy(const TwistState& x) const {
  const auto q = twist::reduced_of<fixed_rows>(x.q), v = twist::reduced_of<fixed_rows>(x.v);
  const FixedFields at = fields<double>(q);
  TwistEnergy sum;
  std::array<SectionStrain<double>, points> rates{};
  if (properties_->damping > 0) rates = strain_rates<double>(q, v);
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
