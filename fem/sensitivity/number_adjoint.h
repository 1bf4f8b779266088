#pragma once
#include <vector>

#include "fem/element/element_batch.h"
#include "fem/sensitivity/residual_differences.h"
#include "fem/system/assembly.h"

namespace nurbeam {

/// Sums of the residuals of a motion, each times multipliers, and their derivatives by the numbers of
/// elements with fixed ends. If many parameters change nothing but such numbers, their effect on a quantity
/// takes one evaluation of each element.
template <int D>
class NumberAdjoint {
 public:
  using Columns = ResidualDifferences::Columns;

  /// Sums for these elements of a system, which must outlive this object; `sums`: number of columns of
  /// multipliers. Precondition: takes all of the elements.
  NumberAdjoint(const Assembly<D>& system, const std::vector<int>& elements, Eigen::Index sums);

  static bool takes(const MeshElement<D>& element) {
    return ElementBatch<D>::takes(element.element) &&
           ElementBatch<D>::has_number_rates(element.element.properties());
  }

  Eigen::Index sums() const { return sums_; }
  /// Adds the residual at a state times these multipliers (unknowns x sums).
  void add(const State& at, const Columns& multipliers);
  /// Difference of a sum, to first order, between the numbers of `more` and those of `less` in the place of
  /// an element.
  double difference(Eigen::Index sum, int element, const BeamElement<D>& more,
                    const BeamElement<D>& less) const;

 private:
  struct Part {
    int beam;
    ElementBatch<D> batch;
    std::vector<FixedLanes> rates;  // one per sum
  };
  struct Place {
    std::size_t part;
    int lane;
  };

  const Assembly<D>* system_;
  Eigen::Index sums_;
  std::vector<Part> parts_;
  std::vector<Place> places_;  // per element of the system
};

}  // namespace nurbeam
