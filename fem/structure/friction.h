#pragma once
#include <optional>

#include "fem/time_table.h"

namespace nurbeam {

/// Friction of a body that slides along a beam.
struct Friction {
  /// The law for the jump of tension at a kink. Without a kink coulomb and capstan agree.
  enum class Law {
    coulomb,  ///< the coefficient times the force across the bisector of the tangents
    capstan,  ///< T2/T1 = exp(mu theta)
    bearing   ///< the coefficient times the whole force on the body, as of a pulley that turns on its axle
  };

  double coefficient = 0;                         ///< mu of sliding [-]
  std::optional<double> static_coefficient = {};  ///< coefficient of sticking, at least mu; default mu [-]
  Law law = Law::coulomb;
  /// F_c, the force of a brake or a seal over time [N]; empty: none.
  TimeTable force = {};
  /// Rows (travel [m], F [N]) of a brake that goes by the distance from the start of the body; empty: none.
  TimeTable force_over = {};
  double viscous = 0;    ///< force over sliding velocity [N s/m]
  double quadratic = 0;  ///< force over its square [N s^2/m^2]
  /// k [N/m]; default: EA/l of an element of the beam; on a guide that of a natural frequency of 100 Hz with
  /// the mass of the body.
  std::optional<double> stick_stiffness = {};

  double sticking_coefficient() const { return static_coefficient.value_or(coefficient); }
  /// Whether friction can hold a body at rest.
  bool can_stick() const { return sticking_coefficient() > 0 || !force.empty() || !force_over.empty(); }
  /// k of a body of this mass [kg] on a guide [N/m].
  static double stiffness_on_guide(double mass);
  /// Damping beside a stiffness k [N/m], for a body of this mass [kg] [N s/m].
  static double stick_damping(double stiffness, double mass);
};

}  // namespace nurbeam
