#include "fem/forces/flow_force.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::flow_force_test {

constexpr double speed = 1.7;

template <int D>
BeamSystem running_beam(bool with_rider) {
  ModelBuilder builder(D);
  const int beam = add_bent_beam(builder, D);
  const double length = builder.beam(beam).curve.length();
  if (with_rider) builder.slide(builder.add_body("body", 0.8), beam, 0.43 * length).continuous_slope = false;
  builder.beam(beam).flow = speed;
  BeamModel model = builder.build();
  model.runs_at_rest = true;
  return BeamSystem(std::move(model));
}

// -1/2 rho v^2 of the integral of |r_s|^2, by many points.
template <int D>
double potential(const BeamSystem& system, const Eigen::VectorXd& q) {
  double sum = 0;
  for (const MeshElement<D>& e : system.assembly<D>()->elements()) {
    constexpr int parts = 400;
    const double start = e.span->start(q), length = (e.span->end(q) - start) / parts;
    for (int i = 0; i < parts; ++i) {
      const auto p =
          material_point(e, q, Eigen::VectorXd(Eigen::VectorXd::Zero(q.size())), start + (i + 0.5) * length);
      sum -= length * e.element.properties().mass_per_length * speed * speed / 2 * p.rs.squaredNorm();
    }
  }
  return sum;
}

// Its force is the slope of that potential, by places of moving nodes too.
template <int D>
void check_force(bool with_rider) {
  std::mt19937 random(1);
  const BeamSystem system = running_beam<D>(with_rider);
  const auto force = the_force<D, FlowForce<D>>(system);
  const State state = disturbed_state(system, random);
  const Eigen::VectorXd dynamics = force.dynamics(state);
  Eigen::VectorXd slopes(dynamics.size());
  for (int i = 0; i < slopes.size(); ++i) {
    constexpr double h = 1e-5;
    Eigen::VectorXd more = state.q, less = state.q;
    more[i] += h;
    less[i] -= h;
    slopes[i] = (potential<D>(system, more) - potential<D>(system, less)) / (2 * h);
  }
  EXPECT_LT((dynamics - slopes).lpNorm<Eigen::Infinity>(), 1e-4 * dynamics.lpNorm<Eigen::Infinity>());
}
TEST(FlowForce, IsTheSlopeOfRouthsPotential) {
  for (const bool with_rider : {false, true}) {
    check_force<2>(with_rider);
    check_force<3>(with_rider);
  }
}

template <int D>
void check_tangent() {
  std::mt19937 random(2);
  const BeamSystem system = running_beam<D>(false);
  expect_tangent(the_force<D, FlowForce<D>>(system), disturbed_state(system, random), random);
}
TEST(FlowForce, HasItsTangent) {
  check_tangent<2>();
  check_tangent<3>();
}

}  // namespace nurbeam::testing::flow_force_test
