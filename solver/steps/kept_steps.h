#pragma once
#include <functional>
#include <vector>

#include "solver/steps/generalized_alpha.h"

namespace nurbeam {

/// Steps of generalized-alpha with one system, to be gone over again in either direction. Where there are too
/// many to keep them all, every other, fourth, eighth ... is, and those between are repeated from there.
class KeptSteps {
 public:
  struct Step {
    const State& before;
    const IntegratorHistory& history;  ///< at `before`
    const State& after;
    bool repeated;  ///< as by Integrator::repeat
  };
  /// Is told the number of a step, counted from 0, and the step.
  using Visit = std::function<void(std::size_t, const Step&)>;

  /// `system` must outlive it; `most` steps are kept whole, at least one.
  KeptSteps(const GeneralizedAlpha& settings, const SecondOrderSystem& system, std::size_t most);

  /// One that begins where the last has ended.
  void add(const Step& step);
  std::size_t size() const { return lengths_.size(); }
  /// Visits all from the first to the last, or back. Throws std::runtime_error where a step cannot be
  /// repeated.
  void forward(const Visit& visit) const;
  void back(const Visit& visit) const;

 private:
  struct Moment {
    State state;
    IntegratorHistory history;
  };
  std::vector<Moment> beginnings(std::size_t first) const;
  Step step(std::size_t i, std::size_t first, const std::vector<Moment>& beginnings) const;

  GeneralizedAlpha settings_;  // without error control: steps are as long as they were
  const SecondOrderSystem* system_;
  std::size_t most_, spacing_ = 1;
  std::vector<Moment> moments_;  // where every spacing_-th step begins
  std::vector<double> lengths_;  // of all steps
  std::vector<bool> repeated_;
  State end_;  // of the last
};

}  // namespace nurbeam
