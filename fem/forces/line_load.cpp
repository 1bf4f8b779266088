#include "fem/forces/line_load.h"

namespace nurbeam {

Eigen::Vector3d LineLoad::per_length(int on_beam, double t) const {
  if (on_beam != beam) return Eigen::Vector3d::Zero();
  return value_and_slope(time, t).first * value;
}

}  // namespace nurbeam
