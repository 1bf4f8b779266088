// The forces of an element whose ends are fixed: the same, with all that depends on the ends computed once.
#include "fem/element/beam_element.h"

namespace nurbeam {

namespace {

// Whether strains of the axis carry at the points: not where sections bend and the axial strain is assumed.
bool strains_at_points(const BeamProperties& beam) {
  return !beam.sections || beam.axial_strain == AxialStrain::pointwise;
}

// K += a'H b, without the buffers that Eigen would take for matrices of this size.
template <class Rows, class Other, int n>
void add_product(const Rows& a, const Eigen::Matrix3d& H, const Other& b, Eigen::Matrix<double, n, n>& K) {
  const Eigen::Matrix<double, 3, n> stress = H.lazyProduct(b);
  K += a.transpose().lazyProduct(stress);
}

// H of z = (r_s, r_ss) at a point, in the coordinates of the nodes.
template <int D>
void add_point_tangent(const Eigen::Matrix<double, 2 * D, 2 * D>& H, const Eigen::Vector4d& S1,
                       const Eigen::Vector4d& S2, ElementMatrix<D>& K) {
  for (int l = 0; l < 4; ++l) {
    const Eigen::Matrix<double, 2 * D, D> column =
        H.template leftCols<D>() * S1[l] + H.template rightCols<D>() * S2[l];
    for (int k = 0; k < 4; ++k)
      K.template block<D, D>(k * D, l * D) +=
          S1[k] * column.template topRows<D>() + S2[k] * column.template bottomRows<D>();
  }
}

}  // namespace

// I = (tr(e G e') - l)/2 - int eps_0 ds and its gradient e G in the nodes, with positions counted from the
// start, which G does not see: far from the origin they would leave their round-off; and the strains at the
// ends.
template <int D>
typename BeamElement<D>::FixedStretch BeamElement<D>::fixed_stretch(const FixedSums& of,
                                                                    const ElementState<D>& x) {
  ElementNodes<D> e = x.nodes();
  const Vector start = e.col(0);
  e.col(0).setZero();
  e.col(2) -= start;
  FixedStretch sums{{}, e * of.stretch};
  sums.y << (e.cwiseProduct(sums.I_e).sum() - of.length) / 2, (e.col(1).squaredNorm() - 1) / 2,
      (e.col(3).squaredNorm() - 1) / 2, of.length;
  sums.y.template head<3>() -= of.strain0;
  sums.y[0] -= x.free_strain * of.length;
  sums.y.template segment<2>(1).array() -= x.free_strain;
  return sums;
}

// The same as sums of any element.
template <int D>
AxialSums<D> BeamElement<D>::fixed_sums(const FixedSums& of, const ElementState<D>& x) {
  const FixedStretch stretch = fixed_stretch(of, x);
  AxialSums<D> sums(x.q);
  sums.y = stretch.y;
  sums.y_q.template block<1, 4 * D>(0, 0) =
      Eigen::Map<const Eigen::Matrix<double, 1, 4 * D>>(stretch.I_e.data());
  sums.y_q.row(3).setZero();
  return sums;
}

// The elastic and damping stresses of the axis at the Gauss points, dU/dr_s and dU/dr_ss, on the shape
// functions.
template <int D>
void BeamElement<D>::add_point_forces(const ElementState<D>& x, ElementNodes<D>& force) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  const double EA = properties_->pointwise_axial_stiffness(), EI = properties_->axis_bending_stiffness();
  const double c = properties_->damping;
  for_each_pack([&](const PointPack& p) {
    const VectorLanes<D> rs = combination<D>(e, p.S1), rss = combination<D>(e, p.S2);
    const CurvatureLanes<D> K(rs, rss, properties_->curvature);
    Lanes moment = EI * (K.value - p.kappa0), stretching = EA * ((dot<D>(rs, rs) - 1) / 2 - p.eps0);
    if (c > 0) {
      const VectorLanes<D> rs_rate = combination<D>(e_rate, p.S1);
      moment += c * EI * K.rate(rs_rate, combination<D>(e_rate, p.S2));
      stretching += c * EA * dot<D>(rs, rs_rate);
    }
    moment *= p.weight;
    stretching *= p.weight;
    for (int d = 0; d < D; ++d) {
      const Lanes on_rs = moment * K.by_rs[d] + stretching * rs[d], on_rss = moment * K.by_rss[d];
      for (int k = 0; k < 4; ++k) force(d, k) += (on_rs * p.S1[k] + on_rss * p.S2[k]).sum();
    }
  });
}

template <int D>
ElementVector<D> BeamElement<D>::fixed_force(const FixedSums& sums, const ElementState<D>& x,
                                             const Vector& load) const {
  const ElementNodes<D> e = x.nodes();
  ElementVector<D> f = ElementVector<D>::Zero();
  ElementNodes<D> force = ElementLayout<D>::nodes(x.a) * sums.mass - load * sums.load_factor.transpose();
  if (properties_->mass_damping > 0) force += properties_->mass_damping * x.node_rates() * sums.mass;
  if (const double eta = taut_viscosity(x).value; eta != 0) force += eta * x.node_rates() * sums.stretch;
  if (strains_at_points(*properties_)) add_point_forces(x, force);
  f.template head<4 * D>() = force.reshaped();
  if (!assumes_strain()) return f;
  if (properties_->damping > 0) {
    const AxialSums<D> axial = fixed_sums(sums, x);
    const auto x_q = axial.y_q.template topRows<3>();
    f += x_q.transpose() *
         (AssumedAxialEnergy(properties_->axial_stiffness, axial.y).gradient.template head<3>() +
          AssumedAxialDamping(axial_viscosity(), sums.length, x_q * x.v).stress);
    return f;
  }
  const FixedStretch axial = fixed_stretch(sums, x);
  const Eigen::Vector4d stress = AssumedAxialEnergy(properties_->axial_stiffness, axial.y).gradient;
  f.template head<4 * D>() += stress[0] * axial.I_e.reshaped();
  for (const int end : {0, 1})
    f.template segment<D>(ElementLayout<D>::slope(end)) += stress[1 + end] * e.col(2 * end + 1);
  return f;
}

template <int D>
ElementMatrix<D> BeamElement<D>::fixed_tangent(const FixedSums& sums, const ElementState<D>& x,
                                               const TangentWeights& w) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  const bool mass_alone = w.stiffness == 0 && (w.damping == 0 || !properties_->is_damped());
  const auto add_points = [&](const PointPack& pack) {
    for (int g = 0; g < PointPack::points; ++g) {
      const auto [S1, S2] = pack.derivatives(g);
      const Vector rs = e * S1, rss = e * S2;
      Eigen::Matrix<double, 2 * D, 2 * D> H =
          w.stiffness * elastic_response<D>(*properties_, rs, rss, pack.kappa0[g], pack.eps0[g]).hessian;
      if (properties_->damping > 0) {
        Eigen::Matrix<double, 2 * D, 1> rate;
        rate << e_rate * S1, e_rate * S2;
        const DampingResponse<D> d = damping_response<D>(*properties_, rs, rss, rate);
        H += w.stiffness * d.by_z + w.damping * d.by_rate;
      }
      add_point_tangent<D>(pack.weight[g] * H, S1, S2, K);
    }
  };
  if (!mass_alone && strains_at_points(*properties_)) for_each_pack(add_points);
  if (assumes_strain() && !mass_alone) add_fixed_axial_tangent(sums, x, w, K);
  const TautViscosity<D> eta = mass_alone ? TautViscosity<D>{} : taut_viscosity(x);
  const Eigen::Matrix4d nodal =
      (w.mass + w.damping * properties_->mass_damping) * sums.mass + w.damping * eta.value * sums.stretch;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l) K.template block<D, D>(k * D, l * D).diagonal().array() += nodal(k, l);
  if (eta.value != 0) {
    const ElementNodes<D> by_eta = w.stiffness * e_rate * sums.stretch;
    K.template topRows<4 * D>() += by_eta.reshaped() * eta.gradient.transpose();
  }
  return K;
}

// With x = (I, eps_A, eps_B) and its rate x' = x_q v: x_qq and d(x')/dq are G and ones.
template <int D>
void BeamElement<D>::add_fixed_axial_tangent(const FixedSums& sums, const ElementState<D>& x,
                                             const TangentWeights& w, ElementMatrix<D>& K) const {
  using Layout = ElementLayout<D>;
  const AxialSums<D> axial = fixed_sums(sums, x);
  const AssumedAxialEnergy U(properties_->axial_stiffness, axial.y);
  const auto x_q = axial.y_q.template topRows<3>();
  Eigen::Matrix3d by_x = w.stiffness * U.hessian().template topLeftCorner<3, 3>();
  Eigen::Vector3d stress = w.stiffness * U.gradient.template head<3>();
  if (properties_->damping > 0) {
    const AssumedAxialDamping damping(axial_viscosity(), sums.length, x_q * x.v);
    by_x += w.damping * damping.by_rate;
    stress += w.stiffness * damping.stress;
    Eigen::Matrix<double, 3, Layout::size> rate_q = Eigen::Matrix<double, 3, Layout::size>::Zero();
    const ElementNodes<D> I_e_rate = x.node_rates() * sums.stretch;
    rate_q.template block<1, 4 * D>(0, 0) =
        Eigen::Map<const Eigen::Matrix<double, 1, 4 * D>>(I_e_rate.data());
    for (const int end : {0, 1})
      rate_q.template block<1, D>(1 + end, Layout::slope(end)) =
          x.v.template segment<D>(Layout::slope(end)).transpose();
    add_product(x_q, w.stiffness * damping.by_rate, rate_q, K);
  }
  add_product(x_q, by_x, x_q, K);
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      K.template block<D, D>(k * D, l * D).diagonal().array() += stress[0] * sums.stretch(k, l);
  for (const int end : {0, 1})
    K.diagonal().template segment<D>(Layout::slope(end)).array() += stress[1 + end];
}

template <int D>
void BeamElement<D>::add_point_energies(const ElementState<D>& x, ElementEnergy& sum) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  const double EA = properties_->pointwise_axial_stiffness(), EI = properties_->axis_bending_stiffness();
  for_each_pack([&](const PointPack& p) {
    const VectorLanes<D> rs = combination<D>(e, p.S1), rss = combination<D>(e, p.S2);
    const CurvatureLanes<D> K(rs, rss, properties_->curvature);
    const Lanes stretch = (dot<D>(rs, rs) - 1) / 2 - p.eps0;
    Lanes bend = (K.value - p.kappa0).square();
    if constexpr (D == 3)
      bend -= (p.kappa0 == 0).template cast<double>() * (curvature_rounding * curvature_rounding);
    sum.axial += EA / 2 * (p.weight * stretch.square()).sum();
    sum.bending += EI / 2 * (p.weight * bend).sum();
    if (!(properties_->damping > 0)) return;
    const VectorLanes<D> rs_rate = combination<D>(e_rate, p.S1), rss_rate = combination<D>(e_rate, p.S2);
    sum.dissipation +=
        properties_->damping *
        (p.weight * (EI * K.rate(rs_rate, rss_rate).square() + EA * dot<D>(rs, rs_rate).square())).sum();
  });
}

template <int D>
ElementEnergy BeamElement<D>::fixed_energy(const FixedSums& sums, const ElementState<D>& x,
                                           const Vector& load) const {
  ElementEnergy sum;
  const ElementNodes<D> e_rate = x.node_rates();
  sum.kinetic = e_rate.cwiseProduct(e_rate * sums.mass).sum() / 2;
  sum.dissipation = 2 * properties_->mass_damping * sum.kinetic;
  if (const double eta = taut_viscosity(x).value; eta != 0)
    sum.dissipation += eta * e_rate.cwiseProduct(e_rate * sums.stretch).sum();
  sum.external = -load.dot(x.nodes() * sums.load_factor);
  if (strains_at_points(*properties_)) add_point_energies(x, sum);
  if (!assumes_strain()) return sum;
  const AxialSums<D> axial = fixed_sums(sums, x);
  sum.axial = AssumedAxialEnergy(properties_->axial_stiffness, axial.y).value;
  if (!(properties_->damping > 0)) return sum;
  const Eigen::Vector3d rate = axial.y_q.template topRows<3>() * x.v;
  sum.dissipation += AssumedAxialDamping(axial_viscosity(), sums.length, rate).stress.dot(rate);
  return sum;
}

template AxialSums<2> BeamElement<2>::fixed_sums(const FixedSums&, const ElementState<2>&);
template AxialSums<3> BeamElement<3>::fixed_sums(const FixedSums&, const ElementState<3>&);
template BeamElement<2>::FixedStretch BeamElement<2>::fixed_stretch(const FixedSums&, const ElementState<2>&);
template BeamElement<3>::FixedStretch BeamElement<3>::fixed_stretch(const FixedSums&, const ElementState<3>&);
template void BeamElement<2>::add_point_forces(const ElementState<2>&, ElementNodes<2>&) const;
template void BeamElement<3>::add_point_forces(const ElementState<3>&, ElementNodes<3>&) const;
template void BeamElement<2>::add_point_energies(const ElementState<2>&, ElementEnergy&) const;
template void BeamElement<3>::add_point_energies(const ElementState<3>&, ElementEnergy&) const;
template ElementEnergy BeamElement<2>::fixed_energy(const FixedSums&, const ElementState<2>&,
                                                    const Vector&) const;
template ElementEnergy BeamElement<3>::fixed_energy(const FixedSums&, const ElementState<3>&,
                                                    const Vector&) const;
template ElementVector<2> BeamElement<2>::fixed_force(const FixedSums&, const ElementState<2>&,
                                                      const Vector&) const;
template ElementVector<3> BeamElement<3>::fixed_force(const FixedSums&, const ElementState<3>&,
                                                      const Vector&) const;
template void BeamElement<2>::add_fixed_axial_tangent(const FixedSums&, const ElementState<2>&,
                                                      const TangentWeights&, ElementMatrix<2>&) const;
template void BeamElement<3>::add_fixed_axial_tangent(const FixedSums&, const ElementState<3>&,
                                                      const TangentWeights&, ElementMatrix<3>&) const;
template ElementMatrix<2> BeamElement<2>::fixed_tangent(const FixedSums&, const ElementState<2>&,
                                                        const TangentWeights&) const;
template ElementMatrix<3> BeamElement<3>::fixed_tangent(const FixedSums&, const ElementState<3>&,
                                                        const TangentWeights&) const;

}  // namespace nurbeam
