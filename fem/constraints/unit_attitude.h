#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/binding.h"

namespace nurbeam {

/// The attitude of a rigid body keeps its length, (p.p - 1)/2 = 0: 1 row.
class UnitAttitude {
 public:
  UnitAttitude(const MeshedBeams<3>& at, int body) {
    for (int k = 0; k < 4; ++k) dofs_.push_back(at.mesh.attitudes[body] + k);
  }

  /// Binds those of all rigid bodies.
  template <int D, class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    if constexpr (D == 3)
      for (std::size_t body = 0; body < binding.at.structure.bodies.size(); ++body)
        if (binding.at.mesh.attitudes[body] >= 0) add(UnitAttitude(binding.at, static_cast<int>(body)));
  }

  static constexpr ConstraintOffers offers{};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<3> terms(const MeshedBeams<3>&, const State& state,
                           const ConstraintTerms<3>::Multipliers* y) const {
    ConstraintTerms<3> terms(rows, y != nullptr);
    const Eigen::Vector4d p = state.q.segment<4>(dofs_[0]);
    terms.value[0] = (p.squaredNorm() - 1) / 2;
    terms.gradient.leftCols<4>() = p.transpose();
    if (y) terms.hessian.topLeftCorner<4, 4>().diagonal().setConstant((*y)[0]);
    return terms;
  }

 private:
  std::vector<int> dofs_;
};

}  // namespace nurbeam
