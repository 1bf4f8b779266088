#pragma once
#include <string>
#include <vector>

#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// Whether a path of SVG has the curve exactly: no weights, and a degree of 3 at most.
bool is_exact_in_svg(const NurbsCurve& curve);

/// Curves of one plane as paths of SVG 1.1: lines and Bezier curves, others as cubics within 1e-6 of the size
/// of all. In a plane z = const x goes to the right and y up; in any other the direction nearest to z goes
/// up. Throws std::runtime_error for curves that lie in no plane.
std::string svg_text(const std::vector<NamedCurve>& curves, LengthUnit unit);

}  // namespace nurbeam
