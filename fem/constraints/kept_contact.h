#pragma once
#include <vector>

#include "fem/constraints/constraint_offers.h"
#include "fem/mesh/binding.h"
#include "fem/mesh/stop_distance.h"

namespace nurbeam {

/// A kept contact of a body with a hard stop, or of two bodies: d = 0, 1 row; coordinates of StopDistance.
/// The multiplier is the negative of the contact force.
template <int D>
class KeptContact {
 public:
  KeptContact(const MeshedBeams<D>& at, int stop)
      : number_(stop), distance_(at.structure, at.mesh, at.structure.stops[stop]) {}

  /// Binds the contacts of all stops that are closed.
  template <class Add>
  static void bind(const Binding<D>& binding, Add&& add) {
    const MeshedBeams<D>& at = binding.at;
    for (int i = 0; i < static_cast<int>(at.structure.stops.size()); ++i)
      if (at.mesh.plan.is_closed(i) && is_in_place(at.mesh, at.structure.stops[i])) add(KeptContact(at, i));
  }

  /// Number of the stop in the model.
  int closed_stop() const { return number_; }

  static constexpr ConstraintOffers offers{.on_body = true, .stop = true};
  static constexpr int rows = 1;
  const std::vector<int>& dofs() const { return distance_.dofs(); }
  /// The force on a body [N].
  Eigen::Matrix<double, D, 1> on_body(int body, const State& state,
                                      const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return distance_.on_body(body, state.q, -y[0]).template head<D>();
  }

  ConstraintTerms<D> terms(const MeshedBeams<D>&, const State& state,
                           const typename ConstraintTerms<D>::Multipliers* y) const {
    ConstraintTerms<D> terms(rows, y != nullptr);
    const auto size = static_cast<Eigen::Index>(dofs().size());
    terms.value[0] = distance_.value(state.q);
    terms.gradient.row(0).head(size) = distance_.gradient(state.q).transpose();
    if (y) terms.hessian.topLeftCorner(size, size) = (*y)[0] * distance_.hessian(state.q);
    return terms;
  }

 private:
  int number_;
  StopDistance distance_;
};

}  // namespace nurbeam
