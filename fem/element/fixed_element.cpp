// An element with fixed ends, by itself.
#include <algorithm>
#include <cmath>

#include "fem/element/beam_element.h"
#include "fem/element/fixed_kernel.h"

namespace nurbeam {

namespace {

template <int D>
using Kernel = FixedKernel<D, Lanes, double>;
template <int D>
using Nodes = typename Kernel<D>::Nodes;

template <int D>
Nodes<D> nodes_of(const ElementVector<D>& q) {
  Nodes<D> nodes;
  for (int k = 0; k < 4 * D; ++k) nodes[k / D][k % D] = q[k];
  return nodes;
}

template <int D>
typename Kernel<D>::Load components_of(const Eigen::Matrix<double, D, 1>& load) {
  return components<D>(load);
}

}  // namespace

template <int D>
template <class Use>
auto BeamElement<D>::with_kernel(double free_strain, std::optional<bool> taut, double stabilisation,
                                 const Use& use) const {
  const double side = taut.value_or(false);
  const auto call = [&](const FixedSums& sums, const PointPack* packs, std::size_t count) {
    return use(Kernel<D>{.beam = *properties_,
                         .sums = sums,
                         .points = packs,
                         .count = static_cast<int>(count),
                         .free_strain = free_strain,
                         .side = taut ? &side : nullptr,
                         .own_slopes = own_slopes().count(),
                         .stabilisation = stabilisation});
  };
  if (own_) return call(own_->sums, own_->packs.data(), own_->packs.size());
  const FixedSums sums = beside_->sums(lane_);
  const PointPack pack = beside_->pack(lane_);
  return call(sums, &pack, 1);
}

template <int D>
ElementVector<D> BeamElement<D>::fixed_force(const ElementState<D>& x, const Vector& load) const {
  return with_kernel(
      x.free_strain, x.taut, x.stabilisation,
      [&](const Kernel<D>& kernel) {
        const Nodes<D> force =
            kernel.force(nodes_of<D>(x.q), nodes_of<D>(x.v), nodes_of<D>(x.a), components_of<D>(load));
        ElementVector<D> f = ElementVector<D>::Zero();
        for (int k = 0; k < 4 * D; ++k) f[k] = force[k / D][k % D];
        return f;
      });
}

template <int D>
ElementEnergy BeamElement<D>::fixed_energy(const ElementState<D>& x, const Vector& load) const {
  return with_kernel(
      x.free_strain, x.taut, x.stabilisation,
      [&](const Kernel<D>& kernel) {
        const auto sum = kernel.energies(nodes_of<D>(x.q), nodes_of<D>(x.v), components_of<D>(load));
        return ElementEnergy{sum.kinetic, sum.axial, sum.bending, sum.external, sum.dissipation};
      });
}

template <int D>
ElementMatrix<D> BeamElement<D>::fixed_tangent(const ElementState<D>& x, const TangentWeights& w) const {
  return with_kernel(
      x.free_strain, x.taut, x.stabilisation,
      [&](const Kernel<D>& kernel) {
        typename Kernel<D>::Tangents columns;
        kernel.tangents(nodes_of<D>(x.q), nodes_of<D>(x.v), w, columns);
        ElementMatrix<D> K = ElementMatrix<D>::Zero();
        for (int j = 0; j < 4 * D; ++j)
          for (int i = 0; i < 4 * D; ++i) K(i, j) = columns[j][i];
        return K;
      });
}

template <int D>
AxialSums<D> BeamElement<D>::fixed_axial_sums(const ElementVector<D>& q) const {
  return with_kernel(
      0, {}, 0,
      [&](const Kernel<D>& kernel) {
        const Nodes<D> e = nodes_of<D>(q);
        const auto [I_e, I] = kernel.stretch(e);
        AxialSums<D> sums(q);
        sums.y << I, kernel.end_strain(e, 1), kernel.end_strain(e, 3), kernel.sums.length;
        for (int k = 0; k < 4 * D; ++k) sums.y_q(0, k) = I_e[k / D][k % D];
        sums.y_q.row(3).setZero();
        return sums;
      });
}

template <int D>
double BeamElement<D>::fixed_length(const ElementVector<D>& q) const {
  return with_kernel(
      0, {}, 0, [&](const Kernel<D>& kernel) { return kernel.length(nodes_of<D>(q)); });
}

template <int D>
double BeamElement<D>::fixed_axial_mismatch(const ElementVector<D>& q, const AssumedStrain& assumed) const {
  return with_kernel(
      0, {}, 0,
      [&](const Kernel<D>& kernel) {
        double largest = 0;
        const PointPack& pack = kernel.points[0];
        const Lanes strain = green_strain<D>(Kernel<D>::combination(nodes_of<D>(q), pack.S1)) - pack.eps0;
        for (int g = 0; g < GaussRule::size; ++g)
          largest = std::max(largest, std::abs(strain[g] - assumed.at(GaussRule::points[g])));
        return largest;
      });
}

template ElementVector<2> BeamElement<2>::fixed_force(const ElementState<2>&, const Vector&) const;
template ElementVector<3> BeamElement<3>::fixed_force(const ElementState<3>&, const Vector&) const;
template ElementEnergy BeamElement<2>::fixed_energy(const ElementState<2>&, const Vector&) const;
template ElementEnergy BeamElement<3>::fixed_energy(const ElementState<3>&, const Vector&) const;
template ElementMatrix<2> BeamElement<2>::fixed_tangent(const ElementState<2>&, const TangentWeights&) const;
template ElementMatrix<3> BeamElement<3>::fixed_tangent(const ElementState<3>&, const TangentWeights&) const;
template AxialSums<2> BeamElement<2>::fixed_axial_sums(const ElementVector<2>&) const;
template AxialSums<3> BeamElement<3>::fixed_axial_sums(const ElementVector<3>&) const;
template double BeamElement<2>::fixed_length(const ElementVector<2>&) const;
template double BeamElement<3>::fixed_length(const ElementVector<3>&) const;
template double BeamElement<2>::fixed_axial_mismatch(const ElementVector<2>&, const AssumedStrain&) const;
template double BeamElement<3>::fixed_axial_mismatch(const ElementVector<3>&, const AssumedStrain&) const;

}  // namespace nurbeam
