#include "fem/motion/record_frame.h"

namespace nurbeam {

namespace {

template <int D>
Eigen::Matrix4d control_points(const MeshElement<D>& e, const ElementVector<D>& q) {
  const auto [l, J_a, J_b] = e.element.chart_lengths(q);
  NodalCoordinates nodal = NodalCoordinates::Zero();
  for (int k = 0; k < 4; ++k) nodal.col(k).template head<D>() = q.template segment<D>(k * D);
  nodal.col(1) *= J_a;
  nodal.col(3) *= J_b;
  return to_bezier(nodal, e.element.bezier_weights(q), l).points();
}

template <int D>
ElementRecord record_element(const Beam& beam, const MeshElement<D>& e, const State& state) {
  const ElementVector<D> q = gather<D>(e, state.q, state.v, state.v).q;
  ElementRecord record;
  record.control_points = control_points<D>(e, q);
  record.s_start = q[4 * D];
  record.s_end = q[4 * D + 1];
  record.velocity.setZero();
  for (int i = 0; i < 4; ++i) {
    const double s = e.element.place(q, i / 3.0);
    const MaterialPoint<D> p = material_point<D>(e, state.q, state.v, s);
    const SectionForces carried =
        section_forces<D>(beam.properties, p.rs, p.rss, beam.straight ? 0 : p.kappa0, beam.curve.strain(s));
    record.strain[i] = carried.strain;
    record.curvature[i] = carried.curvature;
    record.axial_force[i] = carried.axial_force;
    record.bending_moment[i] = carried.bending_moment;
    record.velocity.col(i).template head<D>() = p.velocity;
  }
  return record;
}

template <int D>
BeamRecord record_beam(const BeamSystem<D>& system, const State& state, int b) {
  const Mesh<D>& mesh = system.mesh();
  const Beam& beam_model = system.model().beams[b];
  BeamRecord record;
  for (int i = mesh.first_element[b]; i < mesh.first_element[b + 1]; ++i)
    record.elements.push_back(record_element<D>(beam_model, mesh.elements[i], state));
  for (const MeshNode& node : mesh.nodes[b]) {
    record.node_positions.push_back(widened<D>(state.q, node.r));
    record.node_slopes.push_back(widened<D>(state.q, node.slope_left));
    record.node_s.push_back(node.place >= 0 ? beam_model.curve.wrapped(state.q[node.place]) : node.s);
  }
  record.length = system.beam_length(state, b);
  return record;
}

}  // namespace

template <int D>
std::vector<BeamRecord> record_beams(const BeamSystem<D>& system, const State& state) {
  std::vector<BeamRecord> records;
  for (std::size_t b = 0; b < system.model().beams.size(); ++b)
    records.push_back(record_beam<D>(system, state, static_cast<int>(b)));
  return records;
}

template <int D>
Frame record_frame(const BeamSystem<D>& system, const State& state, const std::vector<ProbePlace>& probes) {
  const BeamModel& model = system.model();
  const Mesh<D>& mesh = system.mesh();
  Frame frame;
  frame.time = state.t;
  for (const ProbePlace& probe : probes) {
    const auto& e = mesh.elements[find_element<D>(model, mesh, state.q, probe.beam, probe.s)];
    const MaterialPoint<D> p = material_point<D>(e, state.q, state.v, probe.s);
    frame.probes.push_back({widened<D>(p.r, 0), widened<D>(p.velocity, 0)});
  }
  frame.bodies.resize(model.bodies.size());
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const int r = mesh.joints[j].r, joint = static_cast<int>(j);
    std::optional<double> place = system.place(state, joint);
    if (place) place = model.beams[model.joints[j].beam].curve.wrapped(*place);
    frame.bodies[model.joints[j].body] = {
        {widened<D>(state.q, r), widened<D>(state.v, r)}, place, system.joint_force(state, joint)};
  }
  frame.beams = record_beams<D>(system, state);
  const SystemEnergy e = system.energy(state);
  frame.energy = {e.kinetic, e.gravity, e.axial, e.bending, 0, e.mechanical()};
  return frame;
}

template std::vector<BeamRecord> record_beams<2>(const BeamSystem<2>&, const State&);
template std::vector<BeamRecord> record_beams<3>(const BeamSystem<3>&, const State&);
template Frame record_frame<2>(const BeamSystem<2>&, const State&, const std::vector<ProbePlace>&);
template Frame record_frame<3>(const BeamSystem<3>&, const State&, const std::vector<ProbePlace>&);

}  // namespace nurbeam
