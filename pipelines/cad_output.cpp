#include "pipelines/cad_output.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "cad_import/export_curves.h"
#include "pipelines/export_results.h"

namespace nurbeam {

CadOutput::CadOutput(const CaseOutput& output, const CaseAnalysis& analysis,
                     const std::vector<std::string>& curve_names, std::filesystem::path directory)
    : output_(output), analysis_(analysis), curve_names_(curve_names), directory_(std::move(directory)) {}

bool CadOutput::is_wanted(const Frame& frame) const {
  if (analysis_.type == CaseAnalysis::Type::statics) return true;
  const double same = 1e-9 * std::max(analysis_.end_time, 1e-9);
  return std::any_of(output_.cad_times.begin(), output_.cad_times.end(),
                     [&](double t) { return std::abs(t - frame.time) < same; });
}

void CadOutput::write(const Frame& frame, std::vector<std::filesystem::path>& files) const {
  if (!is_wanted(frame)) return;
  std::vector<NamedCurve> curves;
  for (std::size_t b = 0; b < frame.beams.size(); ++b)
    curves.push_back({curve_names_[b], deformed_curve(frame.beams[b].elements)});
  for (const std::string& format : output_.cad_formats) {
    std::ostringstream name;
    name << "deformed";
    if (analysis_.type != CaseAnalysis::Type::statics) name << "_t" << frame.time;
    name << (format == "iges" ? ".igs" : ".step");
    export_curves(directory_ / name.str(), curves, parse_length_unit(output_.cad_unit));
    files.emplace_back(name.str());
  }
}

}  // namespace nurbeam
