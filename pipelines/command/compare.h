#pragma once
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "cad_import/report/import_report.h"

namespace nurbeam {

/// How far the farthest point of some curves lies from all of some other curves.
struct FarthestPoint {
  double distance = 0;    ///< [m]
  std::size_t curve = 0;  ///< the curve it lies on, an index from 0
};

/// From every point of the curves `a` to the nearest of all curves `b` (so a curve that is cut in two in one
/// of them makes no difference), whatever their degree.
FarthestPoint farthest_point(const std::vector<ImportedCurve>& a, const std::vector<ImportedCurve>& b);

/// Prints the largest distance between the curves of two CAD files, both ways. Returns the exit code: 0 up to
/// the tolerance [m] (a millionth of the size of all curves, if none is given), 1 above it, 2 when a file
/// cannot be read or holds no curve.
int compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                  std::optional<double> tolerance, std::ostream& out, std::ostream& err);

}  // namespace nurbeam
