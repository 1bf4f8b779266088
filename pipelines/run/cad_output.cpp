#include "pipelines/run/cad_output.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cad_import/export_into_step.h"
#include "pipelines/results/export_results.h"
#include "pipelines/results/swept_section.h"

namespace nurbeam {

namespace {

constexpr std::size_t many = 64;  // files that wait

std::string ending_of(const std::string& format) {
  if (format == "iges") return ".igs";
  if (format == "dxf") return ".dxf";
  if (format == "brep") return ".brep";
  if (format == "step-solid") return "_solid.step";
  if (format == "step-section-lines") return "_section_lines.step";
  if (format == "step-source") return "_source.step";
  return ".step";
}

Diagnostic not_swept(const std::filesystem::path& file, const std::string& beam, const std::string& why) {
  return {Severity::warning, file.string(),
          "not written: the section of beam \"" + beam + "\" cannot be swept, as " + why +
              "; write the curves, which have every shape"};
}

// Where its lines go through the section of a beam: the corners of its profile, or what stands for them.
std::vector<Eigen::Vector2d> section_places(const BuiltModel& built, std::size_t b) {
  if (const auto& drawn = built.sources[b].profile) return marked_places(drawn->profile.loops);
  if (const auto& radius = built.model.beams[b].section.radius)
    return {{*radius, 0}, {0, *radius}, {-*radius, 0}, {0, -*radius}};
  const std::vector<Eigen::Vector2d>& outline = built.sources[b].outline.front();
  const std::size_t quarter = outline.size() / 4;
  return {outline[0], outline[quarter], outline[2 * quarter], outline[3 * quarter]};
}

}  // namespace

CadOutput::CadOutput(const CaseFile& case_file, const BuiltModel& built, std::filesystem::path directory,
                     std::size_t first_frame)
    : case_(case_file), built_(built), directory_(std::move(directory)), frame_(first_frame) {}

bool CadOutput::is_wanted(const Snapshot& frame) const {
  const bool one_frame =
      case_.analysis.type == CaseAnalysis::Type::statics && case_.analysis.load_factors.empty();
  if (one_frame || case_.output.cad_at_all_times) return true;
  return std::ranges::any_of(case_.output.cad_times,
                             [&](double t) { return case_.analysis.is_same_time(t, frame.time); });
}

std::string CadOutput::time_text(double time) const {
  constexpr int usual_digits = 6, most_digits = std::numeric_limits<double>::max_digits10;
  const auto text = [](double t, int digits) {
    std::ostringstream stream;
    stream << std::setprecision(digits) << t;
    return stream.str();
  };
  int digits = usual_digits;
  const auto is_other = [&](double t) {
    return !case_.analysis.is_same_time(t, time) && text(t, digits) == text(time, digits);
  };
  while (digits < most_digits && std::ranges::any_of(case_.output.cad_times, is_other)) ++digits;
  return text(time, digits);
}

// Numbers of one width, so that the names sort as the frames follow each other.
std::string CadOutput::stem(const Snapshot& frame) const {
  std::ostringstream name;
  name << "deformed";
  const bool statics = case_.analysis.type == CaseAnalysis::Type::statics;
  const std::vector<double>& factors = case_.analysis.load_factors;
  if (statics && (factors.empty() || (!case_.output.cad_at_all_times && case_.output.cad_times.size() == 1)))
    return name.str();
  if (!case_.output.cad_at_all_times) {
    name << "_t" << time_text(frame.time);
    return name.str();
  }
  const double last = statics              ? static_cast<double>(factors.size())
                      : case_.output.every ? case_.analysis.end_time / *case_.output.every
                                           : 0;
  const std::size_t width = std::max<std::size_t>(4, std::to_string(std::lround(last) + 1).size());
  name << '_' << std::setfill('0') << std::setw(int(width)) << frame_;
  return name.str();
}

std::vector<NamedCurve> CadOutput::curves(const Snapshot& frame, CurveParameter parameter,
                                          WholeConics conics) const {
  std::vector<NamedCurve> curves;
  for (std::size_t b = 0; b < frame.beams.size(); ++b)
    curves.push_back({built_.sources[b].curve_name,
                      deformed_curve(frame.beams[b].elements, parameter, conics),
                      built_.model.beams[b].name});
  return curves;
}

void CadOutput::flush() {
  if (pending_.empty()) return;
  const std::vector<CurvesFile> files = std::exchange(pending_, {});
  for (const Diagnostic& problem : export_curves(files))
    throw std::runtime_error(problem.where + ": " + problem.message);  // every shape can be written so
}

std::vector<Diagnostic> CadOutput::write_solids(const Snapshot& frame,
                                                const std::filesystem::path& file) const {
  std::vector<NamedSolid> solids;
  std::vector<NamedCurve> axes = curves(frame, CurveParameter::free, WholeConics::smooth);
  for (std::size_t b = 0; b < axes.size(); ++b) {
    if (built_.model.beams[b].rigid) continue;
    NamedCurve& axis = axes[b];
    if (const auto& drawn = built_.sources[b].profile) {
      if (const auto obstacle = sweeping_obstacle(frame.beams[b]))
        return {not_swept(file, built_.model.beams[b].name, *obstacle)};
      solids.emplace_back(
          swept_section(frame.beams[b], drawn->profile.loops, drawn->profile.area, axis.name, axis.part));
      continue;
    }
    const Section& section = built_.model.beams[b].section;
    solids.emplace_back(NamedPipe{std::move(axis), section.radius.value(), section.bore.value_or(0)});
  }
  return export_solids(file, solids, parse_length_unit(case_.output.cad_unit), case_.output.cad_schema);
}

std::vector<Diagnostic> CadOutput::write_section_lines(const Snapshot& frame,
                                                       const std::filesystem::path& file) const {
  std::vector<NamedCurve> lines;
  for (std::size_t b = 0; b < frame.beams.size(); ++b) {
    if (built_.model.beams[b].rigid) continue;
    const std::string& name = built_.model.beams[b].name;
    if (const auto obstacle = sweeping_obstacle(frame.beams[b])) return {not_swept(file, name, *obstacle)};
    const std::vector<Eigen::Vector2d> places = section_places(built_, b);
    for (std::size_t i = 0; i < places.size(); ++i)
      lines.push_back({built_.sources[b].curve_name + " line " + std::to_string(i + 1),
                       section_line(frame.beams[b], places[i]),
                       name + (places.size() > 1 ? " line " + std::to_string(i + 1) : "")});
  }
  return export_curves(file, lines, parse_length_unit(case_.output.cad_unit), case_.output.cad_schema);
}

std::vector<Diagnostic> CadOutput::write_into_source(const Snapshot& frame,
                                                     const std::filesystem::path& file) const {
  std::vector<DeformedCurve> deformed;
  for (const NamedCurve& axis : curves(frame, case_.output.cad_parameter, WholeConics::as_drawn)) {
    const AxisSource& drawn = built_.sources[deformed.size()].axis.value();
    deformed.push_back({drawn.first, drawn.reversed ? axis.curve.reversed() : axis.curve, axis.name,
                        drawn.curves.size() > 1});
  }
  return export_into_step(built_.sources.front().axis.value().file, file, deformed);
}

void CadOutput::write(const Snapshot& frame, const std::string& format,
                      std::vector<Diagnostic>& diagnostics) {
  const std::filesystem::path name = stem(frame) + ending_of(format), file = directory_ / name;
  std::vector<Diagnostic> found;
  if (format == "step-solid")
    found = write_solids(frame, file);
  else if (format == "step-section-lines")
    found = write_section_lines(frame, file);
  else if (format == "step-source")
    found = write_into_source(frame, file);
  else
    pending_.push_back({file,
                        curves(frame, case_.output.cad_parameter, whole_conics_in(written_format(file))),
                        parse_length_unit(case_.output.cad_unit), case_.output.cad_schema});
  for (Diagnostic& diagnostic : found) diagnostic.severity = Severity::warning;  // the run goes on
  const auto is_known = [&](const Diagnostic& d) {                               // from an earlier frame
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [&](const Diagnostic& s) { return s.where == d.where && s.message == d.message; });
  };
  std::erase_if(found, is_known);
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
}

void CadOutput::write(const Snapshot& frame, std::vector<Diagnostic>& diagnostics) {
  if (is_wanted(frame))
    for (const std::string& format : case_.output.cad_formats) write(frame, format, diagnostics);
  if (pending_.size() >= many) flush();
  ++frame_;
}

}  // namespace nurbeam
