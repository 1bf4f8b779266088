#pragma once
#include <optional>
#include <vector>

#include "solver/algebra/near_solver.h"
#include "solver/system/near_kkt.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

enum class ConsistencyStatus {
  done,
  singular  ///< the matrix is, and the state unchanged
};

/// Accelerations and multipliers that belong to (t, q, v): [M G'; G 0][a; lambda] = [f; -curvature], where f
/// may depend on lambda.
[[nodiscard]] ConsistencyStatus make_accelerations_consistent(const SecondOrderSystem& system, State& state);

/// The same, averaged over a step h: [M + (h/2) D + (h^2/4) K, G'; G 0][a; lambda] = [f; -curvature]. Motions
/// slow against h keep their acceleration to O(h^2); those much faster, which an event may have left out of
/// balance, lose theirs. Exact accelerations of such motions would make the first step overshoot by (omega
/// h)^2.
[[nodiscard]] ConsistencyStatus make_accelerations_smooth(const SecondOrderSystem& system, double h,
                                                          State& state);
struct Balance {
  ConsistencyStatus status;
  bool near = false;  ///< whether some unknowns were solved for alone, of which solved_near() are the most
};

/// Corrects accelerations and multipliers that are there by what a change of the mesh has put out of balance,
/// averaged over a step h: [M + (h/2) D + (h^2/4) K, G'; G 0][da; dlambda] = [f - M a - G'lambda; -curvature
/// - G a]. All that is in balance keeps its acceleration, however fast it moves. Near these unknowns, of the
/// coordinates and then the multipliers, where that does; none: everywhere. Where f depends
/// on lambda: as make_accelerations_smooth. `solver`: of neighbouring states and systems, with the same
/// unknowns.
[[nodiscard]] Balance balance_accelerations(const SecondOrderSystem& system, double h,
                                            const std::vector<int>& around, NearSolver& solver, State& state);

/// The unknowns near these, in order, beyond which balance_accelerations corrects none that counts where it
/// solves near them; none: all.
std::vector<int> solved_near(const SecondOrderSystem& system, const std::vector<int>& around);

/// The largest of what is left of the constraints g(q, t), in their units.
double open_constraints(const SecondOrderSystem& system, const State& state);

/// Closes the constraints to `enough`, in their units, by least displacements in the mass norm (Newton's
/// method); nothing moves where they are closed. Returns whether they are in the end.
[[nodiscard]] bool close_constraints(const SecondOrderSystem& system, double enough, State& state);

/// The same as far as round-off lets.
void close_constraints_to_round_off(const SecondOrderSystem& system, State& state);

struct Projection {
  ConsistencyStatus status;
  Eigen::VectorXd impulse;  ///< (m) of the constraints [N s]
};

/// The velocity nearest to `v` in the mass norm with G v + rate = 0; the impulse makes it so: M (v_new - v) +
/// G' impulse = 0. As in an impact that lasts a time h, elastic and damping forces work against it: M + (h/2)
/// D
/// + (h^2/4) K stands for M. Waves much faster than h, which steps of that length could not follow, then
/// carry the impulse away at once instead of being left behind.
[[nodiscard]] Projection project_velocities(const SecondOrderSystem& system, State& state, double h = 0);

/// The velocity with M v + G' impulse = momentum and G v + rate = 0 (L2 projection of a momentum vector (n)).
[[nodiscard]] Projection velocities_from_momentum(const SecondOrderSystem& system,
                                                  const Eigen::VectorXd& momentum, State& state);
/// What has been solved for velocities of one system at places of which each lies near the one before.
struct ProjectionSolver {
  std::optional<NearKkt> near;  ///< of unknowns near some place
  NearSolver whole;
};
/// The same where the velocities of the state already have that momentum, but in the rows of these unknowns,
/// of the coordinates and then the multipliers: solved for near them, or where that does not suffice, and for
/// none, everywhere.
[[nodiscard]] Projection velocities_from_momentum(const SecondOrderSystem& system,
                                                  const Eigen::VectorXd& momentum,
                                                  const std::vector<int>& around, ProjectionSolver& solver,
                                                  State& state);
/// The same for a motion, of which `solver` has solved nothing, and then for its neighbours, on one mesh:
/// these by one correction of the first one's. What that misses is of second order in how far they are, and
/// of third in half the difference of two as far on either side.
[[nodiscard]] Projection velocities_beside(const SecondOrderSystem& system, const Eigen::VectorXd& momentum,
                                           const std::vector<int>& around, NeighbourSolver& solver,
                                           State& state);

}  // namespace nurbeam
