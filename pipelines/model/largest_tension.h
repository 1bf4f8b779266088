#pragma once
#include "fem/model/beam_model.h"

namespace nurbeam {

/// A tension that a beam of a model cannot exceed at rest [N], by a rough upper bound. All forces and weights
/// of the model may pull along the beam, and bend it across, by which it becomes longer: it is then taut as
/// if its ends could not come nearer. Infinite where supports move.
double largest_tension(const BeamModel& model, int beam);

}  // namespace nurbeam
