#include "pipelines/papers/pendulum_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "fem/element/rancf_basis.h"
#include "fem/element/subdivision.h"
#include "fem/model/build.h"
#include "pipelines/papers/papers.h"
#include "pipelines/papers/raised_arc.h"

namespace nurbeam {

namespace {

using Eigen::Vector3d;

constexpr double radius = 0.5, half_angle = std::numbers::pi / 6;  // [m], [rad]
const Vector3d end_B = arc_end(radius, half_angle);

}  // namespace

RationalCubic pendulum_axis(PendulumArc arc) {
  if (arc == PendulumArc::uniform) return raised_arc(radius, half_angle, 1);
  if (arc == PendulumArc::extreme) return raised_arc(radius, half_angle, 1.0 / 4);
  NodalCoordinates e = NodalCoordinates::Zero();
  e.col(1) << 0.667185831, 0, 0;
  e.col(2) = end_B;
  e.col(3) << 0.68333751, 1.18361, 0;
  return to_bezier(e, {1, 1.08621103, 0.98905339, 1}, radius * 2 * half_angle);
}

BeamProperties pendulum_section(double thinner) {
  constexpr double section_radius = 0.02, density = 6000, E = 2e6,
                   area = std::numbers::pi * section_radius * section_radius;
  BeamProperties section{E * area * thinner * thinner, E * area * section_radius * section_radius / 4,
                         density * area};
  section.axial_strain = AxialStrain::pointwise;  // as in [S]
  return section;
}

BeamModel pendulum_model(const PendulumMesh& mesh) {
  const RationalCubic axis = pendulum_axis(mesh.arc);
  const ReferenceCurve drawn({axis}, 2);
  Beam beam{.name = "arc",
            .curve = ReferenceCurve({axis}, 2, mesh.metric ? Metric::arc_length : Metric::label),
            .properties = pendulum_section(mesh.thinner),
            .weights = mesh.ancf ? WeightRule::ones : WeightRule::material,
            .home = home_nodes({0, drawn.length()}, {mesh.elements}, mesh.grading)};
  beam.properties.curvature = mesh.curvature;
  for (HomeNode& node : beam.home) node.s = beam.curve.arc_length(0, drawn.parameter(0, node.s));
  beam.home.back().s = beam.curve.length();
  ModelBuilder builder(2, {0, -9.81, 0});
  builder.pin(builder.add_beam(std::move(beam)), 0);
  return builder.build();
}

PendulumMotion pendulum_motion(const PendulumMesh& mesh, const IntegratorSettings& integrator, double step,
                               int intervals) {
  const BeamModel model = pendulum_model(mesh);
  SimulationOptions options;
  options.end_time = 1;
  options.step = step;
  options.integrator = integrator;
  for (int i = 0; i <= intervals; ++i) options.output_times.push_back(static_cast<double>(i) / intervals);
  PendulumMotion motion;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) {
    const Vector3d b = frame.probes[0].position;
    motion.t.push_back(frame.time);
    motion.AB.push_back(b.norm());
    motion.fall.push_back(b.y() - end_B.y());
    motion.length.push_back(frame.beams[0].length);
    motion.beam.push_back(frame.beams[0]);
  };
  motion.report = simulate(model, {{0, model.beams[0].curve.length()}}, options, observer);
  return motion;
}

PendulumMotion extrapolated_pendulum_motion(const PendulumMesh& mesh, double step, int intervals) {
  const GeneralizedAlpha method{.rho_infinity = 0.9};
  const PendulumMotion coarse = pendulum_motion(mesh, method, step, intervals);
  PendulumMotion fine = pendulum_motion(mesh, method, step / 2, intervals);
  const std::size_t n = std::min(coarse.t.size(), fine.t.size());
  for (auto* values : {&fine.t, &fine.AB, &fine.fall, &fine.length}) values->resize(n);
  fine.beam.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    fine.AB[i] += (fine.AB[i] - coarse.AB[i]) / 3;
    fine.fall[i] += (fine.fall[i] - coarse.fall[i]) / 3;
    fine.length[i] += (fine.length[i] - coarse.length[i]) / 3;
  }
  return fine;
}

PendulumError largest_difference(const PendulumMotion& a, const PendulumMotion& b) {
  PendulumError error{0, 0};
  const auto larger = [](double so_far, double x) {
    return std::isfinite(x) ? std::max(so_far, x) : HUGE_VAL;
  };
  for (std::size_t i = 0; i < std::min(a.t.size(), b.t.size()); ++i) {
    error.AB = larger(error.AB, std::abs(a.AB[i] - b.AB[i]));
    error.fall = larger(error.fall, std::abs(a.fall[i] - b.fall[i]));
  }
  return error;
}

}  // namespace nurbeam
