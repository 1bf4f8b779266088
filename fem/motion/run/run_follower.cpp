#include "fem/motion/run/run_follower.h"

namespace nurbeam {

double corresponding_place(const Beam& beam, double s, const Beam& neighbour) {
  const int h = beam.home_interval(s);
  const double part = (s - beam.home_place(h)) / beam.home_spacing(s);
  return (1 - part) * neighbour.home_place(h) + part * neighbour.home_place(h + 1);
}

Crossing corresponding_crossing(Crossing crossing, const BeamModel& model, const BeamModel& neighbour) {
  const int beam = model.riders[crossing.rider].beam;
  crossing.s = corresponding_place(model.beams[beam], crossing.s, neighbour.beams[beam]);
  return crossing;
}

}  // namespace nurbeam
