#pragma once
#include <set>
#include <utility>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// A set of nodes by beam and index.
using NodeSet = std::set<std::pair<int, int>>;

/// Nodes of `to` that `from` does not have.
NodeSet new_nodes(const BeamSystem& from, const BeamSystem& to);

/// Whether `from` has no element between the same nodes as this span of `to`.
bool is_new(const BeamSystem& from, const BeamSystem& to, const MeshSpan& span);

/// Nodes of the new elements of `to`.
NodeSet nodes_of_new_elements(const BeamSystem& from, const BeamSystem& to);

/// The nodes of beams whose strain is not pointwise.
NodeSet without_pointwise_strain(const BeamModel& model, NodeSet nodes);

/// Indices of the spans that begin or end at these nodes, in order.
std::vector<int> spans_beside(const Mesh& mesh, const NodeSet& nodes);

/// The nodes and their neighbours.
NodeSet with_neighbours(const Mesh& mesh, const NodeSet& nodes);

}  // namespace nurbeam
