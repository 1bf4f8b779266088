#pragma once
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam {

/// The times [s] at which a table of the model, of a load, a brake, a motion or a temperature, has a row, a
/// body is released, or a load that moves leaves its beam (the last moment there and one beyond): increasing.
/// What is smooth between them need not be across: steps end there.
std::vector<double> kink_times(const BeamModel& model);

/// Where a jump ends that begins at a moment: at the last of the times that follow within the resolution of
/// steps [s], if those beyond are a hundred times as far; else at once.
double end_of_jump(const std::vector<double>& times, double time, double resolution);

/// A prescribed motion whose speed jumps.
struct MotionKink {
  int rider;
  double before, after;  ///< ds/dt [m/s]
};
/// Those at one of the kink times.
std::vector<MotionKink> motion_kinks(const BeamModel& model, double time);

}  // namespace nurbeam
