// Sensitivities over linearised changes: transfers to another mesh, and starts of the integrator.
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/sensitivity/neighbouring_mesh.h"
#include "fem/sensitivity/sensitivities_parts.h"
#include "fem/sensitivity/transfer_tangent.h"
#include "fem/system/same_elements.h"
#include "nurbs/number_text.h"
#include "solver/algebra/side_by_side.h"
#include "solver/system/tangent_rows.h"
#include "solver/tangents/start_tangent.h"

namespace nurbeam {

// (m) Derivatives of G a + curvature by each parameter, at fixed a.
MotionTangents::Matrix Sensitivities::curvature_changes(const State& at) const {
  MotionTangents::Matrix changes(at.lambda.size(), tangents_.parameters());
  side_by_side(static_cast<int>(changes.cols()), [&](int k) {
    const auto of = [&](bool more) -> Eigen::VectorXd {
      const auto [system, state] = beside(static_cast<std::size_t>(k), at, more);
      return system.constraint_product(state, at.a) + system.constraint_curvature(state);
    };
    const double p = parameters_[static_cast<std::size_t>(k)].pair.step;
    changes.col(k) = (of(true) - of(false)) / (2 * p);
  });
  return changes;
}

// (n) Changes of the dynamics in a state by each parameter, by t and, in some rows, by these tangents of q.
// Neighbours that lag keep the run's own places.
MotionTangents::Matrix Sensitivities::residual_changes(const State& at, const MotionTangents::Matrix& q,
                                                       const std::vector<int>& rows) {
  Shifts shifts = shifts_at(at);
  for (std::size_t k = 0; k < shifts.size(); ++k)
    if (parameters_[k].lags) shifts[k].clear();
  MotionTangents::Matrix moved = q;
  for (std::size_t k = 0; k < shifts.size(); ++k)
    for (const auto& [place, by] : shifts[k]) moved(place, static_cast<Eigen::Index>(k)) -= by;
  Eigen::MatrixXd by_tangents;
  both([&] { by_tangents = TangentRows(*system_, at, {.stiffness = 1}, rows).product(moved); },
       [&] { differences_->find(*system_, at, tangents_.t, shifts, dynamics_, constraints_); });
  work_.residuals += differences_->work();
  MotionTangents::Matrix changes = dynamics_;
  changes(rows, Eigen::all) += by_tangents;
  return changes;
}

// Takes all neighbours over a transfer, on both meshes, a step away from the run; lagging ones on its own
// systems.
std::vector<TransferTangent::Neighbours> Sensitivities::go_over(const MeshedState& at,
                                                                const FollowedTransfer& transfer) {
  const MeshedState& before = transfer.before;
  std::vector<TransferTangent::Neighbours> neighbours(parameters_.size());
  side_by_side(static_cast<int>(parameters_.size()), [&](int k) {
    Parameter& parameter = parameters_[static_cast<std::size_t>(k)];
    const State tangent = tangents_.of(k);
    const double step = parameter.pair.step;
    TransferTangent::Neighbours& of = neighbours[static_cast<std::size_t>(k)];
    of = {{before.system, moved(before.state, tangent, step)},
          {before.system, moved(before.state, tangent, -step)},
          at.system,
          at.system,
          step};
    if (parameter.lags) return;
    of.more_before.system = std::exchange(parameter.more, nullptr);
    of.less_before.system = std::exchange(parameter.less, nullptr);
    of.more = parameter.more = transfer.replanned(of.more_before);
    of.less = parameter.less = transfer.replanned(of.less_before);
    if (!same_mesh(*at.system, *parameter.more)) not_alike("what happens at an event changes");
  });
  return neighbours;
}

void Sensitivities::transfers(const MeshedState& at, const FollowedTransfer& transfer,
                              const std::function<bool(MeshedState&)>& change) {
  const MeshedState& before = transfer.before;
  const std::optional<TransferPath> path =
      at.system->forces_depend_on_multipliers()
          ? std::nullopt
          : path_of(*before.system, before.state, *at.system, transfer.keeping);
  if (!path) return changes(at, change);
  carry();
  const std::vector<int> kept = kept_elements(*before.system, *at.system);
  const Eigen::RowVectorXd energies_before = differences_->energies(before.state);
  const std::vector<bool> lagging = let_lag(before, *at.system, kept);
  shift_lagging(before.state, -1);
  std::vector<TransferTangent::Neighbours> neighbours = go_over(at, transfer);
  const Eigen::RowVectorXd t = tangents_.t;
  tangents_ = MotionTangents::zero(at.state.q.size(), at.state.lambda.size(), t.size());
  tangents_.t = t;
  dynamics_ = tangents_.q;
  constraints_ = tangents_.lambda;
  go_on_from(at, ResidualDifferences(pairs(), at.state, *differences_, lagging, *at.system, kept));
  const TransferTangent tangent(
      before.system, at.system, *path, std::move(neighbours),
      {differences_->momenta(interpolated(*before.system, before.state, *at.system).v),
       [&](const State& behind) { return energies_of_lagging(behind, energies_before); }},
      [&](const State& state, const MotionTangents::Matrix& q, const std::vector<int>& rows) {
        return residual_changes(state, q, rows);
      });
  if (!tangent.carry(tangents_))
    throw std::runtime_error(
        "a derivative cannot follow the run through an event at t = " + text_of(at.state.t) + " s");
  shift_lagging(at.state, 1);
  tangents_.start_afresh();
}

void Sensitivities::starts(const MeshedState& at, const FollowedStart& of,
                           const std::function<bool(MeshedState&)>& change) {
  const StartTangent start = of.before ? StartTangent(*at.system, of.h, of.around, *of.before, at.state)
                                       : StartTangent(*at.system, of.h, at.state);
  if (!start.regular()) return changes(at, change);
  carry();
  MotionTangents::Matrix dynamics = MotionTangents::Matrix::Zero(dynamics_.rows(), dynamics_.cols());
  for (const StartTangent::Part& part : start.parts()) {
    take_off(find_residual_changes(part.state, tangents_.t), part.stiffness);
    dynamics += part.factor * dynamics_;
  }
  start.find(dynamics, curvature_changes(at.state), tangents_);
  tangents_.start_afresh();
  state_ = at.state;
}

}  // namespace nurbeam
