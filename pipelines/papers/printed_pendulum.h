#pragma once
#include <vector>

#include "fem/comparison/printed_element.h"
#include "pipelines/papers/pendulum_motion.h"

namespace nurbeam {

/// The pendulum of [S] as printed: elements by Eqs. 3-6 and 17-19, motion by Eqs. 20-24 and RK4. It shares no
/// formula of mechanics with the other runs but the law of the section.
struct PrintedPendulum {
  PendulumArc arc = PendulumArc::uniform;
  int elements = 8;
  double grading = 0;  ///< k of Eq. 17 [m]
  PrintedCurvature curvature = PrintedCurvature::second_derivative;
  double step = 5e-4;  ///< [s]
  int panels = 1;      ///< of the quadrature of each element
  bool ancf = false;   ///< all weights 1, nodes and directions as drawn
};

/// A motion over 1 s at every 0.01 s; shorter where it lost all bounds.
struct PrintedMotion {
  std::vector<double> t, AB, fall;  ///< as PendulumMotion
  double energy_departure = 0;      ///< the largest at any step [J]
  bool complete() const { return t.size() == 101; }
};
PrintedMotion printed_pendulum_motion(const PrintedPendulum& pendulum);

/// The largest difference in |AB| over the times that both motions have [m].
double largest_difference_in_AB(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace nurbeam
