#include "fem/motion/remesh/new_elements.h"

#include "fem/motion/remesh/carried_sections.h"

namespace nurbeam {

namespace {

// Per beam and node of `to`: the corresponding node of `from`, -1 where there is none.
std::vector<std::vector<int>> same_nodes(const BeamSystem& from, const BeamSystem& to) {
  const auto &old = from.mesh().nodes, &nodes = to.mesh().nodes;
  std::vector<std::vector<int>> same(nodes.size());
  for (std::size_t b = 0; b < nodes.size(); ++b)
    for (int last = -1; const MeshNode& node : nodes[b]) {
      same[b].push_back(same_node(old[b], node, last + 1));
      if (same[b].back() >= 0) last = same[b].back();
    }
  return same;
}

// Whether two nodes of the old mesh have an element between them; not if one of them is -1.
bool are_joined(const BeamSystem& from, int beam, int a, int b) {
  if (a < 0 || b < 0) return false;
  const int count = static_cast<int>(from.mesh().nodes[beam].size());
  return b - a == 1 || (from.model().beams[beam].is_ring() && b - a == 1 - count);
}

}  // namespace

NodeSet new_nodes(const BeamSystem& from, const BeamSystem& to) {
  const std::vector<std::vector<int>> same = same_nodes(from, to);
  NodeSet added;
  for (int b = 0; b < static_cast<int>(same.size()); ++b)
    for (int i = 0; i < static_cast<int>(same[b].size()); ++i)
      if (same[b][i] < 0) added.emplace(b, i);
  return added;
}

bool is_new(const BeamSystem& from, const BeamSystem& to, const MeshSpan& span) {
  const std::vector<MeshNode>& old = from.mesh().nodes[span.beam];
  return !are_joined(from, span.beam, same_node(old, to.mesh().node_a(span)),
                     same_node(old, to.mesh().node_b(span)));
}

NodeSet nodes_of_new_elements(const BeamSystem& from, const BeamSystem& to) {
  const std::vector<std::vector<int>> same = same_nodes(from, to);
  NodeSet nodes;
  for (const MeshSpan& span : to.mesh().spans)
    if (!are_joined(from, span.beam, same[span.beam][span.node_a], same[span.beam][span.node_b]))
      nodes.insert({{span.beam, span.node_a}, {span.beam, span.node_b}});
  return nodes;
}

NodeSet without_pointwise_strain(const BeamModel& model, NodeSet nodes) {
  std::erase_if(nodes, [&](const auto& node) {
    return model.beams[node.first].properties.axial_strain == AxialStrain::pointwise;
  });
  return nodes;
}

std::vector<int> spans_beside(const Mesh& mesh, const NodeSet& nodes) {
  std::set<int> spans;
  for (const auto& [beam, node] : nodes) {
    const int first = mesh.first_span[beam], end = mesh.first_span[beam + 1];
    if (first == end) continue;  // a guide
    if (first + node < end) spans.insert(first + node);
    // On a ring the last span ends at the first node.
    const int before = node > 0 ? first + node - 1 : end - 1;
    if (mesh.spans[before].node_b == node) spans.insert(before);
  }
  return {spans.begin(), spans.end()};
}

NodeSet with_neighbours(const Mesh& mesh, const NodeSet& nodes) {
  NodeSet wider = nodes;
  for (const int i : spans_beside(mesh, nodes)) {
    const MeshSpan& span = mesh.spans[i];
    wider.insert({{span.beam, span.node_a}, {span.beam, span.node_b}});
  }
  return wider;
}

}  // namespace nurbeam
