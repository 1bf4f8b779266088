// A body that slides on a beam whose sections twist.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/element/twist_inertia.h"
#include "fem/motion/meshed_state.h"
#include "fem/system/assembly.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/verify.h"
#include "solver/consistent.h"
#include "solver/explicit_integrator.h"

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

/// The system with the inertia of the trolley's roll, which is its node's, and nothing else changed.
class WithRoll final : public SecondOrderSystem {
 public:
  WithRoll(const BeamSystem& system, double inertia) : system_(system), inertia_(inertia) {
    const auto& elements = system.assembly<3>()->elements();
    chart_ = elements[1].twist->element.chart(0);
    for (int d = 0; d < 3; ++d) dofs_[d] = elements[1].twist->dofs[TwistLayout::slope(0) + d];
    dofs_[3] = elements[1].twist->dofs[TwistLayout::angle(0)];
  }

  int coordinate_count() const override { return system_.coordinate_count(); }
  int constraint_count() const override { return system_.constraint_count(); }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    system_.residual(state, dynamics, constraints);
    const twist::NodeSpin<double> node = spin(state);
    twist::Reduced<double> force = twist::Reduced<double>::Zero();
    node.add_force(0, inertia_ * node.spin, inertia_ * node.rate, force);
    for (int i = 0; i < 4; ++i) dynamics[dofs_[i]] += force[where[i]];
  }
  Eigen::SparseMatrix<double> tangent_pattern() const override { return system_.tangent_pattern(); }
  void tangent(const State& state, const TangentWeights& w, Eigen::SparseMatrix<double>& kkt) const override {
    system_.tangent(state, w, kkt);
    const auto K = twist::spin_tangent({chart_, chart_}, Eigen::Vector3d(inertia_, 0, 0).asDiagonal(),
                                       part(state.q), part(state.v), part(state.a), w);
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) kkt.coeffRef(dofs_[i], dofs_[j]) += K(where[i], where[j]);
  }
  Eigen::VectorXd constraint_rate(const State& state) const override {
    return system_.constraint_rate(state);
  }
  Eigen::VectorXd constraint_curvature(const State& state) const override {
    return system_.constraint_curvature(state);
  }
  bool admissible(const State& state) const override { return system_.admissible(state); }
  Eigen::VectorXd coordinate_scale() const override { return system_.coordinate_scale(); }

  double kinetic_energy(const State& state) const {
    return energy(system_, state).kinetic + inertia_ * std::pow(spin(state).spin, 2) / 2;
  }
  double energy_of(const State& state) const {
    return energy(system_, state).mechanical() + inertia_ * std::pow(spin(state).spin, 2) / 2;
  }

 private:
  static constexpr std::array<int, 4> where{twist::slope_a, twist::slope_a + 1, twist::slope_a + 2,
                                            twist::angle_a};
  twist::Reduced<double> part(const Eigen::VectorXd& x) const {
    twist::Reduced<double> y = twist::Reduced<double>::UnitX();
    for (int i = 0; i < 4; ++i) y[where[i]] = x[dofs_[i]];
    y[twist::slope_b] = 1;  // of the other end, which has no inertia
    return y;
  }
  twist::NodeSpin<double> spin(const State& state) const {
    return {chart_, 0, part(state.q), part(state.v), part(state.a)};
  }

  const BeamSystem& system_;
  double inertia_;
  Eigen::Matrix3d chart_;
  std::array<int, 4> dofs_{};
};

VerifyResult node_over_a_rod_at_rest() {
  VerifyResult result;
  const double mass = 1e-12, speed = 3;
  const BeamSystem system(twisted_arc(mass, speed, {0, 0, 0}, AxialStrain::pointwise));
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
  WithRoll rolling;
  State state;

  explicit Ride(AxialStrain strain)
      : model(clamped(twisted_arc(0.7, 0.8, {0.3, -1.5, -2}, strain))),
        system(model),
        rolling(system, 0.02),
        state(drawn_state(system)) {
    start_moving(system, state);
    if (make_accelerations_consistent(rolling, state) != ConsistencyStatus::done)
      throw std::runtime_error("no accelerations");
  }
  static BeamModel clamped(BeamModel model) {
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
  const double start = ride.rolling.energy_of(ride.state);
  ExplicitIntegrator integrator(ExplicitRungeKutta{}, ride.rolling, ride.state);
  ride.go(integrator, 1e-4);
  const Vector3d exact(0.72688533, 0.65327391, -0.12949789),
      r = ride.state.q.segment<3>(ride.system.mesh().bodies[0]);
  result.add("place of the trolley [m]", 0.74169056, source, *place(ride.system, ride.state, 0), 2e-8);
  for (int i = 0; i < 3; ++i)
    result.add(std::string("trolley ") + "xyz"[i] + " [m]", exact[i], source, r[i], 2e-8);
  result.add("kinetic energy [J]", 0.5674, source, ride.rolling.kinetic_energy(ride.state), 6e-5);
  result.add("energy at the start [J]", 1.776351, source, start, 1e-6);
  result.add("change of energy [J]", 0, "nothing dissipates", ride.rolling.energy_of(ride.state) - start,
             1e-9);
  return result;
}

}  // namespace

std::vector<VerifyProblem> torsion_sliding_problems() {
  const std::string measures = "material, Green pointwise, as drawn, torsion";
  return {{"torsion-slide-at-rest", measures, node_over_a_rod_at_rest},
          {"torsion-ride", measures, ride_on_a_twisted_arc}};
}

}  // namespace nurbeam
