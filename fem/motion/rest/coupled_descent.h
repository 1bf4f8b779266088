#pragma once
#include <optional>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"

/// Bodies that are held in equilibrium and descend together to where they rest, as connectors or stops couple
/// them. One after the other they would strain the coupling.
namespace nurbeam {

/// Groups of at least two riders, one of which `slides`. Their bodies are coupled by connectors (also over
/// bodies that hang between), by stops, by a body of two riders, or as eyelets of one beam.
std::vector<std::vector<int>> coupled_joints(const BeamModel& model, const std::vector<bool>& slides);

/// (riders x riders) H_ij = d F_i / d s_j of the forces along the beam that hold riders at their places, with
/// the rest in equilibrium [N/m]. Nothing where the tangent is singular. Precondition: the system holds these
/// riders.
std::optional<Eigen::MatrixXd> holding_stiffness(const BeamSystem& system, const State& state,
                                                 const std::vector<int>& riders);

/// A limit row x >= b of a move x.
struct MoveLimit {
  Eigen::VectorXd row;
  double least;                          ///< b [m]
  enum class Of { move, stop, end } of;  ///< limit of this move alone, of a stop, of an end of a beam
};
struct LimitedMove {
  Eigen::VectorXd x;         ///< [m]
  std::vector<bool> pushed;  ///< per limit: it is reached and pressed against by more than round-off
};
/// The move x that minimises f.x + x'|H|x/2 within the limits. |H| has the magnitudes of the eigenvalues of
/// H, so that the move goes down from ridges too. Along an eigenvector of a negative eigenvalue without a
/// force (less than `round_off` [N]), the move is `push` [m].
LimitedMove least_within(const Eigen::VectorXd& f, const Eigen::MatrixXd& H, double round_off, double push,
                         const std::vector<MoveLimit>& limits);

}  // namespace nurbeam
