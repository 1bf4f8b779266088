#pragma once
#include <vector>

#include "nurbs/bezier_path.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// A run of curves that meet end to end, as ordered and oriented.
struct Chain {
  std::vector<int> curves;     ///< indices into the input, in running order
  std::vector<bool> reversed;  ///< whether that curve is run through backwards
  bool closed = false;
};

/// Orders and orients curves whose end points coincide within `tolerance` [m] into maximal chains; a point
/// where three or more ends meet ends the chains there. A chain runs as the first of its curves in the input
/// does; an open one is turned where the curves at both its ends would then run backwards.
std::vector<Chain> find_chains(const std::vector<NurbsCurve>& curves, double tolerance);

/// The cubics of the curves of a chain one after another as one path (breaks: cumulative over the curves).
/// Where two ends do not quite meet both are moved to the point midway, end directions kept; `deviation`
/// includes the largest such shift.
BezierPath join(const std::vector<NurbsCurve>& curves, const Chain& chain, double tolerance);

}  // namespace nurbeam
