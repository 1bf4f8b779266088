#include "fem/motion/snapshot.h"

#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// x(first), ... as a vector in space.
Eigen::Vector3d vector_at(const BeamSystem& system, const Eigen::VectorXd& x, int first) {
  Eigen::Vector3d y = Eigen::Vector3d::Zero();
  y.head(system.dimension()) = x.segment(first, system.dimension());
  return y;
}

BeamRecord record_beam(const BeamSystem& system, const State& state, int b) {
  const Mesh& mesh = system.mesh();
  const ReferenceCurve& curve = system.model().beams[b].curve;
  BeamRecord record;
  for (int i = mesh.first_span[b]; i < mesh.first_span[b + 1]; ++i)
    record.elements.push_back(record_element(system, state, i));
  for (const MeshNode& node : mesh.nodes[b]) {
    record.node_positions.push_back(vector_at(system, state.q, node.r));
    record.node_slopes.push_back(vector_at(system, state.q, node.slope_left));
    record.node_s.push_back(node.place >= 0 ? curve.wrapped(state.q[node.place]) : node.s);
  }
  record.length = beam_length(system, state, b);
  return record;
}

PointRecord record_body(const BeamSystem& system, const State& state, int body) {
  const int r = system.mesh().bodies[body];
  return {vector_at(system, state.q, r), vector_at(system, state.v, r)};
}

}  // namespace

std::vector<BeamRecord> record_beams(const BeamSystem& system, const State& state) {
  std::vector<BeamRecord> records;
  for (int b = 0; b < static_cast<int>(system.model().beams.size()); ++b)
    records.push_back(record_beam(system, state, b));
  return records;
}

Snapshot record_snapshot(const BeamSystem& system, const State& state,
                         const std::vector<ProbePlace>& probes) {
  const BeamModel& model = system.model();
  Snapshot snapshot;
  snapshot.time = state.t;
  for (const ProbePlace& probe : probes) {
    const MaterialPoint<3> p = material_point(system, state, probe.beam, probe.s);
    snapshot.probes.push_back({p.r, p.velocity});
  }
  for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body)
    snapshot.bodies.push_back({record_body(system, state, body), std::nullopt, Eigen::Vector3d::Zero()});
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    BodyRecord& body = snapshot.bodies[model.joints[j].body];
    if (const auto s = place(system, state, j)) body.s = model.beam_of(model.joints[j]).curve.wrapped(*s);
    body.joint_force = joint_force(system, state, j);
  }
  snapshot.beams = record_beams(system, state);
  const SystemEnergy e = energy(system, state);
  snapshot.energy = {.kinetic = e.kinetic,
                     .gravity = e.gravity,
                     .axial = e.axial,
                     .bending = e.bending + e.torsion,
                     .total = e.mechanical()};
  return snapshot;
}

}  // namespace nurbeam
