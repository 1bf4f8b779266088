#pragma once
#include <algorithm>
#include <optional>

#include "fem/forces/load_at_place.h"
#include "fem/structure/beam.h"

namespace nurbeam {

/// Place of a load at time t [m]; nothing if the load has left the beam by more than round-off.
inline std::optional<double> place_of(const LoadAtPlace& load, const Beam& beam, double t) {
  const double start = beam.curve.start(), end = beam.curve.end();
  const double s = load.s + load.speed * t, round_off = 1e-12 * beam.curve.length();
  if (beam.is_ring()) return s;
  if (s < start - round_off || s > end + round_off) return std::nullopt;
  return std::clamp(s, start, end);
}

}  // namespace nurbeam
