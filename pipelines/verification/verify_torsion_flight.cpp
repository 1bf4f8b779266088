// A beam in space whose sections twist, in free flight: against the same elements by Runge-Kutta.

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/motion/remesh/recentring.h"
#include "fem/system/assembly.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "pipelines/verification/noted.h"
#include "pipelines/verification/rod_models.h"
#include "pipelines/verification/verify.h"
#include "solver/steps/explicit_integrator.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using namespace verification;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using Rule = Orientation::Rule;

/// A quarter circle with twisted sections that is thrown, turning by 7 rad in 0.8 s.
struct Flight {
  MeshedState at;
  int recentrings = 0;

  Flight() {
    const ReferenceCurve arc(arc_cubics({0, 0, 0}, 1, 0, pi / 2, 1), 3);
    const double L = arc.length();
    BeamProperties properties = Rod{2000, 2, 1, 0, 0.8}.properties();
    properties.sections->spin_inertia = 0.004;
    properties.axial_strain = AxialStrain::pointwise;
    ModelBuilder builder(3);
    builder.add_beam(arc.oriented({Rule::start, Vector3d::UnitZ(), {{0, 0}, {L, 1.2 * L}}}), properties, {2});
    at = MeshedState::drawn(std::make_shared<const BeamModel>(noted(builder.build())));
    const Vector3d w(6, -4, 5);
    int k = 0;
    for (const MeshNode& node : at.system->mesh().nodes[0]) {
      const Vector3d rs = at.state.q.segment<3>(node.slope_left);
      at.state.v.segment<3>(node.r) = w.cross(Vector3d(at.state.q.segment<3>(node.r)));
      at.state.v.segment<3>(node.slope_left) = w.cross(rs);
      at.state.v[node.angle_left] = w.dot(rs.normalized()) + 3 * k++;
    }
  }

  void fly(double end, double step, bool explicitly) {
    std::unique_ptr<Integrator> integrator = start(explicitly);
    while (at.state.t < end - step / 2) {
      if (integrator->advance(step).status != StepStatus::converged)
        throw std::runtime_error("a step failed");
      at.state = integrator->state();
      if (!recentring_due(*at.system, at.state)) continue;
      at = recentred(*at.system, at.state);
      ++recentrings;
      integrator = start(explicitly);
    }
  }
  std::unique_ptr<Integrator> start(bool explicitly) {
    if (make_accelerations_consistent(*at.system, at.state) != ConsistencyStatus::done)
      throw std::runtime_error("no accelerations");
    if (explicitly) return std::make_unique<ExplicitIntegrator>(ExplicitRungeKutta{}, *at.system, at.state);
    return std::make_unique<GeneralizedAlphaIntegrator>(
        GeneralizedAlpha{.rho_infinity = 0.9, .newton_tolerance = 1e-13}, *at.system, at.state);
  }

  double energy() const { return nurbeam::energy(*at.system, at.state).mechanical(); }
  Vector3d start_point() const { return at.state.q.segment<3>(at.system->mesh().nodes[0][0].r); }
  /// About the origin [kg m^2/s]: by the rotations of all nodes, which turn the angle by w . (t + m)/(1 + t .
  /// m).
  Vector3d angular_momentum() const {
    Eigen::SparseMatrix<double> kkt = tangent_matrix(*at.system, at.state, {.mass = 1});
    const VectorXd p = kkt * at.state.v;
    Vector3d sum = Vector3d::Zero();
    const auto& nodes = at.system->mesh().nodes[0];
    const auto& elements = at.system->assembly<3>()->elements();
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const MeshNode& node = nodes[i];
      const auto part = [&](const VectorXd& x, int first) -> Vector3d { return x.segment<3>(first); };
      const Vector3d t = part(at.state.q, node.slope_left).normalized();
      const TwistElement& element = elements[std::min(i, elements.size() - 1)].twist->element;
      const Vector3d m = element.chart(i < elements.size() ? 0 : 1).col(2);
      for (const int first : {node.r, node.slope_left}) sum += part(at.state.q, first).cross(part(p, first));
      sum += p[node.angle_left] * (t + m) / (1 + t.dot(m));
    }
    return sum;
  }
};

VerifyResult free_flight() {
  VerifyResult result;
  const double end = 0.8;
  const Vector3d exact(-2.622729899, 3.134903344, 5.398534461);
  const std::string source = "the same elements, Runge-Kutta";
  Flight flight;
  const double energy = flight.energy();
  const Vector3d angular_momentum = flight.angular_momentum();
  flight.fly(end, 2e-4, true);
  result.add("exchanges of charts, at least", 1, "it turns by 7 rad", flight.recentrings, 0);
  result.rows.back().at_least = true;
  for (int i = 0; i < 3; ++i)
    result.add(std::string("start ") + "xyz"[i] + " [m]", exact[i], source, flight.start_point()[i], 2e-9);
  const Vector3d d1 = section_point(*flight.at.system, flight.at.state, 0, 0).triad.d2;
  result.add("section at the start, x", 0.32490696, source, d1.x(), 2e-8);
  result.add("section at the start, y", -0.81585570, source, d1.y(), 2e-8);
  result.add("energy [J]", 52.0896, source, energy, 5e-5);
  result.add("change of energy [J]", 0, "nothing dissipates", flight.energy() - energy, 1e-8);
  result.add("change of angular momentum [kg m^2/s]", 0, "no force acts",
             (flight.angular_momentum() - angular_momentum).norm(), 1e-8);
  ConvergenceTable table{"the start [m], generalized-alpha", "step [s]", {}};
  for (const double step : {2e-4, 1e-4, 5e-5}) {
    Flight again;
    again.fly(end, step, false);
    table.rows.emplace_back(step, (again.start_point() - exact).norm());
  }
  result.add(std::move(table), 2, 0.1, "second order, exchanges of charts or not");
  return result;
}

}  // namespace

std::vector<VerifyProblem> torsion_flight_problems() {
  return {{"torsion-flight", "material, Green pointwise, as drawn, torsion", free_flight}};
}

}  // namespace nurbeam
