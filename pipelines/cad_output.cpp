#include "pipelines/cad_output.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <utility>

#include "pipelines/export_results.h"
#include "pipelines/print_diagnostics.h"

namespace nurbeam {

CadOutput::CadOutput(const CaseFile& case_file, const std::vector<std::string>& curve_names,
                     std::filesystem::path directory)
    : case_(case_file), curve_names_(curve_names), directory_(std::move(directory)) {}

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
    curves.push_back({curve_names_[b], deformed_curve(frame.beams[b].elements, parameter)});
  return curves;
}

std::optional<Diagnostic> CadOutput::write_solids(const Frame& frame,
                                                  const std::filesystem::path& file) const {
  std::vector<NamedPipe> pipes;
  for (NamedCurve& axis : curves(frame, CurveParameter::free))
    pipes.push_back({std::move(axis), case_.beams[pipes.size()].section.radius.value()});
  return export_solids(file, pipes, parse_length_unit(case_.output.cad_unit));
}

void CadOutput::write(const Frame& frame, const std::string& format, RunSummary& summary) const {
  const std::string ending = format == "iges" ? ".igs" : format == "step" ? ".step" : "_solid.step";
  const std::filesystem::path name = stem(frame) + ending, file = directory_ / name;
  if (format == "step-solid") {
    if (auto problem = write_solids(frame, file)) {
      problem->severity = Severity::warning;
      print_diagnostics(std::cerr, {*problem});
      summary.diagnostics.push_back(*problem);
      return;
    }
  } else {
    export_curves(file, curves(frame, case_.output.cad_parameter), parse_length_unit(case_.output.cad_unit));
  }
  summary.files.push_back(name);
}

void CadOutput::write(const Frame& frame, RunSummary& summary) {
  if (is_wanted(frame))
    for (const std::string& format : case_.output.cad_formats) write(frame, format, summary);
  ++frame_;
}

}  // namespace nurbeam
