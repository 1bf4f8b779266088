// Sensitivities over steps.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fem/sensitivity/sensitivities_parts.h"
#include "solver/algebra/side_by_side.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

// Number of steps whose matrices of a beam, with factors, fit into memory.
std::size_t steps_ahead_within_memory(const State& state) {
  constexpr double bytes = 64e6, of_an_unknown = 2000;
  const double size = of_an_unknown * static_cast<double>(state.q.size() + state.lambda.size());
  return static_cast<std::size_t>(std::clamp(bytes / size, 2.0, 8.0));
}

}  // namespace

void singular_step() {
  throw std::runtime_error("a derivative cannot follow a step whose matrix is singular");
}

// Derivatives of the length of a step by each parameter, from the tangents at its start. A step shortened by
// the system's step limit changes as the limit does. Another step is a part of the time that is left to the
// next time of the run. A step that lands on an event gets zeros here.
Eigen::RowVectorXd Sensitivities::changes_of_length(const FollowedStep& step) const {
  const double h = step.after.t - step.before.t, limit = system_->step_limit(step.before);
  if (step.beyond) return Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(parameters_.size()));
  if (step.asked <= limit) return -h / step.rest * times();
  Eigen::RowVectorXd changes(tangents_.parameters());
  State own = step.before;  // the step limit depends on places and their rates alone
  const Shifts shifts = shifts_at(step.before);
  for (Eigen::Index k = 0; k < changes.size(); ++k) {
    const Parameter& parameter = parameters_[static_cast<std::size_t>(k)];
    const double p = parameter.pair.step;
    const auto limit_of = [&](double part) {
      if (!parameter.lags) {
        const auto [system, state] = beside(static_cast<std::size_t>(k), step.before, part > 0);
        return system.step_limit(state);
      }
      for (const MeshRider& rider : system_->mesh().riders)
        if (const int place = rider.place; place >= 0) {
          own.q[place] = step.before.q[place] + part * tangents_.q(place, k);
          own.v[place] = step.before.v[place] + part * tangents_.v(place, k);
        }
      for (const auto& [place, by] : shifts[static_cast<std::size_t>(k)]) own.q[place] -= part * by;
      return system_->step_limit(own);
    };
    changes[k] = h / limit * (limit_of(p) - limit_of(-p)) / (2 * p);
  }
  return changes;
}

// Whether the state and the parameters decide the length of a step; false if it leads to the next time of the
// run.
bool Sensitivities::has_own_length(const FollowedStep& step) const {
  return step.beyond || step.asked > system_->step_limit(step.before);
}

// Derivatives of the residual by t alone, constraints below (n + m), by differences over a part of h.
Vector Sensitivities::rates_with_time(const State& at, double h) const {
  const double shift = 1e-4 * h;
  const Eigen::Index n = at.q.size(), m = at.lambda.size();
  State later = at, sooner = at;
  later.t += shift;
  sooner.t -= shift;
  Vector more(n + m), less(n + m);
  system_->residual(later, more.head(n), more.tail(m));
  system_->residual(sooner, less.head(n), less.tail(m));
  return (more - less) / (2 * shift);
}

Sensitivities::Longer Sensitivities::by_length(const FollowedStep& step) const {
  const double h = step.after.t - step.before.t, shift = 1e-4 * h;
  const Eigen::Index n = step.after.q.size(), m = step.after.lambda.size();
  const Vector rates = rates_with_time(step.after, h);
  const State longer =
      ahead_->steps.back()
          ->tangent
          .end(MotionTangents::zero(n, m, 1), Eigen::RowVectorXd::Ones(1), rates.head(n), rates.tail(m))
          .of(0);
  const double beyond = step.beyond(*system_, moved(step.after, longer, shift)) -
                        step.beyond(*system_, moved(step.after, longer, -shift));
  return {longer, beyond / (2 * shift)};
}

void Sensitivities::steps(const FollowedStep& step) {
  const double h = step.after.t - step.before.t;
  state_ = step.after;
  if (h == 0) return;  // start of a body at the end of its beam
  const bool own_length = has_own_length(step);
  if (by_adjoint_ && !own_length) return keep(step);
  if (own_length) carry();
  carry_over({step.before, step.history, step.after, step.repeated}, changes_of_length(step));
  if (step.beyond) {
    arrive();
    const Longer longer = by_length(step);
    for (Eigen::Index k = 0; k < tangents_.parameters(); ++k) {
      const double p = parameters_[static_cast<std::size_t>(k)].pair.step;
      const auto beyond = [&](bool more) {
        auto [system, state] = beside(static_cast<std::size_t>(k), step.after, more);
        const double part = more ? p : -p;
        state.a = step.after.a + part * tangents_.a.col(k);
        state.lambda = step.after.lambda + part * tangents_.lambda.col(k);
        return step.beyond(system, state);
      };
      const double late = -(beyond(true) - beyond(false)) / (2 * p) / longer.approach;
      tangents_.move(k, longer.tangent, late);
    }
  }
}

// Derivatives of the time at the end of the last step ahead.
Eigen::RowVectorXd Sensitivities::times() const {
  return ahead_ && ahead_->is_going ? ahead_->times : tangents_.t;
}

// A step with this system, to be linearised: the first one if tangents are over it, else a new one.
Sensitivities::Ahead::Step& Sensitivities::Ahead::next(const GeneralizedAlpha& settings,
                                                       const BeamSystem& system) {
  if (steps.empty() || !steps.front()->is_over)
    steps.emplace_back(new Step{.tangent = StepTangent(settings, system)});
  else
    std::rotate(steps.begin(), steps.begin() + 1, steps.end());
  return *steps.back();
}

// Linearises a step while tangents come to its start, and lets them go over it.
void Sensitivities::carry_over(const KeptSteps::Step& step, const Eigen::RowVectorXd& change) {
  const Eigen::RowVectorXd at_end = times() + change;
  if (!ahead_) ahead_.reset(new Ahead{.most = steps_ahead_within_memory(state_)});
  if (ahead_->steps.size() == ahead_->most) arrive();
  Ahead::Step& next = ahead_->next(settings_, *system_);
  Shifts shifts;
  both([&] { next.tangent.take(step.before, step.history, step.after, step.repeated); },
       [&] { shifts = find_residual_changes(step.after, at_end); });
  take_off(shifts, next.tangent.stiffness());
  ++work_.tangents;
  work_.solves += change.size();
  next.change = change;
  next.dynamics = dynamics_;
  next.constraints = constraints_;
  next.is_over = false;
  ahead_->times = at_end;
  ahead_->is_going = true;
  ahead_->going.add([this, &next] {
    if (!next.tangent.factorise()) singular_step();
    tangents_ = next.tangent.end(tangents_, next.change, next.dynamics, next.constraints);
    next.is_over = true;
  });
}

// Keeps the tangents at the end of the last step ahead in a record.
void Sensitivities::keep_tangents(Record& record) {
  const auto keep = [this, &record] { record.tangents = of_states(tangents_); };
  if (ahead_ && ahead_->is_going)
    ahead_->going.add(keep);
  else
    keep();
}

// Waits until tangents have reached the end of all steps ahead.
void Sensitivities::arrive() {
  if (!ahead_) return;
  ahead_->going.finish();
  ahead_->is_going = false;
}

}  // namespace nurbeam
