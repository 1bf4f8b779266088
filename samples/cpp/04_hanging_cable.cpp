// A cable drawn as an arc hangs between two points that are nearer than it is long: the catenary.
#include <cmath>
#include <cstdio>

#include "fem/model/build.h"
#include "fem/motion/run/simulation.h"
#include "nurbs/primitives.h"

using namespace nurbeam;

// Half the sag parameter a of cosh: 2 a sinh(span / 2a) = length.
double catenary_sag(double span, double length) {
  double low = span / 20, high = 100 * span;
  for (int i = 0; i < 200; ++i) {
    const double a = (low + high) / 2;
    (2 * a * std::sinh(span / (2 * a)) > length ? low : high) = a;
  }
  return low * (std::cosh(span / (2 * low)) - 1);
}

// Half the angle of the circular arc of that length over that span [rad].
double half_angle(double span, double length) {
  double low = 1e-3, high = 3;
  for (int i = 0; i < 60; ++i)
    (std::sin((low + high) / 2) / (low + high) * 2 > span / length ? low : high) = (low + high) / 2;
  return low;
}

int main() {
  const double span = 10, length = 12, angle = half_angle(span, length), R = length / (2 * angle),
               pi = std::acos(-1.0);
  // Drawn as an arc; the cable itself is straight when nothing pulls at it.
  const ReferenceCurve arc(arc_cubics({0, 0, 0}, R, -pi / 2 - angle, -pi / 2 + angle, 4), 2);
  ModelBuilder builder(2, {0, -9.81, 0});
  const int cable = builder.add_beam(arc.straightened(), Section::round(2e-3),
                                     {.youngs_modulus = 20e9, .density = 7850}, {.elements = 64});
  builder.pin(cable, 0).pin(cable, arc.length());
  const double height = arc.position(0).y();

  SimulationOptions options;
  options.statics = true;
  double sag = 0;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& s) { sag = height - s.probes[0].position.y(); };
  const SimulationReport report = simulate(builder.build(), {{cable, length / 2}}, options, observer);
  std::printf("the cable sags %.4f m; a catenary %.4f m\n", sag, catenary_sag(span, length));
  return report.status == SimulationStatus::done && std::abs(sag / catenary_sag(span, length) - 1) < 2e-3 ? 0
                                                                                                          : 1;
}
