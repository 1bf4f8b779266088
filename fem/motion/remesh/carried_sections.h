#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Gives a new plan the charts of the sections of all beams with torsion: nodes that the present mesh has
/// keep theirs, so that their angles stay; those of new nodes are the present sections. Nothing without
/// torsion. With `like`, the plan of a neighbouring model that has the same spans, those of new nodes are its
/// charts, turned about the tangent as those of nodes that both keep beside them: where both models are drawn
/// alike their sections have the same angles then.
void carry_sections(const BeamSystem& system, const State& state, MeshPlan& plan,
                    const MeshPlan* like = nullptr);

/// The chart of the sections at a node of a beam with torsion: of the element before it (end 1) or behind it
/// (end 0) where there are both.
const Eigen::Matrix3d& section_chart(const BeamSystem& system, int beam, int node, int end);

/// The twist of the present mesh, as an element of a new one has it.
struct CarriedTwist {
  double bubble = 0, bubble_rate = 0;  ///< [rad], [rad/s]
};
/// In a span of a new mesh of the same model, which has the coordinates `next`. The bubble's strain is the
/// least-squares line through the present one, and exact inside one present element; the rate is that there,
/// and zero where there were several.
CarriedTwist carried_twist(const BeamSystem& system, const State& state, const MeshSpan& span,
                           const State& next);

/// The node for the same home node or the same rider; -1 where there is none. `likely`: where it may be.
int same_node(const std::vector<MeshNode>& nodes, const MeshNode& wanted, int likely = 0);

}  // namespace nurbeam
