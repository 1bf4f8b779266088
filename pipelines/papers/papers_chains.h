#pragma once
#include "pipelines/papers/papers_run.h"

namespace nurbeam::papers {

/// Chains of CAD segments with tangent-continuous joints where the curvature jumps, hung at both ends, with
/// the section and the body of Example 3, stress-free as drawn.

/// 1 m of line, a quarter circle of radius 1 m, 1 m of line; the body starts 0.3 m from the left end.
Example line_arc_line_example();
/// 1 m of line, a quarter circle of radius 1 m, a cubic spline of varying curvature; the same start.
Example line_arc_spline_example();
/// line_arc_line with a body that starts 0.2 m before the first joint, passes both, turns about 0.2 m behind
/// the second and comes back over it.
Example reversing_example();

}  // namespace nurbeam::papers
