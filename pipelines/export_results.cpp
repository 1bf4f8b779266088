#include "pipelines/export_results.h"

#include "nurbs/bezier_path.h"

namespace nurbeam {

NurbsCurve deformed_curve(const std::vector<ElementRecord>& elements) {
  BezierPath path;
  for (const ElementRecord& element : elements) {
    if (path.breaks.empty()) {
      path.breaks.push_back(element.s_start);
    }
    path.segments.emplace_back(element.control_points);
    path.breaks.push_back(element.s_end);
  }
  return path.to_nurbs();
}

std::pair<double, std::vector<NamedCurve>> stored_curves(const std::filesystem::path& directory,
                                                         double time) {
  const auto [stored_time, beams] = read_stored_beams(directory, time);
  std::vector<NamedCurve> curves;
  for (const StoredBeam& beam : beams) {
    curves.push_back({beam.name, deformed_curve(beam.elements)});
  }
  return {stored_time, curves};
}

}  // namespace nurbeam
