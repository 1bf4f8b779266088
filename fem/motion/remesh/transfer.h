#pragma once
#include <optional>
#include <vector>

#include "fem/forces/energy.h"
#include "fem/motion/remesh/mesh_rules.h"
#include "solver/algebra/near_solver.h"

namespace nurbeam {

/// A motion on another mesh. Kept nodes keep r and r_s; new nodes take them and their rates from the old
/// curve, moved by match_axial_strain(). Where nodes were only inserted (a split) the axial energy is
/// conserved, and with the pointwise strain the motion is. Accelerations come from kept nodes, from bodies
/// and from the old curve. Multipliers stay if their number does; else they are zero.
State interpolated(const BeamSystem& from, const State& state, const BeamSystem& to);
/// The interpolated() motion with balance_added_nodes().
State balanced(const BeamSystem& from, const State& state, const BeamSystem& to);

/// A move of nodes that restores the energy of before: the nodes of new elements and of `rings` of neighbours
/// around them. The move is 2^-halvings of the least move, with its mu, that a parabola predicts.
struct EnergyMove {
  int rings, halvings;
  double mu;
};

/// The means by which the energy was conserved.
struct EnergyKeeping {
  /// By relative_motion() of the balanced() shape; else by moves of the interpolated() shape.
  bool by_velocities = false;
  std::vector<EnergyMove> moves = {};  ///< empty when conserved by velocities
};

/// A motion on another mesh, and the impulse and moves that it took to carry it over.
struct Transferred {
  State state;
  /// Constraint impulse of the projection of velocities [N s]: the momentum on the new mesh changes by -G'
  /// impulse.
  Eigen::VectorXd impulse;
  EnergyKeeping keeping = {};
};

/// A move of nodes as it was made: 2^-halvings d in the coordinates `free`.
struct MadeMove {
  std::vector<int> free;
  Eigen::VectorXd d;
  double mu;  ///< 0 where d does not restore the energy, but leads to the lowest one
  int halvings;
};

/// The stages of a motion that is carried over to another mesh.
struct TransferPath {
  std::vector<Transferred> stages;  ///< with velocities, before and after each move
  std::vector<MadeMove> moves;
  /// The excess of energy in the last stage, where velocities take it away [J].
  std::optional<double> excess = {};
};

/// Tolerance of constraints in a motion that is carried over to another mesh, in their units: as far open as
/// they were, or round-off.
double closed_enough(const BeamSystem& from, const State& state);

/// A motion on a mesh that cannot hold it exactly. Velocities are the L2 projection of the material velocity
/// field on the balanced() shape. The energy that this changes is given to or taken from relative_motion().
///
/// Where the relative motion is too slow, nodes restore the energy. On the interpolated() shape the nodes of
/// new elements move, and if need be their neighbours too. Their displacements are the least in the mass norm
/// that conserve the total energy to 1e-10 of the kinetic and strain energy. (As interpolated, a merged
/// element carries axial strain that the two did not have; Ding & Ouyang choose weights instead, Eqs. 31-38.)
/// The moves open no constraint. Where the energy cannot be reached, they bring it as near as they can.
///
/// Returns nullopt when the projection is singular or the constraints cannot be closed.
std::optional<Transferred> projected(const BeamSystem& from, const State& state, const BeamSystem& to);
/// The projected() motion where the energy of (from, state) is known already.
std::optional<Transferred> projected(const BeamSystem& from, const State& state, const SystemEnergy& energy,
                                     const BeamSystem& to);
/// The projected() motion with the energy conserved as in a neighbouring motion, so that it is a smooth
/// function of the state and of the model. It repeats the neighbour's moves, and so misses its own energy by
/// as much as the neighbour does. nullopt also where that cannot be done. `solvers`: as for
/// velocities_beside, from the motion that made them first.
std::optional<Transferred> projected_like(const BeamSystem& from, const State& state, const BeamSystem& to,
                                          const EnergyKeeping& keeping, NeighbourSolvers& solvers);

/// The stages of projected(), for a motion whose energy was conserved as `keeping` tells. nullopt where more
/// was needed: bodies stand off their beams, constraints must be closed, or a move leads neither to its
/// energy nor to the lowest.
std::optional<TransferPath> path_of(const BeamSystem& from, const State& state, const BeamSystem& to,
                                    const EnergyKeeping& keeping);

}  // namespace nurbeam
