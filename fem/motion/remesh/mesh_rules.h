#pragma once
#include <limits>
#include <memory>
#include <optional>
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
  becomes_node    ///< a rider has moved away from the beam end or permanent node
};

/// A range of places, strictly between two [m].
struct PlaceRange {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();

  bool holds(double s) const { return low < s && s < high; }
};

/// The mesh that is due now. `change` is none when the present mesh may stay; there is no plan then.
struct NextPlan {
  MeshChange change = MeshChange::none;
  int rider = -1;
  MeshPlan plan = {};
  /// Per rider, up to the first that asks for a change: the range of places in which no rider asks for one,
  /// as long as the mesh is the same.
  std::vector<PlaceRange> quiet = {};
};

/// The plan of the present mesh with the riders at their present places.
MeshPlan present_plan(const BeamSystem& system, const State& state);

/// The plan of the present mesh with nodes, modes of riders, holds and closed stops as in `like`, the plan of
/// a neighbouring model.
MeshPlan plan_like(const MeshPlan& like, const BeamSystem& system, const State& state);

/// The next plan by the rule of the paper near each rider. Where an element beside the moving node is longer
/// than max standard lengths and hides a home node, that node returns. Where it is shorter than min, its far
/// node goes, unless it is a beam end, a hinge or a corner, or permanent.
///
/// Permanent nodes stay: the rider passes them, and comes to a beam end, as a point of the mesh. But breaks
/// before a rider whose slope may be discontinuous go when it is very near (Passing).
///
/// The result is the first change that a rider from `first_joint` on asks for.
NextPlan next_plan(const BeamSystem& system, const State& state, const LengthControl& control,
                   int first_joint = 0);

/// Whether the motion may go on although a change of the mesh is due. A point may stay a point. A node may
/// stay a node until it is almost there. A node before the rider may stay
/// until then, and a hidden node may stay away until the element beside the rider is 1.5 home lengths long.
bool can_wait(const BeamSystem& system, const State& state, const NextPlan& next);

/// The plan with a rider's node gone for good: it is carried as a point of the mesh from now on, and the
/// hidden home nodes beside it are back. Nothing for a rider that is no node, and for one whose slope may be
/// discontinuous, as a point carries no kink.
std::optional<NextPlan> point_for_good(const BeamSystem& system, const State& state,
                                       const LengthControl& control, int rider);

/// A watch that knows for how long no change of the mesh can be due.
class MeshWatch {
 public:
  /// Whether it is known that no change is due. False: the next plan must be looked for.
  bool is_quiet(const std::shared_ptr<const BeamSystem>& system, const State& state) const;
  /// Learns the quiet ranges from `next`, which must cover all riders of the system.
  void look(const std::shared_ptr<const BeamSystem>& system, const NextPlan& next);

 private:
  std::weak_ptr<const BeamSystem> system_;
  std::vector<PlaceRange> quiet_;  // per rider of the system
};

}  // namespace nurbeam
