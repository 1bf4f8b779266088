#include "pipelines/run/cad_output.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>
#include <variant>

#include "cad_import/export_into_step.h"
#include "cad_import/import_curves.h"
#include "nurbs/closest_point.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/results/export_results.h"

namespace nurbeam {

namespace {

/// The curve that is the axis of the beam, which the case read from a file: by its place, so that it does not
/// matter how the case chose it. A curve that is only a part of the axis, or else the first, when none is.
DrawnAxis drawn_axis(const Beam& beam, const ModelFrame& frame, const std::vector<ImportedCurve>& curves) {
  constexpr double near = 1e-5;  // of the length; approximated axes depart by their tolerance
  const double L = beam.curve.length();
  const auto on_axis = [&](double s) { return frame.to_world(beam.curve.position(s)); };
  std::vector<DrawnAxis> candidates;
  for (const ImportedCurve& imported : curves) {
    const NurbsCurve& curve = imported.curve;
    const BezierPath path = BezierPath::from_nurbs(curve, near * L);
    const auto distance = [&](double s) { return closest_point(path, on_axis(s)).distance; };
    const Eigen::Vector3d start = curve.point(curve.knots().start()), end = curve.point(curve.knots().end());
    const bool reversed = (start - on_axis(0)).norm() > (end - on_axis(0)).norm();
    if (distance(0) > near * L) continue;
    const bool whole =
        distance(L / 3) <= near * L && distance(L) <= near * L && std::abs(path.length() - L) <= near * L;
    candidates.push_back({curve, reversed, whole});
    if (whole) return candidates.back();
  }
  return candidates.empty() ? DrawnAxis{curves.front().curve, false, false} : candidates.front();
}

/// Radius of the bore of a section that is a disk or an annulus of the outer radius R; 0 for a disk [m].
/// I / A = (R^2 + r^2) / 4 for an annulus; what round-off leaves of a disk's r^2 is far below `least`.
double bore_of(const BeamProperties& section, double R) {
  constexpr double least = 1e-9;  // of R^2
  const double squared = 4 * section.bending_stiffness / section.axial_stiffness - R * R;
  return squared > least * R * R ? std::sqrt(squared) : 0;
}

std::string ending_of(const std::string& format) {
  if (format == "iges") return ".igs";
  if (format == "step-solid") return "_solid.step";
  if (format == "step-source") return "_source.step";
  return ".step";
}

}  // namespace

CadOutput::CadOutput(const CaseFile& case_file, const BuiltModel& built, std::filesystem::path directory,
                     std::size_t first_frame)
    : case_(case_file), built_(built), directory_(std::move(directory)), frame_(first_frame) {
  const std::vector<std::string>& formats = case_.output.cad_formats;
  if (std::find(formats.begin(), formats.end(), "step-source") == formats.end()) return;
  const ImportReport source = import_curves(std::get<AxisFile>(case_.beams.front().axis.source).path);
  for (const Beam& beam : built_.model.beams) drawn_.push_back(drawn_axis(beam, built_.frame, source.curves));
}

bool CadOutput::is_wanted(const Frame& frame) const {
  if (case_.analysis.type == CaseAnalysis::Type::statics || case_.output.cad_at_all_times) return true;
  const double same = 1e-9 * std::max(case_.analysis.end_time, 1e-9);
  return std::any_of(case_.output.cad_times.begin(), case_.output.cad_times.end(),
                     [&](double t) { return std::abs(t - frame.time) < same; });
}

// Numbers of one width, so that the names sort as the frames follow each other.
std::string CadOutput::stem(const Frame& frame) const {
  std::ostringstream name;
  name << "deformed";
  if (case_.analysis.type == CaseAnalysis::Type::statics) return name.str();
  if (!case_.output.cad_at_all_times) {
    name << "_t" << frame.time;
    return name.str();
  }
  const double last = case_.analysis.end_time / case_.output.every.value_or(case_.analysis.end_time);
  const std::size_t width = std::max<std::size_t>(4, std::to_string(std::lround(last) + 1).size());
  name << '_' << std::setfill('0') << std::setw(int(width)) << frame_;
  return name.str();
}

std::vector<NamedCurve> CadOutput::curves(const Frame& frame, CurveParameter parameter) const {
  std::vector<NamedCurve> curves;
  for (std::size_t b = 0; b < frame.beams.size(); ++b)
    curves.push_back({built_.curve_names[b], deformed_curve(frame.beams[b].elements, parameter)});
  return curves;
}

std::vector<Diagnostic> CadOutput::write_solids(const Frame& frame, const std::filesystem::path& file) const {
  std::vector<NamedPipe> pipes;
  for (NamedCurve& axis : curves(frame, CurveParameter::free)) {
    const std::size_t b = pipes.size();
    const double radius = built_.radii[b].value();
    pipes.push_back({std::move(axis), radius, bore_of(built_.model.beams[b].properties, radius)});
  }
  const auto problem = export_solids(file, pipes, parse_length_unit(case_.output.cad_unit));
  return problem ? std::vector{*problem} : std::vector<Diagnostic>{};
}

std::vector<Diagnostic> CadOutput::write_into_source(const Frame& frame,
                                                     const std::filesystem::path& file) const {
  std::vector<DeformedCurve> deformed;
  for (const NamedCurve& axis : curves(frame, case_.output.cad_parameter)) {
    const DrawnAxis& drawn = drawn_[deformed.size()];
    deformed.push_back(
        {drawn.curve, drawn.reversed ? axis.curve.reversed() : axis.curve, axis.name, !drawn.whole});
  }
  return export_into_step(std::get<AxisFile>(case_.beams.front().axis.source).path, file, deformed);
}

void CadOutput::write(const Frame& frame, const std::string& format,
                      std::vector<Diagnostic>& diagnostics) const {
  const std::filesystem::path name = stem(frame) + ending_of(format), file = directory_ / name;
  std::vector<Diagnostic> found;
  if (format == "step-solid")
    found = write_solids(frame, file);
  else if (format == "step-source")
    found = write_into_source(frame, file);
  else
    export_curves(file, curves(frame, case_.output.cad_parameter), parse_length_unit(case_.output.cad_unit));
  for (Diagnostic& diagnostic : found) diagnostic.severity = Severity::warning;  // the run goes on
  const auto is_known = [&](const Diagnostic& d) {                               // from an earlier frame
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [&](const Diagnostic& s) { return s.where == d.where && s.message == d.message; });
  };
  std::erase_if(found, is_known);
  print_diagnostics(std::cerr, found);
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
}

void CadOutput::write(const Frame& frame, std::vector<Diagnostic>& diagnostics) {
  if (is_wanted(frame))
    for (const std::string& format : case_.output.cad_formats) write(frame, format, diagnostics);
  ++frame_;
}

}  // namespace nurbeam
