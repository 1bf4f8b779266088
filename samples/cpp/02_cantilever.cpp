// A steel wire, held at one end, under a weight at the other: F L^3 / (3 E I), as long as it is small.
#include <cmath>
#include <cstdio>

#include "fem/model/build.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "nurbs/primitives.h"
#include "solver/rest/static_equilibrium.h"

using namespace nurbeam;

int main() {
  const double L = 0.5, F = 1e-3;  // [m], [N]
  const Section wire = Section::round(1e-3);
  const Material steel{.youngs_modulus = 210e9, .density = 7850};

  ModelBuilder builder(2);
  const int beam =
      builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {L, 0, 0})}, 2), wire, steel, {.elements = 8});
  builder.clamp(beam, 0).force(beam, L, {0, -F, 0});
  const BeamSystem system(builder.build());
  State state = drawn_state(system);
  const StaticReport found = find_static_equilibrium({}, system, state);

  const double sag = -material_point(system, state, beam, L).r.y();
  const double expected = F * L * L * L / (3 * steel.youngs_modulus * wire.second_moment);
  std::printf("the tip sinks %.9e m; linear theory: %.9e m\n", sag, expected);
  return found.status == StaticStatus::converged && std::abs(sag / expected - 1) < 1e-6 ? 0 : 1;
}
