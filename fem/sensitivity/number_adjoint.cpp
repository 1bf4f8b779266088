#include "fem/sensitivity/number_adjoint.h"

namespace nurbeam {

template <int D>
NumberAdjoint<D>::NumberAdjoint(const Assembly<D>& system, const std::vector<int>& elements,
                                Eigen::Index sums)
    : system_(&system), sums_(sums), places_(system.elements().size()) {
  for (const int i : elements) {
    const MeshElement<D>& e = system.elements()[i];
    if (parts_.empty() || parts_.back().beam != e.span->beam || parts_.back().batch.is_full() ||
        !parts_.back().batch.has(e.element.properties()))
      parts_.push_back({e.span->beam, ElementBatch<D>(e.element.properties()),
                        std::vector<FixedLanes>(static_cast<std::size_t>(sums))});
    ElementBatch<D>& batch = parts_.back().batch;
    places_[i] = {parts_.size() - 1, batch.count()};
    batch.add(e.element, e.dofs, e.slope_offset, e.index);
  }
}

template <int D>
void NumberAdjoint<D>::add(const State& at, const Columns& multipliers) {
  Eigen::VectorXd of_one;
  for (Eigen::Index k = 0; k < multipliers.cols(); ++k) {
    of_one = multipliers.col(k);
    for (Part& part : parts_)
      part.batch.add_number_rates(at, system_->line_load(part.beam, at),
                                  system_->free_strain_of(part.beam, at), of_one.data(),
                                  part.rates[static_cast<std::size_t>(k)]);
  }
}

template <int D>
double NumberAdjoint<D>::difference(Eigen::Index sum, int element, const BeamElement<D>& more,
                                    const BeamElement<D>& less) const {
  const auto& [part, lane] = places_[element];
  const FixedLanes& rates = parts_[part].rates[static_cast<std::size_t>(sum)];
  return rates.product(lane, ElementBatch<D>::numbers(more), 0) -
         rates.product(lane, ElementBatch<D>::numbers(less), 0);
}

template class NumberAdjoint<2>;
template class NumberAdjoint<3>;

}  // namespace nurbeam
