#pragma once
#include <optional>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"

/// Bodies that are held in equilibrium, and go down together to where they rest because connectors or stops
/// pull or press them together: one after the other they would strain what couples them.
namespace nurbeam {

/// The riders of bodies that connectors (over bodies that hang between, too), stops or a body of two riders
/// couple, in groups of at least two of which one `slides`.
std::vector<std::vector<int>> coupled_joints(const BeamModel& model, const std::vector<bool>& slides);

/// H_ij = d F_i / d s_j of the forces along the beam that hold riders at their places, the rest in
/// equilibrium [N/m]; nothing where the tangent is singular. Precondition: the system holds these riders.
std::optional<Eigen::MatrixXd> holding_stiffness(const BeamSystem& system, const State& state,
                                                 const std::vector<int>& riders);

/// A row x >= b of what a move may be.
struct MoveLimit {
  Eigen::VectorXd row;
  double least;                          ///< b [m]
  enum class Of { move, stop, end } of;  ///< this move alone, a stop, an end of a beam
};
struct LimitedMove {
  Eigen::VectorXd x;         ///< [m]
  std::vector<bool> pushed;  ///< per limit: it is reached and pressed against, by more than round-off
};
/// The x that is least in f.x + x'|H|x/2 within the limits, |H| with the magnitudes of H's eigenvalues: down
/// from ridges, too. Where along an eigenvector of a negative one nothing pulls (less than `round_off` [N]),
/// `push` [m] does.
LimitedMove least_within(const Eigen::VectorXd& f, const Eigen::MatrixXd& H, double round_off, double push,
                         const std::vector<MoveLimit>& limits);

}  // namespace nurbeam
