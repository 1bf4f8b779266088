#pragma once
#include "fem/motion/record/snapshot.h"
#include "fem/structure/measure.h"

namespace nurbeam {

/// Sag of a part of a beam, or clearance of a beam, in a state [m], and the place that has it: of a sag the
/// lowest below the chord (0 where nothing is), of a clearance the lowest above the profile (negative below
/// it). NaN without gravity, where a chord is upright, and where no place of the beam is over the profile. A
/// place is over the profile's nearest point in plan, if that is no end which it lies beyond. Of a ring its
/// number (AtRing) and the place that is in it; NaN after it has let go. Of what turns its number alone
/// (OfTurn).
Extreme record_measure(const BeamSystem& system, const State& state, const Measure& measure);

}  // namespace nurbeam
