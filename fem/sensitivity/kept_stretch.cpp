#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fem/sensitivity/sensitivities_parts.h"
#include "fem/system/observables.h"
#include "solver/algebra/side_by_side.h"
#include "solver/tangents/rates_by_unknowns.h"
#include "solver/tangents/step_adjoint.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

// Number of whole steps that fit into memory: six vectors and the four that place a matrix.
std::size_t steps_within_memory(const State& state) {
  constexpr double bytes = 256e6;
  return static_cast<std::size_t>(
      bytes / (10.0 * sizeof(double) * static_cast<double>(1 + state.q.size() + state.lambda.size())));
}

// The unknowns of a state: t, q, v, a and lambda one below the other.
Vector unknowns_of(const State& state) {
  Vector x(1 + 3 * state.q.size() + state.lambda.size());
  x << state.t, state.q, state.v, state.a, state.lambda;
  return x;
}

void set_unknowns(const Vector& x, State& state) {
  const Eigen::Index n = state.q.size();
  state.t = x[0];
  state.q = x.segment(1, n);
  state.v = x.segment(1 + n, n);
  state.a = x.segment(1 + 2 * n, n);
  state.lambda = x.tail(state.lambda.size());
}

// Step of a finite difference for each unknown, in a motion with steps of length h. Speeds are not linear in
// velocities, some of which may be much less than others.
Vector steps_of_unknowns(const State& state, const Vector& scale, double h) {
  constexpr double part = 1e-5, of_velocities = 1e-6;
  const auto greatest = [](const auto& values) {
    const double found = values.size() > 0 ? values.template lpNorm<Eigen::Infinity>() : 0;
    return found > 0 ? found : 1;
  };
  State steps = state;
  steps.t = part * h;
  steps.q = part * scale;
  steps.v = of_velocities * greatest(state.v.cwiseQuotient(scale)) * scale;
  steps.a = part * greatest(state.a.cwiseQuotient(scale)) * scale;
  steps.lambda.setConstant(part * greatest(state.lambda));
  return unknowns_of(steps);
}

void add_unknowns(const Eigen::MatrixXd& by, MotionTangents& to) {
  const Eigen::Index n = to.q.rows();
  to.t += by.row(0);
  to.q += by.middleRows(1, n);
  to.v += by.middleRows(1 + n, n);
  to.a += by.middleRows(1 + 2 * n, n);
  to.lambda += by.bottomRows(to.lambda.rows());
}

// With more adjoints than this, numbers of elements take longer than neighbours do.
constexpr Eigen::Index few_adjoints = 2;

// (quantities x parameters) The product of adjoints and tangents.
Eigen::MatrixXd product(const MotionTangents& adjoints, const MotionTangents& tangents) {
  Eigen::MatrixXd sum = adjoints.t.transpose() * tangents.t;
  sum += adjoints.last_step.transpose() * tangents.last_step;
  sum += adjoints.q.transpose() * tangents.q;
  sum += adjoints.v.transpose() * tangents.v;
  sum += adjoints.a.transpose() * tangents.a;
  sum += adjoints.lambda.transpose() * tangents.lambda;
  sum += adjoints.algorithmic_acceleration.transpose() * tangents.algorithmic_acceleration;
  sum += adjoints.jerk.transpose() * tangents.jerk;
  return sum;
}

}  // namespace

void Sensitivities::keep(const FollowedStep& step) {
  if (!stretch_)
    stretch_ = std::make_unique<Stretch>(Stretch{
        .start = step.before.t, .steps = KeptSteps(settings_, *system_, steps_within_memory(step.after))});
  stretch_->steps.add({step.before, step.history, step.after, step.repeated});
  stretch_->by_time.push_back(-(step.after.t - step.before.t) / step.rest);
}

// Takes tangents over all steps, kept ones too, and to the records on the way.
void Sensitivities::carry() {
  if (const std::unique_ptr<const Stretch> stretch = std::move(stretch_)) {
    auto record = stretch->records.begin();
    stretch->steps.forward([&](std::size_t i, const KeptSteps::Step& step) {
      carry_over(step, stretch->by_time[i] * times());
      for (; record != stretch->records.end() && records_[*record].position == i + 1; ++record)
        keep_tangents(records_[*record]);
    });
  }
  arrive();
}

void Sensitivities::ask(Asked asked) {
  asked_ = std::move(asked);
  arrive();
  for (const std::size_t record : asked_.records) hold_extremes(records_[record]);
  if (!stretch_) return;
  const bool are_shared_by_many =
      std::any_of(asked_.records.begin(), asked_.records.end(), [this](std::size_t record) {
        return records_[record].extremes && records_[record].extremes->are_shared_by_many();
      });
  if (are_shared_by_many) return carry();
  // Costs in units of one parameter over one step: factors; a quantity back over a step, without and with
  // factors of its own; the derivatives of quantities by one state.
  constexpr double of_factors = 20, without = 8, with = 2, of_a_record = 50;
  std::size_t last = 0, count = 0;
  for (const std::size_t record : asked_.records)
    if (!records_[record].tangents) last = records_[record].position, ++count;
  const double forward =
      (of_factors + static_cast<double>(parameters_.size())) * static_cast<double>(stretch_->steps.size());
  const auto quantities = static_cast<double>(asked_.quantities);
  const double back =
      std::min(without * quantities, of_factors + with * quantities) * static_cast<double>(last) +
      of_a_record * static_cast<double>(count);
  if (back >= forward) carry();
}

MotionTangents::Matrix Sensitivities::through_states(const Quantities& quantities) {
  const auto at_record = [&](std::size_t record, const BeamSystem& system, const State& state) {
    return snapshot(records_[record], system, state, records_[record].probes);
  };
  MotionTangents::Matrix sum = MotionTangents::Matrix::Zero(static_cast<Eigen::Index>(asked_.quantities),
                                                            static_cast<Eigen::Index>(parameters_.size()));
  std::vector<std::size_t> of_steps;
  for (const std::size_t record : asked_.records)
    if (const Rest* rest = records_[record].rest.get())
      sum += rest->adjoint.through_rest(
          [&](const State& state) { return quantities(record, at_record(record, *rest->system, state)); },
          rest->dynamics, rest->constraints);
    else if (!records_[record].tangents)
      of_steps.push_back(record);
  if (of_steps.empty()) return sum;
  const Vector scale = system_->coordinate_scale();
  const double h = (state_.t - stretch_->start) / static_cast<double>(stretch_->steps.size());
  add_through_steps(
      of_steps,
      [&](std::size_t record) {
        const State& recorded = records_[record].state;
        const SystemEnergy known = asked_.contents.energy ? energy(*system_, recorded) : SystemEnergy{};
        const auto at = [&](const Vector& x) {
          State state = recorded;
          set_unknowns(x, state);
          Snapshot snapshot = at_record(record, *system_, state);
          if (asked_.contents.energy)
            snapshot.energy = record_energy(carried_energy(known, *system_, recorded, state));
          return quantities(record, snapshot);
        };
        return rates_by_unknowns(at, unknowns_of(recorded), steps_of_unknowns(recorded, scale, h));
      },
      sum);
  return sum;
}

// Adds derivatives (quantities x parameters) of these records, from the records back to the present place of
// the tangents. `by_state`: (unknowns x quantities) derivatives by the state of one record.
void Sensitivities::add_through_steps(const std::vector<std::size_t>& records,
                                      const std::function<Eigen::MatrixXd(std::size_t)>& by_state,
                                      MotionTangents::Matrix& sum) {
  const Eigen::Index n = state_.q.size(), m = state_.lambda.size();
  const bool times_change = !tangents_.t.isZero(0) || !tangents_.last_step.isZero(0);
  const Eigen::RowVectorXd same_time = Eigen::RowVectorXd::Zero(tangents_.parameters());
  StepAdjoint adjoint(settings_, *system_);
  MotionTangents adjoints = MotionTangents::zero(n, m, sum.rows());
  MotionTangents::Matrix mu;
  const bool by_numbers = sum.rows() <= few_adjoints;
  if (by_numbers) differences_->go_back(*system_, state_, shifts_at(state_), sum.rows());
  const bool are_in_sums = by_numbers && differences_->are_all_in_sums();
  // The step at which the adjoint is.
  std::size_t present = 0;
  std::optional<State> end;
  double h = 0;
  const auto go_over = [&] {
    if (!end) return;
    bool regular = false;
    Shifts shifts;
    const auto find_multipliers = [&] { regular = adjoint.find_multipliers(adjoints, mu); };
    const auto find_changes = [&] { shifts = find_residual_changes(*end, same_time); };
    if (are_in_sums) {  // there are no changes to find beside the sums
      find_multipliers();
      find_changes();
    } else {
      both(find_multipliers, find_changes);
    }
    if (!regular) singular_step();
    work_.solves += mu.cols();
    take_off(shifts, adjoint.stiffness());
    if (!are_in_sums)
      for (Eigen::Index k = 0; k < sum.rows(); ++k) {
        sum.row(k).noalias() -= mu.col(k).head(n).transpose() * dynamics_;
        sum.row(k).noalias() -= mu.col(k).tail(m).transpose() * constraints_;
      }
    if (by_numbers) differences_->add(*end, mu);
    const Vector later = times_change ? rates_with_time(*end, h) : Vector();
    adjoints = adjoint.start(adjoints, mu, stretch_->by_time[present], later);
  };
  auto record = records.rbegin();
  stretch_->steps.back([&](std::size_t i, const KeptSteps::Step& step) {
    if (i + 1 > records_[records.back()].position) return;
    ++work_.tangents;
    both([&] { adjoint.take(step.before, step.history, step.after, step.repeated); }, go_over);
    adjoint.go_on();
    for (; record != records.rend() && records_[*record].position == i + 1; ++record)
      add_unknowns(by_state(*record), adjoints);
    present = i;
    end = step.after;
    h = step.after.t - step.before.t;
  });
  go_over();
  if (by_numbers) sum -= differences_->sums();
  sum += product(adjoints, tangents_);
}

}  // namespace nurbeam
