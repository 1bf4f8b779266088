#pragma once
#include <limits>
#include <vector>

#include "fem/motion/rest/coupled_descent.h"

/// The descent of sliding bodies to where they rest, from one held equilibrium to the next.
namespace nurbeam {

/// State of a sliding body's descent to where it rests.
struct Descent {
  double most;  // limit of the next move [m]; 0 for a body that does not move
  // Place [m] and holding force [N] before the last move, and the move [m]
  double s = 0, force = 0, moved = 0;
  bool arrived = false, at_end = false;  // at_end: at an end of the beam, or at a stop
  bool leaves = false;                   // the body is at an end, and nothing else holds it there
  int balanced = 0;                      // number of places in a row at which nothing held the body
  // Last balanced place that it was pushed off [m]
  double pushed_from = std::numeric_limits<double>::quiet_NaN();
  // Direction in which it slides against its friction.
  int way = 0;
};

/// First move of a body [m]: a quarter of an element; less on a guide, which has no elements.
double first_move(const BeamModel& model, int rider);

/// Next move of an uncoupled body [m]; 0 where it has arrived.
double next_move(const MeshedState& at, int rider, Descent& body);

/// The descent of a group of coupled bodies.
class CoupledDescent {
 public:
  /// `riders`: a group of coupled_joints.
  CoupledDescent(const BeamModel& model, std::vector<int> riders);

  const std::vector<int>& riders() const { return joints_; }
  /// Writes the next moves of the group into `moves` [m]; a body whose Descent::most is 0 stays.
  void next_moves(const MeshedState& at, std::vector<Descent>& bodies, std::vector<double>& moves);

 private:
  // Limits of the next move of the riders `movable`.
  std::vector<MoveLimit> limits(const MeshedState& at, const std::vector<int>& movable) const;

  std::vector<int> joints_;
  double spacing_, most_;  // length of the elements, and limit of the next move [m]
  Eigen::VectorXd moved_;  // last move of each rider [m]
};

}  // namespace nurbeam
