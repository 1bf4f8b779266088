#pragma once
#include <filesystem>

#include "pipelines/study/study_run.h"

namespace nurbeam {

/// study.html: one file, which needs no network: parallel coordinates, scatter plots, sensitivities, the
/// course of a search, the Pareto front, the best curves in 3-D. `study_case` is null where the study has no
/// case. Throws std::runtime_error (file and reason).
void write_study_report(const std::filesystem::path& file, const StudyFile& study,
                        const StudyCase* study_case, const StudyResult& result);

}  // namespace nurbeam
