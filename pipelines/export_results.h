#pragma once
#include <filesystem>
#include <utility>
#include <vector>

#include "cad_import/export_curves.h"
#include "pipelines/results.h"

namespace nurbeam {

/// The deformed axis through the elements of one beam, in order: one NURBS curve over reference arc length.
NurbsCurve deformed_curve(const std::vector<ElementRecord>& elements);

/// The deformed axes stored nearest to `time` [s] in a results directory, and the time they were stored at.
/// Throws as read_stored_beams() does.
std::pair<double, std::vector<NamedCurve>> stored_curves(const std::filesystem::path& directory, double time);

}  // namespace nurbeam
