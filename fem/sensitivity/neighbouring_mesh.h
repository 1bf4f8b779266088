#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"

namespace nurbeam {

/// Whether two systems have the same nodes and coordinates: that of a model and of a neighbouring one.
bool same_mesh(const BeamSystem& system, const BeamSystem& neighbour);

/// A neighbouring model with its beams divided as those of `drawn` are: into as many elements between two
/// places that no element may cross, in the same proportions. Throws std::runtime_error where these places do
/// not correspond.
std::shared_ptr<const BeamModel> divided_like(std::shared_ptr<const BeamModel> model, const BeamModel& drawn);

/// The plan of a system's mesh for a neighbouring model, with places that correspond. Precondition: sections
/// have the drawing's charts, and no elements constant weights.
MeshPlan corresponding_plan(const BeamSystem& system, const BeamModel& neighbour);

/// By how much the places of the riders of a system, which are coordinates, lie elsewhere in two neighbouring
/// models whose parameter differs by twice `step`.
std::vector<std::pair<int, double>> shifts_of_places(const BeamSystem& system, const State& state,
                                                     const BeamModel& more, const BeamModel& less,
                                                     double step);

/// The riders whose places a system holds, but for those whose motion is prescribed.
std::vector<bool> held_joints(const BeamSystem& system);

/// Puts bodies of a neighbour that are carried as points on the spans on which those of `at` are, whichever
/// side of a node they stand on: a run keeps a span until the body passes its end. Precondition: same_mesh.
void stand_on_like_spans(const MeshedState& at, MeshedState& neighbour);

/// The system of a neighbouring model on the mesh of a rest: with the same nodes, sections in its charts, and
/// riders held at the corresponding places. Throws std::runtime_error where elements have constant weights.
std::unique_ptr<BeamSystem> at_rest_like(const MeshedState& at,
                                         const std::shared_ptr<const BeamModel>& model);

}  // namespace nurbeam
