#pragma once
#include <filesystem>
#include <utility>
#include <vector>

#include "cad_import/export_curves.h"
#include "nurbs/smooth/smooth_nurbs.h"
#include "pipelines/results/results.h"

namespace nurbeam {

/// The deformed axis through the elements of one beam, in order: one NURBS curve of the lowest exact degree
/// with few control points, within 1e-12 of its size; over reference arc length at the elements' ends with
/// CurveParameter::material.
NurbsCurve deformed_curve(const std::vector<ElementRecord>& elements,
                          CurveParameter parameter = CurveParameter::free);

/// The deformed axes stored nearest to `time` [s] in a results directory, under the names of the drawn
/// curves, each a part under that of its beam, and the time they were stored at. Throws as
/// read_stored_beams() does.
std::pair<double, std::vector<NamedCurve>> stored_curves(const std::filesystem::path& directory, double time,
                                                         CurveParameter parameter = CurveParameter::free);

}  // namespace nurbeam
