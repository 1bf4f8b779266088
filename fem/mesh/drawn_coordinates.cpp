#include "fem/mesh/drawn_coordinates.h"

namespace nurbeam {

namespace {

// Drawn position of a rider's body, with its offset, for the rider at s.
Eigen::Vector3d drawn_body(const Structure& structure, const Rider& rider, double s) {
  const ReferenceCurve& curve = structure.beam_of(rider).curve;
  if (!rider.is_offset() || !curve.has_sections()) return curve.position(s);
  const DrawnSection section = curve.section(s);
  return curve.position(s) + rider.offset[0] * section.d1 + rider.offset[1] * section.d2;
}

}  // namespace

Eigen::VectorXd planned_places(const Mesh& mesh) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(mesh.coordinate_count);
  for (const std::vector<MeshNode>& nodes : mesh.nodes)
    for (const MeshNode& node : nodes)
      if (node.place >= 0) q[node.place] = node.s;
  for (std::size_t j = 0; j < mesh.riders.size(); ++j)
    if (mesh.riders[j].place >= 0) q[mesh.riders[j].place] = mesh.plan.places[j];
  return q;
}

Eigen::VectorXd drawn_coordinates(const Structure& structure, const Mesh& mesh) {
  const int D = mesh.dimension;
  Eigen::VectorXd q = planned_places(mesh);
  for (std::size_t i = 0; i < structure.bodies.size(); ++i) {
    const Body& body = structure.bodies[i];
    q.segment(mesh.bodies[i], D) = body.position.head(D);
    if (!body.rigid) continue;
    const Eigen::Quaterniond& attitude = body.rigid->attitude;
    q.segment<4>(mesh.attitudes[i]) << attitude.w(), attitude.vec();
  }
  for (std::size_t b = 0; b < mesh.nodes.size(); ++b)
    for (const MeshNode& node : mesh.nodes[b]) {
      const ReferenceCurve& curve = structure.beams[b].curve;
      q.segment(node.r, D) = curve.position(node.s).head(D);
      q.segment(node.slope_left, D) = curve.tangent(node.s, true).head(D);
      q.segment(node.slope_right, D) = curve.tangent(node.s).head(D);
    }
  for (std::size_t j = 0; j < mesh.riders.size(); ++j) {
    if (mesh.plan.modes[j] == Carried::free) continue;
    const Rider& rider = structure.riders[j];
    q.segment(mesh.bodies[rider.body], D) = drawn_body(structure, rider, mesh.plan.places[j]).head(D);
  }
  return q;
}

Eigen::Vector3d drawn_place(const Structure& structure, const Grip& end) {
  if (end.beam >= 0) return structure.beams[end.beam].curve.position(end.s);
  if (end.body < 0) return end.point;
  for (const Rider& rider : structure.riders)
    if (rider.body == end.body) return drawn_body(structure, rider, rider.s);
  return structure.bodies.at(end.body).position;
}

}  // namespace nurbeam
