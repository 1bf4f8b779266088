#pragma once
#include <functional>
#include <stdexcept>
#include <typeindex>
#include <utility>
#include <vector>

#include "tests/fem/mapped_states.h"
#include "tests/fem/random_models.h"

namespace nurbeam::testing {

/// A constraint of a system in the coordinates of the whole system.
struct ConstraintOfSystem {
  int rows = 0;
  std::function<Eigen::VectorXd(const State&)> value;
  std::function<Eigen::MatrixXd(const State&)> gradient;                           ///< (rows x n)
  std::function<Eigen::MatrixXd(const State&, const Eigen::VectorXd& y)> hessian;  ///< (n x n) y . d2g/dq2
  std::function<Eigen::VectorXd(double t)> rate, acceleration;                     ///< (rows) of g at fixed q
  /// (rows) dg/dt, and d2g/dt2 + 2 d2g/dt dq v, in a state.
  std::function<Eigen::VectorXd(const State&)> rate_in, acceleration_in;
  std::function<double(const State& from, const State& to, const Eigen::VectorXd& y)> work;

  /// (n) Generalised forces of its multipliers: -G'y.
  Eigen::VectorXd forces(const State& state, const Eigen::VectorXd& y) const {
    return -gradient(state).transpose() * y;
  }
  /// (rows) v . H v of each.
  Eigen::VectorXd curvature(const State& state) const {
    Eigen::VectorXd result(rows);
    for (int r = 0; r < rows; ++r)
      result[r] = state.v.dot(hessian(state, Eigen::VectorXd::Unit(rows, r)) * state.v);
    return result;
  }
};

/// The same with the constraint itself.
template <int D, class C>
struct BoundIn : ConstraintOfSystem {
  const Assembly<D>& in;
  const C& constraint;
};

/// Puts what is in a part's own coordinates where these are among all.
inline void scatter_columns(const std::vector<int>& dofs, const Eigen::MatrixXd& own, Eigen::MatrixXd& all) {
  for (std::size_t k = 0; k < dofs.size(); ++k)
    if (dofs[k] >= 0) all.col(dofs[k]) += own.col(static_cast<int>(k));
}
inline void scatter_block(const std::vector<int>& dofs, const Eigen::MatrixXd& own, Eigen::MatrixXd& all) {
  for (std::size_t a = 0; a < dofs.size(); ++a)
    for (std::size_t b = 0; b < dofs.size(); ++b)
      if (dofs[a] >= 0 && dofs[b] >= 0)
        all(dofs[a], dofs[b]) += own(static_cast<int>(a), static_cast<int>(b));
}

/// Of a constraint with its Hessian: 0 where it says that it has none.
template <int D, class C>
BoundIn<D, C> in_system(const Assembly<D>& in, const C& c) {
  const int n = in.coordinate_count(), rows = C::rows;
  BoundIn<D, C> bound{{}, in, c};
  bound.rows = rows;
  bound.value = [&in, &c](const State& state) -> Eigen::VectorXd {
    return c.terms(in.beams(), state, nullptr).value;
  };
  bound.gradient = [&in, &c, n, rows](const State& state) {
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(rows, n);
    scatter_columns(c.dofs(), c.terms(in.beams(), state, nullptr).gradient, G);
    return G;
  };
  bound.hessian = [&in, &c, n, rows](const State& state, const Eigen::VectorXd& y) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
    typename ConstraintTerms<D>::Multipliers padded = ConstraintTerms<D>::Multipliers::Zero();
    padded.head(rows) = y;
    if constexpr (!C::offers.linear) scatter_block(c.dofs(), c.terms(in.beams(), state, &padded).hessian, H);
    return H;
  };
  bound.rate = [&c](double t) -> Eigen::VectorXd {
    if constexpr (
        requires { c.rate(t); })
      return c.rate(t);
    return Eigen::VectorXd::Zero(C::rows);
  };
  bound.acceleration = [&c](double t) -> Eigen::VectorXd {
    if constexpr (
        requires { c.acceleration(t); })
      return c.acceleration(t);
    return Eigen::VectorXd::Zero(C::rows);
  };
  bound.rate_in = [&in, &c, rate = bound.rate](const State& state) -> Eigen::VectorXd {
    if constexpr (
        requires { c.rate(in.beams(), state); })
      return c.rate(in.beams(), state);
    return rate(state.t);
  };
  bound.acceleration_in = [&in, &c, rate = bound.acceleration](const State& state) -> Eigen::VectorXd {
    if constexpr (
        requires { c.acceleration(in.beams(), state); })
      return c.acceleration(in.beams(), state);
    return rate(state.t);
  };
  if constexpr (requires(const State& x, const Eigen::VectorXd& y) { c.work(in.beams(), x, x, y, y); })
    bound.work = [&in, &c](const State& from, const State& to, const Eigen::VectorXd& y) {
      return c.work(in.beams(), from, to, y, y);
    };
  else if constexpr (C::offers.work)
    bound.work = [&c](const State& from, const State& to, const Eigen::VectorXd& y) {
      return c.work(from, to, y, y);
    };
  return bound;
}

/// All constraints of a system by their types.
template <int D>
std::vector<std::pair<std::type_index, const void*>> constraints_of(const BeamSystem& system) {
  std::vector<std::pair<std::type_index, const void*>> all;
  system.assembly<D>()->for_each_constraint(
      [&](const auto& c, const auto&) { all.emplace_back(typeid(c), &c); });
  return all;
}
/// The n-th constraint of that type.
template <int D, class C>
BoundIn<D, C> the_constraint(const BeamSystem& system, int n = 0) {
  for (const auto& [type, found] : constraints_of<D>(system))
    if (type == typeid(C) && n-- == 0)
      return in_system<D, C>(*system.assembly<D>(), *static_cast<const C*>(found));
  throw std::runtime_error("the system has no such constraint");
}
template <int D, class C>
int count_of(const BeamSystem& system) {
  int count = 0;
  for (const auto& [type, found] : constraints_of<D>(system)) count += type == typeid(C);
  return count;
}

/// The state a time later, with constant accelerations.
inline State at_time(State state, double h) {
  state.q += h * state.v + h * h / 2 * state.a;
  state.v += h * state.a;
  state.t += h;
  return state;
}

/// Expects gradient and Hessian to be the derivatives of the value, whichever coordinates are moved, and the
/// first two derivatives along a motion those that consistent velocities and accelerations are found with.
inline void expect_derivatives(const ConstraintOfSystem& c, const State& state, std::mt19937& random) {
  const Eigen::VectorXd y = random_vector(c.rows, random);
  for (int trial = 0; trial < 2; ++trial) {
    const Eigen::VectorXd dq = random_vector(state.q.size(), random);
    const auto moved = [&](double h) {
      State there = state;
      there.q += h * dq;
      return there;
    };
    expect_rate([&](double h) { return c.value(moved(h)); }, c.gradient(state) * dq);
    expect_rate([&](double h) { return Eigen::VectorXd(c.gradient(moved(h)).transpose() * y); },
                c.hessian(state, y) * dq);
  }
  const Eigen::MatrixXd H = c.hessian(state, y);
  EXPECT_LT((H - H.transpose()).norm(), 1e-12 * (1 + H.norm()));
  const auto first = [&](const State& at) -> Eigen::VectorXd {
    return c.gradient(at) * at.v + c.rate_in(at);
  };
  expect_rate([&](double h) { return c.value(at_time(state, h)); }, first(state));
  expect_rate([&](double h) { return first(at_time(state, h)); },
              c.gradient(state) * state.a + c.curvature(state) + c.acceleration_in(state));
}

/// Expects work(from, to, y, y) to be that of the power which constant multipliers have.
inline void expect_work(const ConstraintOfSystem& c, const State& state, const Eigen::VectorXd& y,
                        double power) {
  expect_rate_of_number([&](double h) { return c.work(state, at_time(state, h), y); }, power);
}

}  // namespace nurbeam::testing
