#pragma once
#include <optional>
#include <string>

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
  split,          ///< nodes inserted only: exact in position and velocity
  merge,          ///< at least one node removed: velocities by L2 projection
  becomes_point,  ///< a joint near a beam end or a late node: its node goes, it is carried as a point
  becomes_node    ///< a joint has come away from there
};

/// What the mesh should be now; `change` is none when it may stay.
struct NextPlan {
  MeshChange change = MeshChange::none;
  int joint = -1;
  MeshPlan plan;
};

/// The plan of the present mesh with the joints where they are now.
template <int D>
MeshPlan present_plan(const BeamSystem<D>& system, const State& state);

/// Applies the rule of the paper near each joint: where an element beside the moving node is longer than max
/// standard lengths and hides a home node, that node returns; where it is shorter than min, its far node goes
/// (unless it is a beam end, a hinge or a corner, or late). Late nodes stay: the joint passes them, and comes
/// to a beam end, as a point of the mesh; but breaks before a joint whose slope may be discontinuous go when
/// it is very near (passes_as_point).
template <int D>
NextPlan next_plan(const BeamSystem<D>& system, const State& state, const LengthControl& control);

/// The same motion on another mesh: kept nodes keep r and r_s, new nodes take them from the old curve. If
/// `exact` (a split), velocities are interpolated. Otherwise they are the L2 projection of the material
/// velocity field, and the nodes of new elements, if need be their neighbours too, move so that the total
/// energy is kept: by the least displacements, in the mass norm, that bring it back. As interpolated, a
/// merged element carries axial strain that the two had not (Ding & Ouyang choose weights instead, Eqs.
/// 31-38). Where the energy cannot be reached it comes as near as such moves bring it. t, q and v are set; a
/// and lambda are zero. Returns nullopt when the projection is singular. `impulse`, if given, is set to the
/// projection's constraint impulse (constraint_count of `to`, or none if exact): the momentum on the new mesh
/// changes by -G' impulse [N s].
template <int D>
std::optional<State> transfer(const BeamSystem<D>& from, const State& state, const BeamSystem<D>& to,
                              bool exact, Eigen::VectorXd* impulse = nullptr);

/// Weights (k_0, k_1, k_2, 1) of Eqs. 31-38 of Ding & Ouyang: the minimum-norm change from ones that leads
/// the merged curve through r_H at parameter u; all ones if any is not positive. Pseudo-inverse tolerance
/// 1e-2 (relative). slope_a, slope_b: dr/du at the ends [m].
template <int D>
std::array<double, 4> merged_weights(const Eigen::Matrix<double, D, 1>& r_a,
                                     const Eigen::Matrix<double, D, 1>& slope_a,
                                     const Eigen::Matrix<double, D, 1>& r_b,
                                     const Eigen::Matrix<double, D, 1>& slope_b,
                                     const Eigen::Matrix<double, D, 1>& r_h, double u);

extern template MeshPlan present_plan<2>(const BeamSystem<2>&, const State&);
extern template MeshPlan present_plan<3>(const BeamSystem<3>&, const State&);
extern template NextPlan next_plan<2>(const BeamSystem<2>&, const State&, const LengthControl&);
extern template NextPlan next_plan<3>(const BeamSystem<3>&, const State&, const LengthControl&);
extern template std::optional<State> transfer<2>(const BeamSystem<2>&, const State&, const BeamSystem<2>&,
                                                 bool, Eigen::VectorXd*);
extern template std::optional<State> transfer<3>(const BeamSystem<3>&, const State&, const BeamSystem<3>&,
                                                 bool, Eigen::VectorXd*);

}  // namespace nurbeam
