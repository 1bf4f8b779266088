#pragma once
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam {

/// Kink times [s], increasing: times at which a table of the model has a row (of a load, a brake or a
/// temperature), the speed or the acceleration of a motion by rows may jump, or a body is released. A moving
/// load that leaves its beam adds the last moment there and one beyond. Steps end there.
std::vector<double> kink_times(const BeamModel& model);

/// Times [s], increasing, of the other rows of motions, where only the third derivative jumps. Methods of
/// high order gain where steps end there.
std::vector<double> seam_times(const BeamModel& model);

/// End of a jump that begins at `time` [s]. It is the last of the times that follow within the resolution of
/// steps [s], if the times beyond are a hundred times as far; else `time` itself.
double end_of_jump(const std::vector<double>& times, double time, double resolution);

/// A prescribed motion whose speed jumps.
struct MotionKink {
  int rider;
  double before, after;  ///< ds/dt [m/s]
};
/// The motions whose speed jumps at one of the kink times.
std::vector<MotionKink> motion_kinks(const BeamModel& model, double time);
/// Whether the speed of a moved support jumps at a time.
bool support_speed_jumps(const BeamModel& model, double time);

}  // namespace nurbeam
