#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Thresholds in standard (home) element lengths. Figure 7 of Ding & Ouyang has 0.5 and 1.5; a node that is
/// removed late leaves less of the shape behind.
struct LengthControl {
  double min = 0.1;
  double max = 1.15;
};

enum class MeshChange {
  none,
  split,          ///< nodes inserted only
  merge,          ///< at least one node removed: velocities by L2 projection
  becomes_point,  ///< a rider near a beam end or a permanent node: its node goes, it is carried as a point
  becomes_node    ///< a rider has come away from there
};

/// Places strictly between two [m].
struct PlaceRange {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  bool holds(double s) const { return low < s && s < high; }
};

/// What the mesh should be now; `change` is none when it may stay, and there is no plan then.
struct NextPlan {
  MeshChange change = MeshChange::none;
  int rider = -1;
  MeshPlan plan = {};
  /// Of the riders that ask for nothing, up to one that does: where each may be, the mesh being the same, for
  /// none to ask for anything.
  std::vector<PlaceRange> quiet = {};
};

/// The plan of the present mesh with the riders where they are now.
MeshPlan present_plan(const BeamSystem& system, const State& state);

/// The plan of the present mesh with other nodes, riders carried in other modes, held, and stops closed, as
/// in `like`, the plan of a neighbouring model.
MeshPlan plan_like(const MeshPlan& like, const BeamSystem& system, const State& state);

/// Applies the rule of the paper near each rider: where an element beside the moving node is longer than max
/// standard lengths and hides a home node, that node returns; where it is shorter than min, its far node goes
/// (unless it is a beam end, a hinge or a corner, or permanent). Permanent nodes stay: the rider passes them,
/// and comes to a beam end, as a point of the mesh; but breaks before a rider whose slope may be
/// discontinuous go when it is very near (Passing). The first change that a rider from `first_joint` on asks
/// for.
NextPlan next_plan(const BeamSystem& system, const State& state, const LengthControl& control,
                   int first_joint = 0);

/// Whether the motion may go on without a change of the mesh that is due: a rider can stay a point, or a node
/// until it is almost there, a node before it stay until then, and stay away until the element beside the
/// rider is half as long again as it is drawn.
bool can_wait(const BeamSystem& system, const State& state, const NextPlan& next);

/// Knows for how long no change of the mesh can be due.
class MeshWatch {
 public:
  /// Whether the next plan is known to be none. False: it must be looked for.
  bool is_quiet(const std::shared_ptr<const BeamSystem>& system, const State& state) const;
  /// `next`: for all riders of the system.
  void look(const std::shared_ptr<const BeamSystem>& system, const NextPlan& next);

 private:
  std::weak_ptr<const BeamSystem> system_;
  std::vector<PlaceRange> quiet_;  // of each of its riders
};

}  // namespace nurbeam
