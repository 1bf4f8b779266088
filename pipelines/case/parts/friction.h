#pragma once
#include "fem/structure/friction.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

inline Fields<Friction> friction_fields() {
  using namespace shapes;
  using F = Friction;
  const Range coefficient{.lower = 0, .upper = 10, .reason = "a coefficient of friction has no unit"};
  return {{
      field(&F::coefficient, "coefficient", quantity(Dimension::number, coefficient),
            "of sliding: friction over the force across the beam")
          .otherwise("0"),
      field(&F::static_coefficient, "static", quantity(Dimension::number, coefficient),
            "the same of a body that sticks, at least `coefficient`; `coefficient` when omitted"),
      choice_field(
          &F::law, "law",
          {{"coulomb", F::Law::coulomb}, {"capstan", F::Law::capstan}, {"bearing", F::Law::bearing}},
          "at a slope discontinuity: coulomb: of the force across the bisector, up to a wrap of 120 "
          "degrees; capstan: tensions of up to exp(coefficient times angle); bearing: of the whole force on "
          "the body, as of a pulley on its axle")
          .otherwise("coulomb"),
      field(&F::force, "force", constant_or_table(Dimension::force, plausible(0, 1e12)),
            "of a brake or a seal, whatever presses on the beam, or that over time")
          .otherwise("0"),
      field(
          &F::force_over, "force_over",
          rows_over("travel", Dimension::length, Dimension::force, plausible(0, 1e12)),
          "of a brake, by the distance of the body from its start: rows of travel and force, linear between "
          "rows, constant outside"),
      field(&F::viscous, "viscous", quantity(Dimension::damping, plausible(0, 1e16)),
            "force over sliding velocity")
          .otherwise("0"),
      field(&F::quadratic, "quadratic", quantity(Dimension::drag, plausible(0, 1e16)),
            "force over the square of the sliding velocity, as of a water brake")
          .otherwise("0"),
      field(&F::stick_stiffness, "stick_stiffness",
            quantity(Dimension::force_per_length, plausible(1e-9, 1e16)),
            "of a body that sticks; when omitted EA over the length of an element of the beam, on a rigid "
            "curve that with which the body vibrates at 100 Hz"),
  }};
}

}  // namespace nurbeam
