#include "solver/system/consistent.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/local_solution.h"
#include "solver/system/scaled_kkt.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

/// Numbers of coupling levels beyond which an open row changes no acceleration that counts; the smaller one
/// is mostly enough. Systems with no more unknowns than `few_unknowns`, a chain of plane elements with four
/// coordinates at each node, are solved as a whole.
constexpr int short_reach_of_accelerations = 12, long_reach_of_accelerations = 40,
              few_unknowns = 10 * long_reach_of_accelerations;

int reach_of_accelerations(const SecondOrderSystem& system) {
  const int size = system.tangent_pattern().size();
  return size < few_unknowns ? size : long_reach_of_accelerations;
}

/// Levels of the corrections of velocities. Masses of elements that follow one another pass 0.28 from each
/// node to the next: 2e-7 remain, which is enough where little is open, or 4e-17.
constexpr std::array<int, 2> reaches_of_velocities{12, 30};

/// The factorised matrix [M + (h/2) D + (h^2/4) K, G'; G 0].
class FactorisedKkt {
 public:
  FactorisedKkt(const SecondOrderSystem& system, const State& state, double h = 0)
      : n_(system.coordinate_count()), m_(system.constraint_count()), kkt_(system, state, h) {
    regular_ = solver_.factorise(kkt_.matrix, system.moving_unknowns());
  }

  bool regular() const { return regular_; }

  /// (m) G x.
  Eigen::VectorXd constraint_product(const Eigen::VectorXd& x) const {
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(n_ + m_);
    padded.head(n_) = x;
    return (kkt_.matrix * padded).tail(m_);
  }

  /// (n) [M + (h/2) D + (h^2/4) K] x.
  Eigen::VectorXd coordinate_product(const Eigen::VectorXd& x) const {
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(n_ + m_);
    padded.head(n_) = x;
    return kkt_.scale * (kkt_.matrix * padded).head(n_);
  }

  /// (n+m) [x; y] with M x + G'y = top (n), G x = bottom (m). Precondition: regular().
  Eigen::VectorXd solve(const Eigen::VectorXd& top, const Eigen::VectorXd& bottom) const {
    Eigen::VectorXd rhs(n_ + m_);
    rhs << top / kkt_.scale, bottom;
    Eigen::VectorXd solution = solver_.solve(rhs);
    solution.tail(m_) *= kkt_.scale;
    return solution;
  }

 private:
  int n_;
  int m_;
  ScaledKkt kkt_;
  KktSolver solver_;
  bool regular_ = false;
};

/// Velocities and impulse by `solve`(kkt, b, x); x enters with the velocities of the state.
template <class Solve>
Projection from_momentum(const SecondOrderSystem& system, const Vector& momentum, State& state,
                         const Solve& solve) {
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  const ScaledKkt kkt(system, state);
  Vector b(n + m), x = Vector::Zero(n + m);
  b << momentum / kkt.scale, -system.constraint_rate(state);
  x.head(n) = state.v;
  if (!b.allFinite() || !x.allFinite() || !solve(kkt, b, x) || !x.allFinite())
    return {ConsistencyStatus::singular, {}};
  state.v = x.head(n);
  return {ConsistencyStatus::done, kkt.scale * x.tail(m)};
}

/// Velocities near some unknowns; nothing where that is not possible.
std::optional<Projection> near_velocities(const SecondOrderSystem& system, const Vector& momentum,
                                          NearKkt& near, State& state) {
  Vector impulse = Vector::Zero(system.constraint_count());
  if (!near.factorise(state, 0) || !near.correct(momentum, -system.constraint_rate(state), state.v, impulse))
    return std::nullopt;
  return Projection{ConsistencyStatus::done, impulse};
}

/// Velocities near `around`, with the smallest reach that suffices; `near` is made if it is empty.
std::optional<Projection> near_velocities(const SecondOrderSystem& system, const Vector& momentum,
                                          const std::vector<int>& around, std::optional<NearKkt>& near,
                                          State& state) {
  for (const int reach : reaches_of_velocities) {
    if (near && near->reach() > reach) continue;
    if (!near || near->reach() < reach) near.emplace(system, around, reach);
    if (auto projection = near_velocities(system, momentum, *near, state)) return projection;
  }
  return std::nullopt;
}

/// The state without accelerations and multipliers.
State unloaded(const SecondOrderSystem& system, State state) {
  state.a.setZero(system.coordinate_count());
  state.lambda.setZero(system.constraint_count());
  return state;
}

/// (m) g(q, t).
Eigen::VectorXd constraint_values(const SecondOrderSystem& system, const State& moving) {
  Eigen::VectorXd constraints(system.constraint_count());
  system.constraints(moving, constraints);
  return constraints;
}

/// (n) f(q, v, t): minus the dynamics of an unloaded state.
Eigen::VectorXd force(const SecondOrderSystem& system, const State& still) {
  Eigen::VectorXd dynamics(system.coordinate_count());
  Eigen::VectorXd constraints(system.constraint_count());
  system.residual(still, dynamics, constraints);
  return -dynamics;
}

/// (m) G v + dg/dt.
Eigen::VectorXd constraint_speeds(const SecondOrderSystem& system, const State& state) {
  return system.constraint_product(state, state.v) + system.constraint_rate(state);
}

/// (n) M v + G' impulse.
Eigen::VectorXd momentum_of(const SecondOrderSystem& system, const State& at, const Vector& v,
                            const Vector& impulse) {
  // An acceleration so large that forces are lost in round-off beside it.
  const double vast = std::ldexp(1.0, 300);
  State state = at;
  state.v.setZero();
  state.a = vast * v;
  state.lambda = vast * impulse;
  Vector dynamics(v.size()), constraints(impulse.size());
  system.residual(state, dynamics, constraints);
  return dynamics / vast;
}

/// Newton's iteration for accelerations and multipliers if forces depend on the multipliers; returns whether
/// it has converged.
bool correct_accelerations(const SecondOrderSystem& system, double h, State& state) {
  constexpr int most_corrections = 30;
  constexpr double tolerance = 1e-13;
  const Eigen::Index n = state.q.size(), m = state.lambda.size();
  Eigen::VectorXd dynamics(n), constraints(m);
  for (int i = 0; i < most_corrections; ++i) {
    State still = state;
    still.a.setZero();
    const FactorisedKkt kkt(system, still, h);
    if (!kkt.regular()) return false;
    system.residual(still, dynamics, constraints);
    // The matrix is [M + (h/2) D + (h^2/4) K, dF/dlambda; G, 0].
    const Eigen::VectorXd correction =
        kkt.solve(-dynamics - kkt.coordinate_product(state.a),
                  -system.constraint_curvature(state) - kkt.constraint_product(state.a));
    if (!correction.allFinite()) return false;
    state.a += correction.head(n);
    state.lambda += correction.tail(m);
    const double left = correction.tail(m).lpNorm<Eigen::Infinity>();
    if (left <= tolerance * state.lambda.lpNorm<Eigen::Infinity>() ||
        left <= std::numeric_limits<double>::min())
      return true;
  }
  return true;  // round-off is above the tolerance
}

/// One move of Newton's method that closes the constraints, the least in the mass norm. Returns whether there
/// is one, and the new configuration is admissible.
bool move_to_constraints(const SecondOrderSystem& system, State& state) {
  const FactorisedKkt kkt(system, unloaded(system, state));
  if (!kkt.regular()) return false;
  state.q += kkt.solve(Eigen::VectorXd::Zero(state.q.size()), -constraint_values(system, state))
                 .head(state.q.size());
  return system.admissible(state);
}

}  // namespace

ConsistencyStatus make_accelerations_smooth(const SecondOrderSystem& system, double h, State& state) {
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  State still = unloaded(system, state);
  Eigen::VectorXd f = force(system, still);
  const ScaledKkt kkt(system, still, h);
  Eigen::VectorXd right(n + m);
  right << f / kkt.scale, -system.constraint_curvature(state);
  // Memory is released, as the factors need room.
  still = {};
  f.resize(0);
  KktSolver solver;
  if (!solver.factorise(kkt.matrix, system.moving_unknowns())) return ConsistencyStatus::singular;
  const Eigen::VectorXd solution = solver.solve(right);
  if (!solution.allFinite()) return ConsistencyStatus::singular;
  const auto take = [&](State& into) {
    into.a = solution.head(n);
    into.lambda = kkt.scale * solution.tail(m);
  };
  if (!system.forces_depend_on_multipliers()) {
    take(state);
    return ConsistencyStatus::done;
  }
  State found = state;
  take(found);
  if (!correct_accelerations(system, h, found)) return ConsistencyStatus::singular;
  state = std::move(found);
  return ConsistencyStatus::done;
}

Balance balance_accelerations(const SecondOrderSystem& system, double h, const std::vector<int>& around,
                              NearSolver& solver, State& state) {
  if (system.forces_depend_on_multipliers()) return {make_accelerations_smooth(system, h, state)};
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  const State still = unloaded(system, state);
  Eigen::VectorXd dynamics(n), constraints(m);
  const Eigen::VectorXd open =
      -system.constraint_curvature(state) - system.constraint_product(state, state.a);
  if (!around.empty())
    for (const int reach : {short_reach_of_accelerations, reach_of_accelerations(system)}) {
      NearKkt near(system, around, reach);
      system.residual_near(state, near.rows(), dynamics, constraints);
      if (near.factorise(still, h) && near.answer(-dynamics, open, state.a, state.lambda))
        return {ConsistencyStatus::done, true};
    }
  system.residual(state, dynamics, constraints);
  const ScaledKkt kkt(system, still, h);
  Eigen::VectorXd right(n + m), correction;
  right << -dynamics / kkt.scale, open;
  if (!solver.solve(kkt.matrix, system.moving_unknowns(), right, correction) || !correction.allFinite())
    return {ConsistencyStatus::singular};
  state.a += correction.head(n);
  state.lambda += kkt.scale * correction.tail(m);
  return {ConsistencyStatus::done};
}

std::vector<int> solved_near(const SecondOrderSystem& system, const std::vector<int>& around) {
  if (around.empty() || system.forces_depend_on_multipliers()) return {};
  std::vector<int> near = NearKkt(system, around, reach_of_accelerations(system)).unknowns();
  return static_cast<int>(near.size()) < system.tangent_pattern().size() ? near : std::vector<int>{};
}

ConsistencyStatus make_accelerations_consistent(const SecondOrderSystem& system, State& state) {
  return make_accelerations_smooth(system, 0, state);
}

double open_constraints(const SecondOrderSystem& system, const State& state) {
  return constraint_values(system, state).lpNorm<Eigen::Infinity>();
}

bool close_constraints(const SecondOrderSystem& system, double enough, State& state) {
  constexpr int most_moves = 10;
  if (open_constraints(system, state) <= enough) return true;
  State closed = state;
  for (int i = 0; i < most_moves && open_constraints(system, closed) > enough; ++i)
    if (!move_to_constraints(system, closed)) return false;
  if (!(open_constraints(system, closed) <= enough)) return false;
  state = std::move(closed);
  return true;
}

void close_constraints_to_round_off(const SecondOrderSystem& system, State& state) {
  constexpr int most_moves = 10;
  double open = open_constraints(system, state);
  for (int i = 0; i < most_moves && open > 0; ++i) {
    State closed = state;
    if (!move_to_constraints(system, closed)) return;
    const double left = open_constraints(system, closed);
    if (!(left < open / 2)) return;
    state = std::move(closed);
    open = left;
  }
}

Projection project_velocities(const SecondOrderSystem& system, State& state, double h) {
  const Eigen::VectorXd excess = constraint_speeds(system, state);
  if (excess.isZero(0)) return {ConsistencyStatus::done, excess};
  const FactorisedKkt kkt(system, unloaded(system, state), h);
  if (!kkt.regular()) return {ConsistencyStatus::singular, {}};
  const Eigen::VectorXd solution = kkt.solve(Eigen::VectorXd::Zero(state.v.size()), -excess);
  if (!solution.allFinite()) return {ConsistencyStatus::singular, {}};
  state.v += solution.head(system.coordinate_count());
  return {ConsistencyStatus::done, solution.tail(system.constraint_count())};
}

Projection velocities_from_momentum(const SecondOrderSystem& system, const Eigen::VectorXd& momentum,
                                    State& state) {
  return from_momentum(
      system, momentum, state,
      [&](const ScaledKkt& kkt, const Vector& b, Vector& x) {
        return correct_locally(kkt.matrix, b, system.moving_unknowns(), x);
      });
}

Projection velocities_from_momentum(const SecondOrderSystem& system, const Eigen::VectorXd& momentum,
                                    const std::vector<int>& around, ProjectionSolver& solver, State& state) {
  if (!around.empty()) {
    if (const auto near = near_velocities(system, momentum, around, solver.near, state)) return *near;
  }
  return from_momentum(system, momentum, state, [&](const ScaledKkt& kkt, const Vector& b, Vector& x) {
    return solver.whole.solve(kkt.matrix, system.moving_unknowns(), b, x);
  });
}

Projection velocities_beside(const SecondOrderSystem& system, const Vector& momentum,
                             const std::vector<int>& around, NeighbourSolver& solver, State& state) {
  if (!around.empty()) {
    std::optional<NearKkt> near;
    if (const auto projection = near_velocities(system, momentum, around, near, state)) return *projection;
  }
  const Eigen::Index n = system.coordinate_count(), m = system.constraint_count();
  if (solver.solution.size() != n + m)
    return from_momentum(system, momentum, state, [&](const ScaledKkt& kkt, const Vector& b, Vector& x) {
      if (!solver.factors.factorise(kkt.matrix, system.moving_unknowns())) return false;
      x = solver.solution = solver.factors.solve(b);
      solver.scale = kkt.scale;
      return true;
    });
  const Vector v = solver.solution.head(n), impulse = solver.scale * solver.solution.tail(m);
  Vector open(n + m);
  open << (momentum - momentum_of(system, state, v, impulse)) / solver.scale,
      -system.constraint_rate(state) - system.constraint_product(state, v);
  const Vector x = solver.solution + solver.factors.solve(open);
  if (!x.allFinite()) return {ConsistencyStatus::singular, {}};
  state.v = x.head(n);
  return {ConsistencyStatus::done, solver.scale * x.tail(m)};
}

}  // namespace nurbeam
