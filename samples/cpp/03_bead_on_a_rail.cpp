// A heavy bead slides down a stiff quarter of a circle: at the bottom v^2 = 2 g R.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "fem/model/build.h"
#include "fem/motion/run/simulation.h"
#include "nurbs/primitives.h"

using namespace nurbeam;

int main() {
  const double R = 1, g = 9.81, pi = std::numbers::pi;
  ModelBuilder builder(2, {0, -g, 0});
  const ReferenceCurve quarter(arc_cubics({0, R, 0}, R, -pi, -pi / 2, 2), 2);  // from (-R, R) down to (0, 0)
  const int rail = builder.add_beam(quarter, Section::round(0.03), {.youngs_modulus = 210e9, .density = 7850},
                                    {.elements = 12});
  builder.clamp(rail, 0).clamp(rail, quarter.length());
  const int bead = builder.add_body("bead", 0.1);
  builder.slide(bead, rail, 0.01);  // a little below the top

  SimulationOptions options;
  options.end_time = 1;
  options.step = 2e-4;
  for (int i = 0; i <= 200; ++i) options.output_times.push_back(options.end_time * i / 200);
  double fastest = 0;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& s) {
    fastest = std::max(fastest, s.bodies[0].point.velocity.norm());
  };
  const SimulationReport report = simulate(builder.build(), {}, options, observer);

  const double expected = std::sqrt(2 * g * (R * std::cos(0.01 / R)));
  std::printf("reached t = %.3f s in %ld steps; fastest %.4f m/s, for a rigid rail %.4f m/s\n", report.time,
              report.steps, fastest, expected);
  return report.status == SimulationStatus::done && std::abs(fastest / expected - 1) < 5e-3 ? 0 : 1;
}
