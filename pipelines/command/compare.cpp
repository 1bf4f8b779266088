#include "pipelines/command/compare.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <ostream>
#include <string>

#include "nurbs/curve_distance.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/diagnostics/reading_progress.h"

namespace nurbeam {

namespace {

std::vector<NurbsCurve> curves_of(const std::vector<ImportedCurve>& imported) {
  std::vector<NurbsCurve> curves;
  for (const ImportedCurve& curve : imported) curves.push_back(curve.curve);
  return curves;
}

std::string name_of(const ImportReport& report, std::size_t curve) {
  const std::string& name = report.curves[curve].name;
  return "curve " + std::to_string(curve + 1) + (name.empty() ? "" : " \"" + name + "\"") + " of " +
         report.file;
}

/// The diagonal of the box of all control points [m].
double size_of(const std::vector<ImportedCurve>& a, const std::vector<ImportedCurve>& b) {
  Eigen::AlignedBox3d box;
  for (const auto* curves : {&a, &b})
    for (const ImportedCurve& curve : *curves)
      for (const auto& point : curve.curve.control_points().colwise()) box.extend(point.hnormalized());
  return box.diagonal().norm();
}

/// A distance beside the size of the files; 0 where it is their round-off.
std::string distance_text(double distance, double size) {
  constexpr double round_off = 1e-14;
  constexpr int digits = 6;
  return text_of(distance <= round_off * size ? 0 : distance, digits) + " m";
}

}  // namespace

FarthestPoint farthest_point(const std::vector<ImportedCurve>& a, const std::vector<ImportedCurve>& b) {
  const std::vector<NurbsCurve> targets = curves_of(b);
  const CurveDistance target(targets, 1e-8 * size_of(a, b));
  FarthestPoint farthest;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double distance = target.largest_from(a[i].curve);
    if (distance > farthest.distance) farthest = {distance, i};
  }
  return farthest;
}

int compare_files(const std::filesystem::path& a, const std::filesystem::path& b,
                  std::optional<double> given_tolerance, std::ostream& out, std::ostream& err) {
  const ImportReport reports[] = {read_with_progress(a, err), read_with_progress(b, err)};
  for (const ImportReport& report : reports) {
    print_diagnostics(err, report.diagnostics);
    if (!report.ok()) return 2;
    if (report.curves.empty()) {
      err << "error: " << report.file << ": holds no curve to compare\n";
      return 2;
    }
  }
  const double size = size_of(reports[0].curves, reports[1].curves);
  const double tolerance = given_tolerance.value_or(1e-6 * size);
  double largest = 0;
  for (const int from : {0, 1}) {
    const ImportReport &source = reports[from], &target = reports[1 - from];
    const FarthestPoint farthest = farthest_point(source.curves, target.curves);
    largest = std::max(largest, farthest.distance);
    out << "from " << source.file << " to " << target.file << ": " << distance_text(farthest.distance, size)
        << " (" << name_of(source, farthest.curve) << ")\n";
  }
  const bool same = largest <= tolerance;
  out << "largest distance: " << distance_text(largest, size) << ", " << text_of(largest / size, 3)
      << " of the size\n"
      << (same ? "the curves are the same" : "the curves differ") << ": the tolerance is "
      << text_of(tolerance, 6) << " m"
      << (given_tolerance ? "" : ", a millionth of the size; --tolerance LENGTH sets another") << "\n";
  return same ? 0 : 1;
}

}  // namespace nurbeam
