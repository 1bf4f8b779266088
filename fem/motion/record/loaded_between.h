#pragma once
#include <functional>

#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Thrown to end a search, and caught where the search began.
struct Interruption {};

/// A share of a model's loads at a time.
struct Loading {
  double load, t;
};

/// A system between two loadings: load factor 0 is `from`, 1 is `to`, on the way from an equilibrium under
/// `from`. The tangent throws Interruption when the search is to end. State::stabilisation is 0, as it would
/// hinder states on the way, or rises from 0 to 1.
class LoadedBetween final : public SecondOrderSystem {
 public:
  enum class Stabilisation { none, rising };

  LoadedBetween(const SecondOrderSystem& system, Loading from, Loading to,
                const std::function<bool()>& interrupted, Stabilisation stabilisation = Stabilisation::none)
      : system_(system), from_(from), to_(to), interrupted_(interrupted), stabilisation_(stabilisation) {}

  Loading at(double factor) const {
    return {from_.load + (to_.load - from_.load) * factor, from_.t + (to_.t - from_.t) * factor};
  }

  int coordinate_count() const override { return system_.coordinate_count(); }
  int constraint_count() const override { return system_.constraint_count(); }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    system_.residual(loaded(state), dynamics, constraints);
  }
  const SparsePattern& tangent_pattern() const override { return system_.tangent_pattern(); }
  void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override {
    if (interrupted_ && interrupted_()) throw Interruption{};
    system_.tangent(loaded(state), w, kkt);
  }
  Eigen::VectorXd constraint_rate(const State& state) const override {
    return system_.constraint_rate(state);
  }
  Eigen::VectorXd constraint_curvature(const State& state) const override {
    return system_.constraint_curvature(state);
  }
  bool admissible(const State& state) const override { return system_.admissible(state); }
  Eigen::VectorXd coordinate_scale() const override { return system_.coordinate_scale(); }

 private:
  State loaded(State state) const {
    const Loading now = at(state.load);
    state.stabilisation = stabilisation_ == Stabilisation::rising ? state.load : 0;
    state.load = now.load;
    state.t = now.t;
    return state;
  }

  const SecondOrderSystem& system_;
  Loading from_, to_;
  const std::function<bool()>& interrupted_;
  Stabilisation stabilisation_;
};

}  // namespace nurbeam
