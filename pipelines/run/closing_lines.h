#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "fem/motion/record/simulation_report.h"
#include "pipelines/case/case_file.h"
#include "pipelines/results/run_summary.h"

namespace nurbeam {

/// What came of a run, in lines that a terminal of 80 columns has room for: its extremes with their places,
/// what bodies did at the ends of beams, its energy balance, the number of warnings, and where to look on.
/// Extremes have their time, of load steps their load factor. Values that are round-off are left out.
/// `report`: whether the run has one.
std::vector<std::string> closing_lines(const RunSummary& summary, const SimulationReport& run,
                                       const CaseAnalysis& analysis, const std::filesystem::path& out,
                                       bool report);

}  // namespace nurbeam
