#pragma once

class StepGeom_TrimmedCurve;

namespace nurbeam {

/// Makes a piece of pieces (TRIMMED_CURVE of TRIMMED_CURVE) one of the curve below, in its parameter: that of
/// a piece counts from where it begins, along it (ISO 10303-42), where OpenCASCADE takes it for the curve's.
/// Throws std::runtime_error where the beginning of a piece has no parameter and the one on it asks for it.
void restate_nested(StepGeom_TrimmedCurve& trimmed);

}  // namespace nurbeam
