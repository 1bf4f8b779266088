#include "fem/motion/run_follower.h"

namespace nurbeam {

double corresponding_place(const Beam& beam, double s, const Beam& neighbour) {
  const int h = beam.home_interval(s);
  const double part = (s - beam.home_place(h)) / beam.home_spacing(s);
  return (1 - part) * neighbour.home_place(h) + part * neighbour.home_place(h + 1);
}

}  // namespace nurbeam
