#include "fem/mesh/drawn_coordinates.h"

namespace nurbeam {

namespace {

// Of the body of a joint, with its offset, whose joint is at s.
Eigen::Vector3d drawn_body(const Structure& structure, const SlidingJoint& joint, double s) {
  const ReferenceCurve& curve = structure.beam_of(joint).curve;
  if (!joint.is_offset() || !curve.has_sections()) return curve.position(s);
  const DrawnSection section = curve.section(s);
  return curve.position(s) + joint.offset[0] * section.d1 + joint.offset[1] * section.d2;
}

}  // namespace

Eigen::VectorXd planned_places(const Mesh& mesh) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(mesh.coordinate_count);
  for (const std::vector<MeshNode>& nodes : mesh.nodes)
    for (const MeshNode& node : nodes)
      if (node.place >= 0) q[node.place] = node.s;
  for (std::size_t j = 0; j < mesh.joints.size(); ++j)
    if (mesh.joints[j].place >= 0) q[mesh.joints[j].place] = mesh.plan.places[j];
  return q;
}

Eigen::VectorXd drawn_coordinates(const Structure& structure, const Mesh& mesh) {
  const int D = mesh.dimension;
  Eigen::VectorXd q = planned_places(mesh);
  for (std::size_t body = 0; body < structure.bodies.size(); ++body)
    q.segment(mesh.bodies[body], D) = structure.bodies[body].position.head(D);
  for (std::size_t b = 0; b < mesh.nodes.size(); ++b)
    for (const MeshNode& node : mesh.nodes[b]) {
      const ReferenceCurve& curve = structure.beams[b].curve;
      q.segment(node.r, D) = curve.position(node.s).head(D);
      q.segment(node.slope_left, D) = curve.tangent(node.s, true).head(D);
      q.segment(node.slope_right, D) = curve.tangent(node.s).head(D);
    }
  for (std::size_t j = 0; j < mesh.joints.size(); ++j) {
    if (mesh.plan.modes[j] == JointMode::free) continue;
    const SlidingJoint& joint = structure.joints[j];
    q.segment(mesh.bodies[joint.body], D) = drawn_body(structure, joint, mesh.plan.places[j]).head(D);
  }
  return q;
}

Eigen::Vector3d drawn_place(const Structure& structure, const ConnectorEnd& end) {
  if (end.beam >= 0) return structure.beams[end.beam].curve.position(end.s);
  if (end.body < 0) return end.point;
  for (const SlidingJoint& joint : structure.joints)
    if (joint.body == end.body) return drawn_body(structure, joint, joint.s);
  return structure.bodies.at(end.body).position;
}

}  // namespace nurbeam
