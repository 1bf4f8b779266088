#pragma once
#include <optional>

#include "fem/time_table.h"

namespace nurbeam {

/// Friction of a body that slides along a beam.
struct Friction {
  /// The law for the jump of tension at a kink; without a kink both laws agree.
  enum class Law {
    coulomb,  ///< the coefficient times the force across the bisector of the tangents
    capstan   ///< T2/T1 = exp(mu theta)
  };

  double coefficient = 0;                         ///< mu of sliding [-]
  std::optional<double> static_coefficient = {};  ///< coefficient of sticking, at least mu; default mu [-]
  Law law = Law::coulomb;
  /// F_c, the force of a brake or a seal over time [N]; empty: none.
  TimeTable force = {};
  double viscous = 0;  ///< force over sliding velocity [N s/m]
  /// k [N/m]; default: a natural frequency of 100 Hz with the mass of the body.
  std::optional<double> stick_stiffness = {};

  double sticking_coefficient() const { return static_coefficient.value_or(coefficient); }
  /// Whether friction can hold a body at rest.
  bool can_stick() const { return sticking_coefficient() > 0 || !force.empty(); }
  /// Stiffness k [N/m] for a body of this mass [kg], and the damping d [N s/m] beside it.
  double stiffness(double mass) const;
  double stick_damping(double mass) const;
};

}  // namespace nurbeam
