// What the momenta of a free beam, on which a body slides, do that nothing acts on.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "fem/model/build.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/beam_system.h"
#include "nurbs/primitives.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {
namespace {

struct Momenta {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = Eigen::Vector3d::Zero();
};

// p = M v; a rotation turns positions and slopes.
Momenta momenta_of(const BeamSystem& system, const State& state) {
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {.mass = 1});
  const Eigen::VectorXd p =
      (kkt *
       (Eigen::VectorXd(kkt.rows()) << state.v, Eigen::VectorXd::Zero(system.constraint_count())).finished())
          .head(system.coordinate_count());
  const int D = system.dimension();
  const auto part = [&](const Eigen::VectorXd& x, int first) {
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    vector.head(D) = x.segment(first, D);
    return vector;
  };
  Momenta sum;
  std::vector<bool> seen(p.size(), false);
  const auto add = [&](int first, bool position) {
    if (seen[first]) return;
    seen[first] = true;
    if (position) sum.linear += part(p, first);
    sum.angular += part(state.q, first).cross(part(p, first));
  };
  for (const auto& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) {
      add(node.r, true);
      add(node.slope_left, false);
      add(node.slope_right, false);
    }
  for (const int body : system.mesh().bodies) add(body, true);
  return sum;
}

// A bar of 1 m that flies, turns and is bent by it; with a body that slides along it.
BeamModel flying(int dimension, bool with_body) {
  ModelBuilder builder(dimension);
  const int beam = builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, dimension),
                                    BeamProperties(2000, 0.5, 1), {8});
  builder.beam(beam).velocity = BeamVelocity{.translation = {1, 0.5, 0}, .rotation = {0, 0, 3}, .along = 0.2};
  if (with_body) {
    const int body = builder.add_body("m", 0.3);
    builder.slide(body, beam, 0.3, 0.4);
  }
  return builder.build();
}

// Momenta at the end less those at the start.
Momenta flight_drift(const BeamModel& model, const SimulationOptions& options) {
  std::vector<Checkpoint> points;
  SimulationObserver observer;
  observer.checkpoint_due = [&] { return points.empty(); };
  observer.checkpoint = [&](const Checkpoint& point) { points.push_back(point); };
  const SimulationReport report = simulate(model, {}, options, observer);
  EXPECT_EQ(report.status, SimulationStatus::done);
  const auto at = [&](const Checkpoint& point) {
    return momenta_of(BeamSystem(model, point.plan), point.state);
  };
  const Momenta start = at(points.front()), end = at(points.back());
  return {end.linear - start.linear, end.angular - start.angular};
}

SimulationOptions to_half_a_second() {
  SimulationOptions options;
  options.end_time = 0.5;
  options.output_times = {0.5};
  return options;
}

TEST(FreeFlight, WithoutBodiesLinearMomentumIsKeptToRoundOff) {
  for (const int dimension : {2, 3}) {
    SimulationOptions options = to_half_a_second();
    options.step = 2e-3;
    EXPECT_LT(flight_drift(flying(dimension, false), options).linear.norm(), 1e-11);
  }
}

// What error control costs: docs/troubleshooting.md has these numbers.
TEST(FreeFlight, WithABodyMomentaDriftWithTheTolerance) {
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    SimulationOptions options = to_half_a_second();
    options.integrator = GeneralizedAlpha{.tolerance = tolerance};
    const Momenta with = flight_drift(flying(2, true), options),
                  without = flight_drift(flying(2, false), options);
    EXPECT_LT(without.linear.norm(), 1e-13);
    EXPECT_LT(with.linear.norm(), 0.1 * tolerance);
    for (const Momenta& momenta : {with, without}) EXPECT_LT(momenta.angular.norm(), tolerance);
  }
}

}  // namespace
}  // namespace nurbeam
