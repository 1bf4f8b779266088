// Sensitivities over changes that are linearised: transfers to another mesh, and starts of the integrator.
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "fem/sensitivity/neighbouring_mesh.h"
#include "fem/sensitivity/sensitivities_parts.h"
#include "fem/sensitivity/transfer_tangent.h"
#include "nurbs/number_text.h"
#include "solver/side_by_side.h"
#include "solver/start_tangent.h"

namespace nurbeam {

// (m) How G a + curvature changes by each parameter, with a as it is.
MotionTangents::Matrix Sensitivities::curvature_changes(const State& at) const {
  MotionTangents::Matrix changes(at.lambda.size(), tangents_.parameters());
  const auto of = [&](const BeamSystem& system, Eigen::Index k, double part) -> Eigen::VectorXd {
    State state = at;
    state.t += part * tangents_.t[k];
    state.q += part * tangents_.q.col(k);
    state.v += part * tangents_.v.col(k);
    return system.constraint_product(state, at.a) + system.constraint_curvature(state);
  };
  side_by_side(static_cast<int>(changes.cols()), [&](int k) {
    const Parameter& parameter = parameters_[static_cast<std::size_t>(k)];
    const double p = parameter.pair.step;
    changes.col(k) = (of(*parameter.more, k, p) - of(*parameter.less, k, -p)) / (2 * p);
  });
  return changes;
}

// (n) How the dynamics at a state change by each parameter, by t and by these tangents of q.
MotionTangents::Matrix Sensitivities::residual_changes(const State& at, const MotionTangents::Matrix& q) {
  const Eigen::Index n = q.rows();
  Eigen::SparseMatrix<double> stiffness = system_->tangent_pattern().matrix();
  Shifts shifts;
  both([&] { system_->tangent(at, {.stiffness = 1}, stiffness); },
       [&] { shifts = find_residual_changes(at, tangents_.t); });
  MotionTangents::Matrix moved = MotionTangents::Matrix::Zero(stiffness.cols(), q.cols());
  moved.topRows(n) = q;
  for (std::size_t k = 0; k < shifts.size(); ++k)
    for (const auto& [place, by] : shifts[k]) moved(place, static_cast<Eigen::Index>(k)) -= by;
  return dynamics_ + (stiffness * moved).topRows(n);
}

void Sensitivities::transfers(const MeshedState& at, const FollowedTransfer& transfer,
                              const std::function<bool(MeshedState&)>& change) {
  const bool is_plain = at.system->mesh().plan.section_charts.empty() &&  // without torsion
                        !at.system->forces_depend_on_multipliers();
  const std::optional<TransferPath> path =
      is_plain ? path_of(*transfer.before.system, transfer.before.state, *at.system, transfer.moves)
               : std::nullopt;
  if (!path) return changes(at, change);
  carry();
  std::vector<TransferTangent::Neighbours> neighbours(parameters_.size());
  side_by_side(static_cast<int>(parameters_.size()), [&](int k) {
    Parameter& parameter = parameters_[static_cast<std::size_t>(k)];
    const State tangent = tangents_.of(k);
    const auto go_over = [&](std::shared_ptr<const BeamSystem>& system, double by) {
      MeshedState before{std::move(system), moved(transfer.before.state, tangent, by)};
      system = transfer.replanned(before);
      return before;
    };
    const double step = parameter.pair.step;
    MeshedState more = go_over(parameter.more, step), less = go_over(parameter.less, -step);
    if (!same_mesh(*at.system, *parameter.more)) not_alike("what happens at an event changes");
    neighbours[static_cast<std::size_t>(k)] = {std::move(more), std::move(less), parameter.more,
                                               parameter.less, step};
  });
  const Eigen::RowVectorXd t = tangents_.t;
  tangents_ = MotionTangents::zero(at.state.q.size(), at.state.lambda.size(), t.size());
  tangents_.t = t;
  dynamics_ = tangents_.q;
  constraints_ = tangents_.lambda;
  go_on_from(at);
  const TransferTangent tangent(
      at.system, *path, std::move(neighbours),
      [&](const State& state, const MotionTangents::Matrix& q) { return residual_changes(state, q); });
  if (!tangent.carry(tangents_))
    throw std::runtime_error(
        "a derivative cannot follow the run through an event at t = " + text_of(at.state.t) + " s");
  tangents_.start_afresh();
}

void Sensitivities::starts(const MeshedState& at, double h, const std::vector<int>& around,
                           const std::function<bool(MeshedState&)>& change) {
  const StartTangent start(*at.system, h, around, at.state);
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
