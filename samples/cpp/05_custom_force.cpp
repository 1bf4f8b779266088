// A force that nurbeam does not know: a spring with a gap between a body and a point of a beam.
#include <cmath>
#include <cstdio>

#include "fem/model/build.h"
#include "fem/system/initial_state.h"
#include "nurbs/primitives.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"

using namespace nurbeam;

int main() {
  const double k = 400, mass = 0.5, gap = 0.1;  // [N/m], [kg], [m]
  ModelBuilder builder(2);
  const int bar =
      builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 2), Section::round(0.05),
                       {.youngs_modulus = 210e9, .density = 7850}, {.elements = 4});
  builder.clamp(bar, 0).clamp(bar, 1);
  const int ball = builder.add_body("ball", mass, {0.5, 0.3, 0});
  using Point = Grip;
  builder.add(CustomForce{{Point::on_body(ball), Point::on_beam(bar, 0.5)},
                          [=](double, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd&) {
                            const Eigen::Vector3d d = r.col(0) - r.col(1),
                                                  pull = k * (1 - gap / d.norm()) * d;
                            CustomForce::Response response;
                            response.force.resize(3, 2);
                            response.force << -pull, pull;
                            return response;  // its derivatives are taken by differences
                          }});
  const BeamSystem system(builder.build());
  State state = drawn_state(system);
  start_moving(system, state);
  if (make_accelerations_consistent(system, state) != ConsistencyStatus::done) return 1;

  // The bar hardly gives way: the ball swings about the spring's length, 0.2 m up and down.
  const double period = 2 * std::acos(-1.0) * std::sqrt(mass / k);
  GeneralizedAlphaIntegrator integrator({.rho_infinity = 0.9}, system, state);
  const int steps = 400, ball_y = system.mesh().bodies[ball] + 1;
  double lowest = 1;
  for (int i = 0; i < steps; ++i) {
    if (integrator.advance(period / 4 / steps).status != StepStatus::converged) return 1;
    lowest = std::min(lowest, integrator.state().q[ball_y]);
  }
  const double speed = std::abs(integrator.state().v[ball_y]), expected = 0.2 * std::sqrt(k / mass);
  std::printf("after a quarter of a period at %.5f m with %.5f m/s; a rigid bar: %.5f m, %.5f m/s\n", lowest,
              speed, gap, expected);
  return std::abs(speed / expected - 1) < 1e-3 && std::abs(lowest - gap) < 1e-3 ? 0 : 1;
}
