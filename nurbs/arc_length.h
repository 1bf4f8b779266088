#pragma once
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Arc length s(u) of a rational cubic on [0,1] and its inverse, both to about 1e-14 of the length
/// (adaptive Gauss panels; Newton on the speed for the inverse; subdivision paper Eqs. 12-16).
class ArcLengthMap {
 public:
  /// Throws std::invalid_argument when the speed |r'(u)| vanishes on [0,1] (the value and place are named).
  explicit ArcLengthMap(const RationalCubic& cubic);

  double length() const { return panel_lengths_.back(); }
  /// s(u) [m]; u slightly outside [0,1] extrapolates.
  double arc_length(double u) const;
  /// u(s); s slightly outside [0, length] extrapolates.
  double parameter(double s) const;

 private:
  RationalCubic cubic_;
  std::vector<double> panel_breaks_;   // in u, from 0 to 1
  std::vector<double> panel_lengths_;  // cumulative s at each break
};

}  // namespace nurbeam
