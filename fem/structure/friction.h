#pragma once
#include <optional>

#include "fem/time_table.h"

namespace nurbeam {

/// What resists a body that slides along a beam.
struct Friction {
  /// What bounds the jump of tension at a kink; without a kink they are one.
  enum class Law {
    coulomb,  ///< the coefficient times the force across the bisector of the tangents
    capstan   ///< T2/T1 = exp(mu theta)
  };

  double coefficient = 0;                         ///< mu of sliding [-]
  std::optional<double> static_coefficient = {};  ///< at least mu; mu where there is none [-]
  Law law = Law::coulomb;
  TimeTable force = {};                        ///< F_c: of a brake or a seal, over time [N]; empty: none
  double viscous = 0;                          ///< force over sliding velocity [N s/m]
  std::optional<double> stick_stiffness = {};  ///< k [N/m]; without one that of stick_frequency

  double sticking_coefficient() const { return static_coefficient.value_or(coefficient); }
  /// Whether it can hold a body at rest.
  bool can_stick() const { return sticking_coefficient() > 0 || !force.empty(); }
  /// k [N/m] for a body of that mass [kg], and the damping d [N s/m] beside it.
  double stiffness(double mass) const;
  double stick_damping(double mass) const;
};

}  // namespace nurbeam
