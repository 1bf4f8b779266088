#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"

namespace nurbeam {

/// Whether two systems, one of a model and one of its neighbour, have the same nodes and coordinates.
bool same_mesh(const BeamSystem& system, const BeamSystem& neighbour);

/// A neighbouring model with its beams divided as those of `drawn`: as many elements between two places that
/// no element may cross, in the same proportions. Throws std::runtime_error where these places do not
/// correspond.
std::shared_ptr<const BeamModel> divided_like(std::shared_ptr<const BeamModel> model, const BeamModel& drawn);

/// The plan of a system's mesh for a neighbouring model, with corresponding places. Precondition: sections
/// have the charts of the drawing, and no element has constant weights.
MeshPlan corresponding_plan(const BeamSystem& system, const BeamModel& neighbour);

/// Shifts of the places of a system's riders, which are coordinates, by the parameter: coordinate and
/// derivative of its corresponding place, from two neighbouring models whose parameter differs by twice
/// `step`.
std::vector<std::pair<int, double>> shifts_of_places(const BeamSystem& system, const State& state,
                                                     const BeamModel& more, const BeamModel& less,
                                                     double step);

/// Per rider: whether a system holds its place; false for prescribed motions.
std::vector<bool> held_joints(const BeamSystem& system);

/// Moves bodies of a neighbour that are carried as points to the spans of those of `at`, on whichever side of
/// a node they are: a run keeps a span until the body passes its end. Precondition: same_mesh.
void stand_on_like_spans(const MeshedState& at, MeshedState& neighbour);

/// The system of a neighbouring model on the mesh of a rest: with the same nodes, in the charts of its
/// sections, and with riders held at the corresponding places. Throws std::runtime_error where elements have
/// constant weights.
std::unique_ptr<BeamSystem> at_rest_like(const MeshedState& at,
                                         const std::shared_ptr<const BeamModel>& model);

}  // namespace nurbeam
