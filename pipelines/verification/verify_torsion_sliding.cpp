// A body that slides on a beam whose sections twist.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/verify.h"
#include "solver/steps/explicit_integrator.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
using std::numbers::pi;

/// A quarter circle with twisted sections, a body on the node at 30 degrees.
BeamModel twisted_arc(double mass, double speed, const Vector3d& gravity, AxialStrain strain) {
  const ReferenceCurve arc(arc_cubics({0, 0, 0}, 1, 0, pi / 2, 1), 3);
  const double L = arc.length();
  BeamProperties properties(2000, 0, 1);
  properties.sections = SectionStiffness{1, 2, 0, 0.8, 0.004};  // d2 is the reference's d1
  properties.axial_strain = strain;
  ModelBuilder builder(3, gravity);
  builder.add_beam(arc.oriented({Orientation::Rule::start, Vector3d::UnitZ(), {{0, 0}, {L, 1.2 * L}}}),
                   properties, {3});
  builder.slide(builder.add_body("trolley", mass), 0, L / 3, speed);
  return builder.build();
}

VerifyResult node_over_a_rod_at_rest() {
  VerifyResult result;
  const double mass = 1e-12, speed = 3;
  BeamModel model = twisted_arc(mass, speed, {0, 0, 0}, AxialStrain::pointwise);
  const double start = model.riders[0].s;
  model.riders[0].motion = TimeTable{{0, start}, {1, start + speed}};  // else it is too light to be a node
  const BeamSystem system(noted(model));
  State state = drawn_state(system);
  start_moving(system, state);
  const SystemEnergy at = energy(system, state);
  result.add("kinetic energy of the rod [J]", 0, "it is at rest", at.kinetic - mass * speed * speed / 2,
             1e-24);
  result.add("strain energy [J]", 0, "it is as drawn", at.axial + at.bending + at.torsion, 1e-24);
  return result;
}

/// A trolley that rolls with its node, on the arc clamped at its start.
struct Ride {
  static constexpr double end = 0.4;
  BeamModel model;
  BeamSystem system;
  State state;

  explicit Ride(AxialStrain strain)
      : model(clamped(twisted_arc(0.7, 0.8, {0.3, -1.5, -2}, strain))),
        system(noted(model)),
        state(drawn_state(system)) {
    start_moving(system, state);
    if (make_accelerations_consistent(system, state) != ConsistencyStatus::done)
      throw std::runtime_error("no accelerations");
  }
  static BeamModel clamped(BeamModel model) {
    model.bodies[0].roll_inertia = 0.02;
    model.riders[0].follows_section = true;
    model.constraints.push_back(Support{0, 0, true, false, {}});
    mark_held_nodes(model);
    return model;
  }

  void go(Integrator& integrator, double step) {
    for (int i = 0; i < static_cast<int>(std::round(end / step)); ++i)
      if (integrator.advance(step).status != StepStatus::converged) throw std::runtime_error("a step failed");
    state = integrator.state();
  }
};

VerifyResult ride_on_a_twisted_arc() {
  VerifyResult result;
  const std::string source = "the same elements, Runge-Kutta";
  Ride ride(AxialStrain::pointwise);
  const double start = energy(ride.system, ride.state).mechanical();
  ExplicitIntegrator integrator(ExplicitRungeKutta{}, ride.system, ride.state);
  ride.go(integrator, 1e-4);
  const Vector3d exact(0.72688533, 0.65327391, -0.12949789),
      r = ride.state.q.segment<3>(ride.system.mesh().bodies[0]);
  result.add("place of the trolley [m]", 0.74169056, source, *place(ride.system, ride.state, 0), 2e-8);
  for (int i = 0; i < 3; ++i)
    result.add(std::string("trolley ") + "xyz"[i] + " [m]", exact[i], source, r[i], 2e-8);
  result.add("kinetic energy [J]", 0.5674, source, energy(ride.system, ride.state).kinetic, 6e-5);
  result.add("energy at the start [J]", 1.776351, source, start, 1e-6);
  result.add("change of energy [J]", 0, "nothing dissipates",
             energy(ride.system, ride.state).mechanical() - start, 1e-9);
  return result;
}

}  // namespace

std::vector<VerifyProblem> torsion_sliding_problems() {
  const std::string measures = "material, Green pointwise, as drawn, torsion";
  return {{"torsion-slide-at-rest", measures, node_over_a_rod_at_rest},
          {"torsion-ride", measures, ride_on_a_twisted_arc}};
}

}  // namespace nurbeam
