// The forces of an element whose ends are fixed: the same, with all that depends on the ends computed once.
#include "fem/element/beam_element.h"

namespace nurbeam {

namespace {

// Whether strains of the axis carry at the points: not where sections bend and the axial strain is assumed.
bool strains_at_points(const BeamProperties& beam) {
  return !beam.sections || beam.axial_strain == AxialStrain::pointwise;
}

}  // namespace

// The sums of a fixed element: I = (tr(e G e') - l)/2 - int eps_0 ds, with positions counted from the start,
// which G does not see: far from the origin they would leave their round-off.
template <int D>
AxialSums<D> BeamElement<D>::fixed_sums(const ElementVector<D>& q) const {
  ElementNodes<D> e = ElementLayout<D>::nodes(q);
  const Vector start = e.col(0);
  e.col(0).setZero();
  e.col(2) -= start;
  const ElementNodes<D> I_e = e * stretch_;
  AxialSums<D> sums(q);
  sums.y[0] = (e.cwiseProduct(I_e).sum() - length_) / 2;
  sums.y[3] = length_;
  sums.y.template head<3>() -= strain0_;
  sums.y_q.template block<1, 4 * D>(0, 0) = Eigen::Map<const Eigen::Matrix<double, 1, 4 * D>>(I_e.data());
  sums.y_q.row(3).setZero();
  return sums;
}

template <int D>
ElementVector<D> BeamElement<D>::fixed_force(const ElementState<D>& x, const Vector& load) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  ElementVector<D> f = ElementVector<D>::Zero();
  Eigen::Map<ElementNodes<D>> force(f.data());
  force = ElementLayout<D>::nodes(x.a) * mass_ - load * load_factor_.transpose();
  for (const FixedPoint& p : points_) {
    if (!strains_at_points(*properties_)) break;
    const Vector rs = e * p.S1, rss = e * p.S2;
    Eigen::Matrix<double, 2 * D, 1> stress =
        elastic_response<D, Derivatives::one>(*properties_, rs, rss, p.kappa0, p.eps0).gradient;
    if (properties_->damping > 0) {
      Eigen::Matrix<double, 2 * D, 1> rate;
      rate << e_rate * p.S1, e_rate * p.S2;
      stress += damping_response<D>(*properties_, rs, rss, rate).stress;
    }
    force += p.weight *
             (stress.template head<D>() * p.S1.transpose() + stress.template tail<D>() * p.S2.transpose());
  }
  if (!assumes_strain()) return f;
  AxialSums<D> axial = fixed_sums(x.q);
  axial.take_out(x.free_strain);
  const Eigen::Vector4d stress = AssumedAxialEnergy(properties_->axial_stiffness, axial.y).gradient;
  const auto I_e = axial.y_q.template block<1, 4 * D>(0, 0);
  f.template head<4 * D>() += stress[0] * I_e.transpose();
  for (const int end : {0, 1}) force.col(2 * end + 1) += stress[1 + end] * e.col(2 * end + 1);
  if (properties_->damping > 0) {
    const auto x_q = axial.y_q.template topRows<3>();
    f += x_q.transpose() * AssumedAxialDamping(axial_viscosity(), length_, x_q * x.v).stress;
  }
  return f;
}

template <int D>
ElementMatrix<D> BeamElement<D>::fixed_tangent(const ElementState<D>& x, const TangentWeights& w) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  for (const FixedPoint& p : points_) {
    if (!strains_at_points(*properties_)) break;
    const Vector rs = e * p.S1, rss = e * p.S2;
    Eigen::Matrix<double, 2 * D, 2 * D> H =
        w.stiffness * elastic_response<D>(*properties_, rs, rss, p.kappa0, p.eps0).hessian;
    if (properties_->damping > 0) {
      Eigen::Matrix<double, 2 * D, 1> rate;
      rate << e_rate * p.S1, e_rate * p.S2;
      const DampingResponse<D> d = damping_response<D>(*properties_, rs, rss, rate);
      H += w.stiffness * d.by_z + w.damping * d.by_rate;
    }
    for (int l = 0; l < 4; ++l) {
      const Eigen::Matrix<double, 2 * D, D> column =
          p.weight * (H.template leftCols<D>() * p.S1[l] + H.template rightCols<D>() * p.S2[l]);
      for (int k = 0; k < 4; ++k)
        K.template block<D, D>(k * D, l * D) +=
            p.S1[k] * column.template topRows<D>() + p.S2[k] * column.template bottomRows<D>();
    }
  }
  if (assumes_strain()) add_fixed_axial_tangent(x, w, K);
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      K.template block<D, D>(k * D, l * D).diagonal().array() += w.mass * mass_(k, l);
  return K;
}

// With x = (I, eps_A, eps_B) and its rate x' = x_q v: x_qq and d(x')/dq are G and ones.
template <int D>
void BeamElement<D>::add_fixed_axial_tangent(const ElementState<D>& x, const TangentWeights& w,
                                             ElementMatrix<D>& K) const {
  using Layout = ElementLayout<D>;
  AxialSums<D> axial = fixed_sums(x.q);
  axial.take_out(x.free_strain);
  const AssumedAxialEnergy U(properties_->axial_stiffness, axial.y);
  const auto x_q = axial.y_q.template topRows<3>();
  Eigen::Matrix3d by_x = w.stiffness * U.hessian.template topLeftCorner<3, 3>();
  Eigen::Vector3d stress = w.stiffness * U.gradient.template head<3>();
  if (properties_->damping > 0) {
    const AssumedAxialDamping damping(axial_viscosity(), length_, x_q * x.v);
    by_x += w.damping * damping.by_rate;
    stress += w.stiffness * damping.stress;
    Eigen::Matrix<double, 3, Layout::size> rate_q = Eigen::Matrix<double, 3, Layout::size>::Zero();
    const ElementNodes<D> I_e_rate = x.node_rates() * stretch_;
    rate_q.template block<1, 4 * D>(0, 0) =
        Eigen::Map<const Eigen::Matrix<double, 1, 4 * D>>(I_e_rate.data());
    for (const int end : {0, 1})
      rate_q.template block<1, D>(1 + end, Layout::slope(end)) =
          x.v.template segment<D>(Layout::slope(end)).transpose();
    K += w.stiffness * x_q.transpose() * damping.by_rate * rate_q;
  }
  K += x_q.transpose() * by_x * x_q;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      K.template block<D, D>(k * D, l * D).diagonal().array() += stress[0] * stretch_(k, l);
  for (const int end : {0, 1})
    K.diagonal().template segment<D>(Layout::slope(end)).array() += stress[1 + end];
}

template AxialSums<2> BeamElement<2>::fixed_sums(const ElementVector<2>&) const;
template AxialSums<3> BeamElement<3>::fixed_sums(const ElementVector<3>&) const;
template ElementVector<2> BeamElement<2>::fixed_force(const ElementState<2>&, const Vector&) const;
template ElementVector<3> BeamElement<3>::fixed_force(const ElementState<3>&, const Vector&) const;
template void BeamElement<2>::add_fixed_axial_tangent(const ElementState<2>&, const TangentWeights&,
                                                      ElementMatrix<2>&) const;
template void BeamElement<3>::add_fixed_axial_tangent(const ElementState<3>&, const TangentWeights&,
                                                      ElementMatrix<3>&) const;
template ElementMatrix<2> BeamElement<2>::fixed_tangent(const ElementState<2>&, const TangentWeights&) const;
template ElementMatrix<3> BeamElement<3>::fixed_tangent(const ElementState<3>&, const TangentWeights&) const;

}  // namespace nurbeam
