#pragma once
#include <optional>
#include <vector>

#include "fem/forces/energy.h"
#include "fem/motion/remesh/mesh_rules.h"
#include "solver/algebra/near_solver.h"

namespace nurbeam {

/// The same motion on another mesh: kept nodes keep r and r_s, new nodes take them and their rates from the
/// old curve, moved by match_axial_strain(). Where nodes were only inserted (a split) the axial energy is the
/// old one, and with the pointwise strain the motion is. Accelerations are those of kept nodes, of bodies and
/// of the old curve; multipliers stay where they are as many, else they are zero.
State interpolated(const BeamSystem& from, const State& state, const BeamSystem& to);
/// The same with balance_added_nodes().
State balanced(const BeamSystem& from, const State& state, const BeamSystem& to);

/// A move of nodes towards the energy of before: those of new elements and of rings of neighbours around
/// them, of 2^-halvings of the least move, with its mu, that a parabola foretells.
struct EnergyMove {
  int rings, halvings;
  double mu;
};

/// What has kept the energy.
struct EnergyKeeping {
  bool by_velocities = false;          ///< by relative_motion(), of balanced(); else moves, of interpolated()
  std::vector<EnergyMove> moves = {};  ///< none by velocities
};

/// A motion on another mesh, and what carrying it over took.
struct Transferred {
  State state;
  /// Constraint impulse of the projection of velocities [N s]: the momentum on the new mesh changes by -G'
  /// impulse.
  Eigen::VectorXd impulse;
  EnergyKeeping keeping = {};
};

/// A move of them as it has been made: 2^-halvings d of these coordinates.
struct MadeMove {
  std::vector<int> free;
  Eigen::VectorXd d;
  double mu;  ///< 0 where d does not bring the energy, but leads to the lowest
  int halvings;
};

/// A motion on its way to another mesh.
struct TransferPath {
  std::vector<Transferred> stages;  ///< with velocities, before and after each move
  std::vector<MadeMove> moves;
  /// What the last stage has more than the energy, where velocities take it away [J].
  std::optional<double> excess = {};
};

/// How far constraints may be open in a motion that is carried over to another mesh, in their units: as far
/// as they were, or round-off.
double closed_enough(const BeamSystem& from, const State& state);

/// The same for a mesh that cannot hold the motion exactly: velocities are the L2 projection of the material
/// velocity field on the balanced() shape, and what of the energy this changes is given to or taken from
/// relative_motion(), or where that is too slow, brought back by nodes. Then, on the interpolated() shape,
/// those of new elements, if need be their neighbours too, move by the least displacements, in the mass norm,
/// that keep the total energy to 1e-10 of the kinetic and strain energy. (As interpolated, a merged element
/// carries axial strain that the two had not; Ding & Ouyang choose weights instead, Eqs. 31-38.) Such moves
/// open no constraint. Where the energy cannot be reached it comes as near as they bring it. Returns nullopt
/// when the projection is singular or the constraints cannot be closed.
std::optional<Transferred> projected(const BeamSystem& from, const State& state, const BeamSystem& to);
/// With the energy of (from, state), where that is known.
std::optional<Transferred> projected(const BeamSystem& from, const State& state, const SystemEnergy& energy,
                                     const BeamSystem& to);
/// The same with the energy kept as of a neighbouring motion, so that it is a smooth function of the state
/// and of the model: with its moves, whatever they bring, as far away from the energy's own as that one is.
/// nullopt also where that cannot be done. `solvers`: as in velocities_beside, of the motion that made them
/// first.
std::optional<Transferred> projected_like(const BeamSystem& from, const State& state, const BeamSystem& to,
                                          const EnergyKeeping& keeping, NeighbourSolvers& solvers);

/// The way of projected(), for a motion whose energy has been kept so. nullopt where it is more than that:
/// where bodies stand off their beams, constraints must be closed, or a move leads neither to its energy nor
/// to the lowest.
std::optional<TransferPath> path_of(const BeamSystem& from, const State& state, const BeamSystem& to,
                                    const EnergyKeeping& keeping);

}  // namespace nurbeam
