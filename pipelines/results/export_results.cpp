#include "pipelines/results/export_results.h"

#include <algorithm>

#include "nurbs/bezier_path.h"
#include "pipelines/results/run_summary.h"

namespace nurbeam {

namespace {

/// What no CAD system can tell apart: above the round-off of the coordinates, far below 1e-12 of the size
/// [m].
double negligible(const BezierPath& path) {
  double size = 0, farthest = 0;
  for (const RationalCubic& segment : path.segments)
    for (int i = 0; i < 4; ++i) {
      if (i > 0) size += (segment.control_point(i) - segment.control_point(i - 1)).norm();
      farthest = std::max(farthest, segment.control_point(i).norm());
    }
  return std::max(2e-13 * size, 8e-16 * farthest);
}

}  // namespace

NurbsCurve deformed_curve(const std::vector<ElementRecord>& elements, CurveParameter parameter) {
  BezierPath path;
  for (const ElementRecord& element : elements) {
    if (path.breaks.empty()) path.breaks.push_back(element.s_start);
    path.segments.emplace_back(element.control_points);
    path.breaks.push_back(element.s_end);
  }
  return smooth_nurbs(path, parameter, negligible(path)).curve;
}

std::pair<double, std::vector<NamedCurve>> stored_curves(const std::filesystem::path& directory, double time,
                                                         CurveParameter parameter) {
  const auto [stored_time, beams] = read_stored_beams(directory, time);
  const std::map<std::string, std::string> drawn = drawn_curve_names(directory);
  std::vector<NamedCurve> curves;
  for (const StoredBeam& beam : beams) {
    const auto curve = drawn.find(beam.name);
    curves.push_back({curve == drawn.end() ? beam.name : curve->second,
                      deformed_curve(beam.elements, parameter), beam.name});
  }
  return {stored_time, curves};
}

}  // namespace nurbeam
