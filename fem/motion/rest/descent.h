#pragma once
#include <limits>
#include <vector>

#include "fem/motion/rest/coupled_descent.h"

/// How sliding bodies go down to where they rest, from one place at which they are held in equilibrium to the
/// next.
namespace nurbeam {

/// A sliding body on its way to where it rests.
struct Descent {
  double most;                         // of the next move [m]; 0 for one that does not move
  double s = 0, force = 0, moved = 0;  // before the last move, that held it there [m], [N], and the move [m]
  bool arrived = false, at_end = false;  // the latter: of the beam, or at a stop
  bool leaves = false;                   // it is at an end, and nothing else holds it there
  int balanced = 0;                      // places in a row at which nothing held it
  double pushed_from = std::numeric_limits<double>::quiet_NaN();  // the last of them that it was pushed off
  int way = 0;                                                    // that it slides against its friction
};

/// How far a body moves at first [m]: a quarter of an element; on a guide, which has none, less.
double first_move(const BeamModel& model, int rider);

/// The next move of a body by itself [m]; 0 where it has arrived.
double next_move(const MeshedState& at, int rider, Descent& body);

/// Bodies that are coupled, on their way down together.
class CoupledDescent {
 public:
  /// `riders`: those of a group of coupled_joints.
  CoupledDescent(const BeamModel& model, std::vector<int> riders);

  const std::vector<int>& riders() const { return joints_; }
  /// Writes their next moves into `moves` [m]; a body of which nothing is asked (Descent::most is 0) stays.
  void next_moves(const MeshedState& at, std::vector<Descent>& bodies, std::vector<double>& moves);

 private:
  // What may be asked of a move of the riders `movable`.
  std::vector<MoveLimit> limits(const MeshedState& at, const std::vector<int>& movable) const;

  std::vector<int> joints_;
  double spacing_, most_;  // of the elements, and of the next move [m]
  Eigen::VectorXd moved_;  // by the last move [m]
};

}  // namespace nurbeam
