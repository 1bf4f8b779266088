#pragma once
#include "nurbs/curve_chain.h"
#include "nurbs/nurbs_curve.h"

namespace nurbeam {

struct JoinedCurve {
  NurbsCurve curve;
  double gap = 0;  ///< the widest between two ends [m], which both were moved midway
};

/// The curves of a chain as one curve of the highest of their degrees: exactly, but for the gaps. Its knots
/// are full where they meet and in those of lower degree; each keeps its parameters up to a shift.
JoinedCurve joined_curve(const std::vector<NurbsCurve>& curves, const Chain& chain);

/// The same curve with every coordinate in place of the affine map's (which may mirror it).
NurbsCurve moved_curve(const NurbsCurve& curve, const Eigen::Matrix<double, 3, 4>& map);

}  // namespace nurbeam
