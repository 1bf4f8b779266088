#pragma once
#include <optional>
#include <string>

class StepGeom_TrimmedCurve;

namespace nurbeam {

/// That an open B-spline with knots is trimmed at parameters beyond its ends, where OpenCASCADE cuts it off
/// without a word; nothing for other curves and pieces.
std::optional<std::string> trims_beyond_ends(const StepGeom_TrimmedCurve& trimmed);

}  // namespace nurbeam
