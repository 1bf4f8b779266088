#pragma once
#include <vector>

#include "fem/constraints/constraint_terms.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/stop_distance.h"

namespace nurbeam {

/// A body that rests against a hard stop, or two that rest against each other: d = 0, 1 row; coordinates of
/// their places. Its multiplier is the negative of the force between them.
template <int D>
class KeptContact {
 public:
  KeptContact(const MeshedBeams<D>& at, int stop)
      : dofs_(places_of_stop(at.mesh, at.structure.stops[stop])),
        number_(stop),
        stop_(&at.structure.stops[stop]) {}

  /// Of all stops that are closed.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    for (int i = 0; i < static_cast<int>(at.structure.stops.size()); ++i)
      if (at.mesh.plan.is_closed(i) && is_in_place(at.mesh, at.structure.stops[i])) add(KeptContact(at, i));
  }

  /// In the model.
  int closed_stop() const { return number_; }

  static constexpr int rows = 1;
  static constexpr bool linear = true;  ///< no Hessian
  const std::vector<int>& dofs() const { return dofs_; }

  ConstraintTerms<D> terms(const MeshedBeams<D>& at, const State& state,
                           const typename ConstraintTerms<D>::Multipliers*) const {
    ConstraintTerms<D> terms(rows, false);
    terms.value[0] = stop_distance(at.mesh, *stop_, state.q);
    terms.gradient(0, 0) = stop_->weight_of_joint();
    terms.gradient(0, 1) = stop_->weight_of_other();
    return terms;
  }

 private:
  std::vector<int> dofs_;
  int number_;
  const Stop* stop_;
};

}  // namespace nurbeam
