#include "pipelines/results/export_results.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "nurbs/bezier_path.h"
#include "nurbs/smooth/drawn_conic.h"
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

WholeConics whole_conics_in(CadFormat format) {
  return format == CadFormat::iges ? WholeConics::smooth : WholeConics::as_drawn;
}

std::vector<ElementRecord> exaggerated(std::vector<ElementRecord> elements, double factor) {
  if (factor == 1) return elements;
  for (ElementRecord& element : elements) {
    if (!element.drawn_points.allFinite())
      throw std::invalid_argument(
          "the drawn shape is not in these results, which an earlier version wrote; run the case again");
    for (int i = 0; i < 4; ++i) {
      auto point = element.control_points.col(i);
      const Eigen::Vector3d drawn = element.drawn_points.col(i);
      point.head<3>() = point[3] * (drawn + factor * (point.head<3>() / point[3] - drawn));
    }
  }
  return elements;
}

NurbsCurve deformed_curve(const std::vector<ElementRecord>& elements, CurveParameter parameter,
                          WholeConics conics) {
  BezierPath path;
  for (const ElementRecord& element : elements) {
    if (path.breaks.empty()) path.breaks.push_back(element.s_start);
    path.segments.emplace_back(element.control_points);
    path.breaks.push_back(element.s_end);
  }
  if (conics == WholeConics::as_drawn && parameter == CurveParameter::free)
    if (const std::optional<SmoothNurbs> drawn = drawn_conic(path, negligible(path))) return drawn->curve;
  return smooth_nurbs(path, parameter, negligible(path)).curve;
}

std::pair<double, std::vector<NamedCurve>> stored_curves(const std::filesystem::path& directory, double time,
                                                         CurveParameter parameter, WholeConics conics,
                                                         double exaggeration) {
  const auto [stored_time, beams] = read_stored_beams(directory, time);
  const std::map<std::string, std::string> drawn = drawn_curve_names(directory);
  std::vector<NamedCurve> curves;
  for (const StoredBeam& beam : beams) {
    const auto curve = drawn.find(beam.name);
    curves.push_back({curve == drawn.end() ? beam.name : curve->second,
                      deformed_curve(exaggerated(beam.elements, exaggeration), parameter, conics),
                      beam.name});
  }
  return {stored_time, curves};
}

}  // namespace nurbeam
