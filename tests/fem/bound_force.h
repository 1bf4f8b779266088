#pragma once
#include <functional>
#include <stdexcept>
#include <vector>

#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing {

/// A force of a system in the unknowns of the whole system.
struct ForceOfSystem {
  int n = 0, unknowns = 0;
  std::function<Eigen::VectorXd(const State&)> dynamics;                          ///< (n) inertia less force
  std::function<Eigen::MatrixXd(const State&, const TangentWeights& w)> tangent;  ///< (unknowns x unknowns)
  std::function<SystemEnergy(const State&)> energy;
  std::function<double(const State& from, const State& to)> work;
  std::function<std::vector<PointAction>(const State&)> actions;
  std::function<Eigen::Vector3d(const State&, const PointAction&)> place;  ///< where an action is [m]

  /// Of what it does in a motion without inertia [W].
  double power(const State& state) const {
    State coasting = state;
    coasting.a.setZero();
    return -dynamics(coasting).dot(state.v);
  }
};

/// The same with the force itself.
template <int D, class F>
struct ForceIn : ForceOfSystem {
  const Assembly<D>& in;
  const F& force;

  MeshedBeams<D> at() const { return in.beams(); }
};

/// Takes the matrices of a tangent as they are handed over.
template <int D, class F>
struct TangentSink {
  const Assembly<D>& in;
  const F& force;
  Eigen::MatrixXd sum;

  void own(const Eigen::MatrixXd& K) {
    if constexpr (requires { force.dofs(); }) scatter_block(force.dofs(), K, sum);
  }
  void element(int i, const Eigen::MatrixXd& K) {
    const auto& dofs = in.elements()[static_cast<std::size_t>(i)].dofs;
    scatter_block({dofs.begin(), dofs.end()}, K, sum);
  }
  void twist(int i, const Eigen::MatrixXd& K) {
    const auto& dofs = in.elements()[static_cast<std::size_t>(i)].twist->dofs;
    scatter_block({dofs.begin(), dofs.end()}, K, sum);
  }
};

template <int D, class F>
ForceIn<D, F> in_system_of_forces(const Assembly<D>& in, const F& f) {
  const int n = in.coordinate_count(), unknowns = n + in.constraint_count();
  ForceIn<D, F> bound{{}, in, f};
  bound.n = n;
  bound.unknowns = unknowns;
  bound.dynamics = [&in, &f, n](const State& state) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    if constexpr (
        requires { f.template add_force<D>(in.beams(), state, sum); })
      f.template add_force<D>(in.beams(), state, sum);
    else if constexpr (
        requires { f.add_force(in.beams(), state, sum); })
      f.add_force(in.beams(), state, sum);
    return sum;
  };
  bound.tangent = [&in, &f, unknowns](const State& state, const TangentWeights& w) {
    TangentSink<D, F> sink{in, f, Eigen::MatrixXd::Zero(unknowns, unknowns)};
    if constexpr (
        requires { f.template add_tangent<D>(in.beams(), state, w, sink); })
      f.template add_tangent<D>(in.beams(), state, w, sink);
    else if constexpr (
        requires { f.add_tangent(in.beams(), state, w, sink); })
      f.add_tangent(in.beams(), state, w, sink);
    return sink.sum;
  };
  bound.energy = [&in, &f](const State& state) {
    SystemEnergy sum;
    if constexpr (
        requires { f.add_energy(in.beams(), state, sum); })
      f.add_energy(in.beams(), state, sum);
    return sum;
  };
  bound.work = [&in, &f](const State& from, const State& to) -> double {
    if constexpr (
        requires { f.template work<D>(in.beams(), from, to); })
      return f.template work<D>(in.beams(), from, to);
    else if constexpr (
        requires { f.work(in.beams(), from, to); })
      return f.work(in.beams(), from, to);
    throw std::logic_error("the force does no work");
  };
  bound.actions = [&in, &f](const State& state) {
    std::vector<PointAction> actions;
    if constexpr (requires { f.template add_actions<D>(in.beams(), state, actions); })
      f.template add_actions<D>(in.beams(), state, actions);
    else if constexpr (requires { f.add_actions(in.beams(), state, actions); })
      f.add_actions(in.beams(), state, actions);
    return actions;
  };
  bound.place = [&in](const State& state, const PointAction& action) {
    const MeshElement<D>& e = in.elements()[static_cast<std::size_t>(action.element)];
    return widened<D>(material_point(e, state.q, state.v, action.s).r);
  };
  return bound;
}

/// The n-th force of that type in a system.
template <int D, class F>
ForceIn<D, F> the_force(const BeamSystem& system, int n = 0) {
  for (const BoundForce<D>& force : system.assembly<D>()->forces())
    if (const F* found = std::get_if<F>(&force); found && n-- == 0)
      return in_system_of_forces<D, F>(*system.assembly<D>(), *found);
  throw std::runtime_error("the system has no such force");
}
template <int D, class F>
int number_of(const BeamSystem& system) {
  int count = 0;
  for (const BoundForce<D>& force : system.assembly<D>()->forces()) count += std::holds_alternative<F>(force);
  return count;
}

/// Expects the tangent to be the derivative of inertia less force by positions, velocities, accelerations and
/// multipliers.
inline void expect_tangent(const ForceOfSystem& f, const State& state, std::mt19937& random,
                           double h = 4e-3) {
  const int n = f.n, m = f.unknowns - n;
  const Eigen::VectorXd x = random_vector(n, random), y = random_vector(m, random);
  const auto expect = [&](double of_q, double of_v, double of_a, double of_lambda,
                          const Eigen::VectorXd& derivative) {
    expect_rate(
        [&](double step) {
          State moved = state;
          moved.q += step * of_q * x;
          moved.v += step * of_v * x;
          moved.a += step * of_a * x;
          moved.lambda += step * of_lambda * y;
          return f.dynamics(moved);
        },
        derivative, h);
  };
  // What depends on multipliers stands in every tangent.
  const auto product = [&](const TangentWeights& w) -> Eigen::VectorXd {
    return f.tangent(state, w).topLeftCorner(n, n) * x;
  };
  expect(1, 0, 0, 0, product({.stiffness = 1}));
  expect(0, 1, 0, 0, product({.damping = 1}));
  expect(0, 0, 1, 0, product({.mass = 1}));
  expect(0, 0, 0, 1, f.tangent(state, {.stiffness = 1}).topRightCorner(n, m) * y);
}

/// Expects the force at rest to be the gradient of its energy.
inline void expect_potential(const ForceOfSystem& f, const State& state, std::mt19937& random) {
  State still = state;
  still.v.setZero();
  still.a.setZero();
  const Eigen::VectorXd x = random_vector(f.n, random);
  expect_rate_of_number(
      [&](double h) {
        State moved = still;
        moved.q += h * x;
        return f.energy(moved).mechanical();
      },
      f.dynamics(still).dot(x));
}

/// Expects work(from, to) along a motion to be that of the force's power.
inline void expect_work_of_power(const ForceOfSystem& f, const State& state) {
  expect_rate_of_number(
      [&](double h) { return f.work(state, at_time(state, h)) - f.work(state, at_time(state, -h)); },
      2 * f.power(state), 2e-3);
}

/// Expects what the actions at points do in rigid motions to be what the generalised forces do.
inline void expect_actions(const ForceOfSystem& f, const BeamSystem& system, const State& state, int beam) {
  State coasting = state;
  coasting.a.setZero();
  const std::vector<PointAction> actions = f.actions(state);
  ASSERT_FALSE(actions.empty());
  Resultant of_actions;
  for (const PointAction& action : actions) {
    of_actions.force += action.force;
    of_actions.moment += f.place(state, action).cross(action.force) + action.couple;
  }
  const Resultant on_beam =
      resultant(system, state, -f.dynamics(coasting), coordinates_of_beam(system, beam));
  expect_same(on_beam.force, of_actions.force);
  expect_same(on_beam.moment, of_actions.moment);
}

}  // namespace nurbeam::testing
