#pragma once
#include <optional>
#include <vector>

#include "solver/algebra/near_solver.h"
#include "solver/system/near_kkt.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

enum class ConsistencyStatus {
  done,
  singular  ///< the matrix is singular, and the state unchanged
};

/// Accelerations and multipliers that belong to (t, q, v): [M G'; G 0][a; lambda] = [f; -curvature], where f
/// may depend on lambda.
[[nodiscard]] ConsistencyStatus make_accelerations_consistent(const SecondOrderSystem& system, State& state);

/// Consistent accelerations and multipliers, averaged over a step h:
///   [M + (h/2) D + (h^2/4) K, G'; G 0][a; lambda] = [f; -curvature].
/// Motions slow against h keep their acceleration to O(h^2). Motions much faster, which an event may have
/// left out of balance, lose theirs: exact accelerations of such motions would make the first step overshoot
/// by (omega h)^2.
[[nodiscard]] ConsistencyStatus make_accelerations_smooth(const SecondOrderSystem& system, double h,
                                                          State& state);
struct Balance {
  ConsistencyStatus status;
  bool near = false;  ///< whether only unknowns near `around` were solved for; solved_near() lists the most
                      ///< that this can be
};

/// Corrects present accelerations and multipliers where a change of the mesh has put them out of balance,
/// averaged over a step h:
///   [M + (h/2) D + (h^2/4) K, G'; G 0][da; dlambda] = [f - M a - G'lambda; -curvature - G a].
/// Motions in balance keep their acceleration, however fast they are. `around`: numbers of coordinates and
/// then multipliers; only unknowns near them are solved for, if that suffices; empty: everywhere. Where f
/// depends on lambda this is make_accelerations_smooth. `solver`: for neighbouring states and systems with
/// the same unknowns.
[[nodiscard]] Balance balance_accelerations(const SecondOrderSystem& system, double h,
                                            const std::vector<int>& around, NearSolver& solver, State& state);

/// The unknowns near `around`, in order, to which balance_accelerations confines its corrections where it
/// solves near them; empty: all.
std::vector<int> solved_near(const SecondOrderSystem& system, const std::vector<int>& around);

/// The largest value of the constraints g(q, t), in their units.
double open_constraints(const SecondOrderSystem& system, const State& state);

/// Closes the constraints to `enough`, in their units, by least displacements in the mass norm (Newton's
/// method); nothing moves if they are closed. Returns whether they are closed in the end.
[[nodiscard]] bool close_constraints(const SecondOrderSystem& system, double enough, State& state);

/// Closes the constraints as far as round-off allows.
void close_constraints_to_round_off(const SecondOrderSystem& system, State& state);

struct Projection {
  ConsistencyStatus status;
  Eigen::VectorXd impulse;  ///< (m) impulse of the constraints [N s]
};

/// The velocity nearest to `v` in the mass norm with G v + rate = 0, and the impulse that causes it: M (v_new
/// - v) + G' impulse = 0. In an impact that lasts a time h, elastic and damping forces resist too: M + (h/2)
/// D + (h^2/4) K stands for M. Waves much faster than h, which steps of that length could not follow, then
/// carry the impulse away at once instead of remaining.
[[nodiscard]] Projection project_velocities(const SecondOrderSystem& system, State& state, double h = 0);

/// The velocity with M v + G' impulse = momentum and G v + rate = 0 (L2 projection of a momentum vector (n)).
[[nodiscard]] Projection velocities_from_momentum(const SecondOrderSystem& system,
                                                  const Eigen::VectorXd& momentum, State& state);
/// Solvers for velocities of one system, at positions each of which is near the one before.
struct ProjectionSolver {
  std::optional<NearKkt> near;  ///< for unknowns near some place
  NearSolver whole;
};
/// The velocity with M v + G' impulse = momentum and G v + rate = 0. The velocities of the state already
/// satisfy this, except in the rows `around`, of coordinates and then multipliers. It is solved for near
/// these rows, or everywhere where that does not suffice or `around` is empty.
[[nodiscard]] Projection velocities_from_momentum(const SecondOrderSystem& system,
                                                  const Eigen::VectorXd& momentum,
                                                  const std::vector<int>& around, ProjectionSolver& solver,
                                                  State& state);
/// The velocity with M v + G' impulse = momentum and G v + rate = 0, first for a motion with an empty
/// `solver`, and then for its neighbours on one mesh. Neighbours get one correction of the first motion's
/// solution. Its error is of second order in their distance, and of third order in half the difference of two
/// neighbours at equal distances on either side.
[[nodiscard]] Projection velocities_beside(const SecondOrderSystem& system, const Eigen::VectorXd& momentum,
                                           const std::vector<int>& around, NeighbourSolver& solver,
                                           State& state);

}  // namespace nurbeam
