#pragma once
#include <algorithm>
#include <optional>

#include "fem/forces/load_at_place.h"
#include "fem/structure/beam.h"

namespace nurbeam {

/// Place of a load at time t [m]; nothing if the load has left the beam by more than round-off.
inline std::optional<double> place_of(const LoadAtPlace& load, const Beam& beam, double t) {
  const double s = load.s + load.speed * t, end = beam.curve.length(), round_off = 1e-12 * end;
  if (beam.is_ring()) return s;
  if (s < -round_off || s > end + round_off) return std::nullopt;
  return std::clamp(s, 0.0, end);
}

}  // namespace nurbeam
