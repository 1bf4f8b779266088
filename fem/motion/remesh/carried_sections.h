#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Gives a new plan the charts of the sections of all beams with torsion. Nodes that the present mesh has
/// keep their charts, so that their angles stay; new nodes get the present sections as charts. Nothing
/// changes without torsion.
///
/// `like`: the plan of a neighbouring model with the same spans. New nodes then get its charts, turned about
/// the tangent as the charts of kept nodes beside them are. Where both models are drawn alike, sections so
/// have the same angles in both.
void carry_sections(const BeamSystem& system, const State& state, MeshPlan& plan,
                    const MeshPlan* like = nullptr);

/// The chart of the section at a node of a beam with torsion. `end`: 1 for the element before the node, 0 for
/// the element behind it, where both exist.
const Eigen::Matrix3d& section_chart(const BeamSystem& system, int beam, int node, int end);

/// The twist of the present mesh, carried over to an element of a new mesh.
struct CarriedTwist {
  double bubble = 0, bubble_rate = 0;  ///< [rad], [rad/s]
};
/// The twist in a span of a new mesh of the same model, which has the coordinates `next`. The bubble's strain
/// is the least-squares line through the present strain, exact inside one present element. The rate is the
/// present one there, and zero where the span covers several elements.
CarriedTwist carried_twist(const BeamSystem& system, const State& state, const MeshSpan& span,
                           const State& next);

/// The node for the same home node or the same rider; -1 where there is none. `likely`: the index to try
/// first.
int same_node(const std::vector<MeshNode>& nodes, const MeshNode& wanted, int likely = 0);

}  // namespace nurbeam
