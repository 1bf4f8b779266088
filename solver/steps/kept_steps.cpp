#include "solver/steps/kept_steps.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace nurbeam {

KeptSteps::KeptSteps(const GeneralizedAlpha& settings, const SecondOrderSystem& system, std::size_t most)
    : settings_(settings), system_(&system), most_(std::max<std::size_t>(1, most)) {
  settings_.tolerance = 0;
}

void KeptSteps::add(const Step& step) {
  // The length is exact to the last digit, which a difference of two times is not.
  if (size() > 0 && step.history.numbers[0] > 0) lengths_.back() = step.history.numbers[0];
  if (size() % spacing_ == 0) {
    if (moments_.size() == most_) {
      for (std::size_t i = 1; 2 * i < most_; ++i) moments_[i] = std::move(moments_[2 * i]);
      moments_.resize((most_ + 1) / 2);
      spacing_ *= 2;
    }
    if (size() % spacing_ == 0) moments_.push_back({step.before, step.history});
  }
  lengths_.push_back(step.after.t - step.before.t);
  repeated_.push_back(step.repeated);
  end_ = step.after;
}

// Starts of the steps from `first`, which is kept, to the next kept one.
std::vector<KeptSteps::Moment> KeptSteps::beginnings(std::size_t first) const {
  std::vector<Moment> found{moments_[first / spacing_]};
  const std::size_t end = std::min(first + spacing_, size());
  if (end - first == 1) return found;
  GeneralizedAlphaIntegrator integrator(settings_, *system_, found.front().state,
                                        found.front().history.numbers[2]);
  integrator.restore(found.front().state, found.front().history);
  for (std::size_t i = first; i + 1 < end; ++i) {
    const StepReport taken = repeated_[i]
                                 ? integrator.repeat(found.back().state, found.back().history, lengths_[i])
                                 : integrator.advance(lengths_[i]);
    if (taken.status != StepStatus::converged || taken.step != lengths_[i])
      throw std::runtime_error("a derivative cannot repeat a step of the run");
    found.push_back({integrator.state(), integrator.history()});
  }
  return found;
}

// Step number i; `beginnings`: starts of the steps from number `first` on.
KeptSteps::Step KeptSteps::step(std::size_t i, std::size_t first,
                                const std::vector<Moment>& beginnings) const {
  const Moment& moment = beginnings[i - first];
  const State& after = i + 1 == size()                     ? end_
                       : i + 1 - first < beginnings.size() ? beginnings[i + 1 - first].state
                                                           : moments_[(i + 1) / spacing_].state;
  return {moment.state, moment.history, after, repeated_[i]};
}

void KeptSteps::forward(const Visit& visit) const {
  for (std::size_t first = 0; first < size(); first += spacing_) {
    const std::vector<Moment> all = beginnings(first);
    for (std::size_t i = first; i < first + all.size(); ++i) visit(i, step(i, first, all));
  }
}

void KeptSteps::back(const Visit& visit) const {
  for (std::size_t k = moments_.size(); k-- > 0;) {
    const std::size_t first = k * spacing_;
    const std::vector<Moment> all = beginnings(first);
    for (std::size_t i = first + all.size(); i-- > first;) visit(i, step(i, first, all));
  }
}

}  // namespace nurbeam
