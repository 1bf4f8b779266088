#pragma once
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam {

/// The times [s] at which a table of the model, of a load, a brake, a motion or a temperature, has a row, or
/// a body is released: increasing. What is smooth between them need not be across: steps end there.
std::vector<double> kink_times(const BeamModel& model);

/// A prescribed motion whose speed jumps.
struct MotionKink {
  int joint;
  double before, after;  ///< ds/dt [m/s]
};
/// Those at one of the kink times.
std::vector<MotionKink> motion_kinks(const BeamModel& model, double time);

}  // namespace nurbeam
