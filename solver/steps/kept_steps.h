#pragma once
#include <functional>
#include <vector>

#include "solver/steps/generalized_alpha.h"

namespace nurbeam {

/// Steps of generalized-alpha with one system, kept to be visited again in either direction. If there are too
/// many to keep, only every second, fourth, eighth ... step is kept, and those between are repeated from
/// there.
class KeptSteps {
 public:
  struct Step {
    const State& before;
    const IntegratorHistory& history;  ///< at `before`
    const State& after;
    bool repeated;  ///< taken again by Integrator::repeat
  };
  /// Called with the number of a step, counted from 0, and the step.
  using Visit = std::function<void(std::size_t, const Step&)>;

  /// `system` must outlive this object; `most`: number of steps that are kept whole, at least one.
  KeptSteps(const GeneralizedAlpha& settings, const SecondOrderSystem& system, std::size_t most);

  /// Adds a step, which must begin where the last one has ended.
  void add(const Step& step);
  std::size_t size() const { return lengths_.size(); }
  /// forward(): visits all steps from the first to the last; back(): from the last to the first. Both throw
  /// std::runtime_error where a step cannot be repeated.
  void forward(const Visit& visit) const;
  void back(const Visit& visit) const;

 private:
  struct Moment {
    State state;
    IntegratorHistory history;
  };
  std::vector<Moment> beginnings(std::size_t first) const;
  Step step(std::size_t i, std::size_t first, const std::vector<Moment>& beginnings) const;

  GeneralizedAlpha settings_;  // without error control, so that repeated steps have the same length
  const SecondOrderSystem* system_;
  std::size_t most_, spacing_ = 1;
  std::vector<Moment> moments_;  // start of every spacing_-th step
  std::vector<double> lengths_;  // lengths of all steps
  std::vector<bool> repeated_;
  State end_;  // end of the last step
};

}  // namespace nurbeam
