#pragma once
#include "fem/time_table.h"

namespace nurbeam {

/// The free strain: Green's axial strain against the drawing at which a section carries no axial force. A
/// beam has one if it is longer or shorter than drawn, or warmer. It is equal along the whole beam.
struct FreeStrain {
  double constant = 0;     ///< (lambda^2 - 1)/2 of the unstressed length over the drawn one, lambda
  TimeTable thermal = {};  ///< thermal expansion over time; empty: none
  /// Of a beam that carries the axial force S_0 as drawn; by Green's law -S_0/EA, and the energy is S_0 eps +
  /// EA eps^2/2, plus a constant. It is no load: State::load does not scale it.
  double of_tension = 0;

  double at(double t) const {
    return thermal.empty() ? constant : constant + value_and_slope(thermal, t).first;
  }
  bool operator==(const FreeStrain&) const = default;
  bool is_none() const { return constant == 0 && thermal.empty() && of_tension == 0; }
};

}  // namespace nurbeam
